"""Range checks of parameters: one message that names value, unit and range."""

import math
from collections.abc import Sized


def require(
    owner: str,
    name: str,
    value: float,
    unit: str,
    *,
    above: float | None = None,
    at_least: float | None = None,
    at_most: float | None = None,
) -> None:
    """Checks that a parameter is a finite number within its range.

    Raises:
        ValueError: it is not; the message names owner, value, unit and range.
    """
    bounds = [
        text
        for bound, text in (
            (above, f"> {above}"),
            (at_least, f">= {at_least}"),
            (at_most, f"<= {at_most}"),
        )
        if bound is not None
    ]
    number = isinstance(value, (int, float)) and math.isfinite(value)
    if (
        not number
        or (above is not None and not value > above)
        or (at_least is not None and not value >= at_least)
        or (at_most is not None and not value <= at_most)
    ):
        expected = " and ".join(bounds) or "a finite number"
        found = f"{value!r} {unit}".rstrip()
        raise ValueError(f"{owner}: {name} is {found}, expected {expected}")


def require_some(owner: str, items: Sized) -> None:
    """Checks that a system of several has at least one.

    Raises:
        ValueError: it has none.
    """
    if not len(items):
        raise ValueError(f"{owner}: found no parameters, expected at least one")


def require_index(owner: str, which: int, count: int) -> None:
    """Checks that `which` is one of several.

    Raises:
        ValueError: it is not.
    """
    if not 0 <= which < count:
        raise ValueError(f"{owner}: which {which}, expected 0 to {count - 1}")

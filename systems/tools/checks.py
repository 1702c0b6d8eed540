"""Checks of parameters: one message that names value, unit and range."""

import math
from collections.abc import Sequence, Sized
from itertools import pairwise


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


def points_of_curve(
    owner: str, x: Sequence[float], y: Sequence[float], name: str, unit: str = ""
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Abscissae and ordinates as floats, checked.

    Args:
        owner: what has the curve.
        x, y: (n,), (n,).
        name, unit: of the abscissae.

    Raises:
        ValueError: as for `ascending`; the lengths differ, an ordinate is not finite.
    """
    at = ascending(owner, x, name, unit)
    values = tuple(float(value) for value in y)
    if len(values) != len(at):
        raise ValueError(
            f"{owner}: {len(values)} values at {len(at)} points, expected one at each"
        )
    if not all(map(math.isfinite, values)):
        raise ValueError(f"{owner}: a value is not a finite number")
    return at, values


def ascending(
    owner: str, values: Sequence[float], name: str, unit: str = ""
) -> tuple[float, ...]:
    """Two or more finite numbers that strictly ascend, as floats.

    Raises:
        ValueError: they are not; the first pair that does not ascend is named.
    """
    found = tuple(float(value) for value in values)
    if len(found) < 2:
        raise ValueError(f"{owner}: {len(found)} points, expected two or more")
    if not all(map(math.isfinite, found)):
        raise ValueError(f"{owner}: a {name} is not a finite number")
    for before, after in pairwise(found):
        if not after > before:
            pair = f"{after} {unit}".rstrip(), f"{before} {unit}".rstrip()
            raise ValueError(
                f"{owner}: {name} {pair[0]} follows {pair[1]}, expected strictly "
                "ascending ones"
            )
    return found


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

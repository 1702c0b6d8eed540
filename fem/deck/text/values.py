"""Texts of fields to integers, reals and component digits, as Nastran writes them."""

import re
from collections.abc import Callable
from typing import Any

_EXPONENT = re.compile(
    r"([+-]?(?:\d+\.?\d*|\.\d+))(?:(?: *[ED] *)?([+-]\d+)| *[ED] *(\d+))$"
)
_APART = re.compile(r"(?<=\d) (?=\d)")
_LARGEST_ID = 10**12


class Malformed(ValueError):
    """A field that is not what its card asks for; the text says what was expected."""


def integer(text: str) -> int:
    """An integer."""
    try:
        value = int(text)
    except ValueError:
        raise Malformed("an integer") from None
    if "_" in text or not text.isascii() or abs(value) > _LARGEST_ID:
        raise Malformed("an integer")
    return value


def real(text: str) -> float:
    """A real number: 1.5, -.5, 2.9+7, 1.E-3, 1.D3; an integer will do as well.

    Blanks around the letter of the exponent are those of Fortran's formats.

    >>> real("2.9+7"), real("1.D3"), real("-.5"), real("2.0  E+7")
    (29000000.0, 1000.0, -0.5, 20000000.0)
    """
    try:
        value = float(text)
        plain = text.isascii() and "_" not in text and "N" not in text
    except ValueError:
        match = _EXPONENT.match(text)
        if match is None:
            raise Malformed("a real number") from None
        mantissa, signed, unsigned = match.groups()
        value, plain = float(f"{mantissa}e{signed or unsigned}"), True
    if not plain or value in (float("inf"), float("-inf")):
        raise Malformed("a real number")
    return value


def components(text: str) -> str:
    """Digits 1 to 6 in ascending order without repetition, or '0'.

    Single blanks between digits keep translations and rotations apart for the eye.

    >>> components("6213"), components("12 456")
    ('1236', '12456')
    """
    text = _APART.sub("", text)
    if not text.isascii() or not text.isdigit() or set(text) - set("0123456"):
        raise Malformed("component digits 1 to 6")
    digits = "".join(sorted(set(text) - {"0"}))
    return digits or "0"


def word(text: str) -> str:
    """A name."""
    return text


def grid_or_real(text: str) -> int | float:
    """An integer (a grid) or a real number (part of a vector)."""
    try:
        return integer(text)
    except Malformed:
        return real(text)


CONVERTERS: dict[str, Callable[[str], Any]] = {
    "i": integer,
    "f": real,
    "c": components,
    "s": word,
    "u": grid_or_real,
}

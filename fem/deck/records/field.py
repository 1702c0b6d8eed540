"""One field of a card, or one column of its table, as a word of a record.

`name:kind`, then what applies of `=default`, `[dimension]`, `>references`:

    mid1:i=0>MAT1|MAT2|MAT8     z1:f=nan[L]     nsm:f=0.[M/L2]     g0:i>GRID?

Kinds: i integer, f real, c component digits, s word, u integer or real, * sequence. A
field without default is required; a default may be the name of an earlier field. `-` is
a field that is not used. Fields in parentheses repeat, in groups, to the end of the
card; each group becomes a row.

Dimensions are products of M (mass) and L (length): `ML2`, `M/L3`; `1` has none, which
goes without saying beside fields that have one. References name the cards whose ids
may stand there, or GRID, POINT (grid or scalar point), FREEDOM (extra points, too),
CORD, SURFACE (elements with one
face), FACES (elements with faces); a blank, 0, is admitted by GRID?, and by all others.
"""

import math
import re
from dataclasses import dataclass
from functools import cache
from typing import Any

from fem.deck.text.values import CONVERTERS

_FIELD = re.compile(
    r"(?P<name>\w+):(?P<kind>[ifcsu*])(?:=(?P<default>[^\[>]*))?"
    r"(?:\[(?P<dimension>[ML\d/]+)\])?(?:>(?P<targets>\S+))?"
)


@dataclass(frozen=True)
class Field:
    """One word of a record.

    Attributes:
        name: lower-case name of the field, the column of the table.
        kind: see the module's text.
        default: None: required; a tuple names an earlier field.
        dimension: "M/L2"; "" where none is given.
        targets: names of the cards that it refers to.
        blank: the reference may be 0.
    """

    name: str
    kind: str
    default: Any = None
    dimension: str = ""
    targets: tuple[str, ...] = ()
    blank: bool = True


@dataclass(frozen=True)
class Layout:
    """Fields before the parentheses, fields within them."""

    fixed: tuple[Field, ...]
    repeated: tuple[Field, ...]


@cache
def layout(text: str) -> Layout:
    """The description of a card, parsed.

    Raises:
        ValueError: a word that is no field (an error in the program).
    """
    fixed, _, repeated = text.partition("(")
    return Layout(_fields(fixed), _fields(repeated.rstrip(" )")))


def _fields(text: str) -> tuple[Field, ...]:
    return tuple(map(_field, text.split()))


def _field(word: str) -> Field:
    if word == "-":
        return Field("-", "-")
    match = _FIELD.fullmatch(word)
    if match is None:
        raise ValueError(f"record: found '{word}', expected name:kind=default[L]>CARD")
    kind, targets = match["kind"], match["targets"] or ""
    return Field(
        name=match["name"],
        kind=kind,
        default=_default(kind, match["default"]),
        dimension=match["dimension"] or "",
        targets=tuple(targets.rstrip("?").split("|")) if targets else (),
        blank=targets != "GRID",
    )


def _default(kind: str, text: str | None) -> Any:
    """The default of a field; a tuple names an earlier field."""
    if text is None or kind in "sc":
        return text
    if text == "nan":
        return math.nan
    if re.match(r"[a-z]", text):
        return (text,)
    return CONVERTERS[kind](text)

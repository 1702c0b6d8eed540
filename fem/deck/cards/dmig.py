"""DMIG: matrices given directly, one card of header and one per column.

Complex ones (TIN 3, 4) have two values a term: real and imaginary part, or with POLAR
amplitude and phase in degrees.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.lexer import RawCard
from fem.deck.text.values import Malformed

_SYMMETRIC = 6
_REAL, _COMPLEX = (1, 2), (3, 4)

_Term = tuple[int, int, int, int, float, float]


@dataclass(frozen=True)
class _Head:
    """What the header of a matrix says."""

    card: RawCard
    form: int
    complex: bool
    polar: bool


def read_dmig(cards: Sequence[RawCard], problems: list[str]) -> list[dict[str, Any]]:
    """Rows of the DMIG table, one per matrix, symmetric ones completed."""
    headers: dict[str, _Head] = {}
    terms: dict[str, list[_Term]] = {}
    for card in cards:
        fields = Fields(card)
        try:
            name = fields.word(1, "NAME")
            if fields.text(2) == "0":
                headers[name] = _head(fields)
            else:
                terms.setdefault(name, []).extend(_column(fields))
        except Malformed as error:
            problems.append(f"{card.place}: DMIG {error}: {card}")
    for name in terms.keys() - headers.keys():
        problems.append(f"DMIG {name} has no header (third field 0)")
    return [_row(name, head, terms.get(name, [])) for name, head in headers.items()]


def _head(fields: Fields) -> _Head:
    form, kind = fields.integer(3, "IFO"), fields.integer(4, "TIN", 1)
    if form not in (1, 2, 6, 9):
        raise Malformed(f"field IFO: found {form}, expected 1, 2, 6 or 9")
    if kind not in (*_REAL, *_COMPLEX):
        raise Malformed(f"field TIN: found {kind}, expected 1 to 4")
    polar = fields.integer(6, "POLAR", 0) > 0
    return _Head(fields.card, form, kind in _COMPLEX, polar)


def _column(fields: Fields) -> list[_Term]:
    column, c = fields.integer(2, "GJ"), fields.integer(3, "CJ", 0)
    return [
        (
            fields.integer(k, "G"),
            fields.integer(k + 1, "C", 0),
            column,
            c,
            fields.real(k + 2, "A"),
            fields.real(k + 3, "B", 0.0),
        )
        for k in fields.groups(5, 4)
    ]


def _row(name: str, head: _Head, terms: list[_Term]) -> dict[str, Any]:
    if head.form == _SYMMETRIC:
        mirrored = [
            (c, cc, r, rc, a, b) for r, rc, c, cc, a, b in terms if (r, rc) != (c, cc)
        ]
        terms = terms + mirrored
    columns = list(zip(*terms)) or [()] * 6
    keys = ("rowids", "rowcs", "colids", "colcs")
    row: dict[str, Any] = {
        key: np.array(values, dtype=np.int64) for key, values in zip(keys, columns)
    }
    values, second = np.array(columns[4:6], dtype=np.float64)
    if head.complex and head.polar:
        values = values * np.exp(1j * np.radians(second))
    elif head.complex:
        values = values + 1j * second
    row.update(name=name, form=head.form, values=values)
    return {**row, "file": head.card.file, "line": head.card.line}

"""DMIG: matrices given directly, one card of header and one per column."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.lexer import RawCard
from fem.deck.text.values import Malformed

_SYMMETRIC = 6


def read_dmig(cards: Sequence[RawCard], problems: list[str]) -> list[dict[str, Any]]:
    """Rows of the DMIG table, one per matrix, symmetric ones completed."""
    headers: dict[str, tuple[RawCard, int]] = {}
    terms: dict[str, list[tuple[int, int, int, int, float]]] = {}
    for card in cards:
        fields = Fields(card)
        try:
            name = fields.word(1, "NAME")
            if fields.text(2) == "0":
                headers[name] = (card, _form(fields))
            else:
                terms.setdefault(name, []).extend(_column(fields))
        except Malformed as error:
            problems.append(f"{card.place}: DMIG {error}: {card}")
    for name in terms.keys() - headers.keys():
        problems.append(f"DMIG {name} has no header (third field 0)")
    return [
        _row(name, card, form, terms.get(name, []))
        for name, (card, form) in headers.items()
    ]


def _form(fields: Fields) -> int:
    form, kind = fields.integer(3, "IFO"), fields.integer(4, "TIN", 1)
    if form not in (1, 2, 6, 9):
        raise Malformed(f"field IFO: found {form}, expected 1, 2, 6 or 9")
    if kind not in (1, 2):
        raise Malformed(f"field TIN: found {kind}, expected a real matrix, 1 or 2")
    return form


def _column(fields: Fields) -> list[tuple[int, int, int, int, float]]:
    column, c = fields.integer(2, "GJ"), fields.integer(3, "CJ", 0)
    return [
        (
            fields.integer(k, "G"),
            fields.integer(k + 1, "C", 0),
            column,
            c,
            fields.real(k + 2, "A"),
        )
        for k in fields.groups(5, 4)
    ]


def _row(
    name: str, card: RawCard, form: int, terms: list[tuple[int, int, int, int, float]]
) -> dict[str, Any]:
    if form == _SYMMETRIC:
        mirrored = [
            (c, cc, r, rc, a) for r, rc, c, cc, a in terms if (r, rc) != (c, cc)
        ]
        terms = terms + mirrored
    columns = list(zip(*terms)) or [()] * 5
    keys = ("rowids", "rowcs", "colids", "colcs")
    row: dict[str, Any] = {
        key: np.array(values, dtype=np.int64) for key, values in zip(keys, columns)
    }
    row.update(name=name, form=form, values=np.array(columns[4], dtype=np.float64))
    return {**row, "file": card.file, "line": card.line}

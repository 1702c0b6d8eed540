"""Cards as texts to the tables that their records describe."""

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
import pandas as pd

from fem.deck.records import CARDS, TABLES, Card, table_of
from fem.deck.records.fixed_fields import read_regular
from fem.deck.text.fields import Fields
from fem.deck.text.lexer import RawCard
from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]
External = Callable[[RawCard, Callable[[Any], Rows]], Rows]


def make_tables(
    cards: Mapping[str, Sequence[RawCard]],
    external: External,
    problems: list[str],
    notices: list[str],
) -> dict[str, pd.DataFrame]:
    """All tables of the records.

    Args:
        cards: supported cards by name.
        external: rows of single cards by way of pyNastran's objects.
        problems: what is wrong is appended.
        notices: what is remarkable is appended.
    """
    for record in CARDS.values():
        if record.fills:
            _apply_defaults(record.name, *record.fills, cards, problems)
    pieces: dict[str, list[dict[str, list]]] = {}
    for name, group in cards.items():
        record = CARDS[name]
        if record.fills:
            continue
        columns = _columns(record, group, external, problems, notices)
        if columns:
            columns["card"] = [name] * len(columns["line"])
            pieces.setdefault(table_of(name), []).append(columns)
    return {
        name: _frame(record, pieces[name]) if name in pieces else _without_rows(name)
        for name, record in TABLES.items()
    }


def _columns(
    record: Card,
    cards: Sequence[RawCard],
    external: External,
    problems: list[str],
    notices: list[str],
) -> dict[str, list]:
    if record.gather:
        return _columns_of_rows(record.gather(cards, problems))
    if record.fields:
        columns = read_regular(cards, record.fields, problems, notices)
        if record.finish:
            record.finish(columns, problems)
        return columns
    rows: list[dict[str, Any]] = []
    for card in cards:
        try:
            made = _rows(record, card, external)
        except Malformed as error:
            problems.append(f"{card.place}: {card.name} {error}: {card}")
            continue
        for row in made:
            row["file"], row["line"] = card.file, card.line
        rows += made
    return _columns_of_rows(rows)


def _rows(record: Card, card: RawCard, external: External) -> list[dict[str, Any]]:
    if record.extract:
        return external(card, record.extract)
    assert record.read is not None, record.name
    return record.read(Fields(card))


def _columns_of_rows(rows: list[dict[str, Any]]) -> dict[str, list]:
    return {key: [row[key] for row in rows] for key in rows[0]} if rows else {}


def _apply_defaults(
    name: str,
    target: str,
    indices: Sequence[int],
    cards: Mapping[str, Sequence[RawCard]],
    problems: list[str],
) -> None:
    """Fill blank fields from GRDSET, BAROR or BEAMOR."""
    given = cards.get(name, ())
    if not given:
        return
    if len(given) > 1:
        problems.append(f"{given[1].place}: a second {name}; one is allowed")
    vector = [i for i in indices if i in (5, 6, 7)] if name != "GRDSET" else []
    for card in cards.get(target, ()):
        oriented = any(card.field(i) for i in vector)
        for index in indices:
            skip = oriented and index in vector
            text = given[0].field(index)
            if text and not skip and not card.field(index):
                card.fields.extend([""] * (index + 1 - len(card.fields)))
                card.fields[index] = text


def _frame(record: Card, pieces: list[dict[str, list]]) -> pd.DataFrame:
    """One table; columns of numbers are int64 or float64, others objects."""
    kinds = {"file": "s", "line": "i"}
    kinds |= {name: item.kind for name, item in record.columns.items()}
    columns = {}
    for name, kind in kinds.items():
        values = [value for piece in pieces for value in piece[name]]
        if kind in "ifu":
            columns[name] = np.array(values, np.int64 if kind == "i" else np.float64)
        else:
            columns[name] = np.empty(len(values), dtype=object)
            columns[name][:] = values
    if any("thru" in piece for piece in pieces):
        ranges = [part for piece in pieces for part in _thru(piece)]
        columns["thru"] = np.empty(len(ranges), dtype=object)
        columns["thru"][:] = ranges
    return pd.DataFrame(columns)


@cache
def _without_rows(name: str) -> pd.DataFrame:
    """The table of a card that a deck does not have: most of them, in every deck.

    Decks share it, as nothing changes a table in place.
    """
    return _frame(TABLES[name], [])


def _thru(piece: dict[str, list]) -> list:
    """Ranges of each row: an `IdRange`, a tuple of them (lists of elements), None."""
    return piece.get("thru") or [None] * len(piece["line"])

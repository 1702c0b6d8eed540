"""Cards as texts to the tables of the schema."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from fem.deck.cards import lists, masses, shapes
from fem.deck.cards.dmig import read_dmig
from fem.deck.cards.finish import FINISHERS
from fem.deck.catalogue import DEFAULTS_FOR
from fem.deck.fields import Fields
from fem.deck.layouts import LAYOUTS
from fem.deck.lexer import RawCard
from fem.deck.regular import layout, read_regular
from fem.deck.schema import ALIASES, COLUMNS
from fem.deck.values import Malformed

RowReader = Callable[[RawCard], list[dict[str, Any]]]

_SYNONYMS = {
    **ALIASES,
    "CELAS4": "CELAS2",
    "CDAMP4": "CDAMP2",
    "CMASS4": "CMASS2",
    "EIGR": "EIGRL",
    "NSM1": "NSM",
    "NSML1": "NSML",
    **{f"CORD{form}{kind}": "CORD" for form in "12" for kind in "RCS"},
}
_LISTS = {**lists.READERS, **masses.READERS, **shapes.READERS}


def supported(name: str, external: Mapping[str, Any]) -> bool:
    """Whether cards of that name have a place in the tables."""
    return name in LAYOUTS or name in _LISTS or name in external or name == "DMIG"


def layouts_and_lists() -> list[str]:
    """Names of the cards that are read without pyNastran's help."""
    return sorted({*LAYOUTS, *_LISTS, "DMIG"})


def make_tables(
    cards: Mapping[str, Sequence[RawCard]],
    external: Mapping[str, RowReader],
    problems: list[str],
    notices: list[str],
) -> dict[str, pd.DataFrame]:
    """All tables of the schema.

    Args:
        cards: supported cards by name.
        external: readers of single cards for names that neither have a layout nor are
            lists.
        problems: what is wrong is appended.
        notices: what is remarkable is appended.
    """
    for name in DEFAULTS_FOR:
        _apply_defaults(name, cards, problems)
    pieces: dict[str, list[dict[str, list]]] = {}
    for name, group in cards.items():
        if name in DEFAULTS_FOR:
            continue
        if name == "DMIG":
            columns = _columns_of_rows(read_dmig(group, problems))
        elif name in LAYOUTS:
            columns = read_regular(group, LAYOUTS[name], problems, notices)
            if name in FINISHERS:
                FINISHERS[name](columns, problems)
            if name.startswith("CORD"):
                _complete_frame(name, columns)
        else:
            columns = _read_rows(group, _row_reader(name, external), problems)
        if columns:
            columns["card"] = [name] * len(columns["line"])
            pieces.setdefault(_SYNONYMS.get(name, name), []).append(columns)
    return {name: _frame(name, pieces.get(name, [])) for name in COLUMNS}


def _row_reader(name: str, external: Mapping[str, RowReader]) -> RowReader:
    if name in external:
        return external[name]
    read = _LISTS[name]
    return lambda card: read(Fields(card))


def _read_rows(
    cards: Sequence[RawCard], read: RowReader, problems: list[str]
) -> dict[str, list]:
    rows: list[dict[str, Any]] = []
    for card in cards:
        try:
            made = read(card)
        except Malformed as error:
            problems.append(f"{card.place}: {card.name} {error}: {card}")
            continue
        for row in made:
            row["file"], row["line"] = card.file, card.line
        rows += made
    return _columns_of_rows(rows)


def _columns_of_rows(rows: list[dict[str, Any]]) -> dict[str, list]:
    return {key: [row[key] for row in rows] for key in rows[0]} if rows else {}


def _apply_defaults(
    name: str, cards: Mapping[str, Sequence[RawCard]], problems: list[str]
) -> None:
    """Fill blank fields from GRDSET, BAROR or BEAMOR."""
    given = cards.get(name, ())
    if not given:
        return
    if len(given) > 1:
        problems.append(f"{given[1].place}: a second {name}; one is allowed")
    target, indices = DEFAULTS_FOR[name]
    vector = [i for i in indices if i in (5, 6, 7)] if name != "GRDSET" else []
    for card in cards.get(target, ()):
        oriented = any(card.field(i) for i in vector)
        for index in indices:
            skip = oriented and index in vector
            text = given[0].field(index)
            if text and not skip and not card.field(index):
                card.fields.extend([""] * (index + 1 - len(card.fields)))
                card.fields[index] = text


def _complete_frame(name: str, columns: dict[str, list]) -> None:
    """CORD1R to CORD2S share a table."""
    count = len(columns["cid"])
    columns["type"], columns["form"] = [name[5]] * count, [int(name[4])] * count
    for key in ("g1", "g2", "g3", "rid"):
        columns.setdefault(key, [0] * count)
    for key in (f"{p}{k}" for p in "abc" for k in "123"):
        columns.setdefault(key, [np.nan] * count)


def _kinds() -> dict[str, dict[str, str]]:
    """Types of the columns that layouts describe, by table."""
    kinds: dict[str, dict[str, str]] = {}
    for name, text in LAYOUTS.items():
        shape = layout(text)
        for item in (*shape.fixed, *shape.repeated):
            table = kinds.setdefault(_SYNONYMS.get(name, name), {})
            table.setdefault(item.name, "f" if item.kind == "u" else item.kind)
    return kinds


_INTEGERS = frozenset(
    """
    line id eid pid mid sid tid cid rid g g0 g1 g2 g3 g4 g34 c1 c2 form gn refgrid
    mcid delayid extrap
    """.split()
)
_KINDS = _kinds()


def _frame(name: str, pieces: list[dict[str, list]]) -> pd.DataFrame:
    """One table; columns of numbers are int64 or float64, others objects."""
    columns = {}
    kinds = _KINDS.get(name, {})
    for item in ("file", "line", *COLUMNS[name].split()):
        key = item.rstrip("*")
        values = [value for piece in pieces for value in piece[key]]
        if item.endswith("*"):
            array = np.empty(len(values), dtype=object)
            array[:] = values
        elif kinds.get(key) == "i" or (key not in kinds and key in _INTEGERS):
            array = np.array(values, dtype=np.int64)
        elif kinds.get(key) == "f" or (values and isinstance(values[0], float)):
            array = np.array(values, dtype=np.float64)
        else:
            array = np.empty(len(values), dtype=object)
            array[:] = values
        columns[key] = array
    if any("thru" in piece for piece in pieces):
        columns["thru"] = np.array(
            [flag for piece in pieces for flag in _thru(piece)], dtype=bool
        )
    return pd.DataFrame(columns)


def _thru(piece: dict[str, list]) -> list[bool]:
    return piece.get("thru") or [False] * len(piece["line"])

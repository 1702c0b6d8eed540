"""Checks of a whole deck: references, duplicates, selected sets, coordinate systems."""

from collections.abc import Mapping, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.deck.cleanup import ids
from fem.deck.deck import Deck
from fem.deck.records import CARDS, TABLES, static_loads, targets_of
from fem.deck.records.field import Field
from fem.errors import Problems
from fem.geometry.coordinates import resolve

Tables = Mapping[str, pd.DataFrame]

_MOST = 20  # problems of one kind that are listed
_WORDS = {
    "GRID": "grid",
    "POINT": "point",
    "FREEDOM": "point",
    "CORD": "coordinate system",
}


def check(deck: Deck, *, partial: bool = False) -> list[str]:
    """All problems of a deck whose single cards are well-formed.

    Args:
        deck: the deck.
        partial: its points may be in other sections (BEGIN SUPER).
    """
    tables = deck.cards
    problems = Problems() if partial else Problems(_no_points(deck))
    problems += _duplicates(tables)
    if not problems:
        problems += _references(tables)
    if not problems:
        with problems.gathered():
            resolve(tables["CORD"], tables["GRID"])
    return problems


def _no_points(deck: Deck) -> list[str]:
    if deck.cards["GRID"].empty and deck.cards["SPOINT"].empty:
        return [f"{deck.path}: the deck has no GRID and no SPOINT"]
    return []


def _duplicates(cards: Tables) -> list[str]:
    """Ids that are given more than once."""
    groups: dict[str, list[str]] = {}
    for name, card in TABLES.items():
        if card.ids and len(cards[name]):
            groups.setdefault(name if card.ids == "own" else card.ids, []).append(name)
    problems: list[str] = []
    for names in groups.values():
        column = key_of(names[0])
        found = ids(cards, names, column)
        if len(np.unique(found)) == len(found):
            continue
        table = pd.concat(
            [cards[n][[column, "file", "line"]].assign(card=n) for n in names]
        )
        for _, row in table[table.duplicated(column)].head(_MOST).iterrows():
            problems.append(
                f"{row['file']}:{row['line']}: {row['card']} {row[column]} is defined "
                "more than once"
            )
    return problems


def key_of(name: str) -> str:
    """Name of the column with the ids of a table."""
    return next(iter(TABLES[name].columns))


def _flat(values: pd.Series) -> tuple[Int64, Int64]:
    """Integers of a column, lists unrolled, and the row of each."""
    if values.dtype != object:
        return values.to_numpy(np.int64), np.arange(len(values))
    lengths = [np.size(value) for value in values]
    parts = [np.ravel(value) for value in values]
    flat = np.concatenate(parts) if parts else np.zeros(0)
    return flat.astype(np.int64), np.repeat(np.arange(len(values)), lengths)


def _missing(
    tables: Tables,
    name: str,
    column: str,
    known: Int64,
    what: str,
    *,
    blank: bool = True,
) -> list[str]:
    """References of a column that are not among `known`; 0 and below are a `blank`."""
    table = tables[name]
    if table.empty:
        return []
    values, rows = _flat(table[column])
    bad = ~np.isin(values, known)
    if blank:
        bad &= values > 0
    found = list(dict.fromkeys(zip(rows[bad].tolist(), values[bad].tolist())))
    key = table.columns[2]  # the first after file and line
    extra = {*tables["EPOINT"]["id"]} if "EPOINT" in tables and what == "point" else ()
    problems = [
        f"{table['file'][row]}:{table['line'][row]}: {name} {table[key][row]}: "
        + (
            f"{number} is an extra point (EPOINT), expected a grid or scalar point"
            if number in extra
            else f"{what} {number} is not defined"
        )
        for row, number in found[:_MOST]
    ]
    if len(found) > _MOST:
        problems.append(f"... and {len(found) - _MOST} more {name} of that kind")
    return problems


def _references(tables: Tables) -> list[str]:
    """Ids that a card refers to and no card has."""
    problems: list[str] = []
    for name, card in TABLES.items():
        for item in card.columns.values():
            if item.targets and len(tables[name]):
                shown = _used_only(tables, name)
                if (name, item.name) == ("DMIG", "colids"):
                    shown = {**tables, name: _with_freedoms(tables[name])}
                names = [t for word in item.targets for t in targets_of(word)]
                known = np.concatenate([ids(tables, [t], key_of(t)) for t in names])
                problems += _missing(
                    shown, name, item.name, known, _what(item), blank=item.blank
                )
    return problems


def _with_freedoms(table: pd.DataFrame) -> pd.DataFrame:
    """DMIG whose columns are freedoms: those of form 9 have numbers."""
    return pd.DataFrame(table[table["form"] != 9].reset_index(drop=True))


def _used_only(tables: Tables, name: str) -> Tables:
    """Tables with a property's rows that elements use: others are not looked at."""
    users = _users(name)
    if not users:
        return tables
    table = tables[name]
    used = table["pid"].isin(ids(tables, users, "pid"))
    return {**tables, name: table.loc[used].reset_index(drop=True)}


@cache
def _users(name: str) -> Sequence[str]:
    """Elements that may have a property of this card."""
    return [
        card
        for card, record in TABLES.items()
        if (pid := record.columns.get("pid")) and name in pid.targets
    ]


def _what(item: Field) -> str:
    """What a reference should name, in words."""
    word = _WORDS.get(item.targets[0])
    names = [t for word in item.targets for t in targets_of(word)]
    if word is None and all(CARDS[name].element for name in names):
        word = f"element ({', '.join(names)})"
    return word or " or ".join(names)


STATIC_LOADS = (
    *(c.name for c in static_loads.RECORDS if c.has_table and c.name != "LOAD"),
    "DAREA",
)


FREQUENCIES = ("FREQ", "FREQ1", "FREQ2", "FREQ3", "FREQ4", "FREQ5")
_TRANSIENT = (109, 112, 129)
_MODAL = (103, 107, 110, 111, 112)
_SELECTED: tuple[tuple[str, tuple[str, ...], tuple[int, ...]], ...] = (
    ("spc", ("SPC", "SPCADD"), ()),
    ("mpc", ("MPC", "MPCADD"), ()),
    ("load", (*STATIC_LOADS, "LOAD"), (101, 105)),
    ("dload", ("DLOAD", "TLOAD1", "TLOAD2"), _TRANSIENT),
    ("dload", ("DLOAD", "RLOAD1", "RLOAD2"), (108, 111)),
    ("frequency", FREQUENCIES, (108, 111)),
    ("loadset", ("LSEQ",), _TRANSIENT),
    ("ic", ("TIC",), _TRANSIENT),
    ("tstep", ("TSTEP",), _TRANSIENT),
    ("method", ("EIGRL",), _MODAL),
    ("method", ("EIGRL", "EIGB"), (105,)),
    ("nsm", ("NSM", "NSML", "NSMADD"), ()),
    ("massset", ("MASSSET",), ()),
)

# Cards that combine sets: attribute of the subcase, column, tables of the members.
_COMBINED: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "SPCADD": ("spc", "sets", ("SPC",)),
    "MPCADD": ("mpc", "sets", ("MPC",)),
    "NSMADD": ("nsm", "sets", ("NSM", "NSML")),
    "LOAD": ("load", "lids", STATIC_LOADS),
    "DLOAD": ("dload", "lids", ("TLOAD1", "TLOAD2", "RLOAD1", "RLOAD2")),
}


class Selected(NamedTuple):
    """Problems of the selected sets, and remarks on them."""

    problems: list[str]
    notices: list[str]


# Sets of constraints that are selected and not there: nothing is constrained by them,
# as in Nastran, which says so (message 2047).
_MAY_BE_ABSENT = frozenset({"spc", "mpc"})


def check_selected(deck: Deck, sol: int) -> Selected:
    """Sets that the case control selects and that the deck does not have."""
    problems: list[str] = []
    notices: list[str] = []
    for attribute, names, solutions in _SELECTED:
        if solutions and sol not in solutions:
            continue
        known = {0, *ids(deck.cards, names, "sid").tolist()}
        for subcase in deck.case_control:
            number = getattr(subcase, attribute)
            if number not in known and attribute in _MAY_BE_ABSENT:
                notices.append(
                    f"{attribute.upper()} = {number} is selected and not in the deck: "
                    "it constrains nothing"
                )
            elif number not in known:
                problems.append(
                    f"{deck.path}: subcase {subcase.id}: {attribute.upper()} = "
                    f"{number} is not defined; expected a set of "
                    f"{', '.join(names[:3])}"
                )
        nested = _nested(deck, attribute)
        if attribute == "load":  # NX Nastran runs the deck pload4/cquad4 of pyNastran
            notices += [f"warning: {text}; it loads nothing" for text in nested]
        else:
            problems += nested
        absent = _members(deck, attribute)
        if attribute in _MAY_BE_ABSENT:
            notices += [f"{text}; it constrains nothing" for text in absent]
        elif attribute == "load" and _some_there(deck):
            notices += [f"warning: {text}; it loads nothing" for text in absent]
        else:
            problems += absent
    return Selected(list(dict.fromkeys(problems)), list(dict.fromkeys(notices)))


def _nested(deck: Deck, attribute: str) -> list[str]:
    """Selected combinations of combinations: Nastran does not follow them."""
    problems = []
    chosen = [getattr(subcase, attribute) for subcase in deck.case_control]
    for name, (user, column, targets) in _COMBINED.items():
        table = deck.cards[name]
        if user != attribute or table.empty:
            continue
        own = set(table["sid"].tolist()) - set(ids(deck.cards, targets, "sid").tolist())
        table = table[table["sid"].isin(chosen)]
        problems += [
            f"{row['file']}:{row['line']}: {name} {row['sid']}: set {number} "
            f"combines sets itself, expected sets of {' or '.join(targets[:3])}"
            for row in table.to_dict("records")
            for number in sorted(own & {int(i) for i in row[column]})
        ]
    return problems


def _some_there(deck: Deck) -> bool:
    """Whether each selected LOAD has a set that is there."""
    chosen = [subcase.load for subcase in deck.case_control]
    known = ids(deck.cards, STATIC_LOADS, "sid")
    rows = deck.cards["LOAD"]
    named = rows[rows["sid"].isin(chosen)]["lids"]
    return all(np.isin(lids, known).any() for lids in named)


def _members(deck: Deck, attribute: str) -> list[str]:
    """Sets that a selected SPCADD, LOAD etc. combines and that are not there."""
    chosen = [getattr(subcase, attribute) for subcase in deck.case_control]
    problems: list[str] = []
    for name, (user, column, targets) in _COMBINED.items():
        table = deck.cards[name]
        if user == attribute and len(table):
            table = table[table["sid"].isin(chosen)].reset_index(drop=True)
            known = np.append(ids(deck.cards, targets, "sid"), deck.cards[name]["sid"])
            what = f"{targets[0]} set"
            problems += _missing({name: table}, name, column, known, what)
    return problems

"""Superelements put together: the parts of BEGIN SUPER = n as one model.

The parts are placed (SELOC), their points joined, by SECONCT or where they coincide,
and solved with the residual structure. In statics that is what their reduction gives;
for modes and dynamics each part says which of its points are interior, and by which
coordinates it is reduced (`main_section`).

Points, elements, properties, materials and coordinate systems of a part whose ids are
in use get an offset. The basic frame of a part that is turned becomes a coordinate
system, and what refers to the basic frame refers to it: nothing else has to be turned.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import pandas as pd

from fem.deck.deck import Deck, Superelement
from fem.deck.superelements.ids import (
    Tables,
    ids_of_kind,
    offsets,
    renamed,
    shift_notices,
)
from fem.deck.superelements.joining import join_points, merge_points, with_points
from fem.deck.superelements.matrices import TYPES as EXTERNAL
from fem.deck.superelements.monitors import with_monitors
from fem.deck.superelements.placing import part_frame
from fem.errors import InputError

# What serves the reduction of a part and changes nothing in the whole.
_OF_REDUCTION = (
    "ASET",
    "CSET",
    "QSET",
    "EXTRN",
    "OMIT",
    "SEBULK",
    "SECONCT",
    "SELOC",
    "SEMPLN",
    "EIGRL",
)
# They act on all masses of a model, there on those of their part.
_INERTIAL = ("GRAV", "RFORCE", "ACCEL", "ACCEL1")


@dataclass(frozen=True)
class Whole:
    """The model in one piece, what is wrong with it and what is remarkable.

    `increments`: tables of the mass increments of the parts, by increment.
    """

    cards: Mapping[str, pd.DataFrame]
    problems: list[str]
    notices: list[str]
    components: tuple[Superelement, ...] = ()
    increments: Mapping[int, list[Tables]] = field(default_factory=dict)


def join(deck: Deck, parts: Mapping[int, Deck]) -> Whole:
    """The residual structure with its superelements.

    Args:
        deck: main bulk data, with SEBULK, SECONCT, SELOC.
        parts: bulk data of BEGIN SUPER = n.
    """
    problems = check_sections(deck, parts)
    notices = _other_parameters(deck, parts)
    if problems:
        return Whole(deck.cards, problems, notices)
    tables = [dict(deck.cards)]
    given = {0: _points(deck)}
    maps = {0: {}}
    grid_lists: set[int] = set()
    increments: dict[int, list[Tables]] = {}
    for number, part in sorted(parts.items()):
        own = {k: v for k, v in part.cards.items() if k not in _OF_REDUCTION}
        frame = part_frame(deck, part, number, problems)
        maps[number] = offsets(tables, own, number)
        shifted = maps[number]["element"] or maps[number]["property"]
        if shifted and (len(own["NSM"]) or len(own["NSML"])):
            problems.append(
                f"superelement {number}: NSM with elements or properties whose ids are "
                "in use elsewhere is not supported; expected ids of its own"
            )
        basic = 1 + max(ids_of_kind(own, "frame"), default=0) + maps[number]["frame"]
        basic = max(basic, *(1 + i for t in tables for i in ids_of_kind(t, "frame")), 1)
        whole = renamed(own, maps[number], frame, basic)
        for m, added in part.increments.items():
            own = renamed(dict(added.cards), maps[number], frame, basic)
            increments.setdefault(m, []).append(own)
        sets = [i for table in (*tables, whole) for i in table["SET1"]["sid"]]
        start = basic if frame is not None else 0
        whole, lists = with_monitors(whole, maps[number], start, number, sets)
        grid_lists |= lists
        tables.append(whole)
        notices += shift_notices(number, maps[number])
        given[number] = _points(part)
    external = [n in _of_types(deck, EXTERNAL) for n in (0, *sorted(parts))]
    cards = _stacked(tables, external, problems)
    if problems:
        return Whole(cards, problems, notices)
    joined = join_points(deck, given, maps, cards, problems)
    cards = merge_points(cards, joined, problems, grid_lists)
    own = sorted(set(parts) - _of_types(deck, EXTERNAL))
    found = [_component(n, parts[n], maps[n], joined) for n in own]
    cards["QSET"] = with_modal(cards["QSET"], found)
    notices.append(
        f"{len(parts)} superelements ({', '.join(map(str, sorted(parts)))}), joined at "
        f"{len(joined)} points: one model in statics, which is exact, and for landings"
    )
    if not problems:
        points = {*cards["GRID"]["id"], *cards["SPOINT"]["id"]}
        gone = {p: other for p, other in joined.items() if p not in points}
        for tables in (t for own in increments.values() for t in own):
            tables |= {name: with_points(name, t, gone) for name, t in tables.items()}
    return Whole(cards, problems, notices, tuple(found), increments)


def _component(
    number: int, part: Deck, shift: Mapping[str, int], joined: Mapping[int, int]
) -> Superelement:
    """What a part's sets ask of its reduction, by ids of the whole."""
    add = shift.get("point", 0)
    shared = {*joined, *joined.values()}

    def ids(name: str) -> list[int]:
        return (part.cards[name]["id"].to_numpy(np.int64) + add).tolist()

    modal = dict(zip(ids("QSET"), part.cards["QSET"]["c"].astype(str)))
    interior = sorted({*ids("GRID"), *ids("SPOINT")} - shared - {*modal})
    kept = zip(ids("ASET"), part.cards["ASET"]["c"].tolist())
    counts = part.cards["SENQSET"]["n"].tolist()
    return Superelement(
        number=number,
        interior=np.array(interior, np.int64),
        generalised=tuple((joined.get(i, i), c) for i, c in modal.items()),
        count=int(sum(counts)),
        kept=tuple((i, str(c)) for i, c in kept if i in {*interior}),
        methods=part.cards["EIGRL"],
    )


def with_modal(table: pd.DataFrame, parts: Sequence[Superelement]) -> pd.DataFrame:
    """QSET with the modal coordinates of all parts."""
    pairs = [pair for part in parts for pair in part.generalised]
    if not pairs:
        return table
    new = pd.DataFrame(pairs, columns=["id", "c"]).assign(file="", line=0)
    new = new.reindex(columns=table.columns)
    return pd.concat([table, new], ignore_index=True)


# -- what is asked for ----------------------------------------------------------------


def check_sections(deck: Deck, parts: Mapping[int, Deck]) -> list[str]:
    """Parts that SEBULK and SELOC ask for and the deck does not have.

    Args:
        deck: main bulk data.
        parts: bulk data of BEGIN SUPER = n.
    """
    problems = []
    for _, row in deck.cards["SEBULK"].iterrows():
        place = f"{row['file']}:{row['line']}: SEBULK {row['seid']}"
        if row["type"] not in ("PRIMARY", "PRIM", "REPEAT", "MIRROR", *EXTERNAL):
            problems.append(
                f"{place}: type {row['type']}, expected PRIMARY with BEGIN SUPER = "
                f"{row['seid']}, REPEAT, MIRROR, EXTOP4, or EXTERNAL with DMIG"
            )
        elif row["seid"] not in parts:
            problems.append(f"{place}: BEGIN SUPER = {row['seid']} is not in the deck")
    for _, row in deck.cards["SELOC"].iterrows():
        if row["seid"] not in parts:
            place = f"{row['file']}:{row['line']}: SELOC {row['seid']}"
            problems.append(f"{place}: BEGIN SUPER = {row['seid']} is not in the deck")
    return problems


def _of_types(deck: Deck, types: tuple[str, ...]) -> set[int]:
    """Superelements that SEBULK has as one of some types."""
    table = deck.cards["SEBULK"]
    return set(table["seid"][table["type"].isin(types)].tolist())


def _other_parameters(deck: Deck, parts: Mapping[int, Deck]) -> list[str]:
    notices = []
    for number, part in sorted(parts.items()):
        names = [k for k, v in part.params.items() if deck.params.get(k, v) != v]
        if names:
            notices.append(
                f"superelement {number}: {', '.join(sorted(names))}: the values of the "
                "main bulk data hold for all"
            )
    return notices


def _points(deck: Deck) -> set[int]:
    grids = deck.cards["GRID"]["id"].tolist()
    return {*grids, *deck.cards["SPOINT"]["id"].tolist()}


# -- together -------------------------------------------------------------------------


def _stacked(
    tables: list[Tables], external: Sequence[bool], problems: list[str]
) -> Tables:
    """One table per card. Inertial loads must be those of all parts.

    External ones do not count: inertial loads do not act on their mass.
    """
    inside = len(tables) - sum(external)
    cards = {}
    for name in tables[0]:
        present = [t[name] for t in tables if name in t and len(t[name])]
        stacked = pd.concat(present, ignore_index=True) if present else tables[0][name]
        said = [c for c in stacked.columns if c not in ("file", "line", "card")]
        if name in _INERTIAL and len(present):
            one = {t[said].to_string(index=False) for t in present}
            if len(one) > 1 or len(present) < inside:
                problems.append(
                    f"{name}: it acts on the masses of its own superelement only, not "
                    "supported here; expected the same in all of them"
                )
            stacked = present[0]
        elif name in (
            "LOAD",
            "SPCADD",
            "MPCADD",
            "NSMADD",
            "TABLED1",
            "TSTEP",
            "DLOAD",
        ):
            text = stacked[said].astype(str)
            stacked = stacked[~text.duplicated()].reset_index(drop=True)
        cards[name] = stacked
    return cards


def in_one_piece(deck: Deck, parts: Mapping[int, Deck]) -> tuple[Deck, Whole]:
    """The deck whose tables are those of `join`."""
    try:
        whole = join(deck, parts)
    except InputError as error:
        whole = Whole(deck.cards, list(error.problems), [])
    return replace(deck, cards=whole.cards, components=whole.components), whole

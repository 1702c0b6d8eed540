"""Superelements put together: the parts of BEGIN SUPER = n as one model.

The parts are placed (SELOC), their points joined, by SECONCT or where they coincide,
and solved with the residual structure. In statics that is what their reduction gives;
for modes and dynamics each part says which of its points are interior, and by which
coordinates it is reduced (`superelement_sets`).

Points, elements, properties, materials and coordinate systems of a part whose ids are
in use get an offset. The basic frame of a part that is turned becomes a coordinate
system, and what refers to the basic frame refers to it: nothing else has to be turned.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from fem.arrays import Float64
from fem.deck.deck import Deck
from fem.deck.superelement_ids import (
    Tables,
    columns_with_ids,
    ids_of_kind,
    offsets,
    renamed,
    shifts_said,
)
from fem.deck.superelement_matrices import TYPES as EXTERNAL
from fem.deck.superelement_monitors import with_monitors
from fem.deck.superelement_sets import Superelement
from fem.errors import InputError
from fem.geometry.coordinates import resolve

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
_INERTIAL = ("GRAV", "RFORCE", "ACCEL1")
_TOLERANCE = 1e-5
_Point = tuple[int, int]  # superelement, id


@dataclass(frozen=True)
class Whole:
    """The model in one piece, what is wrong with it and what is remarkable."""

    cards: Mapping[str, pd.DataFrame]
    problems: list[str]
    notices: list[str]
    components: tuple[Superelement, ...] = ()


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
    for number, part in sorted(parts.items()):
        own = {k: v for k, v in part.cards.items() if k not in _OF_REDUCTION}
        frame = _placing(deck, part, number, problems)
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
        sets = [i for table in (*tables, whole) for i in table["SET1"]["sid"]]
        start = basic if frame is not None else 0
        whole, lists = with_monitors(whole, maps[number], start, number, sets)
        grid_lists |= lists
        tables.append(whole)
        notices += shifts_said(number, maps[number])
        given[number] = _points(part)
    external = [n in _of_types(deck, EXTERNAL) for n in (0, *sorted(parts))]
    cards = _stacked(tables, external, problems)
    if problems:
        return Whole(cards, problems, notices)
    joined = _joined(deck, given, maps, cards, problems)
    cards = _merged(cards, joined, problems, grid_lists)
    own = sorted(set(parts) - _of_types(deck, EXTERNAL))
    found = [_component(n, parts[n], maps[n], joined) for n in own]
    cards["QSET"] = with_modal(cards["QSET"], found)
    notices.append(
        f"{len(parts)} superelements ({', '.join(map(str, sorted(parts)))}), joined at "
        f"{len(joined)} points: one model in statics, which is exact, and for landings"
    )
    return Whole(cards, problems, notices, tuple(found))


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
    """What SEBULK and SELOC ask for and the deck does not have.

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


def _places(deck: Deck) -> pd.DataFrame:
    """Grids and POINTs, which serve as places."""
    columns = ["id", "cp", "x1", "x2", "x3", "cd"]
    points = deck.cards["POINT"].assign(cd=0)
    grids = deck.cards["GRID"]
    if points.empty:
        return grids
    both = [grids[columns], points[columns]]
    return pd.DataFrame(pd.concat(both, ignore_index=True))


# -- places ---------------------------------------------------------------------------


def _placing(
    deck: Deck, part: Deck, number: int, problems: list[str]
) -> tuple[Float64, Float64] | None:
    """Axes (3, 3) and origin (3,) of the part's basic frame in the main one."""
    rows = deck.cards["SELOC"]
    rows = rows[rows["seid"] == number]
    if rows.empty:
        return None
    row = rows.iloc[0]
    name = f"{row['file']}:{row['line']}: SELOC {number}"
    found = []
    for own, which in ((part, "pa"), (deck, "pb")):
        ids = [int(row[f"{which}{k}"]) for k in (1, 2, 3)]
        grid = _places(own)
        absent = [str(i) for i in ids if i not in set(grid["id"])]
        if absent:
            where = "the superelement" if own is part else "the main bulk data"
            problems.append(f"{name}: grid {', '.join(absent)} is not in {where}")
            return None
        _, xyz = resolve(own.cards["CORD"], grid)
        found.append(xyz[[grid["id"].tolist().index(i) for i in ids]])
    (first, own), (second, main) = ((_triad(xyz), xyz) for xyz in found)
    sides = [np.linalg.norm(np.roll(x, 1, axis=0) - x, axis=1) for x in (own, main)]
    if np.isnan(first).any() or np.isnan(second).any():
        problems.append(f"{name}: its three points lie on a line")
        return None
    if np.abs(sides[0] - sides[1]).max() > 1e-3 * sides[0].max():
        problems.append(
            f"{name}: its points are {sides[0].tolist()} apart in the superelement and "
            f"{sides[1].tolist()} in the main bulk data, expected the same triangle"
        )
    axes = second @ first.T
    return axes, main[0] - axes @ own[0]


def _triad(xyz: Float64) -> Float64:
    """(3, 3) axes as columns: x from the first point to the second, y to the third."""
    x, v = xyz[1] - xyz[0], xyz[2] - xyz[0]
    z = np.cross(x, v)
    if np.linalg.norm(z) < 1e-9 * np.linalg.norm(x) * np.linalg.norm(v):
        return np.full((3, 3), np.nan)
    x, z = x / np.linalg.norm(x), z / np.linalg.norm(z)
    return np.stack([x, np.cross(z, x), z], axis=1)


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


def _joined(
    deck: Deck,
    given: Mapping[int, set[int]],
    maps: Mapping[int, Mapping[str, int]],
    cards: Tables,
    problems: list[str],
) -> dict[int, int]:
    """Point -> the point of another part that takes its place."""

    def name(point: _Point) -> int:
        return point[1] + maps[point[0]].get("point", 0)

    pairs = []
    for _, row in deck.cards["SECONCT"].iterrows():
        for ends in zip(row["gidas"].tolist(), row["gidbs"].tolist()):
            points = list(zip((int(row["sea"]), int(row["seb"])), ends))
            absent = [p for p in points if p[1] not in given.get(p[0], set())]
            if absent:
                problems.append(
                    f"{row['file']}:{row['line']}: SECONCT: superelement "
                    f"{absent[0][0]} has no point {absent[0][1]}"
                )
            else:
                pairs.append((name(points[0]), name(points[1])))
    manual = deck.cards["SEBULK"]
    manual = set(manual["seid"][manual["method"].str.startswith("MAN")].tolist())
    owner = {name((n, i)): n for n, ids in given.items() for i in ids}
    pairs += [
        (a, b)
        for a, b in _coincident(cards, owner, deck.cards["SEBULK"])
        if not manual & {owner[a], owner[b]}
    ]
    order = sorted(owner, key=lambda point: (owner[point], point))
    rank = {point: k for k, point in enumerate(order)}
    home = {point: point for point in owner}

    def root(point: int) -> int:
        while home[point] != point:
            point = home[point]
        return point

    for a, b in pairs:
        first, second = sorted((root(a), root(b)), key=rank.__getitem__)
        home[second] = first
    return {point: root(point) for point in owner if root(point) != point}


def _coincident(
    cards: Tables, owner: Mapping[int, int], sebulk: pd.DataFrame
) -> Iterator[tuple[int, int]]:
    """Pairs of grids of different superelements at one place."""
    grid = cards["GRID"]
    _, xyz = resolve(cards["CORD"], grid)
    tolerance = float(sebulk["tol"].max()) if len(sebulk) else _TOLERANCE
    ids = grid["id"].tolist()
    for a, b in sorted(cKDTree(xyz).query_pairs(tolerance)):
        if owner[ids[a]] != owner[ids[b]]:
            yield ids[a], ids[b]


def _merged(
    cards: Tables, joined: Mapping[int, int], problems: list[str], lists: set[int]
) -> Tables:
    """Tables in which joined points are one; those with axes of their own are tied.

    `lists` are the SET1 that hold points.
    """
    grid = cards["GRID"]
    frames, xyz = resolve(cards["CORD"], grid)
    at = {int(i): k for k, i in enumerate(grid["id"])}
    cd = np.maximum(grid["cd"].to_numpy(np.int64), 0)
    axes = frames.triads(cd, xyz)
    replaced, tied = {}, []
    for point, other in joined.items():
        alike = (point in at) == (other in at)
        if not alike:
            problems.append(f"SECONCT: {point} and {other}: a grid and a scalar point")
        elif point in at and not np.allclose(axes[at[point]], axes[at[other]]):
            tied.append((point, other))
        else:
            replaced[point] = other
    if problems:
        return cards
    merged = {
        name: _with_points(name, table, replaced) for name, table in cards.items()
    }
    sets = merged["SET1"] = merged["SET1"].copy()
    sets["ids"] = [
        tuple(replaced.get(i, i) for i in ids) if number in lists else ids
        for number, ids in zip(sets["sid"], sets["ids"])
    ]
    for name in ("GRID", "SPOINT"):
        table = merged[name]
        merged[name] = table[~table["id"].isin(list(replaced))].reset_index(drop=True)
    grid = merged["GRID"]
    for point, other in replaced.items():
        if point in at:
            digits = {*cards["GRID"]["ps"][at[point]]}
            row = grid.index[grid["id"] == other][0]
            grid.at[row, "ps"] = "".join(sorted(digits | {*grid.at[row, "ps"]}))
    merged["RBE2"] = _with_ties(merged["RBE2"], tied, ids_of_kind(merged, "element"))
    return merged


def _with_points(
    name: str, table: pd.DataFrame, replaced: Mapping[int, int]
) -> pd.DataFrame:
    """A table in which other points stand for those that are replaced."""
    if not replaced or name in ("GRID", "SPOINT"):
        return table
    table = table.copy()
    for column, kind in columns_with_ids(name):
        if kind != "point" or column not in table:
            continue
        values = table[column]
        if values.dtype != object:
            table[column] = values.replace(replaced)
            continue
        changed = np.empty(len(values), dtype=object)
        for row, value in enumerate(values):
            ids = np.asarray(value, dtype=np.int64)
            changed[row] = np.array([replaced.get(int(i), int(i)) for i in ids.ravel()])
        table[column] = changed
    return table


def _with_ties(
    table: pd.DataFrame, tied: list[tuple[int, int]], taken: set[int]
) -> pd.DataFrame:
    """RBE2 with those between joined grids whose displacement axes differ."""
    if not tied:
        return table
    start = max(taken, default=0) + 1
    rows = [
        {"eid": start + k, "gn": other, "cm": "123456", "gms": np.array([point])}
        for k, (point, other) in enumerate(tied)
    ]
    new = pd.DataFrame(rows).assign(file="", line=0, card="RBE2")
    new = new.reindex(columns=[c for c in new if c in table])
    return pd.concat([table, new], ignore_index=True)


def in_one_piece(deck: Deck, parts: Mapping[int, Deck]) -> tuple[Deck, Whole]:
    """The deck whose tables are those of `join`."""
    try:
        whole = join(deck, parts)
    except InputError as error:
        whole = Whole(deck.cards, list(error.problems), [])
    return replace(deck, cards=whole.cards, components=whole.components), whole

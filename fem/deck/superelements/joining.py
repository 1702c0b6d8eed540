"""Points of superelements joined, by SECONCT or where they coincide."""

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from fem.deck.deck import Deck
from fem.deck.superelements.ids import Tables, columns_with_ids, ids_of_kind
from fem.geometry.coordinates import resolve

_TOLERANCE = 1e-5
_Point = tuple[int, int]  # superelement, id


def join_points(
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


def merge_points(
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
    merged = {k: with_points(k, table, replaced) for k, table in cards.items()}
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


def with_points(
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

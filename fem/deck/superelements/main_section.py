"""Superelements of the main bulk data: SESET, field SEID of GRID, and their sets.

A superelement's interior points follow its boundary: statically, and by as many modes
with the boundary held as it has generalised coordinates (QSET, SEQSET, SENQSET).
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.deck.deck import Superelement


def main_superelements(cards: Mapping[str, pd.DataFrame]) -> list[Superelement]:
    """Superelements of SESET and of the field SEID of GRID, outermost first.

    One whose boundary (SEBSET) lies within another is reduced before that.
    """
    grids = cards["GRID"]
    owner = dict(zip(grids["id"].tolist(), grids["seid"].tolist()))
    scalars = cards["SPOINT"]["id"].tolist()
    owner |= dict.fromkeys(scalars, 0)
    known = np.array(sorted(owner), np.int64)
    for seid, ids in _members(cards["SESET"], known):
        owner.update(dict.fromkeys(ids, seid))
    numbers = sorted(set(owner.values()) - {0})
    q = _by_superelement(cards["SEQSET"], known)
    boundary = _by_superelement(cards["SEBSET"], known)
    c = _by_superelement(cards["SECSET"], known)
    counts = dict(zip(cards["SENQSET"]["seid"], cards["SENQSET"]["n"]))
    found = []
    for n in numbers:
        modal = q.get(n, {})
        points = np.array([p for p, own in owner.items() if own == n], np.int64)
        found.append(
            Superelement(
                number=n,
                interior=np.setdiff1d(points, list(modal)),
                generalised=tuple(sorted(modal.items())),
                count=int(counts.get(n, 0)),
                free=n in c,
            )
        )
    within = {n: {owner[p] for p in boundary.get(n, ())} - {0, n} for n in numbers}
    return sorted(found, key=lambda s: -_depth(s.number, within))


def _depth(number: int, within: Mapping[int, set[int]], most: int = 50) -> int:
    """Superelements between this one and the residual structure."""
    if not most:
        return 0
    return max((1 + _depth(n, within, most - 1) for n in within[number]), default=0)


def _members(table: pd.DataFrame, known: Int64) -> list[tuple[int, list[int]]]:
    found = []
    for seid, point, thru in zip(table["seid"], table["id"], table["thru"]):
        ids = [int(point)] if thru is None else thru.among(known).tolist()
        found.append((int(seid), ids))
    return found


def _by_superelement(table: pd.DataFrame, known: Int64) -> dict[int, dict[int, str]]:
    """Points with their components by superelement."""
    found: dict[int, dict[int, str]] = {}
    for (seid, ids), digits in zip(_members(table, known), table["c"]):
        own = found.setdefault(seid, {})
        for i in ids:
            own[i] = own.get(i, "") + str(digits)
    return found

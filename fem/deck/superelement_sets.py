"""What a deck asks of the reduction of its superelements, on the model in one piece.

A superelement's interior points follow its boundary: statically, and by as many modes
with the boundary held as it has generalised coordinates (QSET, SEQSET, SENQSET).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.deck.case_control import Subcase


@dataclass(frozen=True, kw_only=True)
class Superelement:
    """One superelement of a model in one piece.

    Attributes:
        number: its id.
        interior: (i,) points that only it has.
        generalised: points, and their components, that stand for its modes.
        count: modes without points of their own (SENQSET).
        kept: points of its interior and components that are kept (ASET).
        methods: EIGRL cards of its own bulk data.
        free: its modes have parts of the boundary free (CSET, SECSET).
    """

    number: int
    interior: Int64
    generalised: tuple[tuple[int, str], ...] = ()
    count: int = 0
    kept: tuple[tuple[int, str], ...] = ()
    methods: pd.DataFrame | None = None
    free: bool = False


def of_main_section(cards: Mapping[str, pd.DataFrame]) -> list[Superelement]:
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


# -- subcases -------------------------------------------------------------------------


def split_subcases(
    subcases: Sequence[Subcase],
) -> tuple[list[Subcase], list[Subcase]]:
    """Subcases of the residual structure, and those of superelements alone."""
    residual = [c for c in subcases if c.superelements is None or 0 in c.superelements]
    others = [c for c in subcases if c not in residual]
    return (residual, others) if residual else (others, [])


def subcase_of(number: int, subcases: Sequence[Subcase]) -> Subcase:
    """The subcase whose METHOD serves a superelement."""
    residual, others = split_subcases(subcases)
    named = [c for c in others if number in (c.superelements or ())]
    return (named or residual)[0]


# Selections that are sets of bulk data, and the tables of each.
CHOSEN: dict[str, tuple[str, ...]] = {
    "spc": ("SPC", "SPCADD"),
    "mpc": ("MPC", "MPCADD"),
}


def with_chosen_sets(
    tables: Mapping[str, pd.DataFrame],
    number: int,
    subcases: Sequence[Subcase],
    loads: tuple[str, ...],
) -> tuple[dict[str, pd.DataFrame], list[Subcase]]:
    """Tables of a part whose sets have the numbers that the residual subcases choose.

    A subcase with SUPER = n may choose other sets than the one that is solved. The
    k-th of them belongs to the k-th of the residual structure; one alone to all.

    Returns:
        The tables, and the subcases: where one of the residual structure chooses no
        set, it chooses that of the part.
    """
    residual, others = split_subcases(subcases)
    own = [c for c in others if number in (c.superelements or ())]
    changed, cases = dict(tables), list(subcases)
    if not own:
        return changed, cases
    own = own * len(residual) if len(own) == 1 else own
    for attribute, names in {**CHOSEN, "load": loads}.items():
        pairs = []
        for mine, main in zip(own, residual):
            a, b = getattr(mine, attribute), getattr(main, attribute)
            if a and not b:
                at = next(k for k, c in enumerate(cases) if c.id == main.id)
                cases[at] = replace(cases[at], **{attribute: a})
            elif a != b:
                pairs.append((a, b))
        for name in names:
            if pairs:
                changed[name] = _renumbered(changed[name], pairs)
    return changed, cases


def _renumbered(table: pd.DataFrame, pairs: Sequence[tuple[int, int]]) -> pd.DataFrame:
    """Rows of set b are those of set a, for each pair; without a there are none."""
    taken = {b for _, b in pairs}
    parts = [table[~table["sid"].isin(list(taken))]]
    parts += [table[table["sid"] == a].assign(sid=b) for a, b in dict.fromkeys(pairs)]
    return pd.DataFrame(pd.concat(parts, ignore_index=True))

"""Subcases of superelements: which are theirs, and which sets they choose."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import pandas as pd

from fem.deck.control.subcase import Subcase


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

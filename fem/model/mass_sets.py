"""Masses that case control combines: MASSSET, M = S0 (S1 M1 + S2 M2 + ...).

M0 is the mass of the main bulk data, direct input (M2GG) included, the others are those
of BEGIN MASSID = n. Nothing but M differs between subcases that choose other sets.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import scipy.sparse as sp

from fem.elements.registry import read_elements
from fem.geometry.points import Points
from fem.model.assembly import assemble_mass

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def combined_mass(
    deck: Deck, points: Points, base: sp.csr_matrix, massset: int
) -> sp.csr_matrix:
    """(g, g) mass of a MASSSET.

    Args:
        deck: with the set and its increments.
        points: of the deck.
        base: (g, g) mass of the main bulk data.
        massset: number of the set.

    Raises:
        InputError: what is wrong with elements of an increment.
    """
    s0, terms = combination_of(deck, massset)
    coupled = deck.number("COUPMASS") > 0
    factor = deck.number("WTMASS") * deck.number("CM1")
    total = sp.csr_matrix(base.shape)
    for scale, number in terms:
        one = base
        if number:
            blocks = read_elements(deck.increments[number], points)
            one = assemble_mass(points, blocks, coupled=coupled, factor=factor)
        total = total + s0 * scale * one
    return sp.csr_matrix(total)


def combination_of(deck: Deck, massset: int) -> tuple[float, list[tuple[float, int]]]:
    """Overall factor, factors and increments of a MASSSET."""
    table = deck.cards["MASSSET"]
    row = table[table["sid"] == massset].iloc[0]
    return float(row["s0"]), list(zip(row["factors"], row["massids"]))


def combination_story(deck: Deck, massset: int) -> str:
    """Words for what the mass of a set is made of."""
    s0, terms = combination_of(deck, massset)
    names = [
        (f"{s:g} x " if s != 1.0 else "") + (f"MASSID {n}" if n else "the base")
        for s, n in terms
    ]
    whole = f"{s0:g} x (" * (s0 != 1.0) + " + ".join(names) + ")" * (s0 != 1.0)
    based = any(not n for _, n in terms)
    left = "" if based else "; without 0 the mass of the main bulk data does not count"
    return f"MASSSET {massset}: the mass is {whole}{left}"

"""Damping that a deck gives: what a transient uses of it, and what it leaves unused."""

from __future__ import annotations

from typing import TYPE_CHECKING

import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.model.assembly import Matrices

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def damping_in_transients(deck: Deck, matrices: Matrices) -> Damping:
    """B = B1 + (G/W3 + ALPHA2) K + ALPHA1 M + K4/W4 of the g-set."""
    stiff, w3, w4 = (deck.number(name) for name in ("ALPHA2", "W3", "W4"))
    if w3 > 0.0:
        stiff += deck.number("G") / w3
    other = matrices.damping
    if w4 > 0.0 and matrices.structural_damping.nnz:
        k4 = sp.csr_matrix(matrices.structural_damping / w4)
        elements = Damping.from_matrix(k4, matrices.stiffness)
        stiff += elements.stiffness_factor
        if elements.other is not None:
            other = sp.csr_matrix(other + elements.other)
    return Damping(
        stiffness_factor=stiff,
        mass_factor=deck.number("ALPHA1"),
        other=other if other.nnz else None,
    )


def inactive_damping(deck: Deck, matrices: Matrices) -> list[str]:
    """Damping that the deck gives and that a transient does not use, in words."""
    lines = []
    g = deck.number("G")
    if g != 0.0 and deck.number("W3") == 0.0:
        lines.append(
            f"the damping PARAM,G,{g:g} is inactive: a transient uses it only with "
            "PARAM,W3; give W3, the circular frequency (rad/s) at which it is to "
            "hold, and it becomes the viscous damping (G/W3) K"
        )
    if matrices.structural_damping.nnz and deck.number("W4") == 0.0:
        lines.append(
            "the damping of elements and materials (GE) is inactive: a transient "
            "uses it only with PARAM,W4; give W4, the circular frequency (rad/s) "
            "at which it is to hold, and it becomes the viscous damping (GE/W4) K"
        )
    return lines

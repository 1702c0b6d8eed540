"""A viscous damping matrix with its proportional part kept apart.

B = a K + b M + B'. Structural damping of the whole model (PARAM G with W3) and of one
material (GE with W4) are proportional to K. Time integration never multiplies by K
where the proportion is known (see `fem.transient`).
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

if TYPE_CHECKING:
    from fem.assembly import Matrices
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class Damping:
    """B = stiffness_factor K + mass_factor M + other.

    Attributes:
        stiffness_factor: a, s.
        mass_factor: b, 1/s.
        other: (n, n) B', sparse; None for none.
    """

    stiffness_factor: float = 0.0
    mass_factor: float = 0.0
    other: sp.csr_matrix | None = None

    @classmethod
    def of(
        cls,
        damping: "Damping | sp.spmatrix | sp.sparray | None",
        stiffness: sp.csr_matrix,
    ) -> "Damping":
        """Any form of B; a matrix that is a multiple of K is recognised as such."""
        if isinstance(damping, Damping):
            return damping
        if damping is None:
            return cls()
        matrix = sp.csr_matrix(damping, dtype=float)
        scale = np.abs(stiffness.data).max(initial=0.0)
        if matrix.nnz == 0 or scale == 0.0:
            return cls(other=matrix if matrix.nnz else None)
        factor = float(matrix.multiply(stiffness).sum() / stiffness.power(2).sum())
        rest = sp.csr_matrix(matrix - factor * stiffness)
        if np.abs(rest.data).max(initial=0.0) <= 1e-14 * abs(factor) * scale:
            return cls(stiffness_factor=factor)
        return cls(other=matrix)

    def matrix(self, stiffness: sp.csr_matrix, mass: sp.csr_matrix) -> sp.csr_matrix:
        """The whole B as one sparse matrix."""
        total = self.stiffness_factor * stiffness + self.mass_factor * mass
        if self.other is not None:
            total = total + self.other
        return sp.csr_matrix(total)


def damping_in_transients(deck: "Deck", matrices: "Matrices") -> Damping:
    """B = B1 + (G/W3 + ALPHA2) K + ALPHA1 M + K4/W4 of the g-set."""
    stiff, w3, w4 = (deck.number(name) for name in ("ALPHA2", "W3", "W4"))
    if w3 > 0.0:
        stiff += deck.number("G") / w3
    other = matrices.damping
    if w4 > 0.0 and matrices.structural_damping.nnz:
        k4 = sp.csr_matrix(matrices.structural_damping / w4)
        elements = Damping.of(k4, matrices.stiffness)
        stiff += elements.stiffness_factor
        if elements.other is not None:
            other = sp.csr_matrix(other + elements.other)
    return Damping(
        stiffness_factor=stiff,
        mass_factor=deck.number("ALPHA1"),
        other=other if other.nnz else None,
    )


def inactive_damping(deck: "Deck", matrices: "Matrices") -> list[str]:
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

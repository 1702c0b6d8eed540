"""A viscous damping matrix with its proportional part kept apart.

B = a K + b M + B'. Structural damping of the whole model (PARAM G with W3) and of one
material (GE with W4) are proportional to K. Time integration never multiplies by K
where the proportion is known (see `fem.response.direct`).
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.arrays import Float64


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
    def from_matrix(
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

    def projected(self, shape: Float64, stiffness: Float64, mass: Float64) -> Float64:
        """(m, m) symmetric Φᵀ B Φ.

        Args:
            shape: (n, m) Φ.
            stiffness: (m, m) Φᵀ K Φ.
            mass: (m, m) Φᵀ M Φ.
        """
        total = self.stiffness_factor * stiffness + self.mass_factor * mass
        if self.other is not None:
            total = total + shape.T @ (self.other @ shape)
        return 0.5 * (total + total.T)

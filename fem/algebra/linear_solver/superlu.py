"""scipy's SuperLU as the solver that is always there.

With the symmetric mode and no threshold pivoting, rows and columns are permuted alike
and the factorisation is an L D Lᵀ in disguise: the diagonal of U is D, and its signs
are the inertia (Sylvester). Where SuperLU had to leave the diagonal, the count is not
offered (`inertia` is None). Matrices that are not symmetric are pivoted as usual.
"""

from typing import Self

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import SuperLU, splu

from fem.algebra.linear_solver.interface import (
    Float64,
    Kind,
    SingularMatrixError,
    checked_right_side,
    room_for_solution,
)


class SuperLuFactorization:
    """A matrix factorised by SuperLU; see `Factorization` for the attributes.

    Args:
        matrix: (n, n), both triangles; symmetric, unless kind is "general".
        kind: "spd" raises on a negative pivot, "symmetric" counts them.

    Raises:
        SingularMatrixError: zero pivot, or a negative one with kind "spd".
    """

    def __init__(self, matrix: sp.spmatrix | sp.sparray, *, kind: Kind = "spd") -> None:
        csc = sp.csc_matrix(matrix, dtype=np.float64)
        self.n: int = matrix.shape[0]
        try:
            lu = splu(csc) if kind == "general" else _symmetric(csc)
        except RuntimeError as error:
            if "singular" not in str(error):
                raise
            raise SingularMatrixError(None) from error
        pivots = lu.U.diagonal()
        # Pivot i of the permuted matrix belongs to the row that perm_c sends to i.
        original = np.argsort(lu.perm_c)
        bad = pivots <= 0.0 if kind == "spd" else pivots == 0.0
        if bad.any():
            raise SingularMatrixError(int(original[np.flatnonzero(bad)[0]]))
        symmetric = kind != "general" and bool(np.array_equal(lu.perm_r, lu.perm_c))
        self.inertia = int(np.sum(pivots < 0.0)) if symmetric else None
        self.perturbed_pivots = 0
        self.nnz_factor = int(lu.L.nnz)
        self.memory_bytes = 12 * int(lu.L.nnz + lu.U.nnz)
        self._lu = lu

    def solve(self, right: Float64, out: Float64 | None = None) -> Float64:
        """Solution of A x = right, see `Factorization.solve`."""
        if self._lu is None:
            raise ValueError("the factorisation has been closed")
        b = checked_right_side(right, self.n)
        x = room_for_solution(b, out)
        if b.size:
            x[...] = self._lu.solve(b)
        return x

    def close(self) -> None:
        """Release the memory of the factor."""
        self._lu = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _symmetric(matrix: sp.csc_matrix) -> SuperLU:
    return splu(
        matrix,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )

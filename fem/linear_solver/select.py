"""The choice of the solver, in one place."""

import numpy as np
import scipy.sparse as sp

from fem.linear_solver.interface import Factorization, Kind, SolverName
from fem.linear_solver.pardiso import PardisoFactorization, pardiso_is_available
from fem.linear_solver.superlu import SuperLuFactorization


def factorize(
    matrix: sp.spmatrix | sp.sparray,
    *,
    kind: Kind = "spd",
    threads: int | None = None,
    solver: SolverName | None = None,
) -> Factorization:
    """Factorise a sparse symmetric matrix.

    Args:
        matrix: (n, n) sparse, symmetric, both triangles given.
        kind: "spd" for positive definite matrices, "symmetric" for indefinite ones
            (gives the inertia).
        threads: threads of PARDISO; None: the environment's number, else all cores.
        solver: "pardiso", "superlu" or None: PARDISO where it is installed.

    Returns:
        The factorisation; close it, or use it as a context manager.

    Raises:
        SingularMatrixError: zero pivot, or a negative one with kind "spd".
        ValueError: the matrix is not square, or holds NaN or infinity.
    """
    rows, columns = matrix.shape
    if rows != columns:
        raise ValueError(f"matrix has shape {matrix.shape}, expected a square one")
    if not np.isfinite(matrix.data).all():
        raise ValueError("the matrix holds NaN or infinite entries")
    if solver is None:
        solver = "pardiso" if pardiso_is_available() else "superlu"
    if solver == "pardiso":
        return PardisoFactorization(matrix, kind=kind, threads=threads)
    if solver == "superlu":
        return SuperLuFactorization(matrix, kind=kind)
    raise ValueError(f"solver '{solver}' is unknown, expected 'pardiso' or 'superlu'")

"""The choice of the solver, in one place."""

import numpy as np
import scipy.sparse as sp

from fem.algebra.linear_solver.interface import Factorization, Kind, SolverName
from fem.algebra.linear_solver.pardiso import PardisoFactorization, pardiso_is_available
from fem.algebra.linear_solver.superlu import SuperLuFactorization


def factorize(
    matrix: sp.spmatrix | sp.sparray,
    *,
    kind: Kind = "spd",
    threads: int | None = None,
    solver: SolverName | None = None,
    columns: int | None = None,
) -> Factorization:
    """Factorise a sparse matrix.

    Args:
        matrix: (n, n) sparse, both triangles given.
        kind: "spd" for positive definite matrices, "symmetric" for indefinite ones
            (gives the inertia), "general" for those that are not symmetric.
        threads: threads of PARDISO; None: the environment's number, else all cores.
        solver: "pardiso", "superlu" or None: PARDISO where it is installed.
        columns: right-hand sides at a time, where very many solves follow. For few,
            PARDISO looks for the smaller factor (a solve is a pass over it); for
            blocks and by default it takes the ordering with the larger dense parts.

    Returns:
        The factorisation; close it, or use it as a context manager.

    Raises:
        SingularMatrixError: zero pivot, or a negative one with kind "spd".
        ValueError: the matrix is not square, or holds NaN or infinity.
    """
    if matrix.shape[0] != matrix.shape[1]:
        raise ValueError(f"matrix has shape {matrix.shape}, expected a square one")
    if not np.isfinite(matrix.data).all():
        raise ValueError("the matrix holds NaN or infinite entries")
    if solver is None:
        solver = "pardiso" if pardiso_is_available() else "superlu"
    if solver == "pardiso":
        return PardisoFactorization(matrix, kind=kind, threads=threads, columns=columns)
    if solver == "superlu":
        return SuperLuFactorization(matrix, kind=kind)
    raise ValueError(f"solver '{solver}' is unknown, expected 'pardiso' or 'superlu'")

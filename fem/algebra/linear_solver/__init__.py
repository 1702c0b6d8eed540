"""Sparse direct factorisation of matrices behind one small interface.

MKL's PARDISO is the default where its library is installed (x86-64); scipy's SuperLU
serves everywhere else. Both keep the factor in memory and solve for single vectors
and for blocks of right-hand sides; blocks are several times cheaper per column.
"""

from fem.algebra.linear_solver.interface import (
    Factorization,
    Kind,
    SingularMatrixError,
    SolverName,
    default_threads,
)
from fem.algebra.linear_solver.pardiso import PardisoFactorization, pardiso_is_available
from fem.algebra.linear_solver.select import factorize
from fem.algebra.linear_solver.superlu import SuperLuFactorization

__all__ = [
    "Factorization",
    "Kind",
    "PardisoFactorization",
    "SingularMatrixError",
    "SolverName",
    "SuperLuFactorization",
    "default_threads",
    "factorize",
    "pardiso_is_available",
]

"""What every factorisation offers, and what it raises."""

import os
from typing import Literal, Protocol, Self

import numpy as np

from fem.arrays import Float64

Kind = Literal["spd", "symmetric", "general"]
SolverName = Literal["pardiso", "superlu"]


class SingularMatrixError(ArithmeticError):
    """The matrix is singular, or not positive definite where that was promised.

    Args:
        row: row at which the elimination stopped, None where it is unknown.
    """

    def __init__(self, row: int | None) -> None:
        self.row = row
        where = "" if row is None else f" at row {row}"
        super().__init__(f"zero or negative pivot{where}")


class Factorization(Protocol):
    """A factorised matrix A of order n; a context manager.

    Attributes:
        n: order of the matrix.
        inertia: number of negative eigenvalues of A (Sylvester's law), 0 for a
            positive definite matrix; None where pivoting made the count unsafe, and
            for matrices that are not symmetric.
        perturbed_pivots: pivots that the solver had to replace.
        nnz_factor: stored entries of one triangle of the factor.
        memory_bytes: memory that the factor holds.
    """

    @property
    def n(self) -> int: ...
    @property
    def inertia(self) -> int | None: ...
    @property
    def perturbed_pivots(self) -> int: ...
    @property
    def nnz_factor(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...

    def solve(self, right: Float64, out: Float64 | None = None) -> Float64:
        """Solution of A x = right.

        Args:
            right: (n,) or (n, k); Fortran order avoids a copy. Not overwritten.
            out: array of the same shape in Fortran order for the solution.

        Returns:
            Array of the same shape; blocks come in Fortran order.
        """
        ...

    def close(self) -> None:
        """Release the memory of the factor; solving is impossible afterwards."""
        ...

    def __enter__(self) -> Self: ...
    def __exit__(self, *exception: object) -> None: ...


def default_threads() -> int:
    """Threads of a factorisation: MKL_NUM_THREADS, OMP_NUM_THREADS, else all cores."""
    for name in ("MKL_NUM_THREADS", "OMP_NUM_THREADS"):
        text = os.environ.get(name, "")
        if text.isdigit() and int(text) > 0:
            return int(text)
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def checked_right_side(right: Float64, n: int) -> Float64:
    """The right-hand side as a float64 array whose columns lie contiguous in memory."""
    array = np.asarray(right, dtype=np.float64)
    if array.ndim not in (1, 2) or array.shape[0] != n:
        raise ValueError(
            f"right-hand side has shape {array.shape}, expected ({n}, ...)"
        )
    return np.asfortranarray(array)


def room_for_solution(right: Float64, out: Float64 | None) -> Float64:
    """The array that a solution goes into, of the shape of its right-hand side."""
    if out is None:
        return np.empty_like(right, order="F")
    if out.shape != right.shape or not out.flags.f_contiguous:
        raise ValueError(f"solution has shape {out.shape}, expected {right.shape}, 'F'")
    return out

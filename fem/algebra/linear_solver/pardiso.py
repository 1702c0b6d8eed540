"""MKL's PARDISO through ctypes: no per-call checks, no refinement, no copies.

The matrix is handed over in compressed rows, zero-based (iparm 35): the upper triangle,
or all of it where it is not symmetric. Solves run phase 33 only. Thread counts are set
for each call and put back, so that other users of MKL in the process keep theirs.

Reference: oneMKL Developer Reference, "oneMKL PARDISO Parameters in Tabular Form".
"""

import ctypes
import sys
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Self

import numpy as np
import scipy.sparse as sp

from fem.algebra.linear_solver.interface import (
    Float64,
    Kind,
    SingularMatrixError,
    checked_right_side,
    default_threads,
    room_for_solution,
)

_MATRIX_TYPE = {"spd": 2, "symmetric": -2, "general": 11}
_ANALYSE, _FACTORISE, _SOLVE, _RELEASE = 11, 22, 33, -1

# Positions in iparm (zero-based; the manual counts from one).
_OWN_VALUES, _ORDERING, _REFINEMENT, _PIVOT_EXPONENT = 0, 1, 7, 9
_SCALING, _MATCHING, _PERTURBED, _PEAK_KB, _SYMBOLIC_KB = 10, 12, 13, 14, 15
_FACTOR_KB, _FACTOR_NNZ, _NEGATIVE, _BAD_ROW, _ZERO_BASED = 16, 17, 22, 29, 34
_MINIMUM_DEGREE, _METIS = 0, 2
# Up to so many right-hand sides at a time a solve is bound by reading the factor.
_FEW = 4

_ERRORS = {
    -1: "inconsistent input",
    -2: "not enough memory",
    -3: "reordering failed",
    -5: "unclassified internal error",
    -6: "preordering failed",
    -7: "diagonal matrix is singular",
    -8: "integer overflow",
    -9: "not enough memory for out-of-core work",
}


def _candidates() -> list[Path]:
    """Places where the wheel `mkl`, conda or the system keep the library."""
    found: list[Path] = []
    try:
        files = metadata.files("mkl") or []
        found += [Path(str(f.locate())) for f in files if "mkl_rt" in f.name]
    except metadata.PackageNotFoundError:
        pass
    for folder in (Path(sys.prefix) / "lib", Path(sys.prefix) / "Library" / "bin"):
        found += sorted(folder.glob("*mkl_rt*"))
    return [path for path in found if path.exists()]


@cache
def _library() -> ctypes.CDLL | None:
    """The single dynamic library of MKL, None where it is absent."""
    for name in [*map(str, _candidates()), "libmkl_rt.so.3", "libmkl_rt.so.2"]:
        try:
            return ctypes.CDLL(name)
        except OSError:
            continue
    return None


def pardiso_is_available() -> bool:
    """Whether MKL's library can be loaded on this machine."""
    return _library() is not None


def _entries(matrix: sp.spmatrix | sp.sparray, kind: Kind) -> sp.csr_matrix:
    """Upper triangle with every diagonal entry present, as PARDISO demands.

    Both triangles of a matrix that is not symmetric.
    """
    upper = sp.coo_matrix(matrix if kind == "general" else sp.triu(matrix))
    diagonal = np.arange(matrix.shape[0])
    # Duplicates are summed: explicit zeros complete the pattern, values stay.
    rows = np.append(upper.row, diagonal)
    columns = np.append(upper.col, diagonal)
    values = np.append(upper.data, np.zeros(diagonal.size))
    result = sp.csr_matrix((values, (rows, columns)), shape=matrix.shape, dtype=float)
    result.sum_duplicates()
    return result


class PardisoFactorization:
    """A matrix factorised by PARDISO; see `Factorization` for the attributes.

    Args:
        matrix: (n, n); only the upper triangle is read, unless kind is "general".
        kind: "spd" for a Cholesky, "symmetric" for an L D Lᵀ factorisation, "general"
            for L U with pivots that are looked for.
        threads: threads for factorisation and solves; None: `default_threads()`.
        columns: right-hand sides of the many solves to come, see `factorize`.

    Raises:
        SingularMatrixError: zero pivot, or a negative one with kind "spd", or one that
            had to be replaced with kind "general".
        MemoryError: the factor does not fit.
    """

    def __init__(
        self,
        matrix: sp.spmatrix | sp.sparray,
        *,
        kind: Kind = "spd",
        threads: int | None = None,
        columns: int | None = None,
    ) -> None:
        library = _library()
        if library is None:
            raise RuntimeError("MKL's library libmkl_rt is not installed")
        self._mkl = library
        self._threads = threads or default_threads()
        self._given = _entries(matrix, kind)
        self.n: int = matrix.shape[0]
        self._indptr = np.ascontiguousarray(self._given.indptr, dtype=np.int32)
        self._indices = np.ascontiguousarray(self._given.indices, dtype=np.int32)
        self._handle = np.zeros(64, dtype=np.int64)
        self._type = _MATRIX_TYPE[kind]
        self._iparm = np.zeros(64, dtype=np.int32)
        self._iparm[[_OWN_VALUES, _ZERO_BASED]] = 1, 1
        self._iparm[_PIVOT_EXPONENT] = 8 if kind == "symmetric" else 13
        self._iparm[_REFINEMENT] = 0
        self._iparm[[_SCALING, _MATCHING]] = kind == "general"
        self._iparm[[_FACTOR_NNZ]] = -1
        self._open = True
        few = columns is not None and columns <= _FEW
        self._factorise(kind, (_METIS, _MINIMUM_DEGREE) if few else (_METIS,))

    def _analyse(self, orderings: tuple[int, ...]) -> None:
        """Order the unknowns; of several orderings the one with the smaller factor."""
        blank, attempts = self._iparm, []
        for ordering in orderings:
            self._handle, self._iparm = np.zeros(64, dtype=np.int64), blank.copy()
            self._iparm[_ORDERING] = ordering
            self._check(self._call(_ANALYSE, None, None, 1))
            attempts.append((self._handle, self._iparm))
        best, *others = sorted(attempts, key=lambda found: found[1][_FACTOR_NNZ])
        for self._handle, self._iparm in others:
            self._call(_RELEASE, None, None, 1)
        self._handle, self._iparm = best

    def _factorise(self, kind: Kind, orderings: tuple[int, ...]) -> None:
        try:
            self._analyse(orderings)
            error = self._call(_FACTORISE, None, None, 1)
            if error == -4:
                row = int(self._iparm[_BAD_ROW])
                raise SingularMatrixError(row - 1 if 0 < row <= self.n else None)
            self._check(error)
        except Exception:
            self.close()
            raise
        negative = int(self._iparm[_NEGATIVE]) if kind == "symmetric" else 0
        self.inertia = None if kind == "general" else negative
        self.perturbed_pivots = int(self._iparm[_PERTURBED])
        if kind == "general" and self.perturbed_pivots:
            self.close()
            raise SingularMatrixError(None)
        self.nnz_factor = int(self._iparm[_FACTOR_NNZ])
        kilobytes = int(self._iparm[_SYMBOLIC_KB]) + int(self._iparm[_FACTOR_KB])
        self.memory_bytes = 1024 * max(kilobytes, int(self._iparm[_PEAK_KB]))

    def _check(self, error: int) -> None:
        if error in (-2, -9):
            raise MemoryError(f"PARDISO: {_ERRORS[error]}")
        if error:
            text = _ERRORS.get(error, "unknown error")
            raise RuntimeError(f"PARDISO failed with {error}: {text}")

    def _call(
        self, phase: int, right: Float64 | None, x: Float64 | None, columns: int
    ) -> int:
        integer = ctypes.c_int
        error = integer(0)
        by = ctypes.byref
        void = ctypes.c_void_p

        def pointer(array: np.ndarray | None) -> ctypes.c_void_p:
            return void(None if array is None else array.ctypes.data)

        previous = self._mkl.MKL_Set_Num_Threads_Local(integer(self._threads))
        try:
            self._mkl.pardiso(
                pointer(self._handle),
                by(integer(1)),
                by(integer(1)),
                by(integer(self._type)),
                by(integer(phase)),
                by(integer(self.n)),
                pointer(self._given.data),
                pointer(self._indptr),
                pointer(self._indices),
                void(None),
                by(integer(columns)),
                pointer(self._iparm),
                by(integer(0)),
                pointer(right),
                pointer(x),
                by(error),
            )
        finally:
            self._mkl.MKL_Set_Num_Threads_Local(integer(previous))
        return error.value

    def solve(self, right: Float64, out: Float64 | None = None) -> Float64:
        """Solution of A x = right, see `Factorization.solve`."""
        if not self._open:
            raise ValueError("the factorisation has been closed")
        b = checked_right_side(right, self.n)
        x = room_for_solution(b, out)
        if b.size:
            columns = 1 if b.ndim == 1 else b.shape[1]
            self._check(self._call(_SOLVE, b, x, columns))
        return x

    def close(self) -> None:
        """Release the memory of the factor."""
        if getattr(self, "_open", False):
            self._open = False
            self._call(_RELEASE, None, None, 1)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __del__(self) -> None:
        if not sys.is_finalizing():
            self.close()

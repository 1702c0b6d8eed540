"""Products of mostly diagonal sparse matrices with blocks of vectors.

Lumped mass matrices are diagonal but for the few rows of offset masses and eliminated
constraints. Taking the diagonal apart makes the product a pass over the vectors alone.
Sums of vectors and products with the diagonal are taken piece by piece, so that what is
in between stays in the processor's cache.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Float64

Term = tuple[float, Float64]
_PIECE = 16384  # numbers at a time: a sum and what is added to it stay in the cache


def shape_of(matrix: sp.spmatrix | sp.sparray) -> tuple[int, int]:
    """Rows and columns; scipy's stubs leave them open for compressed matrices."""
    rows, columns = matrix.shape
    return int(rows), int(columns)


@dataclass(frozen=True)
class SplitMatrix:
    """A sparse matrix as its diagonal plus the rest on the rows it has.

    Attributes:
        diagonal: (n,) or None where it is zero.
        rows, columns: rows and columns of the rest.
        rest: (len(rows), len(columns)) the off-diagonal part, compressed.
    """

    diagonal: Float64 | None
    rows: npt.NDArray[np.intp]
    columns: npt.NDArray[np.intp]
    rest: sp.csr_matrix

    @classmethod
    def from_matrix(cls, matrix: sp.spmatrix | sp.sparray) -> "SplitMatrix":
        """Split a square sparse matrix."""
        diagonal = matrix.diagonal()
        rest = sp.coo_matrix(matrix)
        off = (rest.row != rest.col) & (rest.data != 0.0)
        rows, row_at = np.unique(rest.row[off], return_inverse=True)
        columns, column_at = np.unique(rest.col[off], return_inverse=True)
        compressed = sp.csr_matrix(
            (rest.data[off], (row_at, column_at)), shape=(len(rows), len(columns))
        )
        return cls(diagonal if diagonal.any() else None, rows, columns, compressed)

    def dot(self, vectors: Float64) -> Float64:
        """Product with vectors (c, n), one per row; a new array (c, n)."""
        product = (
            np.zeros_like(vectors) if self.diagonal is None else vectors * self.diagonal
        )
        if self.rest.nnz:
            if len(vectors) == 1:
                product[0, self.rows] += self.rest @ vectors[0, self.columns]
            else:
                product[:, self.rows] += (self.rest @ vectors[:, self.columns].T).T
        return product

    def of_sum(self, *terms: Term, out: Float64) -> None:
        """Product with a sum of factors times vectors (c, n), into `out`."""
        given = [term for term in terms if term[0] != 0.0]
        if self.diagonal is None:
            out[:] = 0.0
        else:
            scaled_sum(self.diagonal, *given, out=out)
        if self.rest.nnz and given:
            chosen = sum(factor * v[:, self.columns] for factor, v in given)
            out[:, self.rows] += (self.rest @ chosen.T).T


def scaled_sum(diagonal: Float64, *terms: Term, out: Float64) -> None:
    """A diagonal (n,) times a sum of factors times vectors (c, n), into `out`."""
    given = [(factor * diagonal, v) for factor, v in terms if factor != 0.0]
    for part, buffer in _pieces(out):
        whole = out[:, part]
        if not given:
            whole[:] = 0.0
        for i, (scale, vectors) in enumerate(given):
            target = buffer if i else whole
            np.multiply(vectors[:, part], scale[part], out=target)
            if i:
                whole += buffer


def weighted_sum(*terms: Term, out: Float64) -> None:
    """Sum of factors times vectors (c, n), into `out`, which is none of them."""
    given = [term for term in terms if term[0] != 0.0]
    for part, buffer in _pieces(out):
        whole = out[:, part]
        if not given:
            whole[:] = 0.0
        for i, (factor, vectors) in enumerate(given):
            np.multiply(vectors[:, part], factor, out=buffer if i else whole)
            if i:
                whole += buffer


def _pieces(vectors: Float64) -> Iterator[tuple[slice, Float64]]:
    """Columns piece by piece, and memory for as many numbers."""
    cases, size = vectors.shape
    width = max(1, min(size, _PIECE // max(cases, 1)))
    memory = np.empty((cases, width))
    for start in range(0, size, width):
        stop = min(start + width, size)
        yield slice(start, stop), memory[:, : stop - start]

"""Products of mostly diagonal sparse matrices with blocks of vectors.

Lumped mass matrices are diagonal but for the few rows of offset masses and eliminated
constraints. Taking the diagonal apart makes the product a pass over the vectors alone.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Float64


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
    def of(cls, matrix: sp.spmatrix | sp.sparray) -> "SplitMatrix":
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

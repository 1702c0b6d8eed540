"""The g-set as the free set and, below it, what depends on it.

With u_g = T u_f nearly all rows of T copy a freedom, a few combine many (an RBE3 on 700
freedoms). In the matrices of the free set such a row fills a block of 700 by 700; in
vectors that are extended by the dependent freedoms nothing fills, and a product with
Tᵀ A T costs little more than one with A.
"""

from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sp

from fem.algebra.sparse_products import SplitMatrix, Term, scaled_sum, shape_of
from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class Extension:
    """The g-set as vectors of the free set with the dependent freedoms below.

    Attributes:
        place: (g,) row of each freedom in an extended vector; -1: it is fixed.
        dependent: (d, f) dependent freedoms from the free set.
    """

    place: Int64 = field(repr=False)
    dependent: sp.csr_matrix = field(repr=False)

    @classmethod
    def from_expansion(cls, expand: sp.csr_matrix) -> "Extension":
        """The extension that u_g = T u_f (g, f) stands for."""
        T = sp.csr_matrix(expand, copy=True)
        T.eliminate_zeros()
        _, free = shape_of(T)
        count = np.diff(T.indptr)
        place = np.full(len(count), -1, np.int64)
        single = np.flatnonzero(count == 1)
        at = T.indptr[single]
        copied = T.data[at] == 1.0
        place[single[copied]] = T.indices[at][copied]
        rest = np.flatnonzero((place < 0) & (count > 0))
        place[rest] = free + np.arange(len(rest))
        return cls(place=place, dependent=sp.csr_matrix(T[rest]))

    @property
    def size(self) -> int:
        """Rows of an extended vector."""
        return sum(shape_of(self.dependent))

    def extended(self, displacement: Float64) -> Float64:
        """(f + d, ...) from vectors (f, ...)."""
        return np.concatenate([displacement, self.dependent @ displacement])

    def rows(self, operator: sp.csr_matrix) -> sp.csr_matrix:
        """(r, f + d) from rows on the g-set."""
        given = sp.coo_matrix(operator)
        place = self.place[given.col]
        keep = (place >= 0) & (given.data != 0.0)
        shape = (shape_of(operator)[0], self.size)
        entries = given.data[keep], (given.row[keep], place[keep])
        return sp.csr_matrix(entries, shape=shape)


@dataclass(frozen=True, kw_only=True)
class CondensedProduct:
    """Products with Tᵀ A T by its factors; as `SplitMatrix`.

    Attributes:
        split: A on extended vectors.
        columns: (k,) freedoms that others depend on.
        dependent: (d, k) how they do.
        free: f, size of the free set.
    """

    split: SplitMatrix = field(repr=False)
    columns: Int64 = field(repr=False)
    dependent: sp.csr_matrix = field(repr=False)
    free: int

    @classmethod
    def from_matrix(
        cls, matrix: sp.csr_matrix, expand: sp.csr_matrix
    ) -> "CondensedProduct":
        """Products with T' A T, from A (g, g) and T (g, f)."""
        extension = Extension.from_expansion(expand)
        half = extension.rows(matrix)  # (g, f + d)
        whole = extension.rows(sp.csr_matrix(half.T)).T
        columns = np.unique(extension.dependent.indices)
        return cls(
            split=SplitMatrix.from_matrix(sp.csr_matrix(whole)),
            columns=columns,
            dependent=sp.csr_matrix(extension.dependent[:, columns]),
            free=shape_of(expand)[1],
        )

    def dot(self, vectors: Float64) -> Float64:
        """Product with vectors (c, f), one per row; a new array (c, f)."""
        out = np.empty_like(vectors)
        self.of_sum((1.0, vectors), out=out)
        return out

    def of_sum(self, *terms: Term, out: Float64) -> None:
        """Product with a sum of factors times vectors (c, f), into `out`."""
        split, f = self.split, self.free
        diagonal = split.diagonal
        if diagonal is None:
            diagonal = np.zeros(f + shape_of(self.dependent)[0])
        scaled_sum(diagonal[:f], *terms, out=out)
        moved = (self.dependent @ _chosen(terms, self.columns).T).T
        on_dependent = moved * diagonal[f:]
        if split.rest.nnz:
            free, rows = (
                np.searchsorted(split.columns, f),
                np.searchsorted(split.rows, f),
            )
            beside = moved[:, split.columns[free:] - f]
            given = np.hstack([_chosen(terms, split.columns[:free]), beside])
            found = (split.rest @ given.T).T
            out[:, split.rows[:rows]] += found[:, :rows]
            on_dependent[:, split.rows[rows:] - f] += found[:, rows:]
        out[:, self.columns] += (self.dependent.T @ on_dependent.T).T


def _chosen(terms: tuple[Term, ...], columns: Int64) -> Float64:
    """(c, k) columns of a sum of factors times vectors."""
    found = [factor * vectors[:, columns] for factor, vectors in terms if factor]
    return sum(found[1:], found[0]) if found else 0.0 * terms[0][1][:, columns]

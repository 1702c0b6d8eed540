"""Rows of elements as maps of the displacements that an element hangs on, and few more.

A row that hangs on grids under a constraint (a rib of an RBE3 on 700 freedoms) would
have hundreds of entries on the free set. Here it has those of its own grids: vectors of
the free set are extended by the dependent freedoms (`fem.algebra.extension`), which are
computed once for all elements.
"""

from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sp

from drake_landing.parts.stress_kernels import AT_ONCE
from fem.algebra.sparse_products import shape_of
from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class DenseRows:
    """Rows of elements, dense: as `stress_kernels.of_displacements` takes them.

    Attributes:
        pointer: (e + 1,) where the columns of each element begin.
        column: (d,) their places in extended vectors.
        coefficient: (d, k) rows of an element, column by column.
    """

    pointer: Int64 = field(repr=False)
    column: Int64 = field(repr=False)
    coefficient: Float64 = field(repr=False)

    @classmethod
    def from_sparse(cls, operator: sp.csr_matrix, elements: int) -> "DenseRows":
        """Dense rows of a sparse operator (e k, n), k rows an element."""
        rows, n = shape_of(operator)
        k = rows // max(elements, 1)
        given = sp.coo_matrix(operator)
        element, row = given.row // max(k, 1), given.row % max(k, 1)
        pairs, at = np.unique(
            element.astype(np.int64) * n + given.col, return_inverse=True
        )
        dense = np.zeros((len(pairs), k))
        np.add.at(dense, (at, row), given.data)
        count = np.bincount(pairs // n, minlength=elements)
        padded = -(-count // AT_ONCE) * AT_ONCE
        pointer, first = (np.concatenate([[0], np.cumsum(c)]) for c in (padded, count))
        place = np.arange(len(pairs)) + np.repeat(pointer[:-1] - first[:-1], count)
        column = np.zeros(pointer[-1], np.int64)
        coefficient = np.zeros((pointer[-1], k))
        # Padding repeats a column of the element itself, with nothing upon it.
        for extra in range(AT_ONCE):
            short = np.flatnonzero(padded - count > extra)
            column[pointer[short + 1] - 1 - extra] = (pairs % n)[first[short]]
        column[place], coefficient[place] = pairs % n, dense
        return cls(pointer=pointer, column=column, coefficient=coefficient)

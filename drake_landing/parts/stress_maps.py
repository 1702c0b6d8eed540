"""Linear maps from displacements to the quantities that stresses follow from."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Evaluate = Callable[[Float64], Float64]

MEASURES = ("equivalent", "largest", "smallest")


@dataclass(frozen=True, kw_only=True)
class StressPiece:
    """Some elements of a part.

    Attributes:
        elements, rows: slices of the elements and linear quantities of the part.
        evaluate: from (..., n k) linear quantities to (..., n, 3) `MEASURES`.
    """

    elements: slice
    rows: slice
    evaluate: Evaluate


@dataclass(frozen=True, kw_only=True)
class StressPart:
    """Elements of one kind.

    Attributes:
        id: (e,) elements.
        operator: (e k, g) from displacements of the g-set to k linear quantities of
            each element.
        pieces: the elements in groups whose histories fit into a cache.
    """

    id: Int64
    operator: sp.csr_matrix
    pieces: tuple[StressPiece, ...]

    def of(self, displacement: Float64) -> Float64:
        """(c, e, 3) under displacements of the g-set (g, c)."""
        linear = np.asarray(self.operator @ displacement).T
        found = [piece.evaluate(linear[:, piece.rows]) for piece in self.pieces]
        return np.concatenate(found, axis=1)

"""A matrix as it lies in a file: its name, its values, perhaps names of its rows."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fem.arrays import Int64

SQUARE, RECTANGULAR, SYMMETRIC = 1, 2, 6


@dataclass(frozen=True, kw_only=True)
class NamedMatrix:
    """A matrix; where a reduction or a deck uses it, it must be real.

    Attributes:
        name: up to eight characters.
        values: (n, m), real or complex, finite.
        rows, columns: (n, 2), (m, 2) point id and component (0 for a scalar point);
            None where the file does not say (OUTPUT4, HDF5).
    """

    name: str
    values: npt.NDArray[Any]
    rows: Int64 | None = None
    columns: Int64 | None = None

    @property
    def form(self) -> int:
        """Nastran's: 6 symmetric, 1 square, 2 rectangular."""
        n, m = self.values.shape
        if n != m:
            return RECTANGULAR
        return SYMMETRIC if np.array_equal(self.values, self.values.T) else SQUARE

"""Extremes over time of all element results, in one pass and without histories.

For every element and every column of a table (von Mises among them) the smallest and
the largest value and their times. Works on chunks of the response while a transient
runs; memory is four numbers per element and column.
"""

import h5py
import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Float64
from fem.recovery.elements import ElementTable
from fem.recovery.table_response import Factors, TableResponse
from fem.response.observation import Chunk


class Envelope:
    """Observer that keeps the extremes of one table.

    Args:
        table: which elements and results.
        expand: (g, n) g-set from the freedoms of the transient.
        name: group of the result file.
        case: load case.
        factors: see `TableResponse`.

    Attributes:
        smallest, largest: (e, c) extremes in the columns of the table.
        time_of_smallest, time_of_largest: (e, c) when they occur first, s.
    """

    def __init__(
        self,
        table: ElementTable,
        expand: sp.csr_matrix,
        name: str = "envelope",
        case: int = 0,
        factors: Factors | None = None,
    ) -> None:
        self.table, self._name = table, name
        self._response = TableResponse(table, expand, case, factors)
        shape = (len(table.id), len(table.columns))
        self.smallest, self.largest = np.full(shape, np.inf), np.full(shape, -np.inf)
        self.time_of_smallest, self.time_of_largest = np.zeros(shape), np.zeros(shape)

    @property
    def name(self) -> str:
        """Group of the result file."""
        return self._name

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Start afresh; see `Observer`."""
        self.smallest[:], self.largest[:] = np.inf, -np.inf

    def observe(self, chunk: Chunk) -> None:
        """Take the extremes of a chunk; see `Observer`."""
        linear = self._response.linear(chunk)
        for piece in self.table.pieces:
            values = piece.evaluate(linear)
            for sign, extreme, when in (
                (1.0, self.smallest, self.time_of_smallest),
                (-1.0, self.largest, self.time_of_largest),
            ):
                _update(values, sign, extreme, when, piece.place, chunk.time)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Bytes of the extremes."""
        return 4 * self.largest.nbytes

    def write(self, file: h5py.File) -> None:
        """Datasets `min`, `max`, `time_of_min`, `time_of_max`, `id`."""
        group = file.create_group(f"{self._name}/{self.table.table}")
        group["id"] = self.table.id
        group["min"], group["max"] = self.smallest, self.largest
        group["time_of_min"] = self.time_of_smallest
        group["time_of_max"] = self.time_of_largest
        group.attrs["columns"] = list(self.table.columns)


def _update(
    values: Float64,
    sign: float,
    extreme: Float64,
    when: Float64,
    place: npt.NDArray[np.intp],
    time: Float64,
) -> None:
    """Smaller (sign 1) or larger (-1) values (m, n, c) go into extremes at places."""
    found = values.min(axis=0) if sign > 0.0 else values.max(axis=0)
    known = extreme[place]
    better = sign * found < sign * known
    if not better.any():
        return
    known[better] = found[better]
    extreme[place] = known
    # When it is so is looked up for the new extremes only.
    at = np.argmin(sign * values[:, better], axis=0)
    times = when[place]
    times[better] = time[at]
    when[place] = times

"""Observer of a transient: the worst stress of every element, and its field."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from drake_landing.parts.stress import Stresses
from fem.observation import Chunk

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Snapshot:
    """Displacements at one instant.

    Attributes:
        time: s.
        element: whose stress is at its worst then.
        displacement: (f,) of the free set.
    """

    time: float
    element: int
    displacement: Float64 = field(repr=False)


class StressWatch:
    """Keeps extremes over time, and the displacements at the worst instants.

    Args:
        stresses: of all elements.
        group: (e,) number of the component of each element.
        allowed: (e,) Pa, NaN where unknown: the worst element of a component is the one
            with the highest stress over this, if any is known there.

    Attributes:
        equivalent: (c, e) largest equivalent stress of c load cases.
        time: (c, e) when.
        largest, smallest: (c, e) extremes of the direct or principal stresses.
        worst: component -> snapshot, of the first load case.
    """

    def __init__(self, stresses: Stresses, group: Int64, allowed: Float64) -> None:
        self.stresses = stresses
        self._group = group
        self._weight = _weights(group, allowed)
        self._highest: dict[int, float] = {}
        self.worst: dict[int, Snapshot] = {}
        self.equivalent = self.time = self.largest = self.smallest = np.zeros((0, 0))

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Start afresh; see `Observer`."""
        shape = (cases, len(self.stresses.id))
        self.equivalent, self.time = np.zeros(shape), np.full(shape, time[0])
        self.largest, self.smallest = np.zeros(shape), np.zeros(shape)
        self._highest, self.worst = {}, {}

    def observe(self, chunk: Chunk) -> None:
        """Take the extremes of a chunk; see `Observer`."""
        first = 0
        for part in self.stresses.parts:
            linear = chunk.get("displacement", part.operator)
            for piece in part.pieces:
                at = slice(first + piece.elements.start, first + piece.elements.stop)
                self._take(at, piece.evaluate(linear[..., piece.rows]), chunk.time)
            first += len(part.id)
        self._snap(chunk)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Bytes of extremes and snapshots."""
        snapshots = len(np.unique(self._group)) * size
        return 8 * (4 * cases * len(self.stresses.id) + snapshots)

    def _take(self, at: slice, values: Float64, time: Float64) -> None:
        """Extremes of (m, c, n, 3) go into those of the elements `at`."""
        equal = values[..., 0]
        when = equal.argmax(axis=0)
        found = np.take_along_axis(equal, when[None], axis=0)[0]
        known = self.equivalent[:, at]
        better = found > known
        self.equivalent[:, at] = np.where(better, found, known)
        self.time[:, at] = np.where(better, time[when], self.time[:, at])
        np.maximum(self.largest[:, at], values[..., 1].max(0), self.largest[:, at])
        np.minimum(self.smallest[:, at], values[..., 2].min(0), self.smallest[:, at])

    def _snap(self, chunk: Chunk) -> None:
        """Displacements of the chunk's worst instants that are worse than before."""
        score = self.equivalent[0] * self._weight
        order = np.argsort(-score, kind="stable")
        group, first = np.unique(self._group[order], return_index=True)
        improved = [
            (int(g), int(e))
            for g, e in zip(group, order[first])
            if score[e] > self._highest.get(int(g), 0.0)
        ]
        if not improved:
            return
        window = chunk.get("displacement")
        for component, e in improved:
            self._highest[component] = float(score[e])
            row = int(np.argmin(np.abs(chunk.time - self.time[0, e])))
            self.worst[component] = Snapshot(
                time=float(chunk.time[row]),
                element=int(self.stresses.id[e]),
                displacement=window[row, 0].copy(),
            )


def _weights(group: Int64, allowed: Float64) -> Float64:
    """(e,) factors that make stresses comparable within a component."""
    weight = np.where(np.isfinite(allowed), 1.0 / allowed, 0.0)
    for component in np.unique(group):
        own = group == component
        if not weight[own].any():
            weight[own] = 1.0
    return weight

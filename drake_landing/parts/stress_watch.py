"""Observer of a transient: the worst stress of every element, and its field."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from drake_landing.parts.stress import Stresses
from fem.algebra.sparse_products import shape_of
from fem.response.observation import Chunk

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
        about: (f,) displacements to which the transient is an increment: the first load
            case upon them is one more case, the last. None: there is none.

    Attributes:
        equivalent: (c, e) largest equivalent stress of c cases.
        time: (c, e) when.
        largest, smallest: (c, e) extremes of the direct or principal stresses.
        worst: component -> snapshot, of the first load case upon `about`.
    """

    def __init__(
        self,
        stresses: Stresses,
        group: Int64,
        allowed: Float64,
        about: Float64 | None = None,
    ) -> None:
        self.stresses = stresses
        self._about = about
        self._offset = [
            None if about is None else part.operator @ about for part in stresses.parts
        ]
        self._group = group
        self._weight = np.where(stresses.axial_only, 0.0, _weights(group, allowed))
        self._highest: dict[int, float] = {}
        self.worst: dict[int, Snapshot] = {}
        self.equivalent = self.time = self.largest = self.smallest = np.zeros((0, 0))

    @property
    def content(self) -> list[object]:
        """What decides about the worst elements."""
        return [self._group, self._weight, self._about]

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Start afresh; see `Observer`."""
        shape = (cases + (self._about is not None), len(self.stresses.id))
        self.equivalent, self.time = np.zeros(shape), np.full(shape, time[0])
        self.largest, self.smallest = np.zeros(shape), np.zeros(shape)
        self._highest, self.worst = {}, {}

    def observe(self, chunk: Chunk) -> None:
        """Take the extremes of a chunk; see `Observer`."""
        first = 0
        for part, offset in zip(self.stresses.parts, self._offset):
            linear = chunk.get("displacement", part.operator)
            if offset is not None:
                linear = np.concatenate([linear, linear[:, :1] + offset], axis=1)
            for piece in part.pieces:
                at = slice(first + piece.elements.start, first + piece.elements.stop)
                self._take(at, piece.evaluate(linear[..., piece.rows]), chunk.time)
            first += len(part.id)
        self._snap(chunk)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Bytes of extremes and snapshots."""
        snapshots = len(np.unique(self._group)) * size
        return 8 * (4 * cases * len(self.stresses.id) + snapshots)

    def arrays(self) -> dict[str, npt.NDArray]:
        """All that was found, for `restore`."""
        worst = list(self.worst.values())
        size = (
            shape_of(self.stresses.parts[0].operator)[1] if self.stresses.parts else 0
        )
        return {
            "equivalent": self.equivalent,
            "time": self.time,
            "largest": self.largest,
            "smallest": self.smallest,
            "worst_group": np.array(list(self.worst), np.int64),
            "worst_time": np.array([w.time for w in worst], float),
            "worst_element": np.array([w.element for w in worst], np.int64),
            "worst_displacement": np.array(
                [w.displacement for w in worst], float
            ).reshape(len(worst), size),
        }

    def restore(self, arrays: Mapping[str, npt.NDArray]) -> None:
        """Takes over what the same observer has found before."""
        self.equivalent, self.time = arrays["equivalent"], arrays["time"]
        self.largest, self.smallest = arrays["largest"], arrays["smallest"]
        self.worst = {
            int(group): Snapshot(time=float(t), element=int(e), displacement=u)
            for group, t, e, u in zip(
                arrays["worst_group"],
                arrays["worst_time"],
                arrays["worst_element"],
                arrays["worst_displacement"],
            )
        }

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
        case = 0 if self._about is None else -1
        score = self.equivalent[case] * self._weight
        order = np.argsort(-score, kind="stable")
        group, first = np.unique(self._group[order], return_index=True)
        improved = [
            (int(g), int(e))
            for g, e in zip(group, order[first])
            if score[e] > self._highest.get(int(g), 0.0)
        ]
        if not improved:
            return
        window, about = chunk.get("displacement"), self._about
        for component, e in improved:
            self._highest[component] = float(score[e])
            row = int(np.argmin(np.abs(chunk.time - self.time[case, e])))
            self.worst[component] = Snapshot(
                time=float(chunk.time[row]),
                element=int(self.stresses.id[e]),
                displacement=window[row, 0] + (0.0 if about is None else about),
            )


def _weights(group: Int64, allowed: Float64) -> Float64:
    """(e,) factors that make stresses comparable within a component."""
    weight = np.where(np.isfinite(allowed), 1.0 / allowed, 0.0)
    for component in np.unique(group):
        own = group == component
        if not weight[own].any():
            weight[own] = 1.0
    return weight

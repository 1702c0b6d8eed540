"""Observer of a transient: the worst stress of every element, and its field."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from drake_landing.parts.stress import Stresses
from drake_landing.parts.stress_extremes import Steady, StressExtremes
from drake_landing.parts.stress_rows import Extremes, stress_maps
from fem.algebra.sparse_products import shape_of
from fem.response.observation import Chunk

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_STATE = ("square", "when", "high", "low")


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
        maps = stress_maps(stresses)
        steady = None if about is None else Steady(stress=maps.of(about), apart=True)
        self._seen = StressExtremes(maps.rows, maps.maps(), maps.extension, steady)
        self._group = group
        self._weight = np.where(stresses.axial_only, 0.0, _weights(group, allowed))
        self._highest: dict[int, float] = {}
        self.worst: dict[int, Snapshot] = {}

    @property
    def equivalent(self) -> Float64:
        """(c, e) largest equivalent stress of c cases, Pa."""
        return self._seen.state.equivalent.T

    @property
    def time(self) -> Float64:
        """(c, e) when, s."""
        return self._seen.time[self._seen.state.when.T]

    @property
    def largest(self) -> Float64:
        """(c, e) of the direct or principal stresses, Pa."""
        return self._seen.state.high.T

    @property
    def smallest(self) -> Float64:
        """(c, e) of the direct or principal stresses, Pa."""
        return self._seen.state.low.T

    @property
    def content(self) -> list[object]:
        """Settings that decide about the worst elements, for keys of the cache."""
        return [self._group, self._weight, self._about]

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Start afresh; see `Observer`."""
        self._seen.begin(time, cases, size)
        self._highest, self.worst = {}, {}

    def observe(self, chunk: Chunk) -> None:
        """Take the extremes of a chunk; see `Observer`."""
        self._seen.observe(chunk)
        self._snap(chunk)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Bytes of extremes and snapshots."""
        snapshots = len(np.unique(self._group)) * size
        return 8 * snapshots + self._seen.memory_bytes(times, cases, size)

    def arrays(self) -> dict[str, npt.NDArray]:
        """Extremes and their instants as arrays, for `restore`."""
        worst, state = list(self.worst.values()), self._seen.state
        _, size = shape_of(self.stresses.expand)
        return {
            "instants": self._seen.time,
            **{name: getattr(state, name) for name in _STATE},
            "worst_group": np.array(list(self.worst), np.int64),
            "worst_time": np.array([w.time for w in worst], float),
            "worst_element": np.array([w.element for w in worst], np.int64),
            "worst_displacement": np.array(
                [w.displacement for w in worst], float
            ).reshape(len(worst), size),
        }

    def restore(self, arrays: Mapping[str, npt.NDArray]) -> None:
        """Takes over what the same observer has found before."""
        self._seen.time = arrays["instants"]
        self._seen.state = Extremes(**{name: arrays[name] for name in _STATE})
        self.worst = {
            int(group): Snapshot(time=float(t), element=int(e), displacement=u)
            for group, t, e, u in zip(
                arrays["worst_group"],
                arrays["worst_time"],
                arrays["worst_element"],
                arrays["worst_displacement"],
            )
        }

    def _snap(self, chunk: Chunk) -> None:
        """Displacements of the chunk's worst instants that are worse than before."""
        case = 0 if self._about is None else -1
        state = self._seen.state.take(slice(None), slice(case, None if case else 1))
        score = state.equivalent[:, 0] * self._weight
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
            row = int(state.when[e, 0]) - chunk.first
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

"""Observer of a transient: extremes of all elements' stresses, every load case."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from drake_landing.parts.stress_kernels import lanes_of
from drake_landing.parts.stress_rows import Extremes, Map, StressRows, starts
from fem.algebra.extension import Extension
from fem.arrays import Float64
from fem.response.observation import Chunk

# Lanes at a time: they fill the vector units, and what a tile of them reads of the
# displacements stays in the second cache until the neighbouring elements need it.
_LANES = 32


@dataclass(frozen=True, kw_only=True)
class Steady:
    """Stresses that those of the transient add to.

    Attributes:
        stress: per part, (e per_element,) Pa.
        apart: they count in one more load case alone, the last, which else is the
            first; else in all.
    """

    stress: Sequence[Float64] = field(repr=False)
    apart: bool = False


class StressExtremes:
    """Keeps the largest stresses of every element and when they occur.

    Args:
        rows: all parts.
        maps: of each, on extended vectors.
        extension: of vectors of the free set.
        steady: what comes to the stresses; None: nothing.
        until: (c,) s, when each load case is over; None: none is before the last.

    Attributes:
        time: (t,) output times, s.
        state: extremes of all elements and cases.
    """

    def __init__(
        self,
        rows: Sequence[StressRows],
        maps: Sequence[Map],
        extension: Extension,
        steady: Steady | None = None,
        until: Sequence[float] | None = None,
    ) -> None:
        self._rows, self._maps, self._extension = rows, maps, extension
        self._steady = steady
        self._until = None if until is None else np.asarray(until, float)
        if until is not None and steady is not None and steady.apart:
            self._until = np.append(self._until, until[0])
        self._offset = (
            [np.zeros(r.size * r.per_element) for r in rows]
            if steady is None
            else [np.asarray(s, float) for s in steady.stress]
        )
        self.time: Float64 = np.zeros(0)
        self.state = Extremes.zero(0)

    @property
    def size(self) -> int:
        """Elements."""
        return sum(r.size for r in self._rows)

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Start afresh; see `Observer`."""
        apart = self._steady is not None and self._steady.apart
        self.time, self.state = time, Extremes.zero(self.size, cases + apart)

    def observe(self, chunk: Chunk) -> None:
        """Take the extremes of a chunk; see `Observer`.

        Raises:
            ArithmeticError: displacements are not finite.
        """
        window = chunk.get("displacement")
        if not np.isfinite(window[-1:]).all():
            at = f"before {chunk.time[-1]:.4g} s"
            raise ArithmeticError(f"displacements are not finite any more {at}")
        total = self.state.square.shape[1]
        # All tiles alike: a short one at the end would leave lanes empty.
        tiles = max(1, round(len(window) * total / _LANES))
        for part in np.array_split(np.arange(len(window)), min(tiles, len(window))):
            if len(part):
                self._tile(window[part[0] : part[-1] + 1], chunk.first + int(part[0]))

    def _tile(self, window: Float64, first: int) -> None:
        total, free = self.state.square.shape[1], window.shape[2]
        u = np.empty((self._extension.size, len(window) * total))
        lanes_of(window, total, u)
        if self._until is not None:
            # At rest is no extreme: every load case begins there.
            time = self.time[first : first + len(window), None]
            u[:free, (time > self._until).ravel()] = 0.0
        u[free:] = self._extension.dependent @ u[:free]
        share = np.tile(self._share(total), len(window))
        for rows, maps, offset, at in zip(
            self._rows, self._maps, self._offset, starts(self._rows)
        ):
            rows.of_displacements(maps, offset, share, u, first, self.state, int(at))

    def _share(self, total: int) -> Float64:
        """(cases,) of the steady stresses that comes to each."""
        if self._steady is None or self._steady.apart:
            share = np.zeros(total)
            share[-1] = self._steady is not None
            return share
        return np.ones(total)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Bytes of the extremes and of a tile."""
        return 28 * (cases + 1) * self.size + 8 * _LANES * self._extension.size

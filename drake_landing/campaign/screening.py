"""Envelopes of all elements from the amplitudes of a landing.

Stresses are products of the stress modes with the amplitudes, tile by tile in the
processor's cache, in single precision (the modes' truncation is four orders larger);
extremes are taken by compiled kernels.

Most instants need not be looked at. Von Mises' stress, the largest principal magnitude
and that of a bar are norms, so that between two coarse instants, with the chord q_c of
the amplitudes q from one to the other,

    |S q(t)| <= max(|S q_0|, |S q_1|) + Σ |S_i| max_t |q_i(t) - q_c,i(t)|.

The largest principal stress, and less the smallest, are convex, which gives them the
same bound. Where it stays below what is known of an element already, no instant of the
interval can be its extreme. Nothing is lost by this: the extremes are those of all
instants.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from drake_landing.campaign.basis import ScreeningBasis
from drake_landing.parts.stress_kernels import norms_of, of_intervals
from drake_landing.parts.stress_rows import Extremes, StressRows, starts
from fem.arrays import Float64

_ROWS = 512  # of a tile: with 1000 instants it stays in the cache
_INTERVAL = 16  # instants: two vectors of the processor
_ROUNDING = 1.0 + 1e-5  # of bounds in single precision


@dataclass(frozen=True, kw_only=True)
class Screened:
    """Stresses of one landing.

    Attributes:
        equivalent: (e,) largest equivalent stress, Pa.
        when: (e,) number of its instant.
        high, low: (e,) largest and smallest direct or principal stress, Pa.
    """

    equivalent: Float64
    when: np.ndarray
    high: Float64
    low: Float64


@dataclass(frozen=True, kw_only=True)
class _Intervals:
    """Amplitudes by intervals of time.

    Attributes:
        coarse: (r, c) at the ends of the intervals.
        fine: (c - 1, r, s) at the instants after each first end, the second included.
        bend: (r, c - 1) largest distances from the chords.
    """

    coarse: np.ndarray
    fine: np.ndarray
    bend: np.ndarray

    @classmethod
    def from_samples(cls, q: np.ndarray) -> "_Intervals":
        """Intervals of amplitudes (r, t), the last one repeated to fill them."""
        r, t = q.shape
        count = max(1, -(-(t - 1) // _INTERVAL))
        full = np.concatenate(
            [q, np.repeat(q[:, -1:], count * _INTERVAL + 1 - t, axis=1)], axis=1
        )
        coarse = np.ascontiguousarray(full[:, ::_INTERVAL])
        fine = full[:, 1:].reshape(r, count, _INTERVAL)
        share = np.arange(1, _INTERVAL + 1, dtype=q.dtype) / q.dtype.type(_INTERVAL)
        step = np.diff(coarse, axis=1)[..., None]
        away = np.abs(fine - coarse[:, :-1, None] - share * step).max(axis=2)
        return cls(
            coarse=coarse,
            fine=np.ascontiguousarray(fine.transpose(1, 0, 2)),
            bend=away * q.dtype.type(_ROUNDING),
        )


def screen(
    basis: ScreeningBasis,
    rows: Sequence[StressRows],
    amplitudes: Float64,
    steady: Sequence[np.ndarray] | None = None,
) -> Screened:
    """Extremes of all elements over all instants.

    Args:
        basis: stress modes of `rows`.
        rows: all parts.
        amplitudes: (n + 6 k, t).
        steady: per part, (e per_element,) stresses that the landing's add to; None:
            increments alone.
    """
    q = np.ascontiguousarray(amplitudes, dtype=np.float32)
    intervals = _Intervals.from_samples(q)
    state = Extremes.zero(sum(r.size for r in rows))
    for i, (part, at) in enumerate(zip(rows, starts(rows))):
        modes = basis.stress[i]
        still = np.zeros(len(modes)) if steady is None else steady[i]
        still = still.astype(np.float32)
        for elements in _tiles(part):
            k = part.per_element
            own = slice(elements.start * k, elements.stop * k)
            found = state.take(slice(int(at) + elements.start, int(at) + elements.stop))
            if part.kind == "other":
                sigma = modes[own] @ q + still[own, None]
                part.of_rows(sigma, elements, 0, state, int(at))
            else:
                _pruned(part, elements, modes[own], still[own], intervals, found)
    return Screened(
        equivalent=state.equivalent[:, 0],
        when=np.minimum(state.when[:, 0], q.shape[1] - 1),
        high=state.high[:, 0],
        low=state.low[:, 0],
    )


def _pruned(
    part: StressRows,
    elements: slice,
    modes: np.ndarray,
    steady: np.ndarray,
    intervals: _Intervals,
    found: Extremes,
) -> None:
    """Extremes of a tile of sheets or lines."""
    sheet, isotropic = part.kind == "sheet", part.isotropic[elements]
    norms = np.empty((len(isotropic), modes.shape[1]), modes.dtype)
    norms_of(sheet, modes, part.points, isotropic, norms)
    of_intervals(
        sheet,
        modes @ intervals.coarse + steady[:, None],
        norms @ intervals.bend,
        modes,
        steady,
        intervals.fine,
        part.points,
        isotropic,
        found.square,
        found.when,
        found.high,
        found.low,
    )


def history_of(
    basis: ScreeningBasis,
    rows: Sequence[StressRows],
    part: int,
    element: int,
    amplitudes: Float64,
) -> Float64:
    """(per_element, t) stresses of one element over time, increments, Pa."""
    k = rows[part].per_element
    own = slice(element * k, (element + 1) * k)
    return basis.stress[part][own].astype(float) @ amplitudes


def _tiles(part: StressRows) -> Iterator[slice]:
    if part.kind == "other":
        yield from (piece.elements for piece in part.part.pieces)
        return
    count = max(1, _ROWS // part.per_element)
    for start in range(0, part.size, count):
        yield slice(start, min(start + count, part.size))

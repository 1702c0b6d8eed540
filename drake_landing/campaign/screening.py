"""Envelopes of all elements from the amplitudes of a landing.

Stresses are products of the stress modes with the amplitudes, tile by tile in the
processor's cache, in single precision (the modes' truncation is four orders larger);
extremes are taken by compiled kernels.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from drake_landing.campaign.basis import ScreeningBasis
from drake_landing.parts.stress_rows import Extremes, StressRows, starts
from fem.arrays import Float64

_ROWS = 512  # of a tile: with 1000 instants it stays in the cache


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
    state = Extremes.zero(sum(r.size for r in rows))
    for i, (part, at) in enumerate(zip(rows, starts(rows))):
        k = part.per_element
        for elements in _tiles(part):
            own = slice(elements.start * k, elements.stop * k)
            sigma = basis.stress[i][own] @ q
            if steady is not None:
                sigma += steady[i][own, None].astype(np.float32)
            part.of_rows(sigma, elements, 0, state, int(at))
    return Screened(
        equivalent=state.equivalent[:, 0],
        when=state.when[:, 0],
        high=state.high[:, 0],
        low=state.low[:, 0],
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

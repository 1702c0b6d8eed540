"""Attachment loads of the multibody run, handed over to the direct transient response.

The multibody run logs loads at its own, uneven steps; the transient integrates on an
even grid of step h. Sampling at the grid would lose impulse and fold high frequencies
back. Instead the samples F_n are those for which

    (F_{n-1} + 10 F_n + F_{n+1}) / 12 = (1/h) ∫ F(t) hat_n(t) dt

with hat_n the triangle of width 2h about t_n and F(t) the smooth curve through the
logged values. The right-hand side is an average, so nothing is folded back unseen. The
hats sum to 1 and reproduce t: the sums h ΣF_n and h ΣF_n t_n are ∫F dt and ∫F t dt
exactly, hence the full model receives exactly the momentum of the multibody model. The
weights 1, 10, 1 (Numerov's) undo the averaging to fourth order: a sine of angular
frequency w comes out with the factor 1 - (w h/2)⁴/15 + ..., where the bare average has
1 - (w h/2)²/3.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.interpolate import Akima1DInterpolator
from scipy.linalg import solve_banded

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

# Events leave samples a rounding error apart.
_SAME_INSTANT = 1e-9


@dataclass(frozen=True, kw_only=True)
class AttachmentLoads:
    """Loads of the gears on the airframe, in the axes of the deck's basic frame.

    Attributes:
        time: (t,) s.
        node_id: (k,) grids of the deck.
        load: (t, k, 6) force (N) and moment (N m) at the node.
    """

    time: Float64
    node_id: Int64
    load: Float64

    def __post_init__(self) -> None:
        expected = (len(self.time), len(self.node_id), 6)
        if self.load.shape != expected:
            raise ValueError(f"load has shape {self.load.shape}, not {expected}")
        if len(self.time) < 2 or np.any(np.diff(self.time) <= 0):
            raise ValueError("time must be strictly increasing, at least two instants")

    @property
    def step(self) -> float:
        """Step of the even time grid, s.

        Raises:
            ValueError: the grid is not even; see `resampled`.
        """
        steps = np.diff(self.time)
        if np.ptp(steps) > 1e-6 * steps[0]:
            raise ValueError("the loads are not on an even time grid")
        return float(self.time[-1] - self.time[0]) / (len(self.time) - 1)

    def held(self) -> tuple[Float64, Float64]:
        """Time (t + 2,) s and load with a last value held for two steps beyond the end.

        The integrator looks one step ahead.
        """
        beyond = self.time[-1] + self.step * np.array([1.0, 2.0])
        last = np.repeat(self.load[-1:], 2, axis=0)
        return np.append(self.time, beyond), np.concatenate([self.load, last])

    def resampled(self, step: float, duration: float) -> "AttachmentLoads":
        """Loads on the grid 0, step, ... up to the duration."""
        grid = time_grid(step, duration)
        flat = self.load.reshape(len(self.time), -1)
        load = resample(self.time, flat, grid).reshape(len(grid), -1, 6)
        return AttachmentLoads(time=grid, node_id=self.node_id, load=load)


def time_grid(step: float, duration: float) -> Float64:
    """(t,) 0, step, ..., s: the last one is the first not before the duration."""
    count = int(np.ceil(duration / step - 1e-6))
    return step * np.arange(count + 1)


def distinct_instants(time: Float64) -> Int64:
    """Rows to keep of a log in which events left samples a rounding error apart.

    Of such a group the last one stays: it is the state after the event.
    """
    keep = np.ones(len(time), bool)
    keep[:-1] = np.diff(time) > _SAME_INSTANT
    return np.flatnonzero(keep)


def smooth_curve(time: Float64, values: Float64) -> Akima1DInterpolator:
    """Piecewise cubic through uneven samples: local, without overshoot at a kink."""
    keep = distinct_instants(time)
    return Akima1DInterpolator(time[keep], values[keep])


def resample(time: Float64, values: Float64, grid: Float64) -> Float64:
    """Values on an even grid with the impulse and first moment of the curve.

    Args:
        time: (t,) increasing, s; values before and after it are held.
        values: (t, ...) logged.
        grid: (g,) even, s.

    Returns:
        (g, ...).
    """
    step = grid[1] - grid[0]
    curve = smooth_curve(*_held(time, values, grid[0] - step, grid[-1] + step))
    second = curve.antiderivative(2)
    knots = grid[0] + step * np.arange(-1, len(grid) + 1)
    # The integral of F against a hat is the second difference of its second integral.
    average = np.diff(second(knots), 2, axis=0) / step**2
    bands = np.ones((3, len(grid)))
    bands[1] = 10.0
    bands[1, [0, -1]] = 11.0  # the neighbour outside the grid equals the end
    flat = solve_banded((1, 1), bands / 12, average.reshape(len(grid), -1))
    return flat.reshape(average.shape)


def _held(
    time: Float64, values: Float64, start: float, end: float
) -> tuple[Float64, Float64]:
    """The log, its ends held up to the given instants."""
    if time[-1] < end:
        time = np.append(time, end + (end - time[-1]) + 1e-6)
        values = np.concatenate([values, values[-1:]])
    if time[0] > start:
        time = np.insert(time, 0, start - 1e-6)
        values = np.concatenate([values[:1], values])
    return time, values

"""Functions of time of dynamic loads: tables (TABLED1) and TLOAD2's formula."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64


class TimeFunction(Protocol):
    """A factor as a function of time (s)."""

    def __call__(self, time: Float64) -> Float64:
        """Values (t,) at times (t,)."""
        ...


@dataclass(frozen=True)
class Table:
    """TABLED1: linear between points, on linear or logarithmic axes.

    Outside the table the two points at that end are continued, or held constant with
    `flat` (EXTRAP 1). At a jump, two points at one time, the mean of both counts.
    """

    x: Float64
    y: Float64
    log_x: bool = False
    log_y: bool = False
    flat: bool = False

    def __call__(self, time: Float64) -> Float64:
        x, y = self.x, self.y
        t = np.asarray(time, dtype=np.float64)
        if self.flat:
            t = np.clip(t, x[0], x[-1])
        # Times are sums of steps: a point of the table is met but for rounding.
        gaps = np.diff(x)
        near = min(1e-9 * (x[-1] - x[0]), 1e-3 * gaps[gaps > 0.0].min(initial=np.inf))
        first = np.searchsorted(x, t - near, side="left")
        after = np.searchsorted(x, t + near, side="right")
        last = len(x) - 1
        on_point = after > first
        mean = 0.5 * (y[np.minimum(first, last)] + y[np.clip(after - 1, 0, last)])
        return np.where(on_point, mean, self._between(t, first))

    def continued(self, first: float, last: float) -> list[tuple[float, float]]:
        """Ends of a run from first to last (s) beyond the table where values change.

        Returns:
            Time (s) and value at each end of the run that is beyond the table.
        """
        if self.flat:
            return []
        slack = 1e-9 * (last - first)
        ends = []
        for time, edge, beyond in (
            (first, self.x[0], first < self.x[0] - slack),
            (last, self.x[-1], last > self.x[-1] + slack),
        ):
            value = float(self(np.array([time]))[0])
            if beyond and value != float(self(np.array([edge]))[0]):
                ends.append((time, value))
        return ends

    def _between(self, t: Float64, upper: npt.NDArray[np.intp]) -> Float64:
        """Interpolation or extrapolation by the segment that ends at `upper`."""
        upper = np.clip(upper, 1, len(self.x) - 1)
        x0, x1 = self.x[upper - 1], self.x[upper]
        y0, y1 = self.y[upper - 1], self.y[upper]
        # At an end with two points at one time there is nothing to continue.
        steep = x1 == x0
        if self.log_x:
            ratio = np.log(np.maximum(t, np.finfo(float).tiny) / x0)
            ratio = ratio / np.where(steep, 1.0, np.log(x1 / x0))
        else:
            ratio = (t - x0) / np.where(steep, 1.0, x1 - x0)
        ratio = np.where(steep, np.where(t > x0, 1.0, 0.0), ratio)
        if self.log_y:
            return y0 * (y1 / y0) ** ratio
        return y0 + ratio * (y1 - y0)


@dataclass(frozen=True, kw_only=True)
class Pulse:
    """TLOAD2: t^B exp(C t) cos(2 pi F t + P) from T1 to T2, t counted from T1.

    Attributes:
        start, end: T1 and T2, s.
        frequency: F, Hz.
        phase: P, degrees.
        growth: C, 1/s.
        power: B.
    """

    start: float
    end: float
    frequency: float = 0.0
    phase: float = 0.0
    growth: float = 0.0
    power: float = 0.0

    def __call__(self, time: Float64) -> Float64:
        span = self.end - self.start
        t = np.asarray(time, dtype=np.float64) - self.start
        # The ends belong to the pulse; times are sums of steps.
        inside = (t >= -1e-9 * span) & (t <= span * (1.0 + 1e-9))
        t = np.where(inside, np.clip(t, 0.0, span), span)
        angle = 2.0 * np.pi * self.frequency * t + np.radians(self.phase)
        value = t**self.power * np.exp(self.growth * t) * np.cos(angle)
        return np.where(inside, value, 0.0)


@dataclass(frozen=True)
class Scaled:
    """TABLED2, TABLED3: a function of (x - origin) / scale.

    Series of TABLED4 have their limits in x itself.
    """

    function: "Table | Series"
    origin: float
    scale: float

    def __call__(self, time: Float64) -> Float64:
        x = np.asarray(time, dtype=np.float64)
        if isinstance(self.function, Series):
            x = np.clip(x, self.function.lowest, self.function.highest)
        return self.function((x - self.origin) / self.scale)


@dataclass(frozen=True, kw_only=True)
class Series:
    """TABLED4: a power series; x beyond its limits counts as the limit."""

    terms: Float64
    lowest: float
    highest: float

    def __call__(self, time: Float64) -> Float64:
        x = np.asarray(time, dtype=np.float64)
        return np.asarray(np.polynomial.polynomial.polyval(x, self.terms))


@dataclass(frozen=True)
class Delayed:
    """A function that begins later by `delay` (s)."""

    function: TimeFunction
    delay: float

    def __call__(self, time: Float64) -> Float64:
        return self.function(np.asarray(time, dtype=np.float64) - self.delay)

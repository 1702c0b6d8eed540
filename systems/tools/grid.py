"""Tables over two variables: bilinear between the points, held beyond the last ones."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from systems.tools.checks import ascending
from systems.tools.scalar import Scalar


@dataclass(frozen=True)
class Grid:
    """A function of two variables.

    Attributes:
        x, y: (n,), (m,) abscissae, strictly ascending, two or more of each.
        z: (n, m) values.

    Raises:
        ValueError: sizes differ, a value is not finite, or abscissae do not ascend.
    """

    x: Sequence[float]
    y: Sequence[float]
    z: Sequence[Sequence[float]]

    def __post_init__(self) -> None:
        x, y = (ascending("grid", axis, "abscissa") for axis in (self.x, self.y))
        z = tuple(tuple(float(v) for v in row) for row in self.z)
        if len(z) != len(x) or any(len(row) != len(y) for row in z):
            sizes = sorted({len(row) for row in z})
            raise ValueError(
                f"grid: {len(z)} rows of {', '.join(map(str, sizes))} values, expected "
                f"{len(x)} rows of {len(y)}"
            )
        if not all(math.isfinite(v) for row in z for v in row):
            raise ValueError("grid: a value is not a finite number")
        for name, value in (("x", x), ("y", y), ("z", z)):
            object.__setattr__(self, name, value)

    def value(self, x: Scalar, y: Scalar) -> Scalar:
        """z at (x, y)."""
        i, u = place(self.x, x)
        j, v = place(self.y, y)
        low, high = self.z[i], self.z[i + 1]
        return (1.0 - u) * ((1.0 - v) * low[j] + v * low[j + 1]) + u * (
            (1.0 - v) * high[j] + v * high[j + 1]
        )

    @property
    def axes(self) -> tuple[npt.NDArray[np.float64], ...]:
        """x (n,), y (m,), z (n, m): what `interpolated` takes when compiled."""
        return np.array(self.x), np.array(self.y), np.array(self.z)

    @property
    def least(self) -> float:
        """The smallest value."""
        return min(v for row in self.z for v in row)


def interpolated(grid: Grid, x: Scalar, y: Scalar) -> Scalar:
    """z at (x, y); in compiled laws of a grid's `axes`."""
    return grid.value(x, y)


def place(axis: Sequence[float], x: Scalar) -> tuple[int, Scalar]:
    """Interval of x and its share of it, held at the ends."""
    if x <= axis[0]:
        return 0, 0.0 * x
    last = len(axis) - 2
    if x >= axis[-1]:
        return last, 1.0 + 0.0 * x
    i, end = 0, last + 1
    while end - i > 1:
        middle = (i + end) // 2
        if axis[middle] <= x:
            i = middle
        else:
            end = middle
    return i, (x - axis[i]) / (axis[i + 1] - axis[i])

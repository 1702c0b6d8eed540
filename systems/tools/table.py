"""Piecewise-linear tables y(x), with slope and exact integral.

Plain tuples and `bisect`: a look-up costs well under a microsecond, where numpy.interp
on one number costs several.
"""

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from systems.tools.checks import points_of_curve
from systems.tools.scalar import Scalar


@dataclass(frozen=True)
class Table:
    """A piecewise-linear function.

    Attributes:
        x: (n,) abscissae, strictly ascending, n >= 2.
        y: (n,) ordinates.
        extend: beyond the last point the last segment is continued; otherwise the last
            ordinate is held. Before the first point the first ordinate is held.

    Raises:
        ValueError: lengths differ, fewer than two points, a value is not finite, or x
            does not ascend.

    >>> table = Table([0.0, 2.0], [0.0, 4.0])
    >>> table.value(1.0), table.slope(1.0), table.integral(1.0), table.value(3.0)
    (2.0, 2.0, 1.0, 4.0)
    """

    x: Sequence[float]
    y: Sequence[float]
    extend: bool = False
    _slope: tuple[float, ...] = field(init=False, repr=False, compare=False)
    _area: tuple[float, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        x, y = points_of_curve("table", self.x, self.y, "abscissa")
        slope = tuple((y[i + 1] - y[i]) / (x[i + 1] - x[i]) for i in range(len(x) - 1))
        area = [0.0]
        for i in range(len(x) - 1):
            area.append(area[-1] + 0.5 * (y[i] + y[i + 1]) * (x[i + 1] - x[i]))
        for name, value in (
            ("x", x),
            ("y", y),
            ("_slope", (*slope, slope[-1] if self.extend else 0.0)),
            ("_area", tuple(area)),
        ):
            object.__setattr__(self, name, value)

    def value(self, x: Scalar) -> Scalar:
        """y at x."""
        i = bisect_right(self.x, x) - 1
        if i < 0:
            return self.y[0] + 0.0 * x
        return self.y[i] + self._slope[i] * (x - self.x[i])

    def slope(self, x: Scalar) -> float:
        """dy/dx at x, from the right."""
        i = bisect_right(self.x, x) - 1
        return 0.0 if i < 0 else self._slope[i]

    def integral(self, x: Scalar) -> Scalar:
        """Integral of y from the first abscissa to x, exact."""
        i = bisect_right(self.x, x) - 1
        if i < 0:
            return self.y[0] * (x - self.x[0])
        d = x - self.x[i]
        return self._area[i] + d * (self.y[i] + 0.5 * self._slope[i] * d)

    @property
    def rows(self) -> npt.NDArray[np.float64]:
        """(3, n) abscissae, ordinates, slopes: what `look_up` takes when compiled."""
        return np.array([self.x, self.y, self._slope])

    @property
    def ascending(self) -> bool:
        """No ordinate is less than the one before it."""
        return all(b >= a for a, b in pairwise(self.y))


def look_up(table: Table, x: Scalar) -> Scalar:
    """y at x; in compiled laws of a table's `rows`."""
    return table.value(x)

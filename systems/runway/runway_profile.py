"""Profiles of a runway: height over distance, with slope and curvature.

A measured profile, a 1-cosine bump, waves, a step with a smooth ramp. All have a
continuous slope, which the nearest-point contact of `runway` needs.
"""

import math
import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Protocol

from systems.tools.checks import points_of_curve, require
from systems.tools.scalar import Scalar, cos, sin


class Profile(Protocol):
    """Height of a runway over distance, with continuous slope."""

    @property
    def max_curvature(self) -> float:
        """Largest d²h/dd² (a hollow is positive), 1/m."""
        ...

    def shape(self, d: Scalar) -> tuple[Scalar, Scalar, float]:
        """Height m, slope, curvature 1/m at distance d, m."""
        ...


@dataclass(frozen=True, kw_only=True)
class CosineBump:
    """One full 1-cosine: h = H/2 (1 - cos 2π(d - start)/length).

    Attributes:
        height: m, negative for a dip.
        length: m.
        start: m, distance at which it begins.
    """

    height: float
    length: float
    start: float

    def __post_init__(self) -> None:
        require("1-cosine bump", "height", self.height, "m")
        require("1-cosine bump", "length", self.length, "m", above=0.0)
        require("1-cosine bump", "start", self.start, "m")

    @property
    def max_curvature(self) -> float:
        """See `Profile`."""
        return 2.0 * abs(self.height) * (math.pi / self.length) ** 2

    def shape(self, d: Scalar) -> tuple[Scalar, Scalar, float]:
        """See `Profile`."""
        u = d - self.start
        if u <= 0.0 or u >= self.length:
            return 0.0, 0.0, 0.0
        k, h = 2.0 * math.pi / self.length, 0.5 * self.height
        c = cos(k * u)
        return h * (1.0 - c), h * k * sin(k * u), h * k * k * c


@dataclass(frozen=True, kw_only=True)
class Waves:
    """A sine without end: h = amplitude sin 2π(d - start)/wavelength.

    Attributes:
        amplitude, wavelength, start: m.
    """

    amplitude: float
    wavelength: float
    start: float = 0.0

    def __post_init__(self) -> None:
        require("runway waves", "amplitude", self.amplitude, "m")
        require("runway waves", "wavelength", self.wavelength, "m", above=0.0)
        require("runway waves", "start", self.start, "m")

    @property
    def max_curvature(self) -> float:
        """See `Profile`."""
        return abs(self.amplitude) * (2.0 * math.pi / self.wavelength) ** 2

    def shape(self, d: Scalar) -> tuple[Scalar, Scalar, float]:
        """See `Profile`."""
        k = 2.0 * math.pi / self.wavelength
        s = sin(k * (d - self.start))
        slope = self.amplitude * k * cos(k * (d - self.start))
        return self.amplitude * s, slope, -self.amplitude * k * k * s


@dataclass(frozen=True, kw_only=True)
class Step:
    """A step with a half-cosine ramp, smooth at both ends.

    Attributes:
        height: m, negative for a step down.
        ramp: m, length of the ramp.
        start: m, distance at which the ramp begins.
    """

    height: float
    ramp: float
    start: float

    def __post_init__(self) -> None:
        require("runway step", "height", self.height, "m")
        require("runway step", "ramp", self.ramp, "m", above=0.0)
        require("runway step", "start", self.start, "m")

    @property
    def max_curvature(self) -> float:
        """See `Profile`."""
        return 0.5 * abs(self.height) * (math.pi / self.ramp) ** 2

    def shape(self, d: Scalar) -> tuple[Scalar, Scalar, float]:
        """See `Profile`."""
        u = d - self.start
        if u <= 0.0:
            return 0.0, 0.0, 0.0
        if u >= self.ramp:
            return self.height, 0.0, 0.0
        k, h = math.pi / self.ramp, 0.5 * self.height
        c = cos(k * u)
        return h * (1.0 - c), h * k * sin(k * u), h * k * k * c


@dataclass(frozen=True, kw_only=True)
class MeasuredProfile:
    """Heights measured along a runway, joined by cubics with continuous slope.

    Slopes at the points are central differences, zero at both ends, beyond which the
    height is held.

    Attributes:
        distance: (n,) m, strictly ascending, n >= 2.
        height: (n,) m.
    """

    distance: Sequence[float]
    height: Sequence[float]
    _slope: tuple[float, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        d, h = points_of_curve(
            "runway profile", self.distance, self.height, "distance", "m"
        )
        inner = [
            (h[i + 1] - h[i - 1]) / (d[i + 1] - d[i - 1]) for i in range(1, len(d) - 1)
        ]
        object.__setattr__(self, "distance", d)
        object.__setattr__(self, "height", h)
        object.__setattr__(self, "_slope", (0.0, *inner, 0.0))

    @property
    def max_curvature(self) -> float:
        """See `Profile`."""
        ends = [0.0]
        for i, (a, b) in enumerate(pairwise(self.distance)):
            # The curvature of a cubic is largest at one of its ends.
            ends += [self._segment(i, 0.0)[2], self._segment(i, b - a)[2]]
        return max(ends)

    def shape(self, d: Scalar) -> tuple[Scalar, Scalar, float]:
        """See `Profile`."""
        if d <= self.distance[0]:
            return self.height[0], 0.0, 0.0
        if d >= self.distance[-1]:
            return self.height[-1], 0.0, 0.0
        i = bisect_right(self.distance, d) - 1
        return self._segment(i, d - self.distance[i])

    def _segment(self, i: int, u: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        width = self.distance[i + 1] - self.distance[i]
        m0, m1 = self._slope[i], self._slope[i + 1]
        mean = (self.height[i + 1] - self.height[i]) / width
        c2 = (3.0 * mean - 2.0 * m0 - m1) / width
        c3 = (m0 + m1 - 2.0 * mean) / (width * width)
        return (
            self.height[i] + u * (m0 + u * (c2 + u * c3)),
            m0 + u * (2.0 * c2 + 3.0 * u * c3),
            2.0 * c2 + 6.0 * u * c3,
        )


FOOT = 0.3048
"""m"""


def measured_tracks(
    path: str | Path, *, unit: float = 1.0, start: float = 0.0, backwards: bool = False
) -> tuple[MeasuredProfile, ...]:
    """Reads a file of two columns, distance and height, or of three: distance, heights
    of the left and of the right track.

    Columns are separated by commas, semicolons or blanks. A first line that is not
    numbers is taken as the heading; what follows # is a remark.

    Args:
        path: of the file.
        unit: of both, m; see FOOT.
        start: m, added to the distances.
        backwards: the runway is travelled from its last point to the first one.

    Returns:
        One profile, or left and right.

    Raises:
        ValueError: a line cannot be read; the message names file and line.
    """
    rows: list[list[float]] = []
    with open(path, encoding="utf-8-sig", errors="replace") as file:
        for number, line in enumerate(file, start=1):
            text = line.split("#")[0].strip()
            if text:
                row = _numbers(text, f"{path}, line {number}", first=number == 1)
                if not all(map(math.isfinite, row)):
                    raise ValueError(
                        f"{path}, line {number}: found {text!r}, expected finite "
                        "numbers"
                    )
                rows += [row] if row else []
                if row and len(row) != len(rows[0]):
                    raise ValueError(
                        f"{path}, line {number}: found {len(row)} columns, expected "
                        f"{len(rows[0])} as before"
                    )
    if len(rows) < 2:
        raise ValueError(f"{path}: {len(rows)} points, expected two or more")
    if backwards:
        last = rows[-1][0]
        sides = slice(None, 0, -1)  # left and right change sides
        rows = [[last - row[0], *row[sides]] for row in reversed(rows)]
    distance = [start + unit * row[0] for row in rows]
    try:
        return tuple(
            MeasuredProfile(distance=distance, height=[unit * row[i] for row in rows])
            for i in range(1, len(rows[0]))
        )
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _numbers(text: str, place: str, first: bool) -> list[float]:
    """Two or three of them; none of a heading."""
    try:
        row = [float(word) for word in re.split(r"[,;\s]+", text)]
    except ValueError:
        row = []
    if len(row) in (2, 3) or (first and not row):
        return row
    raise ValueError(
        f"{place}: found {text!r}, expected distance and height, or distance and the "
        "heights of the left and of the right track"
    )

"""Rows of grids along the fuselage: the frames, and divisions of the bays between."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from drake_landing.reference.d150.facts import table
from drake_landing.reference.d150.geometry import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class Rows:
    """r rows from nose to tail.

    Attributes:
        x: (r,) m.
        frame: (r,) number of the frame in the table of frames; -1 between frames.
        bay: (r - 1,) number of the frame before each row of elements.
        names: of the frames, C01 to C87.
    """

    x: Float64
    frame: Int64
    bay: Int64
    names: tuple[str, ...]

    def at(self, name: str) -> int:
        """The row of a frame."""
        return int(np.flatnonzero(self.frame == self.number(name))[0])

    def number(self, name: str) -> int:
        """The number of a frame in the table."""
        return self.names.index(name)

    def between(self, first: str, last: str) -> range:
        """The rows from one frame to another, both included."""
        return range(self.at(first), self.at(last) + 1)

    def frames(self, first: str, last: str) -> list[int]:
        """The rows of the frames from one to another, both included."""
        return [r for r in self.between(first, last) if self.frame[r] >= 0]


def fuselage_rows(size: float) -> Rows:
    """Rows with elements of about that length (m)."""
    frames = table("fuselage_frames")
    knots = frames.x.to_numpy()
    x, frame, bay = [knots[:1]], [0], []
    for k, (a, b) in enumerate(pairwise(knots)):
        each = max(1, round((b - a) / size))
        x.append(a + (b - a) * np.arange(1, each + 1) / each)
        frame += [-1] * (each - 1) + [k + 1]
        bay += [k] * each
    return Rows(
        x=np.concatenate(x),
        frame=np.array(frame),
        bay=np.array(bay),
        names=tuple(frames.frame),
    )

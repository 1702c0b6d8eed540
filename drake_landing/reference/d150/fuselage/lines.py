"""Lines of grids along the fuselage, from crown to keel of the starboard half.

The named lines run where something meets the skin: window belt, passenger floor, upper
cover of the center wing box, cargo floor, sides of the keel beam. The others divide the
arcs between them evenly. Angles are those of the ellipse's parameter from the crown.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import (
    Float64,
    fuselage_point,
    fuselage_section,
)

NAMES = ("window_top", "window_bottom", "floor", "wing", "cargo", "keel", "bottom")


@dataclass(frozen=True, kw_only=True)
class Lines:
    """n + 1 lines at r rows.

    Attributes:
        index: name -> number of the line.
        angle: (r, n + 1) from the crown, rad.
        p: (r, n + 1, 3) positions of the grids, m.
    """

    index: Mapping[str, int]
    angle: Float64
    p: Float64

    @property
    def count(self) -> int:
        """n, the number of elements from crown to keel."""
        return self.p.shape[1] - 1

    def nearest(self, row: int, column: int, value: float, low: int, high: int) -> int:
        """Line from low to high where a coordinate of a row is nearest to a value."""
        at = self.p[row, low : high + 1, column]
        return low + int(np.argmin(np.abs(at - value)))


def fuselage_lines(x: Float64, elements: Mapping[str, int]) -> Lines:
    """The lines at stations x.

    Args:
        x: (r,) m.
        elements: name of a line -> elements between it and the line above.
    """
    named = _named_angles(x)
    counts = [elements[name] for name in NAMES]
    index = dict(zip(("crown", *NAMES), np.concatenate([[0], np.cumsum(counts)])))
    columns = [named[:, :1]]
    for k, (a, b) in enumerate(pairwise(named.T)):
        share = np.arange(1, counts[k] + 1) / counts[k]
        columns.append(a[:, None] + share * (b - a)[:, None])
    angle = np.concatenate(columns, axis=1)
    p = fuselage_point(np.repeat(x, angle.shape[1]), angle.ravel())
    p = p.reshape(*angle.shape, 3)
    p[:, [0, -1], 1] = 0.0
    return Lines(index={k: int(v) for k, v in index.items()}, angle=angle, p=p)


def _named_angles(x: Float64) -> Float64:
    """(r, 8) angles of crown and named lines; above and below the floor in proportion.

    The floor is level where there are crossbeams; before and behind its line keeps the
    angle.
    """
    data, shape = facts("fuselage_shell"), facts("fuselage")
    frames = table("fuselage_frames").set_index("frame")
    middle = np.array([frames.x[data["section_frame"]]])
    heights = [data["lines"][k] for k in ("window_top", "window_bottom")]
    heights += [
        shape["passenger_floor_z"],
        data["lines"]["wing"],
        shape["cargo_floor_z"],
    ]
    top, bottom, floor0, wing, cargo = (_angle_at(middle, z)[0] for z in heights)
    keel = np.pi - np.arcsin(
        data["lines"]["keel_half_width"] / fuselage_section(middle)[0, 0]
    )
    level = frames.x[frames.passenger_floor == 1]
    floor = _angle_at(np.clip(x, level.min(), level.max()), shape["passenger_floor_z"])
    below = (cargo - floor) / (cargo - floor0)
    columns = [0 * x, top / floor0 * floor, bottom / floor0 * floor, floor]
    columns += [floor + (wing - floor0) * below, *(a + 0 * x for a in (cargo, keel))]
    return np.stack([*columns, np.pi + 0 * x], axis=1)


def _angle_at(x: Float64, z: float) -> Float64:
    """Angles where the sections reach a height."""
    _, bottom, top = fuselage_section(x).T
    return np.arccos((z - (bottom + top) / 2) / ((top - bottom) / 2))

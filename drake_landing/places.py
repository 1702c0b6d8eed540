"""Where one looks at an airframe: beams with cuts across them, panels, equipment."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

Float64 = npt.NDArray[np.float64]
Box = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

ANY = (-1e9, 1e9)
EVERYWHERE: Box = (ANY, ANY, ANY)
# In the axes A: aft, starboard, up.
_OUTWARD = {
    "aft": (1.0, 0.0, 0.0),
    "fore": (-1.0, 0.0, 0.0),
    "starboard": (0.0, 1.0, 0.0),
    "port": (0.0, -1.0, 0.0),
    "up": (0.0, 0.0, 1.0),
    "down": (0.0, 0.0, -1.0),
}


def outward_axis(outward: str, R_AB: Float64) -> Float64:
    """(3,) unit vector in B of aft, fore, starboard, port, up or down."""
    return np.array(_OUTWARD[outward]) @ R_AB


def axis_name(direction: Float64) -> str:
    """The axis of B along which a vector points: `-x`."""
    axis = int(np.abs(direction).argmax())
    return "-" * bool(direction[axis] < 0.0) + "xyz"[axis]


@dataclass(frozen=True, kw_only=True)
class Beam:
    """A part of the airframe with cuts across it.

    Attributes:
        name: e.g. wing, starboard.
        outward: aft, fore, starboard, port, up or down: where the part lies that is cut
            off.
        stations: (n,) coordinates of the cuts along the deck's axis (`axis`), from the
            root outward, m.
        tips: grids, B: pieces that hold any of them belong to the beam; none: every
            piece.
        boxes: ranges of x, y, z, B; grids in any of them belong to the beam.
        line: (k, 3) points of a line, B, that moments refer to; None: the EA-weighted
            center of the elements that cross.
        R_AB: (3, 3) axes A in B.
    """

    name: str
    outward: str
    stations: Float64
    tips: tuple[int, ...] = ()
    boxes: tuple[Box, ...] = (EVERYWHERE,)
    line: Float64 | None = None
    R_AB: Float64 = field(default_factory=lambda: np.eye(3), repr=False)

    @property
    def direction(self) -> Float64:
        """(3,) outward, B."""
        return outward_axis(self.outward, self.R_AB)

    @property
    def axis(self) -> str:
        """Axis of B that `stations` are coordinates of: x, y or z."""
        return axis_name(self.direction)[-1]

    @property
    def along(self) -> Float64:
        """(n,) stations as coordinates along the outward direction, ascending."""
        return self.stations * self.direction.sum()

    @property
    def lift(self) -> Float64:
        """(3,) direction of positive shear, B: up; of vertical parts starboard."""
        upright = self.outward in ("up", "down")
        return outward_axis("starboard" if upright else "up", self.R_AB)

    @property
    def across(self) -> Float64:
        """(3,) axis of bending, B: positive bending turns the outer end to `lift`."""
        return np.cross(self.direction, self.lift)

    @property
    def side(self) -> Float64:
        """(3,) direction of positive shear beside `lift`, B: aft; of fuselages
        starboard."""
        body = self.outward in ("fore", "aft")
        return outward_axis("starboard" if body else "aft", self.R_AB)

    @property
    def sideways(self) -> tuple[str, str]:
        """What shear along `side`, and bending that turns the outer end there, are
        called."""
        word = "side" if self.outward in ("fore", "aft") else "fore-and-aft"
        return f"{word} shear", f"{word} bending"


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A point in the middle of a panel, and its neighbours that are held by frames."""

    name: str
    grid: int
    beside: tuple[int, ...]


@dataclass(frozen=True, kw_only=True)
class Places:
    """Places at which the parts are looked at.

    Attributes:
        beams: cut at stations.
        panels: middles of panels.
        equipment: name -> grid id of places that carry equipment.
    """

    beams: tuple[Beam, ...] = ()
    panels: tuple[Panel, ...] = ()
    equipment: Mapping[str, int]

    @property
    def grids(self) -> dict[int, str]:
        """Grid -> what it is for."""
        found = {g: f"parts.panels: {p.name}" for p in self.panels for g in p.beside}
        found |= {p.grid: f"parts.panels: {p.name}" for p in self.panels}
        return found | {g: f"parts.equipment: {n}" for n, g in self.equipment.items()}

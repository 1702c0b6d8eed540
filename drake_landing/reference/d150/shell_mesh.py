"""Grids of a closed shell box (spar to spar) or wedge (hinge line to trailing edge)."""

from dataclasses import dataclass

import numpy as np

from drake_landing.reference.d150.geometry import MIRROR, Float64, Int64, LiftingSurface
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.stations import Stations, plan_x


@dataclass(frozen=True, kw_only=True)
class BoxMesh:
    """Grids of a box: n stations, chordwise a, through the height b.

    Attributes:
        part: title of its section.
        ids: (n, a, b) grid ids; 0 inside the box where there is no rib. The last
            chordwise row of a wedge is its trailing edge: one grid through the height.
        p: (n, a, b, 3) positions in B, m.
        stations: where the stations stand.
        wedge: whether it closes in a trailing edge instead of a rear spar.
        outward: +1 where (chord × span) points from lower to upper surface, else -1.
    """

    part: str
    ids: Int64
    p: Float64
    stations: Stations
    wedge: bool
    outward: int

    @property
    def ribs(self) -> Int64:
        """Station of each rib in order."""
        return np.flatnonzero(self.stations.rib >= 0)

    def ring(self, station: int) -> list[int]:
        """Ids of the grids round a station, each once."""
        section = self.ids[station]
        around = [*section[0], *section[-1], *section[:, 0], *section[:, -1]]
        return sorted({int(i) for i in around if i})

    def spar(self, chordwise: int, first: int, last: int) -> list[int]:
        """Ids of a spar's grids (chordwise 0 front, -1 rear) between stations."""
        return sorted({int(i) for i in self.ids[first : last + 1, chordwise].ravel()})


def box_points(
    shape: LiftingSurface, stations: Stations, chordwise: int, high: int
) -> Float64:
    """(n, chordwise + 1, high + 1, 3) positions of the starboard half, m."""
    share = np.linspace(0.0, 1.0, chordwise + 1)
    front, rear = stations.front, stations.rear
    span = front[:, :1] + share * (rear[:, :1] - front[:, :1])
    x_front, x_rear = plan_x(shape, front)[:, None], plan_x(shape, rear)[:, None]
    x = x_front + share * (x_rear - x_front)
    flat = span.ravel()
    leading = plan_x(shape, np.stack([flat, np.zeros(len(flat))], axis=1))
    fraction = (x.ravel() - leading) / shape.chord_at(flat)
    upper, lower = (shape.point(flat, fraction, s) for s in ("upper", "lower"))
    height = np.linspace(0.0, 1.0, high + 1)[None, :, None]
    p = lower[:, None] + height * (upper - lower)[:, None]
    return p.reshape(len(front), chordwise + 1, high + 1, 3)


def add_box(
    model: ModelBuilder,
    part: str,
    shape: LiftingSurface,
    stations: Stations,
    *,
    chordwise: int,
    high: int,
    first_id: int,
    wedge: bool = False,
    mirror_of: BoxMesh | None = None,
) -> BoxMesh:
    """Writes the grids of a box or wedge.

    Args:
        model: the bench.
        part: title of the section.
        shape: lifting surface.
        stations: of the starboard half.
        chordwise: elements from front to rear.
        high: elements through the height.
        first_id: grid ids ascend from here.
        wedge: closed in a trailing edge.
        mirror_of: the starboard box, for the port one: shares its center-plane grids.
    """
    p = box_points(shape, stations, chordwise, high)
    if mirror_of is not None:
        p = p * MIRROR
    inside = np.zeros(p.shape[:3], bool)
    inside[:, 1:-1, 1:-1] = True
    absent = inside & (stations.rib < 0)[:, None, None]
    if wedge:
        absent[:, -1, 1:] = True
    shared = np.zeros_like(absent)
    if mirror_of is not None:
        shared = np.all(np.abs(p[..., 1]) < 1e-9, axis=(1, 2))[:, None, None] & ~absent
    fresh = ~absent & ~shared
    ids = np.zeros(p.shape[:3], np.int64)
    ids[fresh] = np.arange(first_id, first_id + fresh.sum())
    if mirror_of is not None:
        ids[shared] = mirror_of.ids[shared]
    model.grids(part, ids[fresh].tolist(), p[fresh])
    if wedge:
        ids[:, -1, 1:] = ids[:, -1, :1]
    chord, along = p[0, -1, 0] - p[0, 0, 0], p[-1, 0, 0] - p[0, 0, 0]
    upward = p[0, 0, -1] - p[0, 0, 0]
    outward = 1 if np.cross(chord, along) @ upward > 0 else -1
    return BoxMesh(
        part=part, ids=ids, p=p, stations=stations, wedge=wedge, outward=outward
    )

"""Section loads: what passes through cuts of the airframe, by equilibrium.

A cut takes a part off the airframe. Its section load is the resultant of everything
that acts on that part, inertia included:

    F = Σ (P - M ü - β M u̇),    moment about the cut's point likewise,

the sum over the grids of the part. No element is asked: shells, beams and rigid
elements are cut alike. M is the mass matrix of the full model, β the mass-proportional
damping, which acts from outside; all other damping is internal. P are the loads of the
gears on the airframe: inertia and weight of the gears themselves are in them.

The cuts of a beam share their grids: what lies between two cuts is added up once, and
the section loads are running sums from the end of the beam.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Box = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

COMPONENTS = ("fx", "fy", "fz", "mx", "my", "mz")
# What a section load is called along a beam.
NAMED = ("shear", "bending", "torsion")
ANY = (-1e9, 1e9)
EVERYWHERE: Box = (ANY, ANY, ANY)
_OUTWARD = {
    "aft": (1.0, 0.0, 0.0),
    "fore": (-1.0, 0.0, 0.0),
    "starboard": (0.0, 1.0, 0.0),
    "port": (0.0, -1.0, 0.0),
}


@dataclass(frozen=True, kw_only=True)
class Beam:
    """A part of the airframe with cuts across it, in the axes A (aft, starboard, up).

    Attributes:
        name: e.g. right wing.
        outward: aft, fore, starboard or port: where the part lies that is cut off.
        stations: (n,) coordinates of the cuts along that axis, from the root outward.
        boxes: ranges of x, y, z; grids in any of them belong to the beam.
        line: (k, 3) points of a line that moments refer to; None: the middle of the
            grids next to each cut.
        R_AB: (3, 3) from the deck's basic axes.
    """

    name: str
    outward: str
    stations: Float64
    boxes: tuple[Box, ...] = (EVERYWHERE,)
    line: Float64 | None = None
    R_AB: Float64 = field(default_factory=lambda: np.eye(3), repr=False)

    @property
    def direction(self) -> Float64:
        """(3,) outward, axes A."""
        return np.array(_OUTWARD[self.outward])

    @property
    def across(self) -> Float64:
        """(3,) axis of bending, A: positive bending turns the outer end upward."""
        return np.cross(self.direction, [0.0, 0.0, 1.0])

    def strip(self, p: Float64) -> Int64:
        """Cut inside of which grids (g, 3) in A lie, -1: not beyond any cut."""
        s = p @ self.direction
        cuts = self.stations * self.direction.sum()
        inside = np.zeros(len(p), bool)
        for box in self.boxes:
            low, high = np.array(box).T
            inside |= np.all((p >= low) & (p <= high), axis=1)
        return np.where(inside, np.searchsorted(cuts, s, side="right") - 1, -1)


@dataclass(frozen=True, kw_only=True)
class BeamCuts:
    """The cuts of a beam as linear maps.

    Attributes:
        beam: its name, stations and axes.
        point: (n, 3) of the cuts, where moments refer to, A, m.
        of_acceleration: (6 n, f) inertia of each strip about the origin of A, A.
        loaded: node -> its strip, of the loaded nodes beyond any cut.
        arm: node -> (6, 6) from force and moment there, B, to those at the origin, A.
    """

    beam: Beam
    point: Float64
    of_acceleration: sp.csr_matrix
    loaded: Mapping[int, int]
    arm: Mapping[int, Float64]

    def loads(self, inertia: Float64, node_id: Int64, load: Float64) -> Float64:
        """(t, n, 6) section loads, columns `COMPONENTS`, axes A.

        Args:
            inertia: (t, 6 n) `of_acceleration` times the accelerations.
            node_id: (k,) loaded nodes.
            load: (t, k, 6) on them, B.
        """
        strips = -inertia.reshape(len(inertia), -1, 6)
        for k, node in enumerate(node_id.tolist()):
            if node in self.loaded:
                strips[:, self.loaded[node]] += load[:, k] @ self.arm[node].T
        total = np.cumsum(strips[:, ::-1], axis=1)[:, ::-1].copy()
        total[..., 3:] -= np.cross(self.point, total[..., :3])
        return total

    def named(self, loads: Float64) -> Float64:
        """(t, n, 3) of `NAMED` from section loads (t, n, 6).

        Shear is upward; bending lifts the outer end; torsion turns about the outward
        direction.
        """
        beam = self.beam
        return np.stack(
            [
                loads[..., 2],
                loads[..., 3:] @ beam.across,
                loads[..., 3:] @ beam.direction,
            ],
            axis=-1,
        )


def beam_cuts(
    structure: Structure, beam: Beam, loaded: Mapping[int, Float64]
) -> BeamCuts:
    """Maps of the cuts of a beam.

    Args:
        structure: the full model.
        beam: where it is cut.
        loaded: node -> (3,) position in B of every node that loads act on, m.

    Raises:
        ValueError: no grid lies beyond the last cut.
    """
    points, R = structure.points, beam.R_AB
    p = points.xyz @ R.T
    strip = beam.strip(p)
    if not np.any(strip == len(beam.stations) - 1):
        raise ValueError(
            f"{beam.name}: no grid of the model lies beyond the cut at "
            f"{beam.stations[-1]:g} m"
        )
    inside = np.flatnonzero(strip >= 0)
    gather = _resultants(p[inside], strip[inside], len(beam.stations), R)
    dof = points.dof(points.grid_id[inside][:, None], np.arange(1, 7)[None, :])
    # Forces of the g-set turned into basic axes, then added up.
    turn = sp.csr_matrix(points.basic_rotation()[dof.reshape(-1)])
    of_acceleration = sp.csr_matrix(
        gather @ turn @ structure.matrices.mass @ structure.elimination.T
    )
    places = np.array([R @ place for place in loaded.values()]).reshape(-1, 3)
    of_node = beam.strip(places)
    return BeamCuts(
        beam=beam,
        point=_points(p[inside], strip[inside], beam),
        of_acceleration=of_acceleration,
        loaded={n: int(s) for n, s in zip(loaded, of_node) if s >= 0},
        arm={n: _about_origin(place, R) for n, place in zip(loaded, places)},
    )


def envelope_table(cuts: BeamCuts, time: Float64, loads: Float64) -> pd.DataFrame:
    """Extremes of shear, bending and torsion at the cuts, with their instants.

    Returns:
        Rows `beam, station, quantity, min, time_of_min, max, time_of_max`.
    """
    named = cuts.named(loads)
    low, high = named.argmin(axis=0), named.argmax(axis=0)
    rows = []
    for i, station in enumerate(cuts.beam.stations):
        for q, quantity in enumerate(NAMED):
            a, b = low[i, q], high[i, q]
            found = (named[a, i, q], time[a], named[b, i, q], time[b])
            rows.append([cuts.beam.name, station, quantity, *map(float, found)])
    heads = ["beam", "station", "quantity", "min", "time_of_min", "max", "time_of_max"]
    return pd.DataFrame(rows, columns=heads)


def mean_of_three(load: Float64) -> Float64:
    """Loads (t, ...) as Nastran's scheme applies them: (P(n-1) + P(n) + P(n+1))/3.

    With these the section loads are in equilibrium to rounding. At the start the scheme
    takes the loads before it as zero.
    """
    before = np.concatenate([np.zeros_like(load[:1]), load[:-1]])
    after = np.concatenate([load[1:], load[-1:]])
    middle = load.copy()
    middle[0] = 0.0
    before[1] = 0.0
    return (before + middle + after) / 3.0


def _points(p: Float64, strip: Int64, beam: Beam) -> Float64:
    """(n, 3) middles of the grids nearest beyond each cut, put onto the cut."""
    d, points = beam.direction, []
    if beam.line is not None:
        along = np.argsort(beam.line @ d)
        s, line = (beam.line @ d)[along], beam.line[along]
        at = beam.stations * d.sum()
        found = np.stack([np.interp(at, s, line[:, i]) for i in range(3)], axis=1)
        return found + np.outer(at - found @ d, d)
    spacing = float(np.abs(np.diff(beam.stations)).max())
    for i, station in enumerate(beam.stations):
        own = p[strip >= i]
        ahead = own @ d - station * d.sum()
        near = own[ahead <= max(ahead.min() + 1e-6, min(0.5 * spacing, 0.5))]
        middle = 0.5 * (near.min(axis=0) + near.max(axis=0))
        points.append(middle + d * (station * d.sum() - middle @ d))
    return np.array(points)


def _resultants(p: Float64, strip: Int64, strips: int, R: Float64) -> sp.csr_matrix:
    """(6 n, 6 g) force and moment about the origin, A, of forces and moments, B."""
    maps = np.zeros((len(p), 6, 6))
    maps[:, :3, :3] = maps[:, 3:, 3:] = R
    x, y, z = p.T
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
    maps[:, 3:, :3] = cross @ R
    row = 6 * strip[:, None, None] + np.arange(6)[:, None]
    column = 6 * np.arange(len(p))[:, None, None] + np.arange(6)[None, :]
    row, column = np.broadcast_arrays(row, column)
    keep = maps != 0.0
    return sp.csr_matrix(
        (maps[keep], (row[keep], column[keep])), shape=(6 * strips, 6 * len(p))
    )


def _about_origin(place: Float64, R: Float64) -> Float64:
    """(6, 6) of one node at `place` (3,) in A."""
    one = _resultants(place[None], np.zeros(1, np.int64), 1, R)
    return one.toarray()

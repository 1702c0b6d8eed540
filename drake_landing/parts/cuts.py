"""Section loads: what passes through cuts of the airframe, by equilibrium.

A cut is a plane across an axis of the deck. Elements that cross it are removed, the
outer side falls into connected pieces, and a piece is taken off the airframe. Its
section load is the resultant of everything that acts on that piece, inertia included:

    F = Σ (P - M ü - β M u̇),    moment about the cut's point likewise,

the sum over the grids of the piece. It equals the sum of the forces that the removed
elements, shells, beams and rigid elements alike, exert on the piece with the sign
changed. M is the mass matrix of the full model, β the mass-proportional damping, which
acts from outside; all other damping is internal. P are the loads of the gears on the
airframe: inertia and weight of the gears themselves are in them.

The cuts of a beam share their grids: what lies between two cuts is added up once, and
the section loads are running sums from the end of the beam. A grid in the plane belongs
to the outer side. All of it is in the deck's basic frame B.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from drake_landing.parts.connections import Connections, connections
from drake_landing.parts.section_point import Stretched, crossing, stretched
from drake_landing.places import Beam, axis_name
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Bool = npt.NDArray[np.bool_]

COMPONENTS = ("fx", "fy", "fz", "mx", "my", "mz")
# What a section load is called along a beam.
NAMED = ("shear", "bending", "torsion")
_SAME = 1e-9  # of the size of the model: grids nearer than this to a plane lie in it


@dataclass(frozen=True, kw_only=True)
class BeamCuts:
    """The cuts of a beam as linear maps.

    Attributes:
        beam: its name, stations and axes.
        point: (n, 3) of the cuts, where moments refer to, B, m.
        of_acceleration: (6 n, f) inertia of each strip about the origin, B.
        loaded: node -> its strip, of the loaded nodes beyond any cut.
        arm: node -> (6, 6) from force and moment there to those at the origin, B.
        strip: (g,) cut beyond which each grid lies, -1: beyond none.
        crossing: elements that cross each cut, those of rigid elements left out.
    """

    beam: Beam
    point: Float64
    of_acceleration: sp.csr_matrix
    loaded: Mapping[int, int]
    arm: Mapping[int, Float64]
    strip: Int64 = field(repr=False)
    crossing: tuple[Int64, ...] = field(default=(), repr=False)

    def loads(self, inertia: Float64, node_id: Int64, load: Float64) -> Float64:
        """(t, n, 6) section loads, columns `COMPONENTS`, B.

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

        Shear is upward and bending lifts the outer end, of vertical parts to starboard
        instead; torsion turns about the outward direction.
        """
        beam = self.beam
        return np.stack(
            [
                loads[..., :3] @ beam.lift,
                loads[..., 3:] @ beam.across,
                loads[..., 3:] @ beam.direction,
            ],
            axis=-1,
        )

    def along_side(self, loads: Float64) -> Float64:
        """(t, n, 2) of `Beam.sideways` from section loads (t, n, 6)."""
        side = self.beam.side
        turn = np.cross(self.beam.direction, side)
        return np.stack([loads[..., :3] @ side, loads[..., 3:] @ turn], axis=-1)


class Cutter:
    """Cuts a structure; what all its cuts share is found once."""

    def __init__(self, structure: Structure) -> None:
        self.structure = structure

    @cached_property
    def links(self) -> Connections:
        """Connections that hold the grids together."""
        return connections(self.structure)

    @cached_property
    def elements(self) -> list[Stretched]:
        """Elements under a stretch, for the centers of sections."""
        return stretched(self.structure)

    @cached_property
    def tolerance(self) -> float:
        """Grids nearer to a plane lie in it, m."""
        p = self.structure.points.xyz
        return _SAME * float(np.ptp(p, axis=0).max(initial=0.0))

    def beyond(self, direction: Float64, along: float) -> Bool:
        """(g,) grids on the outer side of a plane, or in it.

        Args:
            direction: (3,) outward, B.
            along: of the plane along it, m.
        """
        return self.structure.points.xyz @ direction >= along - self.tolerance

    def strip(self, beam: Beam) -> Int64:
        """(g,) cut of a beam beyond which each grid lies, -1: beyond none."""
        p = self.structure.points.xyz
        inside = np.zeros(len(p), bool)
        for box in beam.boxes:
            low, high = np.array(box).T
            inside |= np.all((p >= low) & (p <= high), axis=1)
        tips = self.structure.points.rows(np.array(beam.tips, np.int64))
        strip = np.full(len(p), -1)
        for i, along in enumerate(beam.along):
            own = inside & self.beyond(beam.direction, along)
            if len(tips):
                own &= self.held_by(tips, beam.direction, along)
            strip[own] = i
        return strip

    def held_by(self, tips: Int64, direction: Float64, along: float) -> Bool:
        """(g,) grids of the pieces beyond a plane that hold any of the grids `tips`."""
        piece = self.links.pieces(self.beyond(direction, along))
        return np.isin(piece, piece[tips][piece[tips] >= 0])

    def cuts(self, beam: Beam, loaded: Sequence[int]) -> BeamCuts:
        """Maps of the cuts of a beam.

        Args:
            beam: where it is cut.
            loaded: every node that loads act on.

        Raises:
            ValueError: no grid lies beyond the last cut.
        """
        points = self.structure.points
        strip = self.strip(beam)
        if not np.any(strip == len(beam.stations) - 1):
            raise ValueError(
                f"{beam.name}: no grid of the model lies beyond the cut at "
                f"{beam.axis} = {beam.stations[-1]:g} m"
            )
        inside = np.flatnonzero(strip >= 0)
        gather = _resultants(points.xyz[inside], strip[inside], len(beam.stations))
        dof = points.dof(points.grid_id[inside][:, None], np.arange(1, 7)[None, :])
        # Forces of the g-set turned into basic axes, then added up.
        turn = sp.csr_matrix(points.basic_rotation()[dof.reshape(-1)])
        mass, T = self.structure.matrices.mass, self.structure.elimination.T
        at = points.rows(np.array(loaded, np.int64))
        point, crossed = self._points(beam, strip)
        return BeamCuts(
            beam=beam,
            point=point,
            of_acceleration=sp.csr_matrix(gather @ turn @ mass @ T),
            loaded={n: int(strip[a]) for n, a in zip(loaded, at) if strip[a] >= 0},
            arm={n: _about_origin(points.xyz[a]) for n, a in zip(loaded, at)},
            strip=strip,
            crossing=crossed,
        )

    def _points(self, beam: Beam, strip: Int64) -> tuple[Float64, tuple[Int64, ...]]:
        """(n, 3) points of the cuts, and the elements that cross where looked for."""
        d = beam.direction
        if beam.line is not None:
            order = np.argsort(beam.line @ d)
            s, line = (beam.line @ d)[order], beam.line[order]
            found = np.stack(
                [np.interp(beam.along, s, line[:, i]) for i in range(3)], axis=1
            )
            return found + np.outer(beam.along - found @ d, d), ()
        crossed = [
            crossing(self.links, self.elements, strip >= i, d, along)
            for i, along in enumerate(beam.along)
        ]
        return np.array([c.point for c in crossed]), tuple(c.id for c in crossed)


def envelope_table(cuts: BeamCuts, time: Float64, loads: Float64) -> pd.DataFrame:
    """Extremes of shear, bending and torsion at the cuts, with their instants.

    Returns:
        Rows `beam, axis, station, point_x, point_y, point_z, quantity, direction, min,
        time_of_min, max, time_of_max`: the station along an axis of B, the point that
        moments refer to (B, m), the axis of B that the quantity acts along or about.
    """
    named = cuts.named(loads)
    low, high = named.argmin(axis=0), named.argmax(axis=0)
    beam, rows = cuts.beam, []
    # In words: spreadsheets would compute "-x".
    acts = [
        axis_name(v).replace("-", "minus ")
        for v in (beam.lift, beam.across, beam.direction)
    ]
    for i, station in enumerate(beam.stations):
        for q, quantity in enumerate(NAMED):
            a, b = low[i, q], high[i, q]
            found = (named[a, i, q], time[a], named[b, i, q], time[b])
            place = (beam.name, beam.axis, station, *cuts.point[i])
            rows.append([*place, quantity, acts[q], *map(float, found)])
    heads = ["beam", "axis", "station", "point_x", "point_y", "point_z", "quantity",
             "direction", "min", "time_of_min", "max", "time_of_max"]  # fmt: skip
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


def _resultants(p: Float64, strip: Int64, strips: int) -> sp.csr_matrix:
    """(6 n, 6 g) force and moment about the origin of forces and moments, B."""
    maps = np.zeros((len(p), 6, 6))
    maps[:] = np.eye(6)
    x, y, z = p.T
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
    maps[:, 3:, :3] = cross
    row = 6 * strip[:, None, None] + np.arange(6)[:, None]
    column = 6 * np.arange(len(p))[:, None, None] + np.arange(6)[None, :]
    row, column = np.broadcast_arrays(row, column)
    keep = maps != 0.0
    return sp.csr_matrix(
        (maps[keep], (row[keep], column[keep])), shape=(6 * strips, 6 * len(p))
    )


def _about_origin(place: Float64) -> Float64:
    """(6, 6) of one node at `place` (3,), B."""
    one = _resultants(place[None], np.zeros(1, np.int64), 1)
    return one.toarray()

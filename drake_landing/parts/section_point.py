"""Where the loads of a section refer to: the EA-weighted center of what is cut.

All elements are stretched alike along the outward direction d,

    u = ε x,    ε = d dᵀ - ν (1 - d dᵀ),

each free to contract and to turn with the strain; ν is that of metals, and falls out
where all elements contract alike. Their stiffness K tells what each weighs in a plane
that crosses it, and its shape where the plane meets it:

    lines     force at the outer grid, where its line of action (offsets included) meets
              the plane: EA cos³ of the angle between line and d
    sheets    2 U / area times the length of the chord in the plane, at its middle
    solids    force at the outer grids, at the mean of where lines between outer and
              inner grids meet the plane
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.parts.connections import Connections
from fem.arrays import Float64, Int64
from fem.elements.connectivity import element_grids
from fem.elements.shells.shell import Shell
from fem.model.structure import Structure

Bool = npt.NDArray[np.bool_]

_POISSON = 0.3


@dataclass(frozen=True, kw_only=True)
class Stretched:
    """Elements of one block under a stretch along each axis of B, for a strain of 1.

    Attributes:
        id: (e,) elements.
        grids: (e, n) rows of their grids.
        sheets: n grids go round a sheet.
        wrench: (e, n, 3, 6) force and moment about the origin of B that each element
            feels at each grid, under a stretch along x, y and z.
        per_length: (e, 3) force over length of a cut across the stretch, of sheets.
        offset: (e, 3) from the grids to the surface of a sheet.
    """

    id: Int64
    grids: Int64
    sheets: bool
    wrench: Float64
    per_length: Float64
    offset: Float64

    def cut(
        self, p: Float64, beyond: Bool, direction: Float64, station: float
    ) -> tuple[Int64, Float64, Float64]:
        """Elements (c,) that cross a plane, their weights (c,) and points (c, 3).

        Args:
            p: (g, 3) positions of the grids, B.
            beyond: (g,) grids that are cut off.
            direction: (3,) outward along an axis of B.
            station: coordinate of the plane along it, m.
        """
        outer = beyond[self.grids]
        s = p[self.grids] @ direction
        # What a box of a beam cuts off beside the plane is no part of the section.
        mixed = outer.any(axis=1) & ~outer.all(axis=1) & (s.min(axis=1) <= station)
        outer, place = outer[mixed], p[self.grids[mixed]]
        axis = int(np.abs(direction).argmax())
        if self.sheets:
            middle, chord = _chord(place, outer, direction, station)
            weight = self.per_length[mixed, axis] * chord
            return self.id[mixed], weight, middle + self.offset[mixed]
        wrench = (self.wrench[mixed, :, axis] * outer[..., None]).sum(axis=1)
        weight = wrench[:, :3] @ direction
        if place.shape[1] > 2:
            return self.id[mixed], weight, _pairs(place, outer, direction, station)
        aside = wrench[:, :3] - np.outer(weight, direction)
        turned = np.cross(direction, wrench[:, 3:]) + station * aside
        bears = weight > 0.0
        point = _pairs(place, outer, direction, station)
        point[bears] = station * direction + turned[bears] / weight[bears, None]
        return self.id[mixed], weight, point


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """Elements and constraints that cross a cut.

    Attributes:
        point: (3,) EA-weighted center, B; the middle of what crosses where that has no
            stiffness of its own (rigid elements, constraints).
        id: (e,) elements with stiffness that cross.
        stiffness: (e,) force over strain along the normal, N.
    """

    point: Float64
    id: Int64
    stiffness: Float64


def stretched(structure: Structure) -> list[Stretched]:
    """All elements between grids that have stiffness."""
    found = []
    for block in structure.blocks:
        grids = element_grids(structure.points, block)
        stiffness = None if grids is None else block.stiffness()
        if grids is None or stiffness is None or grids.shape[1] < 2:
            continue
        p = structure.points.xyz[grids]
        e, n = grids.shape
        u = _stretch(p, stiffness.shape[1] // n)
        force = np.einsum("eij,ejk->eki", stiffness, u)
        nodal = np.moveaxis(force.reshape(e, 3, n, -1), 1, 2)
        wrench = np.zeros((e, n, 3, 6))
        wrench[..., : nodal.shape[-1]] = nodal
        wrench[..., 3:] += np.cross(p[:, :, None], wrench[..., :3])
        twice_energy = np.einsum("eki,eik->ek", force, u)
        sheets = n > 2 and stiffness.shape[1] == 6 * n
        area = 0.5 * np.linalg.norm(_normal(p), axis=1) if sheets else np.ones(e)
        offset = np.zeros((e, 3))
        if isinstance(block, Shell):
            offset = block.offset[:, None] * _unit(_normal(p))
        found.append(
            Stretched(
                id=block.id,
                grids=grids,
                sheets=sheets,
                wrench=wrench,
                per_length=twice_energy / area[:, None],
                offset=offset,
            )
        )
    return found


def crossing(
    links: Connections,
    elements: list[Stretched],
    beyond: Bool,
    direction: Float64,
    station: float,
) -> Crossing:
    """Elements that cross a cut, and the center of their stiffness.

    Args:
        links: of the model.
        elements: of the model.
        beyond: (g,) grids that are cut off.
        direction: (3,) outward along an axis of B.
        station: coordinate of the plane along it, m.
    """
    cuts = [part.cut(links.p, beyond, direction, station) for part in elements]
    ids = np.concatenate([np.zeros(0, np.int64), *(c[0] for c in cuts)])
    weight = np.concatenate([np.zeros(0), *(c[1] for c in cuts)])
    places = np.concatenate([np.zeros((0, 3)), *(c[2] for c in cuts)])
    bears = weight > 1e-9 * weight.max(initial=0.0)
    if bears.any():
        point = weight[bears] @ places[bears] / weight[bears].sum()
        point = point + direction * (station - point @ direction)
    else:
        point = _middle(links, beyond, direction, station)
    return Crossing(point=point, id=ids, stiffness=weight)


def _stretch(p: Float64, freedoms: int) -> Float64:
    """(e, n f, 3) displacements of the freedoms of elements (e, n, 3), per axis."""
    e, n, _ = p.shape
    u = np.zeros((e, n, freedoms, 3))
    for axis in range(3):
        strain = -_POISSON * np.eye(3)
        strain[axis, axis] = 1.0
        u[:, :, :3, axis] = p @ strain
        if freedoms == 6:
            u[:, :, 3:, axis] = _turn(p, strain)[:, None]
    return u.reshape(e, n * freedoms, 3)


def _turn(p: Float64, strain: Float64) -> Float64:
    """(e, 3) rotation of lines or sheets (e, n, 3) with the strain: none bends."""
    if p.shape[1] == 2:
        t = _unit(p[:, 1] - p[:, 0])
        return np.cross(t, t @ strain)
    n = _unit(_normal(p))
    return -np.cross(n, n @ strain)


def _normal(p: Float64) -> Float64:
    """(e, 3) normals of sheets, as long as twice their area."""
    last = p[:, 3] if p.shape[1] == 4 else p[:, 0]
    return np.cross(p[:, 2] - p[:, 0], last - p[:, 1])


def _unit(v: Float64) -> Float64:
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    return np.divide(v, size, out=np.zeros_like(v), where=size > 0.0)


def _chord(
    p: Float64, outer: Bool, d: Float64, station: float
) -> tuple[Float64, Float64]:
    """(c, 3) middles and (c,) lengths of where a plane meets sheets (c, n, 3)."""
    after = np.roll(p, -1, axis=1)
    edge = outer != np.roll(outer, -1, axis=1)
    at = _on_plane(p, after, d, station)
    count = np.maximum(edge.sum(axis=1), 1)[:, None]
    middle = (at * edge[..., None]).sum(axis=1) / count
    away = np.linalg.norm(at - middle[:, None], axis=2) * edge
    return middle, away.sum(axis=1)


def _pairs(p: Float64, outer: Bool, d: Float64, station: float) -> Float64:
    """(c, 3) mean of where lines from inner to outer grids (c, n, 3) meet a plane."""
    both = outer[:, None, :] & ~outer[:, :, None]
    at = _on_plane(p[:, :, None], p[:, None, :], d, station)
    count = np.maximum(both.sum(axis=(1, 2)), 1)[:, None]
    return (at * both[..., None]).sum(axis=(1, 2)) / count


def _on_plane(a: Float64, b: Float64, d: Float64, station: float) -> Float64:
    """Where lines from a to b (..., 3) meet a plane, between their ends."""
    start, span = a @ d, (b - a) @ d
    share = np.divide(
        station - start, span, out=np.full(span.shape, 0.5), where=span != 0.0
    )
    return a + np.clip(share, 0.0, 1.0)[..., None] * (b - a)


def _middle(
    links: Connections, beyond: Bool, direction: Float64, station: float
) -> Float64:
    """Mean of where lines between grids of the crossing links meet the plane."""
    _, outer, inner = links.crossing(beyond)
    near = links.p[inner] @ direction <= station
    if near.any():
        a, b = links.p[inner[near]], links.p[outer[near]]
        point = _on_plane(a, b, direction, station).mean(axis=0)
    else:
        point = links.p[beyond].mean(axis=0)
    return point + direction * (station - point @ direction)

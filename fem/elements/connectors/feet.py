"""Feet of connectors: the motion of a point of a surface from that of its grids.

Through four points around it: corners of a square as large as the connector's section
(PARTPAT, ELPAT, PROP, ELEM) follow the shape functions of the elements that they lie
on; the foot is the rigid body that fits their translations best.

Through one element (ELEMID, GRIDID): u = Σ N_i u_i, with the rotations of Kirchhoff's
plate, θ1 = w,2, θ2 = -w,1, θ3 = (v,1 - u,2) / 2.

Both are exact for rigid motion and see translations of the grids only. As MSC's guide
describes it (from memory; the size of the square, D sqrt(π) / 2, too).
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64, Int64
from fem.elements.connectors.surfaces import Surfaces, shapes, slopes
from fem.elements.lines.line_geometry import skew

_SQUARE = 0.5 * np.sqrt(np.pi)  # side of a square with the area of a disc, per D
_AROUND = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
_FLAT = 0.05  # four points so close to a line determine no rotation about it


@dataclass(frozen=True, kw_only=True)
class Foot:
    """One end of a connector.

    Attributes:
        place: (3,) basic.
        normal: (3,) of the surface, zero where it stands on a grid.
        dof: (n,) rows of the g-set.
        motion: (6, n) its translation and rotation from these, basic axes.
    """

    place: Float64
    normal: Float64
    dof: Int64
    motion: Float64


def on_grid(row: int, xyz: Float64) -> Foot:
    """The foot is a grid."""
    return Foot(
        place=xyz[row],
        normal=np.zeros(3),
        dof=6 * row + np.arange(6),
        motion=np.eye(6),
    )


def through_element(at: Int64, corners: Float64, natural: Float64) -> Foot:
    """The foot at ξ, η (2,) of one element with grids `at` (4,) at (4, 3)."""
    weight = shapes(natural)
    triangle = at[2] == at[3]  # with the same slopes everywhere
    by_natural = slopes(np.zeros(2) if triangle else natural)
    tangent = by_natural @ corners
    slope = np.linalg.pinv(tangent) @ by_natural  # (3, 4) by x, y, z
    normal = np.cross(*tangent)
    normal = normal / np.linalg.norm(normal)
    x = tangent[0] / np.linalg.norm(tangent[0])
    y = np.cross(normal, x)
    by_x, by_y = x @ slope, y @ slope
    turn = np.multiply.outer(x, np.multiply.outer(by_y, normal))
    turn -= np.multiply.outer(y, np.multiply.outer(by_x, normal))
    turn += 0.5 * np.multiply.outer(normal, np.multiply.outer(by_x, y))
    turn -= 0.5 * np.multiply.outer(normal, np.multiply.outer(by_y, x))
    motion = np.vstack([np.kron(weight, np.eye(3)), turn.reshape(3, 12)])
    place = weight @ corners
    return _foot(place, normal, at[:, None] * 6 + np.arange(3), motion)


def square_about(place: Float64, axis: Float64, diameter: float) -> Float64:
    """(4, 3) the corners of the square across an axis."""
    across = np.linalg.svd(axis[None])[2][1:]  # any two directions: it is a disc
    return place + 0.5 * _SQUARE * diameter * _AROUND @ across


def through_square(
    surfaces: Surfaces, element: int, place: Float64, corners: Int64, natural: Float64
) -> Foot | None:
    """The foot at `place` from four points at ξ, η (4, 2) of elements `corners` (4,).

    None: the surface is too narrow for the four to determine its rotations.
    """
    weight = shapes(natural)
    spots = np.einsum("pi,pij->pj", weight, surfaces.corners[corners])
    lever = spots - place
    size = np.linalg.norm(lever, axis=1).max()
    spread = np.linalg.svd(lever - lever.mean(axis=0), compute_uv=False)
    if spread[1] <= _FLAT * size:
        return None
    unit = np.repeat([1.0, 1.0 / size], 3)
    body = np.hstack([np.tile(np.eye(3), (4, 1)), -skew(lever).reshape(12, 3)])
    fit = unit[:, None] * np.linalg.pinv(body * unit)
    # Each point follows the four corners of its element.
    motion = (fit.reshape(6, 4, 1, 3) * weight[:, :, None]).reshape(6, 48)
    dof = 6 * surfaces.at[corners].reshape(-1, 1) + np.arange(3)
    return _foot(place, surfaces.normals[element], dof, motion)


def _foot(place: Float64, normal: Float64, dof: Int64, motion: Float64) -> Foot:
    """With each freedom once."""
    dofs, motions = merged(dof.reshape(-1), motion)
    return Foot(place=place, normal=normal, dof=dofs, motion=motions)


def merged(dof: Int64, matrix: Float64) -> tuple[Int64, Float64]:
    """Freedoms, each once and ascending, and the columns (..., n) summed."""
    unique, where = np.unique(dof, return_inverse=True)
    total = np.zeros((len(unique), *matrix.shape[:-1]))
    np.add.at(total, where, np.moveaxis(matrix, -1, 0))
    return unique, np.moveaxis(total, 0, -1)

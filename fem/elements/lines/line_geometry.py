"""Axes, ends and offsets of two-node line elements.

The element x axis runs from end A to end B; ends are the grids moved by their rigid
offsets. The orientation vector v spans the x-y plane (plane 1) with it:
z = x × v, y = z × x. All arrays hold one row per element; B is the basic frame, E the
element frame, and R_BE has the element axes as columns.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64


@dataclass(frozen=True, kw_only=True)
class LineGeometry:
    """Placed line elements.

    Attributes:
        length: (e,) distance of the ends.
        R_BE: (e, 3, 3) element axes.
        offset_a: (e, 3) from grid A to end A, basic.
        offset_b: (e, 3) from grid B to end B, basic.
    """

    length: Float64
    R_BE: Float64
    offset_a: Float64
    offset_b: Float64

    def grid_to_end(self) -> Float64:
        """(e, 12, 12) end freedoms in E from grid freedoms in B."""
        map_ = np.zeros((len(self.length), 12, 12))
        R_EB = self.R_BE.transpose(0, 2, 1)
        for k, offset in ((0, self.offset_a), (6, self.offset_b)):
            map_[:, k : k + 3, k : k + 3] = R_EB
            map_[:, k + 3 : k + 6, k + 3 : k + 6] = R_EB
            # u_end = u_grid + θ × w = u_grid - [w]× θ
            map_[:, k : k + 3, k + 3 : k + 6] = -R_EB @ skew(offset)
        return map_

    def end_forces(self) -> Float64:
        """(e, 12, 12) forces at the ends in E from forces at the grids in B."""
        map_ = np.zeros((len(self.length), 12, 12))
        R_EB = self.R_BE.transpose(0, 2, 1)
        for k, offset in ((0, self.offset_a), (6, self.offset_b)):
            map_[:, k : k + 3, k : k + 3] = R_EB
            map_[:, k + 3 : k + 6, k + 3 : k + 6] = R_EB
            # Moved by w from the grid, F leaves the moment -w × F.
            map_[:, k + 3 : k + 6, k : k + 3] = -R_EB @ skew(offset)
        return map_


def skew(v: Float64) -> Float64:
    """(..., 3, 3) matrices [v]× with [v]× a = v × a."""
    v = np.asarray(v, float)
    matrix = np.zeros((*v.shape, 3))
    matrix[..., 0, 1], matrix[..., 0, 2] = -v[..., 2], v[..., 1]
    matrix[..., 1, 0], matrix[..., 1, 2] = v[..., 2], -v[..., 0]
    matrix[..., 2, 0], matrix[..., 2, 1] = -v[..., 1], v[..., 0]
    return matrix


def axes_from_vector(x: Float64, v: Float64) -> Float64:
    """Orthonormal axes from the x direction and a vector in the x-y plane.

    Args:
        x: (e, 3) directions of the element axis, any length.
        v: (e, 3) orientation vectors, not parallel to x.

    Returns:
        (e, 3, 3) axes as columns; NaN where x is zero or v parallel to it.
    """
    x = x / _norm(x)
    z = np.cross(x, v)
    # Below 1e-10 of |v| the plane is given by rounding only.
    z = z / np.where(_norm(z) > 1e-10 * _norm(v), _norm(z), np.nan)
    return np.stack([x, np.cross(z, x), z], axis=-1)


def axes_about(x: Float64) -> Float64:
    """Axes with the given x directions, y near the basic axis most across to x.

    The first of several that are equally so, up to rounding.

    Args:
        x: (e, 3) directions, any length.

    Returns:
        (e, 3, 3) axes as columns.
    """
    along = np.abs(x)
    least = along.min(axis=1, keepdims=True) + 1e-9 * _norm(x)
    seed = np.eye(3)[np.argmax(along <= least, axis=1)]
    return axes_from_vector(x, seed)


def congruence(map_: Float64, matrix: Float64) -> Float64:
    """mapᵀ matrix map for stacks of matrices."""
    return map_.swapaxes(-1, -2) @ matrix @ map_


def _norm(v: Float64) -> Float64:
    return np.sqrt(np.sum(v * v, axis=-1, keepdims=True))

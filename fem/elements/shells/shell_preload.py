"""Differential stiffness of shells: membrane forces on the gradients of displacements.

The membrane forces N do the work

    1/2 int N_xx (w,x^2 + v,x^2) + N_yy (w,y^2 + u,y^2) + 2 N_xy w,x w,y dA

on the quadratic part of the strains: each on what turns across it, products with the
strains themselves are small and left out. A rigid rotation does the work of the turned
forces. Moments and transverse shear add nothing. With this the four factors that MSC
prints for a small model of solids and shells (pyNastran, buckling2_solid_shell_bar) are
met within 0.3 %; with u,a . u,b in full they are 6 to 21 % off, of which nothing is
left on meshes whose elements are thin.

w is linear between the grids, as MSC's factors show: with the curved w that belongs
to the rotations (edges bend by l . (b_2 - b_1) / 8 in their middle) they are missed by
11 % (quadrilaterals) and 16 % (triangles). Of a wave that turns by p and q from one
grid to the next the linear w keeps (sin p / p)(sin q / q) of N_xy, 1 - (p^2 + q^2) / 6,
and 1 - p^2 / 12 - q^2 / 6 of N_xx. The bending stiffness of CQUAD4 is as much too soft
for waves across both directions, so that compression is right on coarse meshes (4 % at
4 elements, 0.04 % at 8) and shear is not (63 %, 9 %, 1.3 % at 16): the curved w has
-21, -8 and -3 % there, and -10, -4 and -1 % under compression. Triangles gain by it
(0.2 and 0.3 % at 8 for 1.5 and 0.1 %), but leave MSC's factors.

Behind an offset (ZOFFS) the grid turns an arm
with the force of the corner at its tip.
"""

import numpy as np

from fem.arrays import Float64
from fem.elements.preload import of_gradients, symmetric_plane, turning_arm
from fem.elements.shells.shell_geometry import Facet, center_gradient, matrix_to_grids

_G = 1.0 / np.sqrt(3.0)
_CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
_POINTS = _G * _CORNERS
_BILINEAR = (
    0.25
    * (1 + np.outer(_POINTS[:, 0], _CORNERS[:, 0]))
    * (1 + np.outer(_POINTS[:, 1], _CORNERS[:, 1]))
)
_SLOPES = 0.25 * np.stack(
    [
        _CORNERS[:, 0] * (1 + np.outer(_POINTS[:, 1], _CORNERS[:, 1])),
        _CORNERS[:, 1] * (1 + np.outer(_POINTS[:, 0], _CORNERS[:, 0])),
    ],
    axis=1,
)


def facet_differential(shape: Facet, membrane: Float64) -> Float64:
    """(e, 6 n, 6 n) at the grids, basic axes.

    Args:
        shape: flat shapes of triangles or quadrilaterals.
        membrane: (e, p, 3) N xx yy xy in element axes at the center and, of
            quadrilaterals, at the corners.
    """
    gradient, weighted = _at_points(shape, membrane)
    e, n = len(membrane), shape.corners
    local = np.zeros((e, n, 6, n, 6))
    for k, own in enumerate(across(weighted)):
        local[:, :, k, :, k] = of_gradients(gradient, own)
    matrix = matrix_to_grids(local.reshape(e, 6 * n, 6 * n), shape)
    if shape.offset.any():
        force = np.einsum("eqab,eqbn->ena", weighted, gradient)
        arm = (shape.offset[:, None] * shape.axes[:, 2])[:, None]
        add_turning(matrix, force @ shape.axes[:, :2], arm)
    return matrix


def across(weighted: Float64) -> tuple[Float64, Float64, Float64]:
    """Forces (..., 2, 2) that work on the gradients of u, v and w."""
    of_u, of_v = np.zeros_like(weighted), np.zeros_like(weighted)
    of_u[..., 1, 1] = weighted[..., 1, 1]
    of_v[..., 0, 0] = weighted[..., 0, 0]
    return of_u, of_v, weighted


def add_turning(matrix: Float64, force: Float64, arm: Float64) -> None:
    """Add to (e, 6 n, 6 n) what forces (e, n, 3) at the tips of arms (e, n or 1, 3) do.

    All in basic axes.
    """
    turning = turning_arm(force, np.broadcast_to(arm, force.shape))
    for k in range(force.shape[1]):
        rows = slice(6 * k + 3, 6 * k + 6)
        matrix[:, rows, rows] += turning[:, k]


def _at_points(shape: Facet, membrane: Float64) -> tuple[Float64, Float64]:
    """(e, q, 2, n) gradients and (e, q, 2, 2) forces times weights."""
    if shape.corners == 3:
        gradient = center_gradient(shape)[:, None]
        weight = shape.area[:, None]
        at_points = membrane[:, :1]
    else:
        jacobian = _SLOPES @ shape.xy[:, None]
        gradient = np.linalg.inv(jacobian) @ _SLOPES
        weight = np.linalg.det(jacobian)
        at_points = _BILINEAR @ membrane[:, 1:5]
    return gradient, weight[..., None, None] * symmetric_plane(at_points)

"""Membrane displacements with vertex rotations (Allman) and assumed stresses.

Each side i -> j bows outward by a parabola of height L (theta_j - theta_i) / 8, so that
sides of neighbours stay together: D. J. Allman, A compatible triangular element
including vertex rotations for plane elasticity analysis, Computers and Structures 19,
1984. The stresses are Pian's five (Int. J. Num. Meth. Eng. 1964; Pian and Sumihara
1984): uniform ones and two that bend. In a quadrilateral these act along xi and eta and
vary across, in a triangle they act along the first side and across it and vary as
L3 - L1 and L2 - L1 of the area coordinates, which depends on the order of the corners.

Theta is tied to the rotation omega of the displacements by G t (Hughes, Brezzi 1989):

    quadrilateral  0.1 A d_0^2 + 0.9 int d^2 dA + 0.001 A h^2,   d = omega - theta
    triangle       0.1 A d_0^2

with d_0 at the center and h the mean of theta, alternately positive and negative.

The form was found in MSC Nastran's results and agrees with them to single precision:
grid point forces of an isotropic square CQUADR and a right-angled CTRIAR in motion give
all coefficients of their stiffness. A rectangle, other right-angled triangles under
forces and an isosceles one under temperatures, which were not used for it, agree to
1e-6. Stored results of distorted quadrilaterals and of laminates were not at hand, and
NX Nastran has other elements.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet, natural_vectors

_GAUSS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / np.sqrt(3.0)
_CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
_MIDDLES = np.array([[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]])


@dataclass(frozen=True, kw_only=True)
class AllmanFields:
    """Fields of triangles or quadrilaterals at their points.

    Attributes:
        weight: (e, q) area that belongs to each point of integration.
        strain: (e, q, 3, 3 n) strains xx yy xy from u v theta of the corners.
        stress: (e, q, 3, 5) assumed stresses xx yy xy.
        at: (e, 1 + n, 3, 5) the same at the center of the area and the corners.
        ties: (e, k, 3 n) what ties theta, with the square root of its weight.
    """

    weight: Float64
    strain: Float64
    stress: Float64
    at: Float64
    ties: Float64


def allman_fields(shape: Facet) -> AllmanFields:
    """Displacements, stresses and ties of triangles or quadrilaterals."""
    return _triangle(shape) if shape.corners == 3 else _quadrilateral(shape)


def _triangle(shape: Facet) -> AllmanFields:
    area = shape.area[:, None]
    opposite = np.roll(shape.edges, -1, axis=1)
    gradient = np.stack([-opposite[..., 1], opposite[..., 0]], axis=1)
    gradient = gradient[:, None] / (2.0 * area[..., None, None])
    points = np.concatenate([_MIDDLES, np.full((1, 3), 1.0 / 3.0)])
    after = np.roll(gradient, -1, axis=3)
    bows = 4.0 * (
        points[:, None] * after + np.roll(points, -1, axis=1)[:, None] * gradient
    )
    gradient = np.broadcast_to(gradient, bows.shape)
    strain, spin = _operators(shape, gradient, bows)
    excess = _less_theta(spin, points)
    stress = _bending(np.eye(2)[None], points[:, [2, 1]] - points[:, :1])
    corners = _bending(np.eye(2)[None], np.eye(3)[:, [2, 1]] - np.eye(3)[:, :1])
    at = np.concatenate([stress[:, -1:], corners], axis=1)
    return AllmanFields(
        weight=np.repeat(area / 3.0, 3, axis=1),
        strain=strain[:, :3],
        stress=np.broadcast_to(stress[:, :3], (len(area), 3, 3, 5)),
        at=np.broadcast_to(at, (len(area), 4, 3, 5)),
        ties=np.sqrt(0.1 * area)[..., None] * excess[:, 3:],
    )


def _quadrilateral(shape: Facet) -> AllmanFields:
    points = np.concatenate([_GAUSS, np.zeros((1, 2))])
    xi, eta = points.T[:, :, None]
    own, other = _CORNERS.T
    bilinear = 0.25 * (1.0 + xi * own) * (1.0 + eta * other)
    slopes = 0.25 * np.stack(
        [own * (1.0 + eta * other), other * (1.0 + xi * own)], axis=1
    )
    xi, eta = points.T
    along = np.stack([-xi * (1 - eta), 0.5 * (1 - eta**2), -xi * (1 + eta)])
    across = np.stack([-0.5 * (1 - xi**2), -eta * (1 + xi), 0.5 * (1 - xi**2)])
    bows = np.stack(
        [
            np.concatenate([along, -0.5 * (1 - eta**2)[None]]).T,
            np.concatenate([across, -eta[None] * (1 - xi)]).T,
        ],
        axis=1,
    )
    jacobian = slopes @ shape.xy[:, None]
    inverse = np.linalg.inv(jacobian)
    weight = np.linalg.det(jacobian)[:, :4]
    strain, spin = _operators(shape, inverse @ slopes, inverse @ bows)
    excess = _less_theta(spin, bilinear)
    area = shape.area[:, None]
    turns = np.zeros((len(area), 1, 4, 3))
    turns[..., 2] = np.sqrt(1e-3 * area)[..., None] * [0.25, -0.25, 0.25, -0.25]
    ties = [
        np.sqrt(0.1 * area)[..., None] * excess[:, 4:],
        np.sqrt(0.9 * weight)[..., None] * excess[:, :4],
        turns.reshape(len(area), 1, 12),
    ]
    center = (weight @ _GAUSS / area)[:, None]
    directions = natural_vectors(shape)
    directions = directions / np.linalg.norm(directions, axis=2, keepdims=True)
    corners = np.concatenate([np.zeros_like(center), _CORNERS - center], axis=1)
    return AllmanFields(
        weight=weight,
        strain=strain[:, :4],
        stress=_bending(directions, (_GAUSS - center)[..., ::-1]),
        at=_bending(directions, corners[..., ::-1]),
        ties=np.concatenate(ties, axis=1),
    )


def _operators(
    shape: Facet, gradient: Float64, bows: Float64
) -> tuple[Float64, Float64]:
    """Strains (e, q, 3, 3 n) and rotation (e, q, 3 n) from u v theta of the corners.

    Args:
        shape: geometry.
        gradient: (e, q, 2, n) of the corners' shape functions.
        bows: (e, q, 2, n) of the parabolas over the sides, 1 in their middle.
    """
    e, q, _, n = gradient.shape
    height = np.stack([shape.edges[..., 1], -shape.edges[..., 0]], axis=1) / 8.0
    # (e, q, direction, component, side): slopes of what a side's bow displaces.
    bent = bows[:, :, :, None] * height[:, None, None]
    slope = np.zeros((e, q, 2, 2, n, 3))
    for component in range(2):
        slope[:, :, :, component, :, component] = gradient
    slope[..., 2] = np.roll(bent, 1, axis=4) - bent
    slope = slope.reshape(e, q, 2, 2, 3 * n)
    xx, yy = slope[:, :, 0, 0], slope[:, :, 1, 1]
    yx, xy = slope[:, :, 0, 1], slope[:, :, 1, 0]  # v,x and u,y
    return np.stack([xx, yy, yx + xy], axis=2), 0.5 * (yx - xy)


def _less_theta(spin: Float64, functions: Float64) -> Float64:
    """(e, q, 3 n) rotation less theta, with the corners' functions (q, n)."""
    spin = spin.copy()
    spin[..., 2::3] -= functions
    return spin


def _bending(directions: Float64, amplitude: Float64) -> Float64:
    """(e, q, 3, 5) uniform stresses, then two along `directions` (e, 2, 2)."""
    amplitude = amplitude if amplitude.ndim == 3 else amplitude[None]
    stress = np.zeros((len(amplitude), amplitude.shape[1], 3, 5))
    stress[..., :3] = np.eye(3)
    for k in range(2):
        a, b = directions[:, k, 0], directions[:, k, 1]
        parts = np.stack([a * a, b * b, a * b], axis=1)
        stress[..., 3 + k] = amplitude[:, :, k, None] * parts[:, None]
    return stress

"""Faces of elements: corner and mid-side grids, and pressure over them.

A face has four corners (or three, the last one 0) and as many mid-sides, each between
a corner and the next; mid-sides that are not there are 0 and follow their corners.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64, Int64
from fem.geometry.points import Points


@dataclass(frozen=True, kw_only=True)
class Faces:
    """Loaded faces with n corners each, n = 3 or 4.

    Attributes:
        corners, middles: (f, n) grid ids, 0 for a mid-side that is not there.
        pressure: (f, n) at the corners.
        direction: (f, 3) unit vectors, basic; NaN for the normal of the face, which
            follows from the corners by the right-hand rule.
    """

    corners: Int64
    middles: Int64
    pressure: Float64
    direction: Float64


def face_forces(points: Points, faces: Faces) -> tuple[Int64, Float64]:
    """Grid rows (m,) and forces (m, 3) in basic axes, consistent with the elements."""
    n = faces.corners.shape[1]
    if len(faces.corners) == 0:
        return np.zeros(0, np.int64), np.zeros((0, 3))
    at, there = _rows(points, faces)
    xyz = points.xyz[at]
    xyz[~there] = _middles(xyz[:, :n])[~there[:, n:]]
    forces = np.zeros((len(at), 2 * n, 3))
    shape, slope, corner_shape, weight = _rule(n)
    follows_normal = np.isnan(faces.direction).any(axis=1)[:, None]
    for q in range(len(weight)):
        a, b = (np.einsum("n,enk->ek", slope[q, :, k], xyz) for k in (0, 1))
        normal = np.cross(a, b)
        area = np.linalg.norm(normal, axis=1, keepdims=True)
        traction = np.where(follows_normal, normal, area * faces.direction)
        size = weight[q] * (faces.pressure @ corner_shape[q])
        forces += shape[q][None, :, None] * (size[:, None] * traction)[:, None, :]
    _hand_over(forces, there, n)
    keep = there.ravel()
    return at.ravel()[keep], forces.reshape(-1, 3)[keep]


def _rows(points: Points, faces: Faces) -> tuple[Int64, npt.NDArray[np.bool_]]:
    ids = np.concatenate([faces.corners, faces.middles], axis=1)
    there = ids > 0
    at = np.zeros_like(ids)
    at[there] = points.rows(ids[there])
    return at, there


def _middles(corners: Float64) -> Float64:
    """(f, n, 3) points half-way from each corner to the next."""
    return 0.5 * (corners + np.roll(corners, -1, axis=1))


def _hand_over(forces: Float64, there: npt.NDArray[np.bool_], n: int) -> None:
    """Give the forces of absent mid-sides to their corners, half each."""
    for k in range(n):
        absent = ~there[:, n + k]
        half = 0.5 * forces[absent, n + k]
        forces[absent, k] += half
        forces[absent, (k + 1) % n] += half


def _rule(n: int) -> tuple[Float64, Float64, Float64, Float64]:
    """Shape functions (q, 2n), slopes (q, 2n, 2), corner ones (q, n), weights (q,)."""
    return _quadrilateral() if n == 4 else _triangle()


def _quadrilateral() -> tuple[Float64, Float64, Float64, Float64]:
    """Eight nodes (serendipity) on the square from -1 to 1, nine points."""
    x, w = np.polynomial.legendre.leggauss(3)
    r, s = (a.ravel() for a in np.meshgrid(x, x, indexing="ij"))
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
    middle = np.array([[0, -1], [1, 0], [0, 1], [-1, 0]], dtype=float)
    shape = np.zeros((9, 8))
    slope = np.zeros((9, 8, 2))
    linear = np.zeros((9, 4))
    for k, (a, b) in enumerate(corner):
        f, g = 1 + a * r, 1 + b * s
        linear[:, k] = f * g / 4
        shape[:, k] = f * g * (a * r + b * s - 1) / 4
        slope[:, k, 0] = a * g * (2 * a * r + b * s) / 4
        slope[:, k, 1] = b * f * (2 * b * s + a * r) / 4
    for k, (a, b) in enumerate(middle, start=4):
        if a == 0:
            shape[:, k] = (1 - r**2) * (1 + b * s) / 2
            slope[:, k, 0], slope[:, k, 1] = -r * (1 + b * s), b * (1 - r**2) / 2
        else:
            shape[:, k] = (1 - s**2) * (1 + a * r) / 2
            slope[:, k, 0], slope[:, k, 1] = a * (1 - s**2) / 2, -s * (1 + a * r)
    return shape, slope, linear, np.outer(w, w).ravel()


# Seven-point rule of degree five on the triangle (Radon 1948).
_RADON = [
    (1 / 3, 1 / 3, 0.225),
    *(
        (a, b, w)
        for p, w in (
            ((6 - 15**0.5) / 21, (155 - 15**0.5) / 1200),
            ((6 + 15**0.5) / 21, (155 + 15**0.5) / 1200),
        )
        for a, b in ((p, p), (1 - 2 * p, p), (p, 1 - 2 * p))
    ),
]


def _triangle() -> tuple[Float64, Float64, Float64, Float64]:
    """Six nodes on the unit triangle."""
    r, s, w = np.array(_RADON).T
    area = np.stack([1 - r - s, r, s], axis=1)
    gradient = np.array([[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]])
    shape = np.zeros((7, 6))
    slope = np.zeros((7, 6, 2))
    for k in range(3):
        j = (k + 1) % 3
        shape[:, k] = area[:, k] * (2 * area[:, k] - 1)
        slope[:, k] = (4 * area[:, k] - 1)[:, None] * gradient[k]
        shape[:, 3 + k] = 4 * area[:, k] * area[:, j]
        slope[:, 3 + k] = 4 * (
            area[:, k, None] * gradient[j] + area[:, j, None] * gradient[k]
        )
    return shape, slope, area, 0.5 * w

"""Shape functions, quadrature and strain operators of solid elements.

Corner and mid-side order is Nastran's. Natural coordinates: hexahedra (x, y, z) in
[-1, 1]^3; pentahedra (r, s) in the unit triangle and zeta in [-1, 1]; tetrahedra
(r, s, t) in the unit tetrahedron; pyramids are hexahedra whose upper face is one point.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64

_G = 1.0 / np.sqrt(3.0)
HEX_CORNERS = np.array(
    [
        [-1, -1, -1],
        [1, -1, -1],
        [1, 1, -1],
        [-1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [1, 1, 1],
        [-1, 1, 1],
    ],
    dtype=float,
)
# Mid-sides of CHEXA: lower face, verticals, upper face.
_HEX_EDGES = np.array(
    [
        [0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 5], [2, 6], [3, 7],
        [4, 5], [5, 6], [6, 7], [7, 4],
    ]
)  # fmt: skip
HEX20_POINTS = np.concatenate([HEX_CORNERS, HEX_CORNERS[_HEX_EDGES].mean(axis=1)])
TRIANGLE = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
PENTA_CORNERS = np.concatenate(
    [np.c_[TRIANGLE, -np.ones(3)], np.c_[TRIANGLE, np.ones(3)]]
)
TETRA_CORNERS = np.concatenate([np.zeros((1, 3)), np.eye(3)])
_TETRA_EDGES = np.array([[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]])

Derivatives = Callable[[Float64], Float64]


@dataclass(frozen=True, kw_only=True)
class Rule:
    """Quadrature: points (q, 3) in natural coordinates and weights (q,)."""

    points: Float64
    weights: Float64


def gauss_hex(order: int) -> Rule:
    """Product rule of order^3 points."""
    x, w = np.polynomial.legendre.leggauss(order)
    points = np.stack(np.meshgrid(x, x, x, indexing="ij"), axis=-1).reshape(-1, 3)
    weights = np.einsum("i,j,k->ijk", w, w, w).ravel()
    return Rule(points=points, weights=weights)


def gauss_penta() -> Rule:
    """Three edge midpoints of the triangle times two points along zeta."""
    triangle = np.array([[0.5, 0.0], [0.5, 0.5], [0.0, 0.5]])
    points = [[*p, z] for z in (-_G, _G) for p in triangle]
    return Rule(points=np.array(points), weights=np.full(6, 1.0 / 6.0))


def product_penta(triangle: int, height: int) -> Rule:
    """A rule of 3 or 7 points on the triangle times Gauss points along zeta.

    The three lie inside (Strang and Fix); the seven are exact to degree 5 (Radon).
    """
    if triangle == 3:
        flat, area = [[1 / 6, 1 / 6], [2 / 3, 1 / 6], [1 / 6, 2 / 3]], [1 / 6] * 3
    else:
        root = np.sqrt(15.0)
        flat, area = [[1 / 3, 1 / 3]], [9 / 80]
        for a, w in (
            ((6 - root) / 21, (155 - root) / 2400),
            ((6 + root) / 21, (155 + root) / 2400),
        ):
            flat += [[a, a], [1 - 2 * a, a], [a, 1 - 2 * a]]
            area += [w] * 3
    z, w = np.polynomial.legendre.leggauss(height)
    points = [[*p, k] for k in z for p in flat]
    return Rule(points=np.array(points), weights=np.outer(w, area).ravel())


def gauss_tetra(order: int) -> Rule:
    """One point (order 1) or four points (order 2)."""
    if order == 1:
        return Rule(points=np.full((1, 3), 0.25), weights=np.array([1.0 / 6.0]))
    a, b = 0.5854101966249685, 0.1381966011250105
    return Rule(
        points=np.array([[b, b, b], [a, b, b], [b, a, b], [b, b, a]]),
        weights=np.full(4, 1.0 / 24.0),
    )


def tetra5() -> Rule:
    """Five points, exact to degree 3, the one at the center with a negative weight."""
    points = np.full((5, 3), 1.0 / 6.0)
    points[0] = 0.25
    points[[2, 3, 4], [0, 1, 2]] = 0.5
    return Rule(points=points, weights=np.array([-16.0, 9.0, 9.0, 9.0, 9.0]) / 120.0)


def tetra15() -> Rule:
    """Fifteen points, exact to degree 5 (Keast), for the mass of quadratic elements."""
    root = np.sqrt(15.0)
    points, weights = [[0.25] * 3], [16.0 / 135.0 / 6.0]
    for a, w in (
        ((7.0 - root) / 34.0, (2665.0 + 14.0 * root) / 37800.0 / 6.0),
        ((7.0 + root) / 34.0, (2665.0 - 14.0 * root) / 37800.0 / 6.0),
    ):
        corner = 1.0 - 3.0 * a
        points += [[a, a, a], [corner, a, a], [a, corner, a], [a, a, corner]]
        weights += [w] * 4
    a, b = (10.0 - 2.0 * root) / 40.0, (10.0 + 2.0 * root) / 40.0
    for i in range(3):
        for low, high in ((a, b), (b, a)):
            point = [high] * 3
            point[i] = low
            if low == a:
                points.append(point)
                other = [a] * 3
                other[i] = b
                points.append(other)
    weights += [20.0 / 378.0 / 6.0] * 6
    return Rule(points=np.array(points), weights=np.array(weights))


def hex8(p: Float64) -> Float64:
    """(q, 8) values at natural points (q, 3)."""
    return 0.125 * np.prod(1.0 + p[:, None, :] * HEX_CORNERS, axis=-1)


def hex8_derivatives(p: Float64) -> Float64:
    """(q, 3, 8)."""
    factor = 1.0 + p[:, None, :] * HEX_CORNERS
    other = [factor[..., (k + 1) % 3] * factor[..., (k + 2) % 3] for k in range(3)]
    return 0.125 * np.stack(other, axis=1) * HEX_CORNERS.T


def hex20(p: Float64) -> Float64:
    """(q, 20) serendipity values."""
    c = HEX20_POINTS
    factor = 1.0 + p[:, None, :] * c
    zero = c == 0.0
    value = np.where(zero, 1.0 - p[:, None, :] ** 2, factor)
    result = 0.25 * np.prod(value, axis=-1)
    corner = 0.125 * np.prod(factor, axis=-1) * (p[:, None, :] @ c.T[None] - 2.0)[:, 0]
    return np.where(zero.any(axis=1), result, corner)


def hex20_derivatives(p: Float64) -> Float64:
    """(q, 3, 20)."""
    c = HEX20_POINTS
    at = p[:, None, :]
    factor = 1.0 + at * c
    zero = c == 0.0
    value = np.where(zero, 1.0 - at**2, factor)
    slope = np.where(zero, -2.0 * at, c)
    total = np.sum(at * c, axis=-1) - 2.0
    rows = []
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        middle = 0.25 * slope[..., k] * value[..., i] * value[..., j]
        pair = 0.125 * factor[..., i] * factor[..., j] * c[:, k]
        corner = pair * (total + factor[..., k])
        rows.append(np.where(zero.any(axis=1), middle, corner))
    return np.stack(rows, axis=1)


def penta6(p: Float64) -> Float64:
    """(q, 6)."""
    r, s, z = p.T
    flat = np.stack([1.0 - r - s, r, s], axis=1)
    low, high = 0.5 * (1.0 - z)[:, None], 0.5 * (1.0 + z)[:, None]
    return np.concatenate([low * flat, high * flat], axis=1)


def penta6_derivatives(p: Float64) -> Float64:
    """(q, 3, 6)."""
    r, s, z = p.T
    flat = np.stack([1.0 - r - s, r, s], axis=1)
    slope = np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])
    low, high = 0.5 * (1.0 - z)[:, None, None], 0.5 * (1.0 + z)[:, None, None]
    in_plane = np.concatenate([low * slope, high * slope], axis=2)
    along = 0.5 * np.concatenate([-flat, flat], axis=1)[:, None]
    return np.concatenate([in_plane, along], axis=1)


def tetra4(p: Float64) -> Float64:
    """(q, 4)."""
    return np.concatenate([1.0 - p.sum(axis=1, keepdims=True), p], axis=1)


def tetra4_derivatives(p: Float64) -> Float64:
    """(q, 3, 4)."""
    slope = np.concatenate([-np.ones((3, 1)), np.eye(3)], axis=1)
    return np.broadcast_to(slope, (len(p), 3, 4))


def tetra10(p: Float64) -> Float64:
    """(q, 10)."""
    linear = tetra4(p)
    i, j = _TETRA_EDGES.T
    corners = linear * (2.0 * linear - 1.0)
    return np.concatenate([corners, 4.0 * linear[:, i] * linear[:, j]], axis=1)


def tetra10_derivatives(p: Float64) -> Float64:
    """(q, 3, 10)."""
    linear = tetra4(p)[:, None, :]
    slope = tetra4_derivatives(p)
    i, j = _TETRA_EDGES.T
    corners = slope * (4.0 * linear - 1.0)
    edges = 4.0 * (slope[..., i] * linear[..., j] + linear[..., i] * slope[..., j])
    return np.concatenate([corners, edges], axis=2)


def pyram5(p: Float64) -> Float64:
    """(q, 5) at natural points of the collapsed hexahedron."""
    value = hex8(p)
    return np.concatenate([value[:, :4], value[:, 4:].sum(axis=1)[:, None]], axis=1)


def pyram5_derivatives(p: Float64) -> Float64:
    """(q, 3, 5)."""
    slope = hex8_derivatives(p)
    top = slope[..., 4:].sum(axis=2, keepdims=True)
    return np.concatenate([slope[..., :4], top], axis=2)


def jacobians(xyz: Float64, derivative: Float64) -> Float64:
    """(e, q, 3, 3) rows d x / d natural from nodes (e, n, 3) and (q, 3, n)."""
    return derivative[None] @ xyz[:, None]


def strain_operator(gradient: Float64) -> Float64:
    """(..., 6, 3 n) strains xx yy zz xy yz zx from nodal u; gradient (..., 3, n)."""
    x, y, z = (gradient[..., k, :] for k in range(3))
    operator = np.zeros((*gradient.shape[:-2], 6, gradient.shape[-1], 3))
    operator[..., 0, :, 0] = operator[..., 3, :, 1] = operator[..., 5, :, 2] = x
    operator[..., 1, :, 1] = operator[..., 3, :, 0] = operator[..., 4, :, 2] = y
    operator[..., 2, :, 2] = operator[..., 4, :, 1] = operator[..., 5, :, 0] = z
    return operator.reshape(*gradient.shape[:-2], 6, -1)


def strain_transform(gradient: Float64) -> Float64:
    """(..., 6, 6) Cartesian from covariant strains, both xx yy zz xy yz zx.

    Args:
        gradient: (..., 3, 3) d natural_a / d x_i at [i, a], the inverse of `jacobians`.
    """
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))
    matrix = np.empty((*gradient.shape[:-2], 6, 6))
    for row, (i, j) in enumerate(pairs):
        for col, (a, b) in enumerate(pairs):
            value = gradient[..., i, a] * gradient[..., j, b]
            if i != j:
                value = value + gradient[..., j, a] * gradient[..., i, b]
            matrix[..., row, col] = value
    return matrix

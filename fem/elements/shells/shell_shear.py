"""Transverse shear of shells: assumed edge strains and residual bending flexibility.

Shear strains are sampled along the edges, where bending without shear gives none
(no locking, Dvorkin and Bathe 1984, MacNeal 1978), and the flexibility is augmented by
the deficiency of linear elements in bending that varies along an edge l,

    Z = Z_s + sum over edges of l l^T / (24 D_l),

D_l the bending stiffness along the edge (MacNeal's residual bending flexibility). The
uniform strain takes all of it; the linear one of the quadrilateral takes 1/40; the
circulation of the triangle, the same shear along all its edges, takes the mean Z. With
these shares squares and half squares have the grid point forces that MSC and NX Nastran
print, to six digits. In longer elements the full length would make the plate soft in
torsion (a strip of 6 x 2 elements of aspect 10 by a factor of 2): quadrilaterals count
their edges with the shorter mean side, triangles are held to the half square's ratio of
the principal values.
"""

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet
from fem.properties.shell_section import ShellSection, intrinsic_bending

LINEAR_SHARE = 0.025
HALF_SQUARE_RATIO = 3.0


def residual_flexibility(shape: Facet, bending: Float64) -> Float64:
    """(e, 2, 2) sum of l l^T / (24 D_l) over the edges l, limited for long elements.

    Args:
        shape: geometry.
        bending: (e, 3, 3) bending stiffness in element axes.
    """
    edge = shape.edges
    length = np.linalg.norm(edge, axis=-1)
    direction = edge / np.where(length == 0.0, 1.0, length)[..., None]
    c, s = np.moveaxis(direction, -1, 0)
    curvature = np.stack([c * c, s * s, 2.0 * c * s], axis=-1)
    along = np.einsum("eki,eij,ekj->ek", curvature, bending, curvature)
    if shape.corners == 4:
        sides = 0.5 * (length[:, :2] + length[:, 2:])
        length = np.broadcast_to(sides.min(axis=1, keepdims=True), length.shape)
    share: Float64 = length**2 / (24.0 * np.where(along > 0.0, along, np.inf))
    scaled = share[..., None] * direction
    residual: Float64 = np.matmul(scaled.transpose(0, 2, 1), direction)
    return _limited(residual) if shape.corners == 3 else residual


def _limited(flexibility: Float64) -> Float64:
    """Symmetric (e, 2, 2) with the larger principal value at most 3 times the other."""
    value, vector = np.linalg.eigh(flexibility)
    value = np.minimum(value, HALF_SQUARE_RATIO * value[:, :1])
    return np.einsum("eik,ek,ejk->eij", vector, value, vector)


def edge_shear(shape: Facet) -> Float64:
    """(e, n, 6 n) shear strain times length along each edge, from flat local freedoms.

    Along an edge l: w_2 - w_1 + l . (b_1 + b_2) / 2 with b = (ry, -rx).
    """
    n = shape.corners
    edge = shape.edges
    operator = np.zeros((len(edge), n, n, 6))
    for i in range(n):
        j = (i + 1) % n
        operator[:, i, i, 2] -= 1.0
        operator[:, i, j, 2] += 1.0
        for corner in (i, j):
            operator[:, i, corner, 4] += 0.5 * edge[:, i, 0]
            operator[:, i, corner, 3] -= 0.5 * edge[:, i, 1]
    return operator.reshape(len(edge), n, 6 * n)


def shear(shape: Facet, section: ShellSection) -> tuple[Float64, Float64]:
    """Stiffness and resultants of transverse shear, flat local freedoms.

    Returns:
        (e, 6 n, 6 n) stiffness and (e, 2, 6 n) shear forces at the centre; both zero
        where the element has no bending stiffness.
    """
    bending = intrinsic_bending(section)
    residual = residual_flexibility(shape, bending)
    plate = np.einsum("eii->e", bending) > 0.0
    # Membranes have no shear; any positive flexibility lets the algebra run.
    flexible = plate[:, None, None] & np.ones((1, 2, 2), bool)
    base = np.where(flexible, section.shear_flexibility, 0.0)
    total = np.where(flexible, base + residual, np.eye(2))
    part = _quadrilateral if shape.corners == 4 else _triangle
    linear = np.where(flexible, base + LINEAR_SHARE * residual, np.eye(2))
    stiffness, force = part(shape, total, linear)
    stiffness[~plate] = 0.0
    force[~plate] = 0.0
    return stiffness, force


def _congruence(operator: Float64, matrix: Float64) -> Float64:
    """(e, n, n) operator^T matrix operator."""
    return operator.transpose(0, 2, 1) @ (matrix @ operator)


def _quadrilateral(
    shape: Facet, total: Float64, linear: Float64
) -> tuple[Float64, Float64]:
    edge = edge_shear(shape)
    # Covariant strains: along xi on edges 1-2 and 4-3, along eta on 1-4 and 2-3.
    lower, upper = 0.5 * edge[:, 0], -0.5 * edge[:, 2]
    left, right = -0.5 * edge[:, 3], 0.5 * edge[:, 1]
    mean = np.stack([0.5 * (lower + upper), 0.5 * (left + right)], axis=1)
    slope = np.stack([0.5 * (upper - lower), 0.5 * (right - left)], axis=1)
    x = shape.xy
    jacobian = 0.25 * np.stack(
        [x[:, 1] + x[:, 2] - x[:, 0] - x[:, 3], x[:, 2] + x[:, 3] - x[:, 0] - x[:, 1]],
        axis=1,
    )
    twist = 0.25 * (x[:, 0] - x[:, 1] + x[:, 2] - x[:, 3])
    inverse = np.linalg.inv(jacobian)
    uniform = inverse @ mean
    # A uniform strain has covariant components that vary by the twist of the shape.
    slope = slope - (twist[:, None, :] @ uniform)
    stiff, area = np.linalg.inv(total), shape.area[:, None, None]
    stiffness = area * _congruence(uniform, stiff)
    stiff_linear = np.linalg.inv(linear)
    weight = np.einsum("eki,ekl,eli->ei", inverse, stiff_linear, inverse)
    stiffness += area / 3.0 * (slope.transpose(0, 2, 1) @ (weight[..., None] * slope))
    return stiffness, stiff @ uniform


def _triangle(
    shape: Facet, total: Float64, _linear: Float64
) -> tuple[Float64, Float64]:
    edge = edge_shear(shape)
    vectors = shape.edges
    length = np.linalg.norm(vectors, axis=-1)
    circulation = edge.sum(axis=1) / length.sum(axis=1)[:, None]
    rest = edge - length[..., None] * circulation[:, None, :]
    uniform = np.linalg.inv(vectors[:, :2]) @ rest[:, :2]
    stiff, area = np.linalg.inv(total), shape.area[:, None, None]
    stiffness = area * _congruence(uniform, stiff)
    mean = 0.5 * np.einsum("eii->e", total)[:, None, None]
    stiffness += area / mean * circulation[:, :, None] * circulation[:, None, :]
    return stiffness, stiff @ uniform

"""Transverse shear of shells: assumed edge strains and residual bending flexibility.

Shear strains are sampled along the edges, where bending without shear gives none
(no locking, Dvorkin and Bathe 1984, MacNeal 1978), and the flexibility is augmented by
the deficiency of linear elements in bending that varies along an edge l,

    Z = Z_s + Z_r,    Z_r = sum over edges of l l^T / (24 D_l),

D_l the bending stiffness along the edge (MacNeal's residual bending flexibility); of a
laminate that about the neutral surface of the direction l. The uniform strain takes all
of it, with the full lengths of the edges.

The part of the strain along x that varies with y bends two strips of length dx in
opposite senses: the element twists, and its width dy resists as well. Two springs side
by side, 12 D / dx^2 of the strips and (1 / e - 1) 12 D / dy^2 of the twist, leave of
the residual flexibility the share

    a = e / (e + (1 - e) (dx / dy)^2),    e = 1/40

(MacNeal, Computers & Structures 8, 1978, and Finite Elements in Analysis and Design 5,
1989, as quoted in public code); likewise that of the strain along y, with dy / dx. On
rectangles, laminates included, reactions and shear forces are those of MSC and NX
Nastran to seven digits. On other quadrilaterals the strains are those along the natural
directions, dx is the mean length in that direction, dy the mean width across it.

The triangle's uniform strain takes Z likewise. The circulation, the same shear along
all its edges, has no direction: its residual flexibility is A / (6 D), A the area, the
only one that all triangles of equal sides, half squares and slender ones share with the
sum over the edges,

    Z_c = sqrt(4/3 det Z_r),    as det(sum of l l^T) = 12 A^2 for any triangle,

and the stiffness is the mean over both directions. Half squares have the grid point
forces of MSC and NX Nastran to six digits; in slender triangles of a foreign airframe
the moments at the grids balance under MSC's displacements.

CQUADR and CTRIAR have others: Z_r is 3/4 of the sum over the edges and what varies
takes none of it; of the triangle A / (12 D) in all directions and A / (2 D) of the
circulation. So say the grid point forces of MSC Nastran (unit and half squares, single
precision) and its deflections of two rectangles and of an isosceles triangle (1e-7).
Where the section is rigid in shear (MID3 blank) what varies keeps the flexibility of a
solid sheet, 6 / (5 G t), as the quadrilateral would lock; MSC's is another (0.2 %).
"""

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet, natural_vectors
from fem.properties.shell_section import ShellSection, bending_along

TWIST_SHARE = 1.0 / 40.0


def residual_flexibility(shape: Facet, section: ShellSection) -> Float64:
    """(e, 2, 2) sum of l l^T / (24 D_l) over the edges l."""
    edge = shape.edges
    length = np.linalg.norm(edge, axis=-1)
    direction = edge / np.where(length == 0.0, 1.0, length)[..., None]
    along = bending_along(section, direction)
    # Without bending stiffness along an edge (MAT2) its strip is as good as cut.
    stiffness = np.einsum("eii->e", section.bending)[:, None]
    along = np.maximum(along, 1e-9 * stiffness)
    share: Float64 = length**2 / (24.0 * np.where(along > 0.0, along, np.inf))
    scaled = share[..., None] * direction
    residual: Float64 = np.matmul(scaled.transpose(0, 2, 1), direction)
    return residual


def twist_shares(jacobian: Float64) -> Float64:
    """(e, 2) shares of the strains along the natural directions that vary across.

    Args:
        jacobian: (e, 2, 2) rows are the halves of the mean vectors along xi and eta.
    """
    length = np.linalg.norm(jacobian, axis=2)
    ratio = length**2 / np.abs(np.linalg.det(jacobian))[:, None]
    shares: Float64 = TWIST_SHARE / (TWIST_SHARE + (1.0 - TWIST_SHARE) * ratio**2)
    return shares


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


def shear(
    shape: Facet, section: ShellSection, *, drills: bool = False
) -> tuple[Float64, Float64]:
    """Stiffness and resultants of transverse shear, flat local freedoms.

    Args:
        shape: geometry.
        section: of the elements.
        drills: of CQUADR and CTRIAR.

    Returns:
        (e, 6 n, 6 n) stiffness and (e, 2, 6 n) shear forces at the center; both zero
        where the element has no bending stiffness.
    """
    plate = np.einsum("eii->e", section.bending) > 0.0
    # Membranes have no shear; any positive flexibility lets the algebra run.
    there = plate[:, None, None]
    base = np.where(there, section.shear_flexibility, np.eye(2))
    residual = np.where(there, residual_flexibility(shape, section), 0.0)
    if shape.corners == 4:
        varying = _varying(shape, base, residual)
        if drills:
            residual, varying = 0.75 * residual, _solid_sheet(base, section)
        stiffness, force = _quadrilateral(shape, base + residual, varying)
    else:
        turning = np.sqrt(4.0 / 3.0 * np.linalg.det(residual).clip(0.0))
        if drills:
            # The sum over the edges has the trace (sum of l^2) / (24 D).
            square = (shape.edges**2).sum(axis=(1, 2))
            turning = np.einsum("eii->e", residual) * 12.0 * shape.area / square
            residual = turning[:, None, None] / 6.0 * np.eye(2)
        turned = base + turning[:, None, None] * np.eye(2)
        stiffness, force = _triangle(shape, base + residual, turned)
    stiffness[~plate] = 0.0
    force[~plate] = 0.0
    return stiffness, force


def _congruence(operator: Float64, matrix: Float64) -> Float64:
    """(e, n, n) operator^T matrix operator."""
    return operator.transpose(0, 2, 1) @ (matrix @ operator)


def _varying(shape: Facet, base: Float64, residual: Float64) -> Float64:
    """(e, 2, 2, 2) flexibility of the strains along xi and eta that vary across."""
    share = twist_shares(natural_vectors(shape))[..., None, None]
    return base[:, None] + share * residual[:, None]


def _solid_sheet(base: Float64, section: ShellSection) -> Float64:
    """(e, 1, 2, 2) flexibility of the section, of a solid sheet where it has none."""
    size = np.einsum("eii->e", base)[:, None, None]
    twisting = section.bending[:, 2:, 2:] * 12.0 / section.thickness[:, None, None] ** 2
    solid = 1.2 / np.where(twisting > 0.0, twisting, 1.0) * np.eye(2)
    return np.where(size > 0.0, base, solid)[:, None]


def _quadrilateral(
    shape: Facet, flexibility: Float64, varying: Float64
) -> tuple[Float64, Float64]:
    """Stiffness and forces from the flexibility (e, 2, 2) of uniform strain.

    `varying` is that of the strains along xi and eta that vary across.
    """
    edge = edge_shear(shape)
    # Covariant strains: along xi on edges 1-2 and 4-3, along eta on 1-4 and 2-3.
    lower, upper = 0.5 * edge[:, 0], -0.5 * edge[:, 2]
    left, right = -0.5 * edge[:, 3], 0.5 * edge[:, 1]
    mean = np.stack([0.5 * (lower + upper), 0.5 * (left + right)], axis=1)
    slope = np.stack([0.5 * (upper - lower), 0.5 * (right - left)], axis=1)
    x = shape.xy
    twist = 0.25 * (x[:, 0] - x[:, 1] + x[:, 2] - x[:, 3])
    inverse = np.linalg.inv(natural_vectors(shape))
    uniform = inverse @ mean
    # A uniform strain has covariant components that vary by the twist of the shape.
    slope = slope - (twist[:, None, :] @ uniform)
    stiff, area = np.linalg.inv(flexibility), shape.area[:, None, None]
    stiffness = area * _congruence(uniform, stiff)
    stiffer = np.broadcast_to(np.linalg.inv(varying), (len(x), 2, 2, 2))
    weight = np.einsum("eik,ekij,ejk->ek", inverse, stiffer, inverse)
    stiffness += area / 3.0 * (slope.transpose(0, 2, 1) @ (weight[..., None] * slope))
    return stiffness, stiff @ uniform


def _triangle(
    shape: Facet, flexibility: Float64, turned: Float64
) -> tuple[Float64, Float64]:
    """Stiffness and forces from the flexibilities (e, 2, 2) of both parts."""
    edge = edge_shear(shape)
    vectors = shape.edges
    length = np.linalg.norm(vectors, axis=-1)
    circulation = edge.sum(axis=1) / length.sum(axis=1)[:, None]
    rest = edge - length[..., None] * circulation[:, None, :]
    uniform = np.linalg.inv(vectors[:, :2]) @ rest[:, :2]
    stiff, area = np.linalg.inv(flexibility), shape.area[:, None, None]
    stiffness = area * _congruence(uniform, stiff)
    mean = 0.5 * np.einsum("eii->e", np.linalg.inv(turned))[:, None, None]
    stiffness += area * mean * circulation[:, :, None] * circulation[:, None, :]
    return stiffness, stiff @ uniform

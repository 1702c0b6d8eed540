"""CPENTA with six nodes: bubble functions and shear sampled along the sides.

Strains are those of the linear displacements, with two changes. Transverse shear (in
the planes of the third natural direction) is sampled at mid-height along the sides of
the triangle; a uniform strain plus the same shear along all sides is fitted, and each
side's midpoint carries the uniform one plus that of its own side. Bubble functions, the
sum of the squared area coordinates in the plane and 1 - zeta^2 along the height, free
the element of locking by Poisson's ratio. Nodal forces and stresses are those that MSC
and NX Nastran print (right triangular prisms). Uniform strain is exact for extruded
meshes; with inclined faces the sampled shear is an approximation that refinement
removes.
"""

from typing import TYPE_CHECKING

import numpy as np

from fem.elements.block import Float64
from fem.elements.isoparametric import (
    PENTA_CORNERS,
    gauss_penta,
    jacobians,
    penta6,
    penta6_derivatives,
    strain_transform,
)
from fem.elements.solid import Shape, Solid
from fem.elements.solid_reader import read_solids
from fem.elements.solid_stiffness import SolidMatrices
from fem.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

CENTRE = np.array([[1.0 / 3.0, 1.0 / 3.0, 0.0]])
OUTPUT = np.concatenate([CENTRE, PENTA_CORNERS])
_SIDES = ((0, 1), (1, 2), (2, 0))
# Covariant strains rr ss zz rs that the displacements give.
_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1))


def penta_solid(xyz: Float64, elasticity: Float64) -> SolidMatrices:
    """Stiffness and stresses at the centre and the corners.

    Args:
        xyz: (e, 6, 3) nodes in the basic frame.
        elasticity: (e, 6, 6) in basic axes.
    """
    rule = gauss_penta()
    sampled = _sampled_shear(xyz)
    jacobian = jacobians(xyz, penta6_derivatives(rule.points))
    volume = rule.weights * np.linalg.det(jacobian)
    # The rule's points are the side midpoints, at two heights.
    strain = _strain(xyz, rule.points, np.tile(sampled, (1, 2, 1, 1)))
    bubble = _bubble(xyz, rule.points)
    stress = elasticity[:, None] @ strain
    soft = elasticity[:, None] @ bubble

    def integral(a: Float64, b: Float64) -> Float64:
        return np.einsum("eq,eqsi,eqsj->eij", volume, a, b, optimize=True)

    coupling = integral(bubble, stress)
    amplitude = -np.linalg.solve(integral(bubble, soft), coupling)
    mean = np.broadcast_to(
        sampled.mean(axis=1, keepdims=True), (len(xyz), len(OUTPUT), 2, 18)
    )
    outside = _strain(xyz, OUTPUT, mean) + _bubble(xyz, OUTPUT) @ amplitude[:, None]
    return SolidMatrices(
        stiffness=integral(strain, stress) + coupling.transpose(0, 2, 1) @ amplitude,
        stress=elasticity[:, None] @ outside,
    )


def _sampled_shear(xyz: Float64) -> Float64:
    """(e, 3, 2, 18) covariant shear (s zeta, zeta r) at the midpoints of the sides."""
    e = len(xyz)
    middle = 0.5 * (xyz[:, :3] + xyz[:, 3:])
    height = 0.5 * (xyz[:, 3:] - xyz[:, :3])
    side = np.stack([middle[:, j] - middle[:, i] for i, j in _SIDES], axis=1)
    operator = np.zeros((e, 3, 6, 3))
    for k, (i, j) in enumerate(_SIDES):
        along = 0.25 * (height[:, i] + height[:, j])
        for node, sign in ((i, -1.0), (j, 1.0)):
            for level, up in ((0, -1.0), (3, 1.0)):
                operator[:, k, node + level] += sign * along + 0.25 * up * side[:, k]
    edge = operator.reshape(e, 3, 18)
    length = np.linalg.norm(side, axis=2)
    circulation = edge.sum(axis=1) / length.sum(axis=1)[:, None]
    rest = edge - length[..., None] * circulation[:, None]
    tangent = side / length[..., None]
    along_r = np.einsum("eki,ei->ek", tangent, side[:, 0])
    along_s = np.einsum("eki,ei->ek", tangent, -side[:, 2])
    r = rest[:, None, 0] + along_r[..., None] * circulation[:, None]
    s = -rest[:, None, 2] + along_s[..., None] * circulation[:, None]
    return np.stack([s, r], axis=2)


def _strain(xyz: Float64, at: Float64, shear: Float64) -> Float64:
    """(e, q, 6, 18) Cartesian strains with the covariant shear (e, q, 2, 18) given."""
    derivative = penta6_derivatives(at)
    jacobian = jacobians(xyz, derivative)
    e, q = jacobian.shape[:2]
    covariant = np.empty((e, q, 6, 6, 3))
    for row, (a, b) in enumerate(_PAIRS):
        part = derivative[None, :, b, :, None] * jacobian[:, :, a, None, :]
        if a != b:
            part = part + derivative[None, :, a, :, None] * jacobian[:, :, b, None, :]
        covariant[:, :, row] = part
    covariant = covariant.reshape(e, q, 6, 18)
    covariant[:, :, 4:] = shear
    return strain_transform(np.linalg.inv(jacobian)) @ covariant


def _bubble(xyz: Float64, at: Float64) -> Float64:
    """(e, q, 6, 3) Cartesian strains of the bubble functions.

    Taken with the Jacobian of the centre and scaled by the ratio of volumes, so that
    their mean vanishes (patch test).
    """
    centre = jacobians(xyz, penta6_derivatives(CENTRE))[:, 0]
    here = np.linalg.det(jacobians(xyz, penta6_derivatives(at)))
    area = np.stack([1.0 - at[:, 0] - at[:, 1], at[:, 0], at[:, 1]], axis=1)
    slope_r, slope_s = 2.0 * (area[:, 1] - area[:, 0]), 2.0 * (area[:, 2] - area[:, 0])
    # Each bubble moves along one natural direction d: metric g_ab = x_a . x_b.
    metric = centre @ centre.transpose(0, 2, 1)
    covariant = np.zeros((len(xyz), len(at), 6, 3))
    for mode in (0, 1):
        towards = metric[:, None, mode]
        covariant[..., 0, mode] = towards[..., 0] * slope_r
        covariant[..., 1, mode] = towards[..., 1] * slope_s
        covariant[..., 3, mode] = towards[..., 0] * slope_s + towards[..., 1] * slope_r
    covariant[..., 2, 2] = metric[:, None, 2, 2] * (-2.0 * at[:, 2])
    ratio = np.linalg.det(centre)[:, None] / here
    turn = strain_transform(np.linalg.inv(centre))[:, None]
    return ratio[..., None, None] * (turn @ covariant)


PENTA6 = Shape(
    card="CPENTA",
    nodes=6,
    corners=6,
    matrices=penta_solid,
    values=penta6,
    derivatives=penta6_derivatives,
    mass_rule=gauss_penta(),
    checked=OUTPUT,
)


def read_cpenta(deck: "Deck", points: Points) -> list[Solid]:
    """The CPENTA blocks of a deck; see `read_solids`."""
    return read_solids(deck, points, "CPENTA", (PENTA6,))

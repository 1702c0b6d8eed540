"""CPENTA with six nodes: bubble functions and shear sampled along the sides.

Strains are those of the linear displacements, with two changes. Transverse shear (in
the planes of the third natural direction) is sampled at mid-height along the sides of
the triangle; a uniform strain plus the same shear along all sides is fitted, and each
side's midpoint carries the uniform one plus that of its own side. Bubble functions, the
sum of the squared area coordinates in the plane and 1 - zeta^2 along the height, free
the element of locking by Poisson's ratio. Nodal forces and stresses are those that MSC
and NX Nastran print (right triangular prisms). Patches of prisms with
parallel faces, upright or leaning, carry uniform strain exactly; with inclined faces
their nodal forces are an approximation that refinement removes.
"""

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.element_axes import penta_axes
from fem.elements.solids.isoparametric import (
    PENTA_CORNERS,
    Rule,
    gauss_penta,
    jacobians,
    penta6,
    penta6_derivatives,
    product_penta,
    strain_operator,
    strain_transform,
)
from fem.elements.solids.penta15 import PENTA15
from fem.elements.solids.solid import Shape, Solid
from fem.elements.solids.solid_reader import read_solids
from fem.elements.solids.solid_stiffness import (
    ShearLines,
    SolidMatrices,
    displacement_solid,
    line_shear_solid,
)
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

CENTER = np.array([[1.0 / 3.0, 1.0 / 3.0, 0.0]])
OUTPUT = np.concatenate([CENTER, PENTA_CORNERS])
_SIDES = ((0, 1), (1, 2), (2, 0))


@dataclass(frozen=True, kw_only=True)
class MidPlane:
    """The triangle at mid-height.

    Attributes:
        side: (e, 3, 3) vectors 1-2, 2-3, 3-1.
        plane: (e, 2, 3) natural directions r and s.
        normal: (e, 3) unit normal.
        rise: (e, 3, 3) half the height vector at the midpoints of the sides.
    """

    side: Float64
    plane: Float64
    normal: Float64
    rise: Float64


def mid_plane(xyz: Float64) -> MidPlane:
    """The triangle at mid-height of (e, 6, 3)."""
    middle = 0.5 * (xyz[:, :3] + xyz[:, 3:])
    height = 0.5 * (xyz[:, 3:] - xyz[:, :3])
    side = np.roll(middle, -1, axis=1) - middle
    normal = np.cross(side[:, 0], -side[:, 2])
    return MidPlane(
        side=side,
        plane=np.stack([side[:, 0], -side[:, 2]], axis=1),
        normal=normal / np.linalg.norm(normal, axis=1, keepdims=True),
        rise=0.5 * (height + np.roll(height, -1, axis=1)),
    )


def penta_solid(xyz: Float64, elasticity: Float64) -> SolidMatrices:
    """Stiffness and stresses at the center and the corners.

    Args:
        xyz: (e, 6, 3) nodes in the basic frame.
        elasticity: (e, 6, 6) in basic axes.
    """
    rule = gauss_penta()
    middle = mid_plane(xyz)
    sampled = _sampled_shear(middle)
    jacobian = jacobians(xyz, penta6_derivatives(rule.points))
    volume = rule.weights * np.linalg.det(jacobian)
    # The rule's points are the side midpoints, at two heights.
    strain = _strain(xyz, rule.points, middle, np.tile(sampled, (1, 2, 1, 1)))
    bubble = _bubble(xyz, rule.points)
    stress = elasticity[:, None] @ strain
    soft = elasticity[:, None] @ bubble

    def integral(a: Float64, b: Float64) -> Float64:
        return np.einsum("eq,eqsi,eqsj->eij", volume, a, b, optimize=True)

    coupling = integral(bubble, stress)
    amplitude = -np.linalg.solve(integral(bubble, soft), coupling)
    # Printed shear is linear over the triangle: corner = both own sides - the opposite.
    mean = sampled.mean(axis=1, keepdims=True)
    corners = 3.0 * mean - 2.0 * sampled[:, [1, 2, 0]]
    printed = np.concatenate([mean, corners, corners], axis=1)
    outside = _strain(xyz, OUTPUT, middle, printed)
    outside = outside + _bubble(xyz, OUTPUT) @ amplitude[:, None]
    return SolidMatrices(
        stiffness=integral(strain, stress) + coupling.transpose(0, 2, 1) @ amplitude,
        stress=elasticity[:, None] @ outside,
    )


def _sampled_shear(middle: MidPlane) -> Float64:
    """(e, 3, 2, 18) shear 2 eps(n, x_r), 2 eps(n, x_s) at the midpoints of the sides.

    Along a side l the covariant shear l . u,zeta + x,zeta . (u_j - u_i), less what the
    height's lean b in the plane makes of the plane strains, over the height.
    """
    side, rise = middle.side, middle.rise
    height = np.einsum("eki,ei->ek", rise, middle.normal)
    operator = np.zeros((len(side), 3, 6, 3))
    for k, (i, j) in enumerate(_SIDES):
        for node, sign in ((i, -1.0), (j, 1.0)):
            for level, up in ((0, -1.0), (3, 1.0)):
                operator[:, k, node + level] += (
                    0.5 * sign * rise[:, k] + 0.25 * up * side[:, k]
                )
    lean = np.einsum("ekx,eax->eka", rise, _dual(middle.plane))
    edge = operator.reshape(-1, 3, 18) - _leaning(middle.plane, lean)
    edge /= height[..., None]
    length = np.linalg.norm(side, axis=2)
    circulation = edge.sum(axis=1) / length.sum(axis=1)[:, None]
    rest = edge - length[..., None] * circulation[:, None]
    tangent = side / length[..., None]
    along = np.einsum("eki,eai->eka", tangent, middle.plane)
    uniform = np.stack([rest[:, 0], -rest[:, 2]], axis=1)
    return uniform[:, None] + along[..., None] * circulation[:, None, None]


def _leaning(plane: Float64, lean: Float64) -> Float64:
    """(e, 3, 18) 2 b^a eps(x_a, l) at mid-height for the sides l; lean (e, 3, 2)."""
    slope = np.array([[-0.5, 0.5, 0.0], [-0.5, 0.0, 0.5]])
    slope = np.concatenate([slope, slope], axis=1)

    def twice_strain(a: int, b: int) -> Float64:
        part = (
            slope[b][:, None] * plane[:, None, a]
            + slope[a][:, None] * plane[:, None, b]
        )
        return part.reshape(-1, 18)

    # Sides in terms of r and s: x_r, x_s - x_r, -x_s.
    weights = np.array([[1.0, 0.0], [-1.0, 1.0], [0.0, -1.0]])
    strains = np.stack(
        [np.stack([twice_strain(a, b) for b in (0, 1)], axis=1) for a in (0, 1)], axis=1
    )
    return np.einsum("eka,kb,eabi->eki", lean, weights, strains)


def _dual(plane: Float64) -> Float64:
    """(e, 2, 3) vectors of the plane dual to its natural directions."""
    return np.linalg.inv(plane @ plane.transpose(0, 2, 1)) @ plane


def _strain(xyz: Float64, at: Float64, middle: MidPlane, shear: Float64) -> Float64:
    """(e, q, 6, 18) Cartesian strains with the shear along n given (e, q, 2, 18)."""
    derivative = penta6_derivatives(at)
    strain = strain_operator(np.linalg.inv(jacobians(xyz, derivative)) @ derivative)
    normal = middle.normal[:, None]
    own = _symmetric(normal, middle.plane)
    own[..., :3] *= 2.0
    change = shear - own[:, None] @ strain
    return (
        strain
        + _symmetric(normal, _dual(middle.plane)).transpose(0, 2, 1)[:, None] @ change
    )


def _symmetric(a: Float64, b: Float64) -> Float64:
    """(..., 6) xx yy zz of a b, xy yz zx of a b + b a, for vectors (..., 3)."""
    a, b = np.broadcast_arrays(a, b)
    i, j = [0, 1, 2], [1, 2, 0]
    return np.concatenate(
        [a * b, a[..., i] * b[..., j] + a[..., j] * b[..., i]], axis=-1
    )


def _bubble(xyz: Float64, at: Float64) -> Float64:
    """(e, q, 6, 3) Cartesian strains of the bubble functions.

    Taken with the Jacobian of the center and scaled by the ratio of volumes, so that
    their mean vanishes (patch test).
    """
    center = jacobians(xyz, penta6_derivatives(CENTER))[:, 0]
    here = np.linalg.det(jacobians(xyz, penta6_derivatives(at)))
    area = np.stack([1.0 - at[:, 0] - at[:, 1], at[:, 0], at[:, 1]], axis=1)
    slope_r, slope_s = 2.0 * (area[:, 1] - area[:, 0]), 2.0 * (area[:, 2] - area[:, 0])
    # Each bubble moves along one natural direction d: metric g_ab = x_a . x_b.
    metric = center @ center.transpose(0, 2, 1)
    covariant = np.zeros((len(xyz), len(at), 6, 3))
    for mode in (0, 1):
        towards = metric[:, None, mode]
        covariant[..., 0, mode] = towards[..., 0] * slope_r
        covariant[..., 1, mode] = towards[..., 1] * slope_s
        covariant[..., 3, mode] = towards[..., 0] * slope_s + towards[..., 1] * slope_r
    covariant[..., 2, 2] = metric[:, None, 2, 2] * (-2.0 * at[:, 2])
    ratio = np.linalg.det(center)[:, None] / here
    turn = strain_transform(np.linalg.inv(center))[:, None]
    return ratio[..., None, None] * (turn @ covariant)


def penta6_full(nodes: Float64, elasticity: Float64, *, rule: Rule) -> SolidMatrices:
    """Six nodes: displacements, all strains at the same points."""
    return displacement_solid(nodes, elasticity, penta6_derivatives, rule, OUTPUT)


def penta6_lines(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Six nodes without bubble functions: shear with the height halfway up it."""
    lines = ShearLines(axes=penta_axes, center=OUTPUT[:1], held=((0, 1), (2,), (2,)))
    rule = product_penta(3, 2)
    return line_shear_solid(nodes, elasticity, penta6_derivatives, rule, lines, OUTPUT)


PENTA6 = Shape(
    card="CPENTA",
    nodes=6,
    corners=6,
    matrices=penta_solid,
    values=penta6,
    derivatives=penta6_derivatives,
    mass_rule=gauss_penta(),
    checked=OUTPUT,
    integration={
        ("TWO", "REDUCED"): penta6_lines,
        ("TWO", "FULL"): partial(penta6_full, rule=product_penta(3, 2)),
        ("THREE", "FULL"): partial(penta6_full, rule=product_penta(7, 3)),
    },
)


def read_cpenta(deck: "Deck", points: Points) -> list[Solid]:
    """The CPENTA blocks of a deck; see `read_solids`."""
    return read_solids(deck, points, "CPENTA", (PENTA6, PENTA15))

"""Stiffness and stresses of solids: displacements, reduced shear, assumed stresses.

Reduced shear: in the element's own axes the normal strains are integrated and printed
as they are, the shear strains taken at fewer points. Both rules integrate the nodal
forces of uniform stress exactly while edges are straight (patch test).

The hybrid hexahedron assumes the 18 stress modes of Pian and Tong (1986): uniform
stress; normal stresses that vary across their direction; shear that varies along the
direction normal to it. Compatible displacements and uniform stress make the patch test
exact on any shape; the modes leave bending free of locking. On cubes it has the grid
point forces that MSC and NX Nastran print for their CHEXA.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.element_axes import stress_rotation
from fem.elements.solids.isoparametric import (
    Derivatives,
    Rule,
    jacobians,
    strain_operator,
    strain_transform,
)


@dataclass(frozen=True, kw_only=True)
class SolidMatrices:
    """Results of the integration over an element.

    Attributes:
        stiffness: (e, 3 n, 3 n) translations of the nodes, basic axes.
        stress: (e, p, 6, 3 n) stress xx yy zz xy yz zx at output points, basic axes.
    """

    stiffness: Float64
    stress: Float64


def displacement_solid(
    xyz: Float64,
    elasticity: Float64,
    derivatives: Derivatives,
    rule: Rule,
    at: Float64,
    spread: Float64 | None = None,
) -> SolidMatrices:
    """Isoparametric displacement element.

    Args:
        xyz: (e, n, 3) nodes in the basic frame.
        elasticity: (e, 6, 6) in basic axes.
        derivatives: shape function derivatives at natural points.
        rule: quadrature.
        at: (p, 3) natural points of the stresses.
        spread: (p, q) the stresses there from those at the points of the rule; None:
            as they are at the points.
    """
    strain, weight = _strain(xyz, derivatives, rule)
    stress = elasticity[:, None] @ strain
    stiffness = np.einsum("eq,eqsi,eqsj->eij", weight, strain, stress, optimize=True)
    if spread is not None:
        outside = np.einsum("pq,eqsi->epsi", spread, stress)
        return SolidMatrices(stiffness=stiffness, stress=outside)
    gradient = derivatives(at)
    inverse = np.linalg.inv(jacobians(xyz, gradient))
    return SolidMatrices(
        stiffness=stiffness,
        stress=elasticity[:, None] @ strain_operator(inverse @ gradient),
    )


@dataclass(frozen=True, kw_only=True)
class Sampling:
    """Where the strains of an element with reduced shear are taken.

    Attributes:
        normal, shear: quadrature of the normal and of the shear strains.
        spread: (p, q) values at the output points from those at the points of `shear`.
        axes: element axes (e, 3, 3) from the Jacobian at the centre.
        centre: (1, 3) natural point.
    """

    normal: Rule
    shear: Rule
    spread: Float64
    axes: Callable[[Float64], Float64]
    centre: Float64


def reduced_shear_solid(
    xyz: Float64,
    elasticity: Float64,
    derivatives: Derivatives,
    sampling: Sampling,
    at: Float64,
) -> SolidMatrices:
    """Displacement element with normal and shear strains taken at different points.

    The energy is that of all strains by the rule of the shear, and of the normal ones
    by their own rule instead. Arguments as for `displacement_solid`.
    """
    axes = sampling.axes(jacobians(xyz, derivatives(sampling.centre))[:, 0])
    turn = stress_rotation(axes, strain=True)
    normal = np.linalg.solve(turn, np.diag([1.0] * 3 + [0.0] * 3) @ turn)[:, None]
    coarse, coarse_weight = _strain(xyz, derivatives, sampling.shear)
    fine, fine_weight = _strain(xyz, derivatives, sampling.normal)

    def energy(strain: Float64, weight: Float64) -> Float64:
        stress = elasticity[:, None] @ strain
        return np.einsum("eq,eqsi,eqsj->eij", weight, strain, stress, optimize=True)

    stiffness = energy(coarse, coarse_weight) - energy(normal @ coarse, coarse_weight)
    gradient = derivatives(at)
    inverse = np.linalg.inv(jacobians(xyz, gradient))
    direct = normal @ strain_operator(inverse @ gradient)
    shear = np.einsum("pq,eqsi->epsi", sampling.spread, coarse - normal @ coarse)
    return SolidMatrices(
        stiffness=stiffness + energy(normal @ fine, fine_weight),
        stress=elasticity[:, None] @ (direct + shear),
    )


def hybrid_solid(
    xyz: Float64,
    elasticity: Float64,
    derivatives: Derivatives,
    rule: Rule,
    modes: Derivatives,
    at: Float64,
) -> SolidMatrices:
    """Hybrid element: assumed stresses, compatible displacements.

    Args:
        xyz: (e, n, 3) nodes in the basic frame.
        elasticity: (e, 6, 6) in basic axes, regular.
        derivatives: shape function derivatives at natural points.
        rule: quadrature.
        modes: (q, 6, b) contravariant stresses at natural points; they are turned by
            the Jacobian at the first point of `at`, the centre.
        at: (p, 3) natural points of the stresses.
    """
    strain, weight = _strain(xyz, derivatives, rule)
    turn = stress_transform(jacobians(xyz, derivatives(at[:1]))[:, 0])
    inside = turn[:, None] @ modes(rule.points)
    compliance = np.linalg.inv(elasticity)[:, None]
    flexible = np.einsum(
        "eq,eqsa,eqsb->eab", weight, inside, compliance @ inside, optimize=True
    )
    work = np.einsum("eq,eqsa,eqsi->eai", weight, inside, strain, optimize=True)
    amplitude = np.linalg.solve(flexible, work)
    outside = turn[:, None] @ modes(at)
    return SolidMatrices(
        stiffness=work.transpose(0, 2, 1) @ amplitude,
        stress=outside @ amplitude[:, None],
    )


def _strain(
    xyz: Float64, derivatives: Derivatives, rule: Rule
) -> tuple[Float64, Float64]:
    """(e, q, 6, 3 n) strain operators and (e, q) weights times Jacobians."""
    derivative = derivatives(rule.points)
    jacobian = jacobians(xyz, derivative)
    gradient = np.linalg.inv(jacobian) @ derivative
    return strain_operator(gradient), rule.weights * np.linalg.det(jacobian)


def stress_transform(jacobian: Float64) -> Float64:
    """(e, 6, 6) Cartesian stress from contravariant one, both xx yy zz xy yz zx.

    sigma = J^T s J with the rows of J scaled to unit length.
    """
    j = jacobian / np.linalg.norm(jacobian, axis=2, keepdims=True)
    # Strains turn with the inverse transpose of what turns stresses.
    return np.linalg.inv(strain_transform(np.linalg.inv(j))).transpose(0, 2, 1)


def _stack_modes(p: Float64, terms: tuple[tuple[int, Float64], ...]) -> Float64:
    modes = np.zeros((len(p), 6, 6 + len(terms)))
    modes[:, :, :6] = np.eye(6)
    for k, (component, value) in enumerate(terms):
        modes[:, component, 6 + k] = value
    return modes


def pian_tong(p: Float64) -> Float64:
    """(q, 6, 18) stress modes of the hexahedron at natural points (q, 3)."""
    x, y, z = p.T
    return _stack_modes(
        p,
        (
            (0, y), (0, z), (0, y * z),
            (1, z), (1, x), (1, z * x),
            (2, x), (2, y), (2, x * y),
            (3, z), (4, x), (5, y),
        ),
    )  # fmt: skip

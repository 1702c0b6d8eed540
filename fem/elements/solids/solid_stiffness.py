"""Stiffness and stresses of solids: displacements, reduced shear, assumed stresses.

Reduced shear: in the element's own axes some strains are taken as they are, the others
(shear) at fewer points. Both rules integrate the nodal forces of uniform stress exactly
while edges are straight (patch test).

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
    """Points at which an element with reduced shear takes its strains.

    Attributes:
        fine: quadrature of the strains that are taken as they are.
        coarse: quadrature of the others.
        basis: functions of the natural coordinates to which those are fitted at the
            points of `coarse`, least squares with the weights of the integration.
        axes: element axes (e, 3, 3) from the Jacobian at the center.
        center: (1, 3) natural point.
        direct: which of xx yy zz xy yz zx in the element axes are taken as they are.
        printed: which of them are printed as they are.
    """

    fine: Rule
    coarse: Rule
    basis: Derivatives
    axes: Callable[[Float64], Float64]
    center: Float64
    direct: tuple[int, ...] = (0, 1, 2)
    printed: tuple[int, ...] = (0, 1, 2)


def reduced_shear_solid(
    xyz: Float64,
    elasticity: Float64,
    derivatives: Derivatives,
    sampling: Sampling,
    at: Float64,
) -> SolidMatrices:
    """Displacement element whose strains are taken at different points.

    The energy is that of all strains by the coarse rule, and of the direct ones by the
    fine rule instead. Arguments as for `displacement_solid`.
    """
    axes = sampling.axes(jacobians(xyz, derivatives(sampling.center))[:, 0])
    turn = stress_rotation(axes, strain=True)

    def part(rows: tuple[int, ...]) -> Float64:
        """(e, 1, 6, 6) the part of a strain that lies in some rows of element axes."""
        kept = np.zeros((6, 6))
        kept[rows, rows] = 1.0
        return np.linalg.solve(turn, kept @ turn)[:, None]

    def energy(strain: Float64, weight: Float64) -> Float64:
        stress = elasticity[:, None] @ strain
        return np.einsum("eq,eqsi,eqsj->eij", weight, strain, stress, optimize=True)

    coarse, coarse_weight = _strain(xyz, derivatives, sampling.coarse)
    fine, fine_weight = _strain(xyz, derivatives, sampling.fine)
    direct, printed = part(sampling.direct), part(sampling.printed)
    values = sampling.basis(sampling.coarse.points)
    weighted = coarse_weight[..., None] * values
    fitted = np.linalg.solve(
        np.einsum("eqa,qb->eab", weighted, values), weighted.transpose(0, 2, 1)
    )

    def spread(points: Float64) -> Float64:
        """(e, p, 6, 3 n) the fitted strains at natural points."""
        share = sampling.basis(points) @ fitted
        return np.einsum("epq,eqsi->epsi", share, coarse, optimize=True)

    smooth = spread(sampling.coarse.points)
    stiffness = energy(smooth + direct @ (coarse - smooth), coarse_weight)
    stiffness += energy(direct @ fine, fine_weight)
    stiffness -= energy(direct @ coarse, coarse_weight)
    gradient = derivatives(at)
    outside = strain_operator(np.linalg.inv(jacobians(xyz, gradient)) @ gradient)
    smooth = spread(at)
    return SolidMatrices(
        stiffness=stiffness,
        stress=elasticity[:, None] @ (smooth + printed @ (outside - smooth)),
    )


@dataclass(frozen=True, kw_only=True)
class ShearLines:
    """Lines along which a linear element takes its shear strains, in its own axes.

    Attributes:
        axes: element axes (e, 3, 3) from the Jacobian at the center.
        center: (1, 3) natural point.
        held: for xy, yz and zx the natural coordinates that are those of the center.
    """

    axes: Callable[[Float64], Float64]
    center: Float64
    held: tuple[tuple[int, ...], ...]


def line_shear_solid(
    xyz: Float64,
    elasticity: Float64,
    derivatives: Derivatives,
    rule: Rule,
    lines: ShearLines,
    at: Float64,
) -> SolidMatrices:
    """Displacement element whose shear strains vary along some directions only.

    Shear of two directions is taken halfway along both: bending does not lock then.
    Other arguments as for `displacement_solid`.
    """
    axes = lines.axes(jacobians(xyz, derivatives(lines.center))[:, 0])
    turn = stress_rotation(axes, strain=True)[:, None]

    def strain(points: Float64) -> Float64:
        own = turn @ _operator(xyz, derivatives, points)
        for component, held in zip((3, 4, 5), lines.held):
            moved = points.copy()
            moved[:, held] = lines.center[0, held]
            own[:, :, component] = (turn @ _operator(xyz, derivatives, moved))[
                :, :, component
            ]
        return np.linalg.solve(turn, own)

    inside = strain(rule.points)
    _, weight = _strain(xyz, derivatives, rule)
    stress = elasticity[:, None] @ inside
    return SolidMatrices(
        stiffness=np.einsum("eq,eqsi,eqsj->eij", weight, inside, stress, optimize=True),
        stress=elasticity[:, None] @ strain(at),
    )


def _operator(xyz: Float64, derivatives: Derivatives, points: Float64) -> Float64:
    """(e, p, 6, 3 n) strains at natural points."""
    gradient = derivatives(points)
    return strain_operator(np.linalg.inv(jacobians(xyz, gradient)) @ gradient)


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
            the Jacobian at the first point of `at`, the center.
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

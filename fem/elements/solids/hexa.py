"""CHEXA with 8 nodes (hybrid, Pian and Tong) or 20 nodes (reduced shear).

With 20 nodes the normal strains are integrated at 3 x 3 x 3 points, the shear strains
at 2 x 2 x 2; printed shear is trilinear through these. A gravity load on one element in
MSC 2020 (pyNastran models, single_element-3d) and a transient in NX 2019.2 (tr1091x)
have these displacements, forces and stresses to single precision. In its nonlinear
SOL 106 NX has the same stresses with 3 x 3 x 3 points for all forces (ehbus69).
Without bubble functions (IN TWO) the shear of two directions is taken between them; a
bent brick of MSC's has that displacement to five digits (pyNastran models, randvar2).
"""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.element_axes import hexa_axes
from fem.elements.solids.isoparametric import (
    HEX_CORNERS,
    gauss_hex,
    hex8,
    hex8_derivatives,
    hex20,
    hex20_derivatives,
)
from fem.elements.solids.layered import LayeredSolid
from fem.elements.solids.layered_reader import read_layered
from fem.elements.solids.solid import Shape, Solid
from fem.elements.solids.solid_reader import read_solids
from fem.elements.solids.solid_stiffness import (
    Sampling,
    ShearLines,
    SolidMatrices,
    displacement_solid,
    hybrid_solid,
    line_shear_solid,
    pian_tong,
    reduced_shear_solid,
)
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

OUTPUT = np.concatenate([np.zeros((1, 3)), HEX_CORNERS])


def hexa8(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Eight nodes (e, 8, 3): hybrid."""
    return hybrid_solid(
        nodes, elasticity, hex8_derivatives, gauss_hex(2), pian_tong, OUTPUT
    )


def _sampling(order: int) -> Sampling:
    """Normal strains at order^3 points, shear strains trilinear through 2 x 2 x 2."""
    return Sampling(
        fine=gauss_hex(order),
        coarse=gauss_hex(2),
        basis=hex8,
        axes=hexa_axes,
        center=OUTPUT[:1],
    )


def hexa20(nodes: Float64, elasticity: Float64, *, order: int = 3) -> SolidMatrices:
    """Twenty nodes (e, 20, 3): reduced shear."""
    return reduced_shear_solid(
        nodes, elasticity, hex20_derivatives, _sampling(order), OUTPUT
    )


def hexa20_full(
    nodes: Float64, elasticity: Float64, *, order: int = 3
) -> SolidMatrices:
    """Twenty nodes: all strains at the same order^3 points."""
    return displacement_solid(
        nodes, elasticity, hex20_derivatives, gauss_hex(order), OUTPUT
    )


def hexa8_full(nodes: Float64, elasticity: Float64, *, order: int) -> SolidMatrices:
    """Eight nodes: displacements, order^3 points."""
    return displacement_solid(
        nodes, elasticity, hex8_derivatives, gauss_hex(order), OUTPUT
    )


def hexa8_lines(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Eight nodes without bubble functions: shear of two directions between them."""
    lines = ShearLines(axes=hexa_axes, center=OUTPUT[:1], held=((0, 1), (1, 2), (2, 0)))
    return line_shear_solid(
        nodes, elasticity, hex8_derivatives, gauss_hex(2), lines, OUTPUT
    )


HEXA8 = Shape(
    card="CHEXA",
    nodes=8,
    corners=8,
    matrices=hexa8,
    values=hex8,
    derivatives=hex8_derivatives,
    mass_rule=gauss_hex(2),
    # Not the corners: Nastran takes bricks that fold there, as in the patch of MacNeal
    # and Harder, and nothing is evaluated there.
    checked=np.concatenate([OUTPUT[:1], gauss_hex(2).points]),
    integration={
        ("TWO", "REDUCED"): hexa8_lines,
        ("TWO", "FULL"): partial(hexa8_full, order=2),
        ("THREE", "FULL"): partial(hexa8_full, order=3),
    },
)
HEXA20 = Shape(
    card="CHEXA",
    nodes=20,
    corners=8,
    matrices=hexa20,
    values=hex20,
    derivatives=hex20_derivatives,
    mass_rule=gauss_hex(3),
    checked=np.concatenate([OUTPUT[:1], gauss_hex(3).points]),
    integration={
        ("TWO", "REDUCED"): partial(hexa20, order=2),
        ("TWO", "FULL"): partial(hexa20_full, order=2),
        ("THREE", "FULL"): hexa20_full,
    },
)


def read_chexa(deck: "Deck", points: Points) -> list[Solid | LayeredSolid]:
    """The CHEXA blocks of a deck; see `read_solids` and `read_layered`."""
    return [
        *read_solids(deck, points, "CHEXA", (HEXA8, HEXA20)),
        *read_layered(deck, points, HEXA8),
    ]

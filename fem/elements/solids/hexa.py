"""CHEXA with 8 nodes (hybrid, Pian and Tong) or 20 nodes (displacements)."""

from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.isoparametric import (
    HEX_CORNERS,
    gauss_hex,
    hex8,
    hex8_derivatives,
    hex20,
    hex20_derivatives,
)
from fem.elements.solids.solid import Shape, Solid
from fem.elements.solids.solid_reader import read_solids
from fem.elements.solids.solid_stiffness import (
    SolidMatrices,
    displacement_solid,
    hybrid_solid,
    pian_tong,
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


def hexa20(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Twenty nodes (e, 20, 3): displacements, 3 x 3 x 3 points."""
    return displacement_solid(
        nodes, elasticity, hex20_derivatives, gauss_hex(3), OUTPUT
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
    quadratic=True,
)


def read_chexa(deck: "Deck", points: Points) -> list[Solid]:
    """The CHEXA blocks of a deck; see `read_solids`."""
    return read_solids(deck, points, "CHEXA", (HEXA8, HEXA20))

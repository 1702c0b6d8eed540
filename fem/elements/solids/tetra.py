"""CTETRA with 4 nodes (uniform strain) or 10 nodes (linear strain).

Ten nodes are integrated at five points: on two distorted elements under a force in MSC
(pyNastran models, tet10) the nodal forces then balance to single precision, which those
of four or fifteen points do not; printed stresses are linear, fitted to the five points
with the weights of the integration.
"""

from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.isoparametric import (
    TETRA_CORNERS,
    gauss_tetra,
    tetra4,
    tetra4_derivatives,
    tetra5,
    tetra10,
    tetra10_derivatives,
    tetra15,
)
from fem.elements.solids.solid import Shape, Solid
from fem.elements.solids.solid_reader import read_solids
from fem.elements.solids.solid_stiffness import SolidMatrices, displacement_solid
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

OUTPUT = np.concatenate([np.full((1, 3), 0.25), TETRA_CORNERS])


# The linear field with the weighted mean and slopes of the values at the five points.
_FIVE = tetra5()
_LINEAR = _FIVE.weights[:, None] * tetra4(_FIVE.points)
_SPREAD = tetra4(OUTPUT) @ np.linalg.solve(_LINEAR.T @ tetra4(_FIVE.points), _LINEAR.T)


def tetra_linear(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Four nodes (e, 4, 3)."""
    return displacement_solid(
        nodes, elasticity, tetra4_derivatives, gauss_tetra(1), OUTPUT
    )


def tetra_quadratic(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Ten nodes (e, 10, 3), five points."""
    return displacement_solid(
        nodes, elasticity, tetra10_derivatives, _FIVE, OUTPUT, _SPREAD
    )


TETRA4 = Shape(
    card="CTETRA",
    nodes=4,
    corners=4,
    matrices=tetra_linear,
    values=tetra4,
    derivatives=tetra4_derivatives,
    mass_rule=gauss_tetra(2),
    checked=OUTPUT[:1],
)
TETRA10 = Shape(
    card="CTETRA",
    nodes=10,
    corners=4,
    matrices=tetra_quadratic,
    values=tetra10,
    derivatives=tetra10_derivatives,
    mass_rule=tetra15(),
    checked=OUTPUT,
)


def read_ctetra(deck: "Deck", points: Points) -> list[Solid]:
    """The CTETRA blocks of a deck; see `read_solids`."""
    return read_solids(deck, points, "CTETRA", (TETRA4, TETRA10))

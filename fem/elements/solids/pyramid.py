"""CPYRAM with 5 nodes: a hexahedron whose upper face is one point (displacements).

On the base it is bilinear and on the sides linear, so that it joins hexahedra and
tetrahedra; two points per direction integrate it exactly (patch test).
"""

from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.isoparametric import (
    HEX_CORNERS,
    gauss_hex,
    pyram5,
    pyram5_derivatives,
)
from fem.elements.solids.solid import Shape, Solid
from fem.elements.solids.solid_reader import read_solids
from fem.elements.solids.solid_stiffness import SolidMatrices, displacement_solid
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

# The strains of the apex depend on the way to it: taken just below.
_APEX = np.array([[0.0, 0.0, 1.0 - 1e-6]])
# The centroid of a pyramid lies a quarter of the height above its base.
OUTPUT = np.concatenate([[[0.0, 0.0, -0.5]], HEX_CORNERS[:4], _APEX])


def pyramid(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Five nodes (e, 5, 3)."""
    return displacement_solid(
        nodes, elasticity, pyram5_derivatives, gauss_hex(2), OUTPUT
    )


PYRAM5 = Shape(
    card="CPYRAM",
    nodes=5,
    corners=5,
    matrices=pyramid,
    values=pyram5,
    derivatives=pyram5_derivatives,
    mass_rule=gauss_hex(3),
    checked=OUTPUT[:5],
)


def read_cpyram(deck: "Deck", points: Points) -> list[Solid]:
    """The CPYRAM blocks of a deck; see `read_solids`."""
    return read_solids(deck, points, "CPYRAM", (PYRAM5,))

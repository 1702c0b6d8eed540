"""CPYRAM with 5 or 13 nodes: a hexahedron whose upper face is one point.

On the base it is bilinear and on the sides linear, so that it joins hexahedra and
tetrahedra; two points per direction integrate it exactly (patch test). With 13 nodes
(Bedrosian's rational functions, polynomials in the natural coordinates) base and sides
are quadratic, and eight points are MSC's rule (PSOLID in its guide of 2022).
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


def _base_and_height(p: Float64) -> tuple[Float64, Float64, Float64]:
    """1 + xi xi_i, 1 + eta eta_i (q, 4) and the height from 0 to 1 (q, 1)."""
    x = 1.0 + p[:, :1] * HEX_CORNERS[:4, 0]
    y = 1.0 + p[:, 1:2] * HEX_CORNERS[:4, 1]
    return x, y, 0.5 * (1.0 + p[:, 2:])


def pyram13(p: Float64) -> Float64:
    """(q, 13): corners, middles of the base's sides, middles of the rising edges."""
    x, y, t = _base_and_height(p)
    s = 1.0 - t
    corner = 0.25 * x * y * s * (s * (x + y - 2.0) - 1.0)
    xi, eta = p[:, :1], p[:, 1:2]
    across = [1.0 - eta, 1.0 + xi, 1.0 + eta, 1.0 - xi]
    along = [1.0 - xi**2, 1.0 - eta**2, 1.0 - xi**2, 1.0 - eta**2]
    base = [0.5 * s**2 * a * b for a, b in zip(across, along)]
    return np.concatenate([corner, t * (2.0 * t - 1.0), *base, s * t * x * y], axis=1)


def pyram13_derivatives(p: Float64) -> Float64:
    """(q, 3, 13)."""
    x, y, t = _base_and_height(p)
    s = 1.0 - t
    cx, cy = HEX_CORNERS[:4, 0], HEX_CORNERS[:4, 1]
    xi, eta, one, none = p[:, :1], p[:, 1:2], np.ones_like(t), np.zeros_like(t)
    bracket = s * (x + y - 2.0) - 1.0
    down = 0.25 * x * y
    rows = [
        [
            *(0.25 * cx * y * s * (bracket + s * x), none),
            *(-xi * s**2 * (1 - eta), 0.5 * s**2 * (1 - eta**2)),
            *(-xi * s**2 * (1 + eta), -0.5 * s**2 * (1 - eta**2)),
            s * t * cx * y,
        ],
        [
            *(0.25 * cy * x * s * (bracket + s * y), none),
            *(-0.5 * s**2 * (1 - xi**2), -eta * s**2 * (1 + xi)),
            *(0.5 * s**2 * (1 - xi**2), -eta * s**2 * (1 - xi)),
            s * t * cy * x,
        ],
        # The height runs from 0 to 1 while zeta runs from -1 to 1.
        [
            *(-0.5 * down * (bracket + s * (x + y - 2.0)), 0.5 * (4.0 * t - one)),
            *(-0.5 * s * (1 - xi**2) * (1 - eta), -0.5 * s * (1 - eta**2) * (1 + xi)),
            *(-0.5 * s * (1 - xi**2) * (1 + eta), -0.5 * s * (1 - eta**2) * (1 - xi)),
            0.5 * (s - t) * x * y,
        ],
    ]
    return np.stack([np.concatenate(row, axis=1) for row in rows], axis=1)


def pyramid_quadratic(nodes: Float64, elasticity: Float64) -> SolidMatrices:
    """Thirteen nodes (e, 13, 3), eight points."""
    return displacement_solid(
        nodes, elasticity, pyram13_derivatives, gauss_hex(2), OUTPUT
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
PYRAM13 = Shape(
    card="CPYRAM",
    nodes=13,
    corners=5,
    matrices=pyramid_quadratic,
    values=pyram13,
    derivatives=pyram13_derivatives,
    mass_rule=gauss_hex(4),
    checked=np.concatenate([OUTPUT[:1], gauss_hex(2).points]),
)


def read_cpyram(deck: "Deck", points: Points) -> list[Solid]:
    """The CPYRAM blocks of a deck; see `read_solids`."""
    return read_solids(deck, points, "CPYRAM", (PYRAM5, PYRAM13))

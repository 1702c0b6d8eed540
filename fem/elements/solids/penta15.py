"""CPENTA with 15 nodes: reduced shear.

Strains in the plane of the triangle are integrated at 7 x 3 points. Those out of it,
yz, zx and zz, are taken at 7 x 2 points and fitted there to functions that are linear
in the plane and along the height: the free corner of two prisms in MSC (pyNastran
models, api3) moves by this to single precision. Printed are xx and yy as they are, the
others fitted, in the axes of `penta_axes`: so do MSC (api3) and NX 2019.2 (ehbus69).
"""

from functools import partial

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.element_axes import penta_axes
from fem.elements.solids.isoparametric import (
    PENTA_CORNERS,
    Rule,
    penta6,
    product_penta,
)
from fem.elements.solids.solid import Shape
from fem.elements.solids.solid_stiffness import (
    Sampling,
    SolidMatrices,
    displacement_solid,
    reduced_shear_solid,
)

CENTER = np.array([[1.0 / 3.0, 1.0 / 3.0, 0.0]])
OUTPUT = np.concatenate([CENTER, PENTA_CORNERS])
_SIDES = (np.array([0, 1, 2]), np.array([1, 2, 0]))
_SLOPE = np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])
_FINE, _COARSE = product_penta(7, 3), product_penta(7, 2)


def _area(p: Float64) -> Float64:
    return np.stack([1.0 - p[:, 0] - p[:, 1], p[:, 0], p[:, 1]], axis=1)


def penta15(p: Float64) -> Float64:
    """(q, 15) serendipity values: corners, lower sides, heights, upper sides."""
    area, z = _area(p), p[:, 2:]
    low, high, bubble = 0.5 * (1.0 - z), 0.5 * (1.0 + z), 1.0 - z * z
    corner = area * (2.0 * area - 1.0)
    side = 4.0 * area[:, _SIDES[0]] * area[:, _SIDES[1]]
    half = 0.5 * area * bubble
    return np.concatenate(
        [
            *(corner * low - half, corner * high - half),
            *(side * low, area * bubble, side * high),
        ],
        axis=1,
    )


def penta15_derivatives(p: Float64) -> Float64:
    """(q, 3, 15)."""
    area, z = _area(p), p[:, 2:]
    low, high, bubble = 0.5 * (1.0 - z), 0.5 * (1.0 + z), 1.0 - z * z
    i, j = _SIDES
    rows = []
    for slope in _SLOPE:
        corner = (4.0 * area - 1.0) * slope
        side = 4.0 * (slope[i] * area[:, j] + area[:, i] * slope[j])
        half = 0.5 * slope * bubble
        parts = (corner * low - half, corner * high - half)
        parts += (side * low, slope * bubble, side * high)
        rows.append(np.concatenate(parts, axis=1))
    corner = 0.5 * area * (2.0 * area - 1.0)
    side = 2.0 * area[:, i] * area[:, j]
    parts = (area * z - corner, area * z + corner, -side, -2.0 * z * area, side)
    rows.append(np.concatenate(parts, axis=1))
    return np.stack(rows, axis=1)


def penta15_solid(
    nodes: Float64, elasticity: Float64, *, rule: Rule = _FINE
) -> SolidMatrices:
    """Fifteen nodes (e, 15, 3): reduced shear."""
    sampling = Sampling(
        fine=rule,
        coarse=_COARSE,
        basis=penta6,
        axes=penta_axes,
        center=CENTER,
        direct=(0, 1, 3),
        printed=(0, 1),
    )
    return reduced_shear_solid(nodes, elasticity, penta15_derivatives, sampling, OUTPUT)


def penta15_full(
    nodes: Float64, elasticity: Float64, *, rule: Rule = _FINE
) -> SolidMatrices:
    """Fifteen nodes: all strains at the same points."""
    return displacement_solid(nodes, elasticity, penta15_derivatives, rule, OUTPUT)


PENTA15 = Shape(
    card="CPENTA",
    nodes=15,
    corners=6,
    matrices=penta15_solid,
    values=penta15,
    derivatives=penta15_derivatives,
    mass_rule=_FINE,
    checked=np.concatenate([CENTER, _FINE.points]),
    integration={
        ("TWO", "REDUCED"): partial(penta15_solid, rule=product_penta(3, 2)),
        ("TWO", "FULL"): partial(penta15_full, rule=product_penta(3, 2)),
        ("THREE", "FULL"): penta15_full,
    },
)

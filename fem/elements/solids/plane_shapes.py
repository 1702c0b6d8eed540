"""Shape functions of triangles of 3 and 6 grids and quadrilaterals of 4 and 8.

Corners first. Natural coordinates of triangles are two of their area coordinates, of
quadrilaterals from -1 to 1.
"""

from collections.abc import Callable

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.ring import shapes as ring_shapes

Shapes = Callable[[Float64], tuple[Float64, Float64]]
CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
_AROUND = [0, 2, 4, 1, 3, 5]  # corners first, of grids that go round


def triangle(count: int) -> Shapes:
    """Triangle of 3 or 6 grids: shape functions (q, n), derivatives (q, 2, n)."""
    there = np.arange(6) % 2 == 0 if count == 3 else np.ones(6, bool)

    def shapes(points: Float64) -> tuple[Float64, Float64]:
        value, slope = ring_shapes(points, there)
        return value[:, _AROUND[:count]], slope[:, :, _AROUND[:count]]

    return shapes


def quad4(points: Float64) -> tuple[Float64, Float64]:
    """Shape functions (q, 4) and derivatives (q, 2, 4)."""
    x, y = points.T[:, :, None]
    a, b = CORNERS.T
    value = 0.25 * (1.0 + a * x) * (1.0 + b * y)
    slope = [0.25 * a * (1.0 + b * y), 0.25 * b * (1.0 + a * x)]
    return value, np.stack(slope, axis=1)


def quad8(points: Float64) -> tuple[Float64, Float64]:
    """Shape functions (q, 8) and derivatives (q, 2, 8), mid-sides after the corners."""
    x, y = points.T[:, :, None]
    linear, slope = quad4(points)
    middle = np.concatenate(
        [
            0.5 * (1.0 - x * x) * (1.0 - y),
            0.5 * (1.0 + x) * (1.0 - y * y),
            0.5 * (1.0 - x * x) * (1.0 + y),
            0.5 * (1.0 - x) * (1.0 - y * y),
        ],
        axis=1,
    )
    along = [
        np.concatenate(parts, axis=1)
        for parts in (
            (-x * (1 - y), 0.5 * (1 - y * y), -x * (1 + y), -0.5 * (1 - y * y)),
            (-0.5 * (1 - x * x), -y * (1 + x), 0.5 * (1 - x * x), -y * (1 - x)),
        )
    ]
    bent = np.stack(along, axis=1)
    half = 0.5 * (np.eye(4) + np.roll(np.eye(4), 1, axis=1))
    return (
        np.concatenate([linear - middle @ half, middle], axis=1),
        np.concatenate([slope - bent @ half, bent], axis=2),
    )

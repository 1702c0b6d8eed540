"""GRAV, ACCEL1, RFORCE: loads that act through the mass matrix.

The load is M times a field of accelerations in the displacement frames. M carries the
scale of PARAM WTMASS already.
"""

from collections.abc import Callable

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.geometry.points import Points


def _field(points: Points, basic: Float64) -> Float64:
    """Translational accelerations (g, 3) in basic axes as a vector of the g-set."""
    field = np.zeros(points.size)
    turned = np.einsum("gji,gj->gi", points.rotation, basic)
    n = len(points.grid_id)
    field[: 6 * n].reshape(n, 6)[:, :3] = turned
    return field


def _direction(points: Points, row: pd.Series) -> Float64:
    """A times N in system CID at its origin, basic axes."""
    vector = row[["n1", "n2", "n3"]].to_numpy(np.float64)
    return float(row["a"]) * (points.frames[row["cid"]].axes @ vector)


def _gravity(points: Points, row: pd.Series) -> Float64:
    uniform = np.broadcast_to(_direction(points, row), (len(points.grid_id), 3))
    return _field(points, uniform)


def _at_grids(points: Points, row: pd.Series) -> Float64:
    basic = np.zeros((len(points.grid_id), 3))
    basic[points.rows(row["grids"])] = _direction(points, row)
    return _field(points, basic)


def _rotation(points: Points, row: pd.Series) -> Float64:
    """Centrifugal field and, with RACC, the field of an angular acceleration.

    w = 2 pi A R and a = 2 pi RACC R about G: -w x (w x r) + a x r.
    """
    axis = points.frames[row["cid"]].axes @ row[["r1", "r2", "r3"]].to_numpy(float)
    grid = int(row["g"])
    centre = points.xyz[points.rows(grid)] if grid else np.zeros(3)
    r = points.xyz - centre
    spin = 2.0 * np.pi * float(row["a"]) * axis
    turning = 2.0 * np.pi * float(row["racc"]) * axis
    return _field(points, np.cross(turning, r) - np.cross(spin, np.cross(spin, r)))


ACCELERATIONS: dict[str, Callable[[Points, pd.Series], Float64]] = {
    "GRAV": _gravity,
    "ACCEL1": _at_grids,
    "RFORCE": _rotation,
}


def accelerations(points: Points, card: str, rows: pd.DataFrame) -> Float64:
    """Sum of the fields of all cards of one name, a vector of the g-set."""
    total = np.zeros(points.size)
    for _, row in rows.iterrows():
        total += ACCELERATIONS[card](points, row)
    return total

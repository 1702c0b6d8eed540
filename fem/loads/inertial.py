"""GRAV, ACCEL, ACCEL1, RFORCE: loads that act through the mass matrix.

The load is M times a field of accelerations in the displacement frames. M carries the
scale of PARAM WTMASS already. The centrifugal field is no motion of a rigid body: what
it does to masses off their grids and to their inertia comes on top (CONM2; the offsets
of bars and shells are left out).
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import where
from fem.elements.scalars.concentrated_mass import read_conm2
from fem.errors import InputError
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def _field(points: Points, basic: Float64, turning: Float64 | None = None) -> Float64:
    """Accelerations (g, 3) in basic axes, angular (3,), as a vector of the g-set."""
    field = np.zeros(points.size)
    n = len(points.grid_id)
    parts = field[: 6 * n].reshape(n, 6)
    parts[:, :3] = np.einsum("gji,gj->gi", points.rotation, basic)
    if turning is not None:
        parts[:, 3:] = np.einsum("gji,j->gi", points.rotation, turning)
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


def _varying(points: Points, row: pd.Series) -> Float64:
    """ACCEL: VAL times N, VAL by the place along an axis of a rectangular system.

    Linear between the places LOC, beyond them that of the nearest (from memory of the
    guide).

    Raises:
        InputError: the system is cylindrical or spherical.
    """
    frame = points.frames[row["cid"]]
    if frame.kind != "R":
        raise InputError(
            f"{where('ACCEL', row)}: system {row['cid']} is not rectangular, expected "
            "CORD1R or CORD2R"
        )
    axis = "XYZ".index(row["dir"])
    place = (points.xyz - frame.origin) @ frame.axes[:, axis]
    value = np.interp(place, row["locs"], row["vals"])
    vector = frame.axes @ row[["n1", "n2", "n3"]].to_numpy(np.float64)
    return _field(points, value[:, None] * vector)


def _rotation(points: Points, row: pd.Series) -> Float64:
    """Centrifugal field and, with RACC, the field of an angular acceleration.

    w = 2 pi A R and a = 2 pi RACC R about G: -w x (w x r) + a x r.
    """
    grid = int(row["g"])
    center = points.xyz[points.rows(grid)] if grid else np.zeros(3)
    r = points.xyz - center
    spin, turning = _about_axis(points, row, "a"), _about_axis(points, row, "racc")
    linear = np.cross(turning, r) - np.cross(spin, np.cross(spin, r))
    return _field(points, linear, turning)


def _about_axis(points: Points, row: pd.Series, name: str) -> Float64:
    """(3,) 2 pi times a field times R of RFORCE, basic axes."""
    axis = points.frames[row["cid"]].axes @ row[["r1", "r2", "r3"]].to_numpy(float)
    turns: Float64 = 2.0 * np.pi * float(row[name]) * axis
    return turns


def spinning_masses(deck: "Deck", points: Points, rows: pd.DataFrame) -> Float64:
    """Load of RFORCE's centrifugal field on CONM2 beyond M times the field at grids.

    -w x (w x m d) of a mass m at d from its grid, and the moment -w x (I w) of its
    inertia I about the grid; a vector of the g-set.
    """
    total = np.zeros(points.size)
    scale = deck.number("WTMASS")
    for block in read_conm2(deck, points):
        moment = block.matrix[:, 3:, :3]
        first = np.stack([moment[:, 2, 1], moment[:, 0, 2], moment[:, 1, 0]], axis=1)
        at = block.dof[:, 0] // 6
        for _, row in rows.iterrows():
            w = _about_axis(points, row, "a")
            force = -np.cross(w, np.cross(w, first))
            couple = -np.cross(w, block.matrix[:, 3:, 3:] @ w)
            both = np.stack([force, couple], axis=1)
            local = np.einsum("eji,ekj->eki", points.rotation[at], both)
            np.add.at(total, block.dof, scale * local.reshape(-1, 6))
    return total


ACCELERATIONS: dict[str, Callable[[Points, pd.Series], Float64]] = {
    "GRAV": _gravity,
    "ACCEL": _varying,
    "ACCEL1": _at_grids,
    "RFORCE": _rotation,
}


def accelerations(points: Points, card: str, rows: pd.DataFrame) -> Float64:
    """(g,) sum of the acceleration fields of all cards of one name."""
    total = np.zeros(points.size)
    for _, row in rows.iterrows():
        total += ACCELERATIONS[card](points, row)
    return total

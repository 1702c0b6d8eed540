"""Forces and moments at points: FORCE, FORCE1, FORCE2, MOMENT..., SLOAD, DAREA.

Each function returns rows of the g-set and values in the displacement frames, to be
added up; a set may hold several cards for one freedom.
"""

from collections.abc import Callable

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.errors import InputError
from fem.geometry.points import Points

Terms = tuple[Int64, Float64]


def vectors_at_grids(
    points: Points, at: Int64, vectors: Float64, first_component: int
) -> Terms:
    """Vectors (n, 3) in basic axes at grid rows (n,) as terms of the g-set.

    Args:
        points: grids.
        at: rows of grids.
        vectors: (n, 3), basic.
        first_component: 0 for forces, 3 for moments.
    """
    local = np.einsum("nji,nj->ni", points.rotation[at], vectors)
    dof = 6 * at[:, None] + first_component + np.arange(3)
    return dof.ravel(), local.ravel()


def _by_components(points: Points, rows: pd.DataFrame, size: str, first: int) -> Terms:
    """FORCE and MOMENT: size times the vector N in system CID at the grid."""
    at = points.rows(rows["g"].to_numpy(np.int64))
    vectors = rows[["n1", "n2", "n3"]].to_numpy(np.float64)
    vectors = vectors * rows[[size]].to_numpy(np.float64)
    cid = rows["cid"].to_numpy(np.int64)
    basic = points.frames.vectors_to_basic(cid, vectors, points.xyz[at])
    return vectors_at_grids(points, at, basic, first)


def _along_line(points: Points, rows: pd.DataFrame, size: str, first: int) -> Terms:
    """FORCE1 and MOMENT1: along the line from G1 to G2."""
    direction = _line(points, rows, "g1", "g2")
    return _directed(points, rows, direction, size, first)


def _along_normal(points: Points, rows: pd.DataFrame, size: str, first: int) -> Terms:
    """FORCE2 and MOMENT2: along (G2 - G1) x (G4 - G3)."""
    a, b = _line(points, rows, "g1", "g2"), _line(points, rows, "g3", "g4")
    return _directed(points, rows, np.cross(a, b), size, first)


def _line(points: Points, rows: pd.DataFrame, start: str, end: str) -> Float64:
    ends = [points.xyz[points.rows(rows[g].to_numpy(np.int64))] for g in (start, end)]
    return ends[1] - ends[0]


def _directed(
    points: Points, rows: pd.DataFrame, direction: Float64, size: str, first: int
) -> Terms:
    length = np.linalg.norm(direction, axis=1)
    if not (length > 0.0).all():
        card = {0: "force", 3: "moment"}[first]
        raise InputError(
            f"{row['file']}:{row['line']}: the grids of the {card} give no direction"
            for _, row in rows[~(length > 0.0)].iterrows()
        )
    at = points.rows(rows["g"].to_numpy(np.int64))
    vectors = direction * (rows[size].to_numpy(np.float64) / length)[:, None]
    return vectors_at_grids(points, at, vectors, first)


def _at_scalar_points(points: Points, rows: pd.DataFrame) -> Terms:
    """SLOAD; at a grid it acts along T1 of the displacement frame (MSC's guide)."""
    ids = rows["id"].to_numpy(np.int64)
    grids = ~np.isin(ids, points.spoint_id)
    return points.dof(ids, grids.astype(np.int64)), rows["f"].to_numpy(np.float64)


def _at_freedoms(points: Points, rows: pd.DataFrame) -> Terms:
    """DAREA; in statics it counts as the FORCE, MOMENT or SLOAD that it stands for."""
    ids, components = (rows[name].to_numpy(np.int64) for name in ("id", "c"))
    return points.dof(ids, components), rows["a"].to_numpy(np.float64)


CONCENTRATED: dict[str, Callable[[Points, pd.DataFrame], Terms]] = {
    "FORCE": lambda points, rows: _by_components(points, rows, "f", 0),
    "MOMENT": lambda points, rows: _by_components(points, rows, "m", 3),
    "FORCE1": lambda points, rows: _along_line(points, rows, "f", 0),
    "MOMENT1": lambda points, rows: _along_line(points, rows, "m", 3),
    "FORCE2": lambda points, rows: _along_normal(points, rows, "f", 0),
    "MOMENT2": lambda points, rows: _along_normal(points, rows, "m", 3),
    "SLOAD": _at_scalar_points,
    "DAREA": _at_freedoms,
}

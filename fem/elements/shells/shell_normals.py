"""Normals at the grids of shells (PARAM SNORM, SNORM cards).

MSC and NX Nastran take the mean of the normals of the corners that meet in a grid:
under the displacements of a foreign airframe moments balance so at grids whose corners
are within 20 degrees of the mean and whose elements are not, and at flat neighbours of
warped elements; a single warped element bends about its corners' normals.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.references import table, where
from fem.elements.shells.shell_geometry import corner_normals, unit
from fem.errors import InputError

if TYPE_CHECKING:
    from fem.deck.deck import Deck
    from fem.geometry.points import Points


# Cards of flat shells and their numbers of corners.
FLAT = {"CQUAD4": 4, "CTRIA3": 3, "CQUADR": 4, "CTRIAR": 3}


def grid_normals(
    xyz: Float64,
    connections: Sequence[Int64],
    limit_deg: float,
    given: tuple[Int64, Float64] | None = None,
) -> Float64:
    """(g, 3) mean normals of the corners at each grid; zero where there is none.

    A grid has a normal where that of each corner there is within `limit_deg` of their
    mean, which counts each corner once. Elements of opposite orientation count alike:
    the normal is that of the line, its sense that of one of them.

    Args:
        xyz: (g, 3) grids in the basic frame.
        connections: (e, n) rows of `xyz`, triangles and quadrilaterals.
        limit_deg: PARAM SNORM; 0: no grid has a normal.
        given: rows (n,) of `xyz` whose normals (n, 3) are said (SNORM), at any angle.
    """
    total = np.zeros_like(xyz)
    if limit_deg <= 0.0 or not connections:
        return total
    at = np.concatenate([c.ravel() for c in connections])
    each = np.concatenate([corner_normals(xyz[c]).reshape(-1, 3) for c in connections])
    first = np.zeros_like(xyz)
    first[at[::-1]] = each[::-1]
    sense = np.where(np.einsum("ij,ij->i", each, first[at]) < 0.0, -1.0, 1.0)
    np.add.at(total, at, sense[:, None] * each)
    mean = unit(total)
    apart = np.abs(np.einsum("ij,ij->i", each, mean[at]))
    folded = np.zeros(len(xyz), dtype=bool)
    folded[at[apart < np.cos(np.radians(limit_deg))]] = True
    normals = np.where(folded[:, None], 0.0, mean)
    if given is not None:
        rows = np.isin(given[0], at)
        normals[given[0][rows]] = unit(given[1][rows])
    return normals


def deck_normals(deck: "Deck", points: "Points") -> Float64:
    """`grid_normals` of all flat shells of a deck.

    SNORM cards count whatever the angle to the shells, and not at all where PARAM SNORM
    is 0 (from memory of the guide).

    Raises:
        InputError: normals of no length.
    """
    connections = []
    for card, corners in FLAT.items():
        rows = table(deck, card)
        if len(rows):
            grids = rows[[f"g{k}" for k in range(1, corners + 1)]].to_numpy(np.int64)
            connections.append(points.rows(grids))
    said = table(deck, "SNORM")
    rows = points.rows(said["g"])
    vectors = said[["n1", "n2", "n3"]].to_numpy(float)
    if len(zero := said[~vectors.any(axis=1)]):
        places = [where("SNORM", row) for _, row in zero.iterrows()]
        raise InputError([f"{place}: the normal has no length" for place in places])
    turned = points.frames.vectors_to_basic(
        said["cid"].to_numpy(np.int64), vectors, points.xyz[rows]
    )
    limit = deck.number("SNORM")
    return grid_normals(points.xyz, connections, limit, (rows, turned))

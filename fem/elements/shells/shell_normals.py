"""Normals at the grids of shells (PARAM SNORM)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.references import table
from fem.elements.shells.shell_geometry import element_normals, unit

if TYPE_CHECKING:
    from fem.deck.deck import Deck
    from fem.geometry.points import Points


# Cards of flat shells and their numbers of corners.
FLAT = {"CQUAD4": 4, "CTRIA3": 3, "CQUADR": 4, "CTRIAR": 3}


def grid_normals(
    xyz: Float64, connections: Sequence[Int64], limit_deg: float
) -> Float64:
    """(g, 3) mean normals of the shells at each grid; zero where there is none.

    A grid has a normal where that of each adjacent element is within `limit_deg` of
    their mean. Elements of opposite orientation count alike: the normal is that of the
    line, its sense that of one of them.

    Args:
        xyz: (g, 3) grids in the basic frame.
        connections: (e, n) rows of `xyz`, triangles and quadrilaterals.
        limit_deg: PARAM SNORM; 0: no grid has a normal.
    """
    total = np.zeros_like(xyz)
    if limit_deg <= 0.0 or not connections:
        return total
    at = np.concatenate([c.ravel() for c in connections])
    each = np.concatenate(
        [np.repeat(element_normals(xyz[c]), c.shape[1], axis=0) for c in connections]
    )
    first = np.zeros_like(xyz)
    first[at[::-1]] = each[::-1]
    sense = np.where(np.einsum("ij,ij->i", each, first[at]) < 0.0, -1.0, 1.0)
    np.add.at(total, at, sense[:, None] * each)
    mean = unit(total)
    apart = np.abs(np.einsum("ij,ij->i", each, mean[at]))
    folded = np.zeros(len(xyz), dtype=bool)
    folded[at[apart < np.cos(np.radians(limit_deg))]] = True
    return np.where(folded[:, None], 0.0, mean)


def deck_normals(deck: "Deck", points: "Points") -> Float64:
    """`grid_normals` of all flat shells of a deck."""
    connections = []
    for card, corners in FLAT.items():
        rows = table(deck, card)
        if len(rows):
            grids = rows[[f"g{k}" for k in range(1, corners + 1)]].to_numpy(np.int64)
            connections.append(points.rows(grids))
    return grid_normals(points.xyz, connections, deck.number("SNORM"))

"""The airframe for pictures: element edges and faces between grids, mode shapes."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.deck.grids import corners_of
from fem.deck.records import topologies

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class Skeleton:
    """Lines and faces that deform.

    Attributes:
        p: (g, 3) positions of the grids, m, axes A.
        shape: (g, 3, n) modal displacement of the grids per unit amplitude, A.
        edges: (e, 2) rows of the two grids of each line.
        faces: (t, 3) rows of the grids of each triangle; none by default.
    """

    p: Float64
    shape: Float64
    edges: Int64
    faces: Int64 = field(default_factory=lambda: np.zeros((0, 3), np.int64))

    def thinned(self, count: int) -> "tuple[Int64, Skeleton]":
        """A coarser net with at most that many lines.

        Grids within one cell of space, as small as the count allows, become one.

        Returns:
            Rows of the grids that stay, and the smaller skeleton.
        """
        of_cell, cells, edges = (
            np.arange(len(self.p)),
            np.arange(len(self.p)),
            self.edges,
        )
        cell = float(np.ptp(self.p, axis=0).max()) / 400
        while len(edges) > count:
            of_cell, cells = _merged(self.p, cell)
            edges = _distinct(cells[self.edges])
            cell *= 1.2
        used, edges = np.unique(edges, return_inverse=True)
        # Faces lie between lines: their corners are corners of lines.
        faces = _distinct(cells[self.faces])
        faces = faces[np.isin(faces, used).all(axis=1)]
        rows = of_cell[used]
        thinned = Skeleton(
            p=self.p[rows],
            shape=self.shape[rows],
            edges=edges.reshape(-1, 2),
            faces=np.searchsorted(used, faces),
        )
        return rows, thinned

    def deformed(self, amplitudes: Float64, factor: float) -> Float64:
        """(g, 3) positions at modal amplitudes (n,), displacements times a factor."""
        return self.p + factor * (self.shape @ amplitudes)


def _merged(p: Float64, cell: float) -> tuple[Int64, Int64]:
    """One grid for each cell, the one nearest to the mean of its cell.

    Returns:
        (c,) rows of these grids, (g,) cell of each grid.
    """
    place = np.floor((p - p.min(axis=0)) / cell).astype(np.int64)
    _, of_grid = np.unique(place, axis=0, return_inverse=True)
    of_grid = of_grid.ravel()
    members = np.bincount(of_grid)
    mean = np.column_stack([np.bincount(of_grid, weights=x) for x in p.T])
    away = np.linalg.norm(p - (mean / members[:, None])[of_grid], axis=1)
    order = np.lexsort((away, of_grid))
    first = np.searchsorted(of_grid[order], np.arange(len(members)))
    return order[first], of_grid


def _distinct(corners: Int64) -> Int64:
    """Lines (e, 2) or triangles (t, 3) whose corners differ, each once."""
    corners = np.unique(np.sort(corners, axis=1), axis=0)
    return corners[(np.diff(corners, axis=1) > 0).all(axis=1)]


def element_edges(cards: Mapping[str, pd.DataFrame], grid_id: Int64) -> Int64:
    """Edges of lines, shells and rigid elements, each once.

    Args:
        cards: tables of a deck.
        grid_id: (g,) ascending.

    Returns:
        (e, 2) rows of `grid_id`.
    """
    pairs = [np.zeros((0, 2), np.int64)]
    shapes = topologies("line", "surface")
    for card, (_, corners) in corners_of(cards, "line", "surface").items():
        pairs += [corners[:, edge] for edge in shapes[card].edges]
    for rigid in cards["RBE2"].itertuples():
        pairs.append(np.array([[rigid.gn, g] for g in rigid.gms], dtype=np.int64))
    for rigid in cards["RBE3"].itertuples():
        pairs.append(
            np.array([[rigid.refgrid, g] for g in set(rigid.grids)], dtype=np.int64)
        )
    edges = np.concatenate([p.reshape(-1, 2) for p in pairs])
    edges = edges[np.isin(edges, grid_id).all(axis=1)]
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    return np.searchsorted(grid_id, edges[edges[:, 0] != edges[:, 1]])


def element_faces(cards: Mapping[str, pd.DataFrame], grid_id: Int64) -> Int64:
    """Triangles of shells, quadrilaterals halved.

    Args:
        cards: tables of a deck.
        grid_id: (g,) ascending.

    Returns:
        (t, 3) rows of `grid_id`.
    """
    found = [np.zeros((0, 3), np.int64)]
    for _, corners in corners_of(cards, "surface").values():
        found.append(corners[:, :3])
        if corners.shape[1] == 4:
            found.append(corners[:, [0, 2, 3]])
    faces = np.concatenate([f.reshape(-1, 3) for f in found])
    return np.searchsorted(grid_id, faces[np.isin(faces, grid_id).all(axis=1)])

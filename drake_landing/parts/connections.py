"""What holds the grids of a model together: elements, rigid elements, couplings.

A link joins the grids of one element. Cut by a plane, a link that has grids on both
sides is removed; links wholly beyond the plane hold the grids there together, and these
fall into pieces.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from fem.constraints.elimination import constraint_equations
from fem.model.direct_input import read_direct
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Bool = npt.NDArray[np.bool_]

# Elements that carry nothing from one grid to another.
_MASSES = ("CONM", "CMASS")


@dataclass(frozen=True, kw_only=True)
class Connections:
    """Links between the grids of a model.

    Attributes:
        p: (g, 3) positions of the grids, B, m.
        link: (k,) link of each entry, ascending.
        grid: (k,) row of a grid that the link joins.
        rigid: (links,) rigid elements, constraints and direct input: no stretch of an
            element says where they bear.
    """

    p: Float64
    link: Int64
    grid: Int64
    rigid: Bool

    def reach(self, s: Float64) -> tuple[Float64, Float64]:
        """(links,), (links,) least and largest coordinate of the grids of each link.

        Args:
            s: (g,) coordinates of the grids.
        """
        start = np.flatnonzero(np.diff(self.link, prepend=-1))
        of = s[self.grid]
        if not len(start):
            return np.zeros(0), np.zeros(0)
        return np.minimum.reduceat(of, start), np.maximum.reduceat(of, start)

    def pieces(self, beyond: Bool) -> Int64:
        """(g,) number of the piece that each grid beyond a cut belongs to, -1: inside.

        Args:
            beyond: (g,) which grids lie beyond.
        """
        entry = beyond[self.grid]
        count = len(self.rigid)
        whole = np.bincount(self.link[entry], minlength=count) == np.bincount(
            self.link, minlength=count
        )
        keep = whole[self.link]
        link, grid = self.link[keep], self.grid[keep]
        first = np.flatnonzero(np.diff(link, prepend=-1))
        head = np.repeat(grid[first], np.diff(np.append(first, len(link))))
        g = len(beyond)
        graph = sp.coo_matrix((np.ones(len(grid), bool), (head, grid)), shape=(g, g))
        _, label = connected_components(graph, directed=False)
        _, number = np.unique(label[beyond], return_inverse=True)
        found = np.full(g, -1)
        found[beyond] = number
        return found

    def crossing(self, beyond: Bool) -> tuple[Int64, Int64, Int64]:
        """Links with grids on both sides: link, one grid beyond, one inside, each (c,).

        Every grid beyond is paired with one inside.
        """
        entry = beyond[self.grid]
        count = len(self.rigid)
        inside = np.full(count, -1)
        inside[self.link[~entry]] = self.grid[~entry]
        mixed = entry & (inside[self.link] >= 0)
        link = self.link[mixed]
        return link, self.grid[mixed], inside[link]


def connections(structure: Structure) -> Connections:
    """Links of a structure: its elements, rigid elements, MPC and direct stiffness."""
    points = structure.points
    grids = len(points.grid_id)
    found: list[tuple[Int64, Int64]] = []
    rigid: list[bool] = []
    for block in structure.blocks:
        if not block.card.startswith(_MASSES):
            element = np.broadcast_to(
                np.arange(len(block.id))[:, None], block.dof.shape
            )
            found.append((element.ravel(), block.dof.ravel()))
            rigid.append(False)
    equations = constraint_equations(structure.deck, points, structure.subcase.mpc)
    for part in equations:
        # All equations of one card are one link.
        _, number = np.unique(part.source, return_inverse=True)
        link = np.concatenate([number, number[part.row]])
        found.append((link, np.concatenate([part.dependent, part.column])))
        rigid.append(True)
    direct = read_direct(structure.deck, points, k2gg=structure.subcase.k2gg).stiffness
    if direct is not None:
        pairs = sp.triu(direct, 1).tocoo()
        link = np.tile(np.arange(pairs.nnz), 2)
        found.append((link, np.concatenate([pairs.row, pairs.col])))
        rigid.append(True)
    return _joined(points.xyz, grids, found, rigid)


def _joined(
    p: Float64, grids: int, found: list[tuple[Int64, Int64]], rigid: list[bool]
) -> Connections:
    """Links of more than one grid, numbered anew."""
    links, rows, kinds, first = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)], [], 0
    for (link, dof), stiff in zip(found, rigid):
        on_grid = (dof >= 0) & (dof < 6 * grids)
        pairs = np.unique(
            np.stack([link[on_grid], dof[on_grid] // 6], axis=1), axis=0
        ).reshape(-1, 2)
        _, number, count = np.unique(
            pairs[:, 0], return_inverse=True, return_counts=True
        )
        several = count[number] > 1
        _, number = np.unique(pairs[several, 0], return_inverse=True)
        links.append(number + first)
        rows.append(pairs[several, 1])
        size = int(number.max(initial=-1)) + 1
        kinds.append(np.full(size, stiff))
        first += size
    return Connections(
        p=p,
        link=np.concatenate(links).astype(np.int64),
        grid=np.concatenate(rows).astype(np.int64),
        rigid=np.concatenate([np.zeros(0, bool), *kinds]),
    )

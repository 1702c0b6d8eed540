"""Pieces of a model that nothing connects: no element, no rigid element, no MPC.

Often a mesh that was not merged. In statics each needs supports of its own; in dynamics
each adds six rigid-body modes.
"""

from collections.abc import Iterable, Sequence

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from fem.arrays import Int64
from fem.elements.block import ElementBlock
from fem.geometry.points import Points


def unconnected_pieces(
    points: Points,
    blocks: Iterable[ElementBlock],
    dependence: sp.csr_matrix,
    m: Int64,
    couplings: Iterable[sp.csr_matrix | None] = (),
) -> list[Int64]:
    """Grids and scalar points that hang together, the largest piece first.

    Args:
        points: the points.
        blocks: the elements.
        dependence, m: of the elimination: (m, g) and (m,).
        couplings: (g, g) matrices of direct input; the amplitudes of a Craig-Bampton
            reduction hang on the others by their mass alone.

    Returns:
        Ids of the points of each piece that holds an element, ascending.
    """
    grids = len(points.grid_id)
    count = grids + len(points.spoint_id)
    used = np.zeros(count, bool)
    ends: list[tuple[Int64, Int64]] = []
    for block in blocks:
        at = _point(block.dof, grids)
        used[at[block.dof >= 0]] = True
        # An absent grid is ground, which connects nothing.
        first = np.where(block.dof[:, :1] >= 0, at[:, :1], at[:, -1:])
        other = np.where(block.dof >= 0, at, first)
        a, b = np.broadcast_to(first, at.shape).ravel(), other.ravel()
        keep = (a != b) & np.broadcast_to(first >= 0, at.shape).ravel()
        ends.append((a[keep], b[keep]))
    coupled = dependence.tocoo()
    pairs = [(m[coupled.row], coupled.col)]
    for entries in (matrix.tocoo() for matrix in couplings if matrix is not None):
        pairs.append((entries.row, entries.col))
    for row, column in pairs:
        a, b = (_point(dof.astype(np.int64), grids) for dof in (row, column))
        ends.append((a, b))
        used[a] = used[b] = True
    row, column = (np.concatenate(part) for part in zip(*ends))
    graph = sp.coo_matrix((np.ones(len(row)), (row, column)), shape=(count, count))
    _, label = connected_components(graph.tocsr(), directed=False)
    ids = np.concatenate([points.grid_id, points.spoint_id])
    pieces = [ids[(label == k) & used] for k in np.unique(label[used])]
    return sorted(pieces, key=len, reverse=True)


def describe_pieces(pieces: Sequence[Int64], *, most: int = 6) -> list[str]:
    """A line where there is more than one piece, naming the smaller ones."""
    if len(pieces) < 2:
        return []
    named = [_name(piece) for piece in pieces[1:]]
    more = f"; ... ({len(named)} in all)" if len(named) > most else ""
    return [
        f"the model falls into {len(pieces)} pieces that nothing connects; apart from "
        f"the largest ({len(pieces[0])} points): " + "; ".join(named[:most]) + more
    ]


def _name(piece: Int64) -> str:
    if len(piece) <= 4:
        return (
            "points " + " ".join(map(str, piece))
            if len(piece) > 1
            else (f"point {piece[0]}")
        )
    return f"{len(piece)} points from {piece[0]} to {piece[-1]}"


def _point(dof: npt.NDArray[np.int64], grids: int) -> Int64:
    """Position of the point of rows of the g-set, -1 for ground."""
    at = np.where(dof < 6 * grids, dof // 6, dof - 5 * grids)
    return np.where(dof >= 0, at, -1)

"""Differential stiffness of the g-set: what the internal forces of a state add to K."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from fem.arrays import Float64, Int64
from fem.elements.dense import DenseBlock
from fem.geometry.points import Points
from fem.loads.element_loads import ElementLoads
from fem.loads.thermal import FreeMotions
from fem.model.assembly import assemble_one, triples_rotation

# Elements that do half of the work: below, a mesh of shells shows no half wave.
COARSE = 8

if TYPE_CHECKING:
    from fem.elements.block import ElementBlock


def differential_stiffness(
    points: Points,
    blocks: Sequence["ElementBlock"],
    u_g: Float64,
    *,
    free: FreeMotions | None = None,
    loads: ElementLoads | None = None,
) -> sp.csr_matrix:
    """(g, g) of the forces that displacements give.

    Args:
        points: numbering and displacement frames.
        blocks: the elements.
        u_g: (g,) displacements, displacement frames.
        free: what elements do that nothing hinders, and that strains none.
        loads: loads on elements between their grids.
    """
    moved = points.basic_rotation() @ u_g
    return assemble_one(points, _matrices(points, blocks, moved, free, loads))


def differential_work(
    points: Points,
    blocks: Sequence["ElementBlock"],
    u_g: Float64,
    shapes: Float64,
) -> tuple[Int64, Float64]:
    """Work of the internal forces of a state on shapes, element by element.

    Args:
        points, blocks, u_g: as for `differential_stiffness`.
        shapes: (g, m) displacements, displacement frames.

    Returns:
        Element ids (e,) and work (m, e), -x' K_d x: positive where it buckles.
    """
    rotation = points.basic_rotation()
    moved, turned = rotation @ u_g, rotation @ shapes
    ids, works = [np.zeros(0, np.int64)], [np.zeros((shapes.shape[1], 0))]
    for block, matrix in _matrices(points, blocks, moved, None, None):
        own = np.where((block.dof >= 0)[..., None], turned[block.dof], 0.0)
        works.append(-np.einsum("eim,eij,ejm->me", own, matrix, own, optimize=True))
        ids.append(block.id)
    return np.concatenate(ids), np.concatenate(works, axis=1)


def half_of_the_work(work: Float64) -> Int64:
    """(m,) how many elements do half of the positive work (m, e) of each shape."""
    ranked = np.cumsum(-np.sort(-np.maximum(work, 0.0), axis=1), axis=1)
    if not ranked.shape[1]:
        return np.zeros(len(work), np.int64)
    return 1 + np.sum(ranked < 0.5 * ranked[:, -1:], axis=1)


def _matrices(
    points: Points,
    blocks: Sequence["ElementBlock"],
    moved: Float64,
    free: FreeMotions | None,
    loads: ElementLoads | None,
) -> Iterator[tuple["ElementBlock", Float64]]:
    for block in blocks:
        if not isinstance(block, DenseBlock) or block.frame != "basic":
            continue
        motion = np.where(block.dof >= 0, moved[block.dof], 0.0)
        unhindered = None if free is None else free.of(block)
        if unhindered is not None:
            motion -= unhindered
        load = None if loads is None else _loads_on(points, block, loads)
        matrix = block.differential_stiffness(motion, load)
        if matrix is not None:
            yield block, matrix


def _loads_on(points: Points, block: DenseBlock, loads: ElementLoads) -> Float64 | None:
    """(e, n) loads between the grids of a block, basic axes; None: none of them."""
    at = np.flatnonzero(np.isin(loads.id, block.id))
    row = np.searchsorted(block.id, loads.id[at])
    same = np.array(
        [np.array_equal(block.grid_dof[r], loads.dof[k]) for r, k in zip(row, at)], bool
    )
    if not same.any():
        return None
    at, row = at[same], row[same]
    value = loads.value[at].sum(axis=2)
    turn = triples_rotation(points, loads.dof[at])
    if turn is not None:
        triples = value.reshape(len(at), -1, 3)
        value = np.einsum("egij,egj->egi", turn, triples).reshape(value.shape)
    found = np.zeros(block.dof.shape)
    np.add.at(found[:, : value.shape[1]], row, value)
    return found


def unstiffened(blocks: Sequence["ElementBlock"]) -> list[str]:
    """Cards of elements with stiffness to which internal forces add none here."""
    none = DenseBlock.differential_stiffness
    return sorted(
        {
            block.card
            for block in blocks
            if getattr(type(block), "differential_stiffness", none) is none
            and block.stiffness() is not None
        }
    )

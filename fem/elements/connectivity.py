"""Grids of the elements of a block, in the order of their cards."""

import numpy as np

from fem.arrays import Int64
from fem.elements.block import ElementBlock
from fem.geometry.points import Points


def element_grids(points: Points, block: ElementBlock) -> Int64 | None:
    """(e, n) positions of the grids of each element, None for scalar elements.

    Freedoms come in triples of one grid: translations, or translations and rotations.
    """
    dof = block.grid_dof
    if block.frame != "basic" or dof.shape[1] % 3 or np.any(dof < 0):
        return None
    grids = dof[:, ::3] // 6
    if np.any(grids >= len(points.grid_id)):
        return None
    paired = grids.shape[1] % 2 == 0 and np.array_equal(grids[:, ::2], grids[:, 1::2])
    return grids[:, ::2] if paired else grids

"""Reference nodes tied to structure by RBE3 so that they stay free.

The node moves with the mean of its grids. By UM six freedoms of those grids are the
dependent ones instead of the node's, so that a reduction can keep the node.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from drake_landing.reference.d150.geometry import Float64
from drake_landing.reference.d150.model import ModelBuilder


def tie(model: ModelBuilder, part: str, node: int, grids: Sequence[int]) -> None:
    """Writes the RBE3 of a reference node that a reduction may keep.

    Args:
        model: the bench.
        part: section of the tie.
        node: the reference node.
        grids: at least three, not on one line.
    """
    p = np.array([model.position[i] for i in grids])
    free = np.array([[(i, c) not in model.dependent for c in (1, 2, 3)] for i in grids])
    chosen = dependent_freedoms(p, model.position[node], free)
    um: dict[int, str] = {}
    for row, component in chosen:
        um[grids[row]] = um.get(grids[row], "") + str(component)
        model.dependent.add((grids[row], component))
    model.average(part, node, grids, {i: "".join(sorted(c)) for i, c in um.items()})


def dependent_freedoms(
    p: Float64, center: Float64, free: npt.NDArray[np.bool_]
) -> list[tuple[int, int]]:
    """Six translations of points that determine a rigid motion best.

    Args:
        p: (n, 3) points.
        center: (3,) where the motion is taken.
        free: (n, 3) those that may be taken.

    Returns:
        Pairs (index of the point, component 1-3), by greedy pivoting.

    Raises:
        ValueError: the points lie on one line, or too few freedoms are free.
    """
    arm = p - center
    scale = np.linalg.norm(arm - arm.mean(axis=0), axis=1).mean()
    motion = np.zeros((len(p), 3, 6))
    motion[:, range(3), range(3)] = 1.0
    for axis in range(3):
        motion[:, :, 3 + axis] = np.cross(np.eye(3)[axis], arm) / scale
    rows = motion.reshape(-1, 6)
    # Coefficients of the element: mean motion per unit translation of a grid.
    left = np.linalg.lstsq(rows.T @ rows, rows.T, rcond=None)[0].T
    left = np.where(free.reshape(-1, 1), left, 0.0)
    largest = np.linalg.norm(left, axis=1).max()
    chosen: list[tuple[int, int]] = []
    while len(chosen) < 6:
        norms = np.linalg.norm(left, axis=1)
        best = int(np.argmax(norms.round(12)))
        if norms[best] < 1e-6 * largest:
            raise ValueError("the grids lie on one line: they cannot carry a node")
        chosen.append((best // 3, best % 3 + 1))
        direction = left[best] / norms[best]
        left = left - np.outer(left @ direction, direction)
    return chosen

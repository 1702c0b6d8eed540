"""Surface elements without a usable shape: empty, concave, corners out of order."""

import numpy as np

from fem.arrays import Float64, Int64
from fem.elements.shells.shell_geometry import facet


def bad_facets(corners: Float64) -> tuple[Int64, list[str]]:
    """Surface elements without a usable shape.

    Args:
        corners: (e, 3 or 4, 3).

    Returns:
        Their positions, and what is wrong with each.
    """
    edges = np.roll(corners, -1, axis=1) - corners
    longest = np.linalg.norm(edges, axis=2).max(axis=1)
    shape = facet(corners)
    flat = shape.edges
    before = np.roll(flat, 1, axis=1)
    turn = before[..., 0] * flat[..., 1] - before[..., 1] * flat[..., 0]
    empty = ~(shape.area > 1e-12 * longest**2)
    concave = (turn <= 1e-9 * longest[:, None] ** 2).any(axis=1) & ~empty
    bad = np.flatnonzero(empty | concave)
    texts = [
        "its corners enclose no area or are out of order"
        if empty[i]
        else "it is concave or its corners are out of order, a corner has an angle of "
        "180 deg or more"
        for i in bad
    ]
    return bad, texts

"""Solids that lack some of their mid-sides: the edge there stays straight.

The mid-side that is not there moves with the mean of its corners. The free corner of a
CHEXA with mid-sides on four edges moves as MSC and NX print it, at rest and in time
(pyNastran models, api3 and tr1091x), to single precision.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.solid import Shape
from fem.elements.solids.solid_stiffness import SolidMatrices


def without(
    shape: Shape, edges: Sequence[tuple[int, int]], present: Sequence[bool]
) -> Shape:
    """A shape with some of its mid-sides.

    Args:
        shape: with all of them.
        edges: corners of each edge, in the order of the mid-sides.
        present: for each edge, whether its mid-side is there.
    """
    follow = _follow(shape, edges, present)
    freedoms = np.kron(follow, np.eye(3))

    def matrices(nodes: Float64, elasticity: Float64) -> SolidMatrices:
        whole = shape.matrices(follow @ nodes, elasticity)
        return SolidMatrices(
            stiffness=freedoms.T @ whole.stiffness @ freedoms,
            stress=whole.stress @ freedoms,
        )

    return replace(
        shape,
        nodes=follow.shape[1],
        matrices=matrices,
        values=lambda p: shape.values(p) @ follow,
        derivatives=lambda p: shape.derivatives(p) @ follow,
        integration={},
    )


def _follow(
    shape: Shape, edges: Sequence[tuple[int, int]], present: Sequence[bool]
) -> Float64:
    """(all nodes, those there) weights with which all nodes follow those there."""
    whole = np.eye(shape.nodes)
    kept = [*range(shape.corners)]
    for k, ends in enumerate(edges):
        if present[k]:
            kept.append(shape.corners + k)
        else:
            whole[shape.corners + k, list(ends)] = 0.5
    return whole[:, kept]

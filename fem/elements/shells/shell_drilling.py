"""Drilling stiffness of shells (PARAM K6ROT): the rotation about the normal.

The freedom rz of each corner is tied to the rotation of the membrane there by a small
penalty, k (rz - (v,x - u,y)/2)^2 / 2 with k = 1e-6 K6ROT G t J, J the area of the
parallelogram of the two edges that meet in the corner. Rigid motions cost nothing. The
grid point forces of MSC and NX Nastran agree with it (unit squares and half squares).
"""

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet


def drilling(shape: Facet, shear_stiffness: Float64, k6rot: float) -> Float64:
    """(e, 6 n, 6 n) stiffness in flat local freedoms.

    Args:
        shape: geometry.
        shear_stiffness: (e,) membrane shear stiffness per width, G t.
        k6rot: PARAM K6ROT, dimensionless.
    """
    n = shape.corners
    after = shape.edges
    before = np.roll(after, 1, axis=1)
    jacobian = before[..., 0] * after[..., 1] - before[..., 1] * after[..., 0]
    operator = np.zeros((len(after), n, n, 6))
    for i in range(n):
        back, ahead = (i - 1) % n, (i + 1) % n
        operator[:, i, i, 5] = 1.0
        # Gradient at corner i from its neighbours: rows of the inverse of the edges.
        edges = np.stack([after[:, i], -before[:, i]], axis=1)
        gradient = np.linalg.inv(edges)
        for k, corner in enumerate((ahead, back)):
            for node, sign in ((corner, 1.0), (i, -1.0)):
                operator[:, i, node, 1] -= 0.5 * sign * gradient[:, 0, k]
                operator[:, i, node, 0] += 0.5 * sign * gradient[:, 1, k]
    operator = operator.reshape(len(after), n, 6 * n)
    stiffness = 1e-6 * k6rot * shear_stiffness[:, None] * jacobian
    return operator.transpose(0, 2, 1) @ (stiffness[..., None] * operator)

"""Motion of points that a rigid body carries."""

import numpy as np

from fem.arrays import Float64


def rigid_motion(lever: Float64, R_BD: Float64 | None = None) -> Float64:
    """(n, 6, 6) motion of points in their displacement frames by a rigid body.

    Args:
        lever: (n, 3) points from the body's reference, basic axes.
        R_BD: (n, 3, 3) displacement axes of the points; None: basic axes.

    Returns:
        Matrices from [translation; rotation] of the reference in basic axes.
    """
    x, y, z = lever.T
    zero = np.zeros_like(x)
    # u = u_0 + θ × r
    turn = np.stack([zero, z, -y, -z, zero, x, y, -x, zero], axis=1).reshape(-1, 3, 3)
    to_d = np.eye(3) if R_BD is None else R_BD.transpose(0, 2, 1)
    matrix = np.zeros((len(lever), 6, 6))
    matrix[:, :3, :3] = matrix[:, 3:, 3:] = to_d
    matrix[:, :3, 3:] = turn if R_BD is None else to_d @ turn
    return matrix

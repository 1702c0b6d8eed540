"""Drilling stiffness of shells (PARAM K6ROT): the rotation about the normal.

The rotation of each corner about its normal d (that of the grid where it has one, else
of the element) is tied to that of the surface there by a small penalty,

    k (theta - omega)^2 / 2,   k = 1e-6 K6ROT G t J,

omega the rotation (w,y, -w,x, (v,x - u,y) / 2) of the surface along d, J the area of
the parallelogram of the two edges that meet in the corner. Rigid motions cost nothing.
The grid point forces of MSC and NX Nastran agree with it (unit squares and half
squares; at kinks of the skin of a wing box).
"""

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet, corner_gradients, corner_spin


def drilling(shape: Facet, shear_stiffness: Float64, k6rot: float) -> Float64:
    """(e, 6 n, 6 n) stiffness in flat local freedoms, see `shell_geometry.to_grids`.

    There rx stands for rx - s_x (rz - spin), with the slope s of d, and ry likewise:
    along d it is s_x rx + s_y ry + (1 + s^2)(rz - spin), over the length of (s, 1).

    Args:
        shape: geometry.
        shear_stiffness: (e,) membrane shear stiffness per width, G t.
        k6rot: PARAM K6ROT, dimensionless.
    """
    n = shape.corners
    after = shape.edges
    before = np.roll(after, 1, axis=1)
    jacobian = before[..., 0] * after[..., 1] - before[..., 1] * after[..., 0]
    gradients = corner_gradients(shape)
    length = np.sqrt(1.0 + np.sum(shape.slope**2, axis=2))[..., None]
    tilt = shape.slope / length
    corner = np.arange(n)
    operator = np.zeros((len(after), n, n, 6))
    operator[..., 0:2] = -length[..., None] * corner_spin(gradients)
    operator[..., 2] = (
        tilt[..., 1:] * gradients[:, :, 0] - tilt[..., :1] * gradients[:, :, 1]
    )
    operator[:, corner, corner, 3:5] = tilt
    operator[:, corner, corner, 5] = length[..., 0]
    operator = operator.reshape(len(after), n, 6 * n)
    stiffness = 1e-6 * k6rot * shear_stiffness[:, None] * jacobian
    return operator.transpose(0, 2, 1) @ (stiffness[..., None] * operator)

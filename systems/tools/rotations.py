"""Rotations as arrays: quaternions, rotation vectors and their derivatives.

The formulas are in `vectors`; here they take and give arrays, for those who call them
now and then.
"""

import numpy as np
import numpy.typing as npt

from systems.tools import vectors

Float64 = npt.NDArray[np.float64]


def skew(v: Float64) -> Float64:
    """(..., 3, 3) matrix of the cross product: skew(a) @ b = a × b."""
    return (v @ _SKEW).reshape(*v.shape, 3)


_SKEW = np.zeros((3, 3, 3))
_SKEW[0, 2, 1] = _SKEW[1, 0, 2] = _SKEW[2, 1, 0] = 1.0
_SKEW = (_SKEW - _SKEW.swapaxes(1, 2)).reshape(3, 9)


def rotation_from_quaternion(q: npt.ArrayLike) -> Float64:
    """(3, 3) rotation matrix of the quaternion (w, x, y, z), of any length but zero."""
    return vectors.rotation_matrix(*np.asarray(q, dtype=float).tolist())


def quaternion_from_rotation(R: Float64) -> Float64:
    """(4,) unit quaternion (w, x, y, z) with w ≥ 0 of a rotation matrix (3, 3)."""
    K = np.empty((4, 4))
    K[0, 0] = np.trace(R)
    K[1:, 1:] = R + R.T - np.trace(R) * np.eye(3)
    K[0, 1:] = K[1:, 0] = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]
    q = np.linalg.eigh(K)[1][:, -1]  # Bar-Itzhack: exact also at half a turn
    return q if q[0] >= 0 else -q


def exp(theta: Float64) -> Float64:
    """(k, 3, 3) rotation matrices of rotation vectors (k, 3), rad."""
    return rotation_kinematics(theta, np.zeros_like(theta))[0]


def rotation_kinematics(
    theta: Float64, theta_dot: Float64
) -> tuple[Float64, Float64, Float64]:
    """Rotations of rotation vectors that change with time.

    Args:
        theta: (k, 3) rotation vectors, rad.
        theta_dot: (k, 3) their rates, rad/s.

    Returns:
        exp([θ]) (k, 3, 3); the left Jacobians J_l(θ) (k, 3, 3); and the products
        (dJ_l/dt) θ' (k, 3), the part of the angular acceleration that comes without θ".
    """
    k = len(theta)
    R, J, bias = np.empty((k, 3, 3)), np.empty((k, 3, 3)), np.empty((k, 3))
    for i in range(k):
        vector, rate = theta[i].tolist(), theta_dot[i].tolist()
        R[i], J[i], _, bias[i] = vectors.rotation_kinematics(tuple(vector), tuple(rate))
    return R, J, bias


def log(R: Float64) -> Float64:
    """(k, 3) rotation vectors, rad, of rotation matrices (k, 3, 3); inverse of `exp`.

    Exact for all angles up to half a turn, where the sign of the axis is arbitrary.
    """
    return np.array([vectors.rotation_vector(R_i) for R_i in R])

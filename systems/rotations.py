"""Rotations in three dimensions: quaternions, rotation vectors and their derivatives.

Small pure functions. A rotation vector θ stands for the rotation exp([θ]); its left
Jacobian J_l(θ) gives the angular velocity J_l(θ) θ' of that rotation in the axes in
which θ is written (Barfoot, State Estimation for Robotics, 7.1). Functions of rotation
vectors are vectorised over leading axes.
"""

import math

import numpy as np
import numpy.typing as npt

Float64 = npt.NDArray[np.float64]

# Below this squared angle the closed forms lose digits; seven terms of the series are
# exact to machine precision there.
_SERIES_BELOW = 0.25


def skew(v: Float64) -> Float64:
    """(..., 3, 3) matrix of the cross product: skew(a) @ b = a × b."""
    return (v @ _SKEW).reshape(*v.shape, 3)


_SKEW = np.zeros((3, 3, 3))
_SKEW[0, 2, 1] = _SKEW[1, 0, 2] = _SKEW[2, 1, 0] = 1.0
_SKEW = (_SKEW - _SKEW.swapaxes(1, 2)).reshape(3, 9)


def rotation_from_quaternion(q: Float64) -> Float64:
    """(3, 3) rotation matrix of the quaternion (w, x, y, z), of any length but zero."""
    return rotations_from_quaternions(q[None])[0]


def rotations_from_quaternions(q: Float64) -> Float64:
    """(k, 3, 3) rotation matrices of quaternions (k, 4)."""
    return np.array([_rotation(*q_i) for q_i in q.tolist()]).reshape(-1, 3, 3)


def _rotation(w: float, x: float, y: float, z: float) -> tuple[float, ...]:
    """The nine elements, by rows."""
    s = 2.0 / (w * w + x * x + y * y + z * z)
    xs, ys, zs = s * x, s * y, s * z
    wx, wy, wz = w * xs, w * ys, w * zs
    xx, xy, xz = x * xs, x * ys, x * zs
    yy, yz, zz = y * ys, y * zs, z * zs
    return (
        1.0 - yy - zz,
        xy - wz,
        xz + wy,
        xy + wz,
        1.0 - xx - zz,
        yz - wx,
        xz - wy,
        yz + wx,
        1.0 - xx - yy,
    )


def quaternion_from_rotation(R: Float64) -> Float64:
    """(4,) unit quaternion (w, x, y, z) with w ≥ 0 of a rotation matrix (3, 3)."""
    K = np.empty((4, 4))
    K[0, 0] = np.trace(R)
    K[1:, 1:] = R + R.T - np.trace(R) * np.eye(3)
    K[0, 1:] = K[1:, 0] = R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]
    q = np.linalg.eigh(K)[1][:, -1]  # Bar-Itzhack: exact also at half a turn
    return q if q[0] >= 0 else -q


def quaternion_rate(q: Float64, w_B: Float64, stabilisation: float = 10.0) -> list:
    """Rate of the quaternion of frame B whose angular velocity in B is w_B, rad/s.

    A term along q pulls its length back to one at the rate 2·stabilisation, 1/s; it
    does not turn the frame.
    """
    w, x, y, z = q.tolist()
    a, b, c = w_B.tolist()
    s = stabilisation * (1.0 - (w * w + x * x + y * y + z * z))
    return [
        0.5 * (-x * a - y * b - z * c) + s * w,
        0.5 * (w * a - z * b + y * c) + s * x,
        0.5 * (z * a + w * b - x * c) + s * y,
        0.5 * (-y * a + x * b + w * c) + s * z,
    ]


# Terms of sin t/t, a = (1 - cos t)/t², b = (t - sin t)/t³ and of the slopes a', b' of
# the latter over t²: column j holds the factors of t²^k, Σ (-1)^k t²^k/(2k + j + 1)!.
_POWERS = np.arange(9)
_TERMS = np.array(
    [[(-1.0) ** k / math.factorial(2 * k + j) for j in (1, 2, 3)] for k in range(10)]
)
_TERMS = np.hstack([_TERMS[:-1], _TERMS[1:, 1:] * (_POWERS + 1.0)[:, None]])


def _coefficients(t2: Float64) -> Float64:
    """(k, 5) of squared angles (k,): sin t/t, a, b, a', b'."""
    if (t2 < _SERIES_BELOW).all():
        return (t2[:, None] ** _POWERS) @ _TERMS
    return np.array([_near(x) if x < _SERIES_BELOW else _far(x) for x in t2.tolist()])


def _near(t2: float) -> Float64:
    return t2**_POWERS @ _TERMS


def _far(t2: float) -> tuple[float, float, float, float, float]:
    t = math.sqrt(t2)
    s = math.sin(t) / t
    a = (1.0 - math.cos(t)) / t2
    b = (1.0 - s) / t2
    return s, a, b, (0.5 * s - a) / t2, (0.5 * a - 1.5 * b) / t2


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
    s, a, b, da, db = _coefficients((theta * theta) @ _SUM).T[:, :, None]
    K = skew(theta)
    KK = K @ K
    aK = a[:, :, None] * K
    R = _ONE + s[:, :, None] * K + a[:, :, None] * KK
    J = _ONE + aK + b[:, :, None] * KK
    # θ × θ', θ × (θ × θ') and θ' × (θ × θ')
    u = K @ theta_dot[:, :, None]
    w = (K @ u)[:, :, 0]
    v = (skew(theta_dot) @ u)[:, :, 0]
    slope = 2.0 * ((theta * theta_dot) @ _SUM)[:, None]
    return R, J, slope * (da * u[:, :, 0] + db * w) + b * v


_ONE, _SUM = np.eye(3), np.ones(3)


def log(R: Float64) -> Float64:
    """(k, 3) rotation vectors, rad, of rotation matrices (k, 3, 3); inverse of `exp`.

    Exact for all angles up to half a turn, where the sign of the axis is arbitrary.
    """
    return np.array([_log(R_i) for R_i in R])


def _log(R: Float64) -> Float64 | tuple[float, float, float]:
    xx, xy, xz, yx, yy, yz, zx, zy, zz = R.ravel().tolist()
    cosine = 0.5 * (xx + yy + zz - 1.0)
    if cosine < 0.0:
        return _log_far(R)
    x, y, z = 0.5 * (zy - yz), 0.5 * (xz - zx), 0.5 * (yx - xy)
    sine = math.sqrt(x * x + y * y + z * z)
    scale = math.atan2(sine, cosine) / sine if sine > 0.0 else 1.0
    return scale * x, scale * y, scale * z


def _log_far(R: Float64) -> Float64:
    q = quaternion_from_rotation(R)
    half_sine = math.sqrt(q[1:] @ q[1:])
    scale = 2.0 * math.atan2(half_sine, q[0]) / half_sine if half_sine > 0 else 2.0
    return scale * q[1:]

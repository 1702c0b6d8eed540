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
    out = np.zeros((*v.shape, 3))
    out[..., 2, 1] = v[..., 0]
    out[..., 0, 2] = v[..., 1]
    out[..., 1, 0] = v[..., 2]
    return out - out.swapaxes(-1, -2)


def cross(a: Float64, b: Float64) -> Float64:
    """a × b over the last axis; several times cheaper than np.cross on few vectors."""
    return a[..., _NEXT] * b[..., _LAST] - a[..., _LAST] * b[..., _NEXT]


_NEXT, _LAST = [1, 2, 0], [2, 0, 1]
_LAST_ROW, _LAST_COLUMN = [2, 0, 1], [1, 2, 0]


def rotation_from_quaternion(q: Float64) -> Float64:
    """(3, 3) rotation matrix of the quaternion (w, x, y, z), of any length but zero."""
    w, x, y, z = q.tolist()
    s = 2.0 / (w * w + x * x + y * y + z * z)
    xs, ys, zs = s * x, s * y, s * z
    return np.array(
        [
            [1.0 - ys * y - zs * z, xs * y - zs * w, xs * z + ys * w],
            [xs * y + zs * w, 1.0 - xs * x - zs * z, ys * z - xs * w],
            [xs * z - ys * w, ys * z + xs * w, 1.0 - xs * x - ys * y],
        ]
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


def _series(first: int) -> tuple[float, ...]:
    """Σ (-1)^k t2^k / (2k + first)!, highest power first."""
    return tuple((-1) ** k / math.factorial(2 * k + first) for k in range(8, -1, -1))


def _slope(series: tuple[float, ...]) -> tuple[float, ...]:
    order = len(series) - 1
    return tuple((order - i) * c for i, c in enumerate(series[:-1]))


_S, _A, _B = _series(1), _series(2), _series(3)
_TERMS = tuple(zip(_S[1:], _A[1:], _B[1:], _slope(_A), _slope(_B)))


def _coefficients(t2: float) -> tuple[float, float, float, float, float]:
    """Of the squared angle: sin t/t, a = (1 - cos t)/t², b = (t - sin t)/t³, a', b'.

    The slopes a', b' are those over t².
    """
    if t2 > _SERIES_BELOW:
        t = math.sqrt(t2)
        s = math.sin(t) / t
        a = (1.0 - math.cos(t)) / t2
        b = (1.0 - s) / t2
        return s, a, b, (0.5 * s - a) / t2, (0.5 * a - 1.5 * b) / t2
    s, a, b, da, db = _S[0], _A[0], _B[0], 0.0, 0.0
    for s_k, a_k, b_k, da_k, db_k in _TERMS:
        s, a, b = s * t2 + s_k, a * t2 + a_k, b * t2 + b_k
        da, db = da * t2 + da_k, db * t2 + db_k
    return s, a, b, da, db


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
    t2 = (theta * theta).sum(axis=1).tolist()
    tt = (theta * theta_dot).sum(axis=1)
    s, a, b, da, db = np.array([_coefficients(x) for x in t2]).reshape(-1, 5).T
    K = skew(theta)
    KK = K @ K
    one = np.eye(3)
    R = one + s[:, None, None] * K + a[:, None, None] * KK
    J = one + a[:, None, None] * K + b[:, None, None] * KK
    u = cross(theta, theta_dot)
    w = cross(theta, u)
    rate = 2.0 * tt[:, None] * (da[:, None] * u + db[:, None] * w)
    return R, J, rate + b[:, None] * cross(theta_dot, u)


def log(R: Float64) -> Float64:
    """(k, 3) rotation vectors, rad, of rotation matrices (k, 3, 3); inverse of `exp`.

    Exact for all angles up to half a turn, where the sign of the axis is arbitrary.
    """
    v = 0.5 * (R - R.swapaxes(1, 2))[:, _LAST_ROW, _LAST_COLUMN]  # axis times sine
    sine = np.sqrt((v * v).sum(axis=1))
    cosine = 0.5 * (np.einsum("kii->k", R) - 1.0)
    if cosine.min() < 0.0:
        return np.array([_log_far(R_i) for R_i in R])
    angle = np.arctan2(sine, cosine)
    return (np.where(sine > 0.0, angle, 1.0) / np.where(sine > 0.0, sine, 1.0))[
        :, None
    ] * v


def _log_far(R: Float64) -> Float64:
    q = quaternion_from_rotation(R)
    half_sine = math.sqrt(q[1:] @ q[1:])
    scale = 2.0 * math.atan2(half_sine, q[0]) / half_sine if half_sine > 0 else 2.0
    return scale * q[1:]

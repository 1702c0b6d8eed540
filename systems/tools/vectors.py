"""Vectors and rotations in three dimensions, compiled: the vocabulary of the laws.

A vector is a tuple of three numbers, a matrix an array (3, 3). A rotation vector θ
stands for the rotation exp([θ]); its left Jacobian J_l(θ) gives the angular velocity
J_l(θ) θ' of that rotation in the axes in which θ is written (Barfoot, State Estimation
for Robotics, 7.1). `rotations` has the same for arrays.
"""

import math

import numpy as np
import numpy.typing as npt

from systems.tools.compiled import compiled

Float64 = npt.NDArray[np.float64]
Vector = tuple[float, float, float]


@compiled
def cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@compiled
def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def added(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@compiled
def skew_entry(v: Vector, i: int, j: int) -> float:
    """Element of [v], the matrix of v ×."""
    if i == j:
        return 0.0
    value = v[3 - i - j]
    return -value if (j - i) % 3 == 1 else value


@compiled
def turned(R: Float64, v: Vector) -> Vector:
    return (
        R[0, 0] * v[0] + R[0, 1] * v[1] + R[0, 2] * v[2],
        R[1, 0] * v[0] + R[1, 1] * v[1] + R[1, 2] * v[2],
        R[2, 0] * v[0] + R[2, 1] * v[1] + R[2, 2] * v[2],
    )


@compiled
def product(A: Float64, B: Float64) -> Float64:
    out = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            out[i, j] = A[i, 0] * B[0, j] + A[i, 1] * B[1, j] + A[i, 2] * B[2, j]
    return out


@compiled
def rotation_matrix(w: float, x: float, y: float, z: float) -> Float64:
    """(3, 3) of a quaternion of any length but zero."""
    s = 2.0 / (w * w + x * x + y * y + z * z)
    R = np.empty((3, 3))
    R[0, 0] = 1.0 - s * (y * y + z * z)
    R[0, 1] = s * (x * y - w * z)
    R[0, 2] = s * (x * z + w * y)
    R[1, 0] = s * (x * y + w * z)
    R[1, 1] = 1.0 - s * (x * x + z * z)
    R[1, 2] = s * (y * z - w * x)
    R[2, 0] = s * (x * z - w * y)
    R[2, 1] = s * (y * z + w * x)
    R[2, 2] = 1.0 - s * (x * x + y * y)
    return R


@compiled
def _coefficients(t2: float) -> tuple[float, float, float, float, float]:
    """Functions of t²: sin t/t, a = (1 - cos t)/t², b = (t - sin t)/t³, a', b'.

    The slopes are those over t². The series are exact to machine precision where the
    closed forms lose digits.
    """
    if t2 < 0.25:
        s = a = b = da = db = 0.0
        power, factorial = 1.0, 1.0
        for k in range(9):
            if k:
                power *= -t2
                factorial *= (2 * k) * (2 * k + 1)
            # power/(2k+1)!, and with two and three more factors
            s += power / factorial
            a += power / (factorial * (2 * k + 2))
            b += power / (factorial * (2 * k + 2) * (2 * k + 3))
            after = factorial * (2 * k + 2) * (2 * k + 3) * (2 * k + 4)
            da -= (k + 1) * power / after
            db -= (k + 1) * power / (after * (2 * k + 5))
        return s, a, b, da, db
    t = math.sqrt(t2)
    s = math.sin(t) / t
    a = (1.0 - math.cos(t)) / t2
    b = (1.0 - s) / t2
    return s, a, b, (0.5 * s - a) / t2, (0.5 * a - 1.5 * b) / t2


@compiled
def rotation_kinematics(
    theta: Vector, rate: Vector
) -> tuple[Float64, Float64, Vector, Vector]:
    """exp([θ]) and J_l(θ) (3, 3), J_l θ' and (dJ_l/dt) θ', with θ' the rate."""
    t2 = dot(theta, theta)
    s, a, b, da, db = _coefficients(t2)
    turn, jacobian = np.empty((3, 3)), np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            one = 1.0 if i == j else 0.0
            both, skew = theta[i] * theta[j], skew_entry(theta, i, j)
            turn[i, j] = (1.0 - a * t2) * one + s * skew + a * both
            jacobian[i, j] = (1.0 - b * t2) * one + a * skew + b * both
    u = cross(theta, rate)
    w = cross(theta, u)
    v = cross(rate, u)
    slope = 2.0 * dot(theta, rate)
    spin = added(added(rate, u, a), w, b)
    bias = (
        slope * (da * u[0] + db * w[0]) + b * v[0],
        slope * (da * u[1] + db * w[1]) + b * v[1],
        slope * (da * u[2] + db * w[2]) + b * v[2],
    )
    return turn, jacobian, spin, bias


@compiled
def rotation_vector(R: Float64) -> Vector:
    """Rotation vector of a rotation matrix, by the quaternion's largest component."""
    trace = R[0, 0] + R[1, 1] + R[2, 2]
    # The matrix 4 q qᵀ, of which the row of the largest diagonal is exact.
    largest = 0
    best = trace
    for i in range(3):
        if R[i, i] > best:
            largest, best = i + 1, R[i, i]
    if largest == 0:
        w, x = 1.0 + trace, R[2, 1] - R[1, 2]
        y, z = R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]
    elif largest == 1:
        w, x = R[2, 1] - R[1, 2], 1.0 + R[0, 0] - R[1, 1] - R[2, 2]
        y, z = R[1, 0] + R[0, 1], R[2, 0] + R[0, 2]
    elif largest == 2:
        w, x = R[0, 2] - R[2, 0], R[1, 0] + R[0, 1]
        y, z = 1.0 - R[0, 0] + R[1, 1] - R[2, 2], R[2, 1] + R[1, 2]
    else:
        w, x = R[1, 0] - R[0, 1], R[2, 0] + R[0, 2]
        y, z = R[2, 1] + R[1, 2], 1.0 - R[0, 0] - R[1, 1] + R[2, 2]
    if w < 0.0:
        w, x, y, z = -w, -x, -y, -z
    sine = math.sqrt(x * x + y * y + z * z)
    scale = 2.0 * math.atan2(sine, w) / sine if sine > 0.0 else 2.0 / w
    return scale * x, scale * y, scale * z

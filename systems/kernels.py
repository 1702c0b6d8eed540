"""The arithmetic of airframe and attachment, compiled.

What it computes is explained where it is used: `modal_kinematics`, `flexible_airframe`
and `attachment`. A vector "per node" is [angular; linear], node after node.
"""

import math

import numpy as np
import numpy.typing as npt

from systems.compiled import compiled

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Vector = tuple[float, float, float]


@compiled
def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@compiled
def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def _skew_entry(v: Vector, i: int, j: int) -> float:
    """Element of [v], the matrix of v ×."""
    if i == j:
        return 0.0
    value = v[3 - i - j]
    return -value if (j - i) % 3 == 1 else value


@compiled
def _turned(R: Float64, v: Vector) -> Vector:
    return (
        R[0, 0] * v[0] + R[0, 1] * v[1] + R[0, 2] * v[2],
        R[1, 0] * v[0] + R[1, 1] * v[1] + R[1, 2] * v[2],
        R[2, 0] * v[0] + R[2, 1] * v[1] + R[2, 2] * v[2],
    )


@compiled
def _rotation(w: float, x: float, y: float, z: float) -> Float64:
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
    """Of a squared angle: sin t/t, a = (1 - cos t)/t², b = (t - sin t)/t³, a', b'.

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
def _sum(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@compiled
def _rotation_kinematics(
    theta: Vector, rate: Vector
) -> tuple[Float64, Float64, Vector, Vector]:
    """exp([θ]) and J_l(θ) (3, 3), J_l θ' and (dJ_l/dt) θ', as in `rotations`."""
    t2 = _dot(theta, theta)
    s, a, b, da, db = _coefficients(t2)
    turn, jacobian = np.empty((3, 3)), np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            one = 1.0 if i == j else 0.0
            both, skew = theta[i] * theta[j], _skew_entry(theta, i, j)
            turn[i, j] = (1.0 - a * t2) * one + s * skew + a * both
            jacobian[i, j] = (1.0 - b * t2) * one + a * skew + b * both
    u = _cross(theta, rate)
    w = _cross(theta, u)
    v = _cross(rate, u)
    slope = 2.0 * _dot(theta, rate)
    spin = _sum(_sum(rate, u, a), w, b)
    bias = (
        slope * (da * u[0] + db * w[0]) + b * v[0],
        slope * (da * u[1] + db * w[1]) + b * v[1],
        slope * (da * u[2] + db * w[2]) + b * v[2],
    )
    return turn, jacobian, spin, bias


@compiled
def _elastic_motion(
    shape: Float64, x: Float64, row: int
) -> tuple[Vector, Vector, Vector, Vector]:
    """Rotation and translation by the modes, and their rates, of a node, B."""
    n = shape.shape[1]
    e = np.zeros((2, 6))
    for c in range(6):
        value = rate = 0.0
        for j in range(n):
            value += shape[row + c, j] * x[13 + j]
            rate += shape[row + c, j] * x[13 + n + j]
        e[0, c], e[1, c] = value, rate
    return (
        (e[0, 0], e[0, 1], e[0, 2]),
        (e[0, 3], e[0, 4], e[0, 5]),
        (e[1, 0], e[1, 1], e[1, 2]),
        (e[1, 3], e[1, 4], e[1, 5]),
    )


@compiled
def _product(A: Float64, B: Float64) -> Float64:
    out = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            out[i, j] = A[i, 0] * B[0, j] + A[i, 1] * B[1, j] + A[i, 2] * B[2, j]
    return out


@compiled
def node_motion(
    x: Float64, shape: Float64, p_GN: Float64
) -> tuple[Float64, Float64, Float64, Float64, Float64, Float64]:
    """Motion of nodes from the state of the body.

    Args:
        x: (13 + 2 n,) p_WG, quaternion, v_WG, ω_B, η, η'.
        shape: (6 k, n) modes, per node [rotation; translation], B.
        p_GN: (k, 3) undeformed places, B, m.

    Returns:
        R_WB (3, 3); pose (12 k,), R_WN by rows and p_WN; velocity (6 k,), W; bias
        (6 k,), acceleration at zero generalised accelerations; rigid (6 k, 6), velocity
        per [v_WG; ω_B]; turn (k, 3, 3), angular velocity per rate of rotation vector.
    """
    k = len(p_GN)
    R = _rotation(x[3], x[4], x[5], x[6])
    v_G, w = (x[7], x[8], x[9]), (x[10], x[11], x[12])
    pose, velocity, bias = np.empty((k, 12)), np.empty((k, 6)), np.empty((k, 6))
    rigid, turn = np.zeros((6 * k, 6)), np.empty((k, 3, 3))
    for i in range(k):
        theta, shift, theta_rate, slide = _elastic_motion(shape, x, 6 * i)
        r = _sum((p_GN[i, 0], p_GN[i, 1], p_GN[i, 2]), shift)
        own, jacobian, spin, own_bias = _rotation_kinematics(theta, theta_rate)
        R_WN = _product(R, own)
        turn[i] = _product(R, jacobian)
        carried = _cross(w, r)
        place = _turned(R, r)
        turning = _turned(R, _sum(w, spin))
        going = _sum(v_G, _turned(R, _sum(carried, slide)))
        turning_bias = _turned(R, _sum(own_bias, _cross(w, spin)))
        going_bias = _turned(R, _cross(w, _sum(carried, slide, 2.0)))
        for c in range(3):
            pose[i, 9 + c] = x[c] + place[c]
            velocity[i, c], velocity[i, 3 + c] = turning[c], going[c]
            bias[i, c], bias[i, 3 + c] = turning_bias[c], going_bias[c]
            rigid[6 * i + 3 + c, c] = 1.0
            across = _cross(r, (R[c, 0], R[c, 1], R[c, 2]))  # row of R [-r]
            for d in range(3):
                pose[i, 3 * c + d] = R_WN[c, d]
                rigid[6 * i + c, 3 + d] = R[c, d]
                rigid[6 * i + 3 + c, 3 + d] = across[d]
    return R, pose.ravel(), velocity.ravel(), bias.ravel(), rigid, turn


@compiled
def node_compliance(
    R: Float64,
    rigid: Float64,
    turn: Float64,
    elastic: Float64,
    inverse_mass: Float64,
) -> Float64:
    """(6 k, 6 k) acceleration of the nodes per wrench, W.

    Args:
        R, rigid, turn: of `node_motion`.
        elastic: (6 k, 6 k) that of the modes, B.
        inverse_mass: (6, 6) of [v_WG; ω_B].
    """
    m = len(rigid)
    mobile = np.empty((m, 6))
    for i in range(m):
        for j in range(6):
            total = 0.0
            for c in range(6):
                total += rigid[i, c] * inverse_mass[c, j]
            mobile[i, j] = total
    out = np.empty((m, m))
    half = np.empty((3, 3))
    for i in range(0, m, 3):
        left = turn[i // 6] if i % 6 == 0 else R
        for j in range(0, i + 1, 3):
            right = turn[j // 6] if j % 6 == 0 else R
            for c in range(3):
                for d in range(3):
                    total = 0.0
                    for f in range(3):
                        total += left[c, f] * elastic[i + f, j + d]
                    half[c, d] = total
            for c in range(3):
                for d in range(3):
                    total = 0.0
                    for f in range(3):
                        total += half[c, f] * right[d, f]
                    for f in range(6):
                        total += mobile[i + c, f] * rigid[j + d, f]
                    out[i + c, j + d] = total
                    out[j + d, i + c] = total
    return out


@compiled
def free_acceleration(
    x: Float64,
    stiffness: Float64,
    damping: Float64,
    inertia: Float64,
    inverse_mass: Float64,
    gravity: float,
) -> tuple[Float64, Float64]:
    """Generalised accelerations without any load but gravity.

    Args:
        x: (13 + 2 n,) state, see `node_motion`.
        stiffness: (n,) per modal mass.
        damping: (n, 1) per modal mass, or (n, n) where it couples modes.
        inertia: (3, 3) about G, B.
        inverse_mass: (6, 6) of [v_WG; ω_B].
        gravity: m/s².

    Returns:
        (6,) [a_WG in W; ω' in B] and (n,) η".
    """
    n = len(stiffness)
    w = (x[10], x[11], x[12])
    torque = _cross(_turned(inertia, w), w)
    rigid, elastic = np.zeros(6), np.empty(n)
    for c in range(3):
        for d in range(3):
            rigid[3 + c] += inverse_mass[3 + c, 3 + d] * torque[d]
    rigid[2] -= gravity
    coupled = damping.shape[1] > 1
    for i in range(n):
        if coupled:
            lost = 0.0
            for j in range(n):
                lost += damping[i, j] * x[13 + n + j]
        else:
            lost = damping[i, 0] * x[13 + n + i]
        elastic[i] = -stiffness[i] * x[13 + i] - lost
    return rigid, elastic


@compiled
def damping_power(x: Float64, modal_mass: Float64, damping: Float64) -> float:
    """Power lost by the modes, W; arguments as of `free_acceleration`."""
    n = len(modal_mass)
    total = 0.0
    for i in range(n):
        lost = 0.0
        if damping.shape[1] > 1:
            for j in range(n):
                lost += damping[i, j] * x[13 + n + j]
        else:
            lost = damping[i, 0] * x[13 + n + i]
        total += modal_mass[i] * x[13 + n + i] * lost
    return total


@compiled
def node_acceleration(
    R: Float64,
    rigid: Float64,
    turn: Float64,
    bias: Float64,
    shape: Float64,
    of_rigid: Float64,
    of_modes: Float64,
) -> Float64:
    """(6 k,) accelerations of nodes, W, from the generalised ones.

    Args:
        R, rigid, turn, bias: of `node_motion`.
        shape: (6 k, n).
        of_rigid: (6,) [a_WG in W; ω' in B].
        of_modes: (n,).
    """
    m, n = shape.shape
    out, local = np.empty(m), np.empty(3)
    for i in range(0, m, 3):
        left = turn[i // 6] if i % 6 == 0 else R
        for c in range(3):
            total = 0.0
            for j in range(n):
                total += shape[i + c, j] * of_modes[j]
            local[c] = total
        for c in range(3):
            total = bias[i + c]
            for d in range(3):
                total += left[c, d] * local[d]
            for d in range(6):
                total += rigid[i + c, d] * of_rigid[d]
            out[i + c] = total
    return out


@compiled
def loaded_acceleration(
    R: Float64,
    rigid: Float64,
    turn: Float64,
    shape: Float64,
    inverse_mass: Float64,
    modal_mass: Float64,
    free_rigid: Float64,
    free_modes: Float64,
    wrench: Float64,
) -> tuple[Float64, Float64]:
    """Generalised accelerations with wrenches at the nodes added.

    Args:
        R, rigid, turn: of `node_motion`.
        shape: (6 k, n).
        inverse_mass: (6, 6) of [v_WG; ω_B].
        modal_mass: (n,).
        free_rigid, free_modes: (6,), (n,) those without.
        wrench: (6 k,) at the nodes, W.
    """
    m, n = shape.shape
    load, of_rigid = np.zeros(6), free_rigid.copy()
    modal, local = np.zeros(n), np.empty(3)
    for i in range(0, m, 3):
        left = turn[i // 6] if i % 6 == 0 else R
        for d in range(3):
            local[d] = (
                left[0, d] * wrench[i]
                + left[1, d] * wrench[i + 1]
                + left[2, d] * wrench[i + 2]
            )
        for c in range(3):
            for d in range(6):
                load[d] += rigid[i + c, d] * wrench[i + c]
            for j in range(n):
                modal[j] += shape[i + c, j] * local[c]
    for c in range(6):
        for d in range(6):
            of_rigid[c] += inverse_mass[c, d] * load[d]
    for j in range(n):
        modal[j] = free_modes[j] + modal[j] / modal_mass[j]
    return of_rigid, modal


@compiled
def state_rate(
    x: Float64, rigid: Float64, modes: Float64, stabilisation: float
) -> Float64:
    """Time derivative of the state from the generalised accelerations.

    A term along the quaternion pulls its length back to one at the rate
    2·stabilisation, 1/s; it does not turn the frame.
    """
    n = len(modes)
    out = np.empty(13 + 2 * n)
    qw, qx, qy, qz = x[3], x[4], x[5], x[6]
    a, b, c = x[10], x[11], x[12]
    s = stabilisation * (1.0 - (qw * qw + qx * qx + qy * qy + qz * qz))
    out[3] = 0.5 * (-qx * a - qy * b - qz * c) + s * qw
    out[4] = 0.5 * (qw * a - qz * b + qy * c) + s * qx
    out[5] = 0.5 * (qz * a + qw * b - qx * c) + s * qy
    out[6] = 0.5 * (-qy * a + qx * b + qw * c) + s * qz
    for i in range(3):
        out[i] = x[7 + i]
    for i in range(6):
        out[7 + i] = rigid[i]
    for i in range(n):
        out[13 + i] = x[13 + n + i]
        out[13 + n + i] = modes[i]
    return out


@compiled
def _rotation_vector(R: Float64) -> Vector:
    """Of a rotation matrix, by way of the quaternion's largest component."""
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


@compiled
def fitting_gaps(
    state: Float64,
    positions: Int64,
    velocities: Int64,
    pose: Float64,
    velocity: Float64,
) -> tuple[Float64, Float64, Float64, Float64]:
    """Fittings relative to nodes.

    Args:
        state: positions and velocities of the plant.
        positions: (k,) first of the fitting's quaternion and place.
        velocities: (k,) first of the fitting's velocity.
        pose, velocity: (12 k,), (6 k,) of the nodes.

    Returns:
        (k, 2, 6) rotation and translation, and their rates; (6 k,) and (6 k,) the same,
        apart; (k, 3, 3) R_WF.
    """
    k = len(positions)
    gap, rate, turns = np.empty((k, 6)), np.empty((k, 6)), np.empty((k, 3, 3))
    both = np.empty((k, 2, 6))
    relative = np.empty((3, 3))
    for i in range(k):
        q, v = positions[i], velocities[i]
        R = _rotation(state[q], state[q + 1], state[q + 2], state[q + 3])
        turns[i] = R
        for c in range(3):
            for d in range(3):
                total = 0.0
                for f in range(3):
                    total += R[c, f] * pose[12 * i + 3 * d + f]
                relative[c, d] = total
        turn = _rotation_vector(relative)
        for c in range(3):
            gap[i, c] = turn[c]
            gap[i, 3 + c] = state[q + 4 + c] - pose[12 * i + 9 + c]
        for c in range(6):
            rate[i, c] = state[v + c] - velocity[6 * i + c]
        both[i, 0], both[i, 1] = gap[i], rate[i]
    return both, gap.ravel(), rate.ravel(), turns


@compiled
def _factorise(A: Float64, start: int, end: int) -> None:
    """Cholesky factor of a diagonal block of A, in place of its lower triangle."""
    for j in range(start, end):
        total = A[j, j]
        for f in range(start, j):
            total -= A[j, f] * A[j, f]
        pivot = math.sqrt(total)
        A[j, j] = pivot
        for i in range(j + 1, end):
            total = A[i, j]
            for f in range(start, j):
                total -= A[i, f] * A[j, f]
            A[i, j] = total / pivot


@compiled
def _solve(L: Float64, b: Float64, start: int, end: int) -> None:
    """Rows start to end of b, in place, with the factor of `_factorise`."""
    for i in range(start, end):
        for f in range(start, i):
            b[i] -= L[i, f] * b[f]
        b[i] /= L[i, i]
    for i in range(end - 1, start - 1, -1):
        for f in range(i + 1, end):
            b[i] -= L[f, i] * b[f]
        b[i] /= L[i, i]


@compiled
def fitting_response(
    mass: Float64, force: Float64, rows: Int64, starts: Int64
) -> tuple[Float64, Float64]:
    """What the fittings do under wrenches on them, and without.

    Args:
        mass: (nv, nv) of the plant: one diagonal block for each fitting and what it
            carries.
        force: (nv,) of everything but the attachments.
        rows: (m,) velocities of the fittings.
        starts: (f + 1,) first row of each block, and nv.

    Returns:
        (m, m) accelerations per wrench and (m,) free accelerations, W.
    """
    nv, m = len(force), len(rows)
    A, out = mass.copy(), np.zeros((m, m))
    free, b = force.copy(), np.empty(nv)
    for g in range(len(starts) - 1):
        start, end = starts[g], starts[g + 1]
        _factorise(A, start, end)
        _solve(A, free, start, end)
        for j in range(m):
            if start <= rows[j] < end:
                for i in range(start, end):
                    b[i] = 0.0
                b[rows[j]] = 1.0
                _solve(A, b, start, end)
                for i in range(m):
                    if start <= rows[i] < end:
                        out[i, j] = b[rows[i]]
    return out, free[rows]


@compiled
def solve_positive(A: Float64, b: Float64) -> Float64:
    """Solution of A x = b for a symmetric positive definite A; NaN if it is not."""
    L, x = A.copy(), b.copy()
    _factorise(L, 0, len(b))
    _solve(L, x, 0, len(b))
    return x


@compiled
def plain_load(
    mass: Float64,
    force: Float64,
    rows: Int64,
    starts: Int64,
    compliance: Float64,
    acceleration: Float64,
    gap: Float64,
    rate: Float64,
    alpha: float,
    beta: float,
) -> Float64:
    """(m,) loads on fittings, each held rigidly at one node; see `attachment`.

    Args:
        mass, force, rows, starts: see `fitting_response`.
        compliance: (m²,) of the nodes.
        acceleration: (m,) of the nodes without the loads.
        gap, rate: (m,).
        alpha, beta: Baumgarte's rates, 1/s.
    """
    A, wanted = fitting_response(mass, force, rows, starts)
    m = len(wanted)
    for i in range(m):
        for j in range(m):
            A[i, j] += compliance[m * i + j]
        stabilised = 2.0 * alpha * rate[i] + beta * beta * gap[i]
        wanted[i] = acceleration[i] - wanted[i] - stabilised
    return solve_positive(A, wanted)

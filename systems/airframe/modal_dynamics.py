"""Equations of motion of a flexible body in mean axes.

The floating frame B has its origin at the center of gravity G of the body and turns
with its mean axes, to which the elastic modes are orthogonal:

    m a_G = F - m g e_z,    I ω' + ω × I ω = M_G,
    m_i η_i" + Σ_j c_ij η_j' + m_i ω_i² η_i = φ_iᵀ f.

The inertia I is that of the undeformed body; the loads act at the deformed places, see
`modal_kinematics`. State x (13 + 2 n): p_WG, quaternion of R_WB, v_WG, ω_B, η, η'.
Generalised accelerations: [a_WG in W; ω' in B] (6) and η" (n).
"""

import numpy as np
import numpy.typing as npt

from systems.tools.compiled import compiled
from systems.tools.vectors import cross, turned

Float64 = npt.NDArray[np.float64]


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
        x: (13 + 2 n,) state.
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
    torque = cross(turned(inertia, w), w)
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
        R, rigid, turn: of `NodeMotion`.
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

"""25.483: one main gear with the loads that it has in the level landing on both.

The paragraph gives one gear the load of that side of the level landing and lets inertia
react what is unbalanced. Over time: the airframe answers to the attachment loads of one
gear alone, as the landing on the main wheels has made them. Nothing rolls away from the
load, as in a landing that touches with one gear first (preset rolled), which therefore
is another condition.

With m, J of the airframe and its modes (mass m_i, damping C, stiffness m_i ω_i²):

    m a = F,   J α = M,   m_i q̈_i + Σ C_ij q̇_j + m_i ω_i² q_i = φ_iᵀ f

for small motions, from rest; the loads are linear between samples and the modes are
then exact (a first-order hold by the matrix exponential).
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd
from scipy.linalg import expm

from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.handover import resample, time_grid
from drake_landing.landing.history import POINT, LandingHistory
from fem.arrays import Float64
from fem.errors import InputError
from systems.airframe.modal_body import ModalBody

_STEP = 2.5e-4  # s, of the modes
_MIDDLE = 0.05  # m, nearer to the plane of symmetry a gear has no side


def gear_of_side(gears: Sequence[LandingGear], side: str) -> LandingGear:
    """The gear farthest to a side.

    Args:
        gears: in A.
        side: starboard or port.

    Raises:
        InputError: there is none on that side.
    """
    sign = 1.0 if side == "starboard" else -1.0
    beside = {g.name: sign * float(g.axle[1]) for g in gears}
    name = max(beside, key=lambda n: beside[n])
    if beside[name] < _MIDDLE:
        raise InputError(
            f"scenario.one_gear: found {side}, but no gear stands on that side"
        )
    return next(g for g in gears if g.name == name)


def with_one_gear(
    history: LandingHistory,
    body: ModalBody,
    gears: Sequence[LandingGear],
    side: str,
    points: Mapping[str, int],
    R_AB: Float64,
) -> LandingHistory:
    """The landing with the loads of one gear alone, and what the airframe answers.

    Args:
        history: of the landing on both main gears.
        body: of the airframe, A.
        gears: in A.
        side: whose gear it is.
        points: monitoring points.
        R_AB: (3, 3).

    Returns:
        The history; loads of other attachments are zero, accelerations of the points
        and modal amplitudes are those of the loads that are left. Gears and their
        energies are those of the landing.

    Raises:
        InputError: no gear stands on that side.
    """
    own = gear_of_side(gears, side).attachments
    monitoring, amplitudes = airframe_answer(history, body, list(own), points, R_AB)
    attachment = {
        name: table if name in own else table * 0.0
        for name, table in history.attachment.items()
    }
    return replace(
        history,
        attachment=attachment,
        monitoring=monitoring,
        amplitudes=amplitudes,
        lift_change={},
    )


def airframe_answer(
    history: LandingHistory,
    body: ModalBody,
    attachments: Sequence[str],
    points: Mapping[str, int],
    R_AB: Float64,
) -> tuple[dict[str, pd.DataFrame], Float64]:
    """Accelerations of points (B) and modal amplitudes under some attachments' loads.

    Args:
        history: with the loads.
        body: of the airframe, A.
        attachments: whose loads act.
        points: monitoring points.
        R_AB: (3, 3).
    """
    grid = time_grid(_STEP, float(history.time[-1]))
    load = np.zeros((len(grid), body.n + 6))
    for name in attachments:
        values = resample(history.time, history.attachment[name].to_numpy(), grid)
        load += _generalised(body, history.attachment_node[name], values, R_AB)
    rigid = load[:, :6] @ np.linalg.inv(_rigid_mass(body)).T
    q, acceleration = _modes(body, load[:, 6:])
    rows = body.rows(list(points.values())) if points else []
    monitoring = {
        point: _at(history.time, grid, _moved(body, row, rigid, acceleration) @ R_AB)
        for point, row in zip(points, rows)
    }
    amplitudes = np.zeros((len(history.time), body.n))
    for i, column in enumerate(q.T):
        amplitudes[:, i] = np.interp(history.time, grid, column)
    return monitoring, amplitudes


def _generalised(body: ModalBody, node: int, load: Float64, R_AB: Float64) -> Float64:
    """(t, 6 + n) force, moment about G (A), modal forces of loads (t, 6) on a node."""
    row = int(np.atleast_1d(body.rows([node]))[0])
    force, moment = load[:, :3] @ R_AB.T, load[:, 3:] @ R_AB.T
    about = moment + np.cross(body.p_BN[row] - body.p_BG, force)
    modal = force @ body.translation[row] + moment @ body.rotation[row]
    return np.hstack([force, about, modal])


def _rigid_mass(body: ModalBody) -> Float64:
    mass = np.zeros((6, 6))
    mass[:3, :3] = body.mass * np.eye(3)
    mass[3:, 3:] = body.inertia_G
    return mass


def _moved(body: ModalBody, row: int, rigid: Float64, elastic: Float64) -> Float64:
    """(t, 3) acceleration of a node, A."""
    arm = body.p_BN[row] - body.p_BG
    turned = np.cross(rigid[:, 3:], arm)
    return rigid[:, :3] + turned + elastic @ body.translation[row].T


def _at(time: Float64, grid: Float64, values: Float64) -> pd.DataFrame:
    columns = [np.interp(time, grid, column) for column in values.T]
    index = pd.Index(time, name="time")
    return pd.DataFrame(np.stack(columns, axis=1), columns=list(POINT), index=index)


def _modes(body: ModalBody, force: Float64) -> tuple[Float64, Float64]:
    """(t, n) amplitudes and their accelerations under modal forces (t, n)."""
    n = body.n
    if not n:
        return np.zeros((len(force), 0)), np.zeros((len(force), 0))
    inverse = 1.0 / body.modal_mass
    omega2 = (2.0 * np.pi * body.frequency) ** 2
    A = np.zeros((2 * n, 2 * n))
    A[:n, n:] = np.eye(n)
    A[n:, :n] = -np.diag(omega2)
    A[n:, n:] = -inverse[:, None] * body.modal_damping
    B = np.vstack([np.zeros((n, n)), np.diag(inverse)])
    whole = np.zeros((4 * n, 4 * n))
    whole[: 2 * n, : 2 * n], whole[: 2 * n, 2 * n : 3 * n] = A * _STEP, B * _STEP
    whole[2 * n : 3 * n, 3 * n :] = np.eye(n)
    steps = expm(whole)
    ahead = steps[: 2 * n, : 2 * n]
    ramp = steps[: 2 * n, 3 * n :]
    constant = steps[: 2 * n, 2 * n : 3 * n] - ramp
    given = force[:-1] @ constant.T + force[1:] @ ramp.T
    state = np.zeros((len(force), 2 * n))
    for i, push in enumerate(given):
        state[i + 1] = ahead @ state[i] + push
    acceleration = state @ A[n:].T + force * inverse
    return state[:, :n], acceleration

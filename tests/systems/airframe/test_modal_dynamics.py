"""Equations of motion of the flexible body, compiled, against plain ones."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from systems.airframe import modal_dynamics
from systems.tools.rotations import rotation_from_quaternion, skew

N = 5


def _state(rng):
    x = rng.normal(size=13 + 2 * N)
    x[3:7] /= np.linalg.norm(x[3:7])
    return x


@pytest.mark.parametrize("coupled", [False, True])
def test_free_acceleration_is_newton_and_euler_and_the_modes(coupled):
    rng = np.random.default_rng(3)
    x, stiffness = _state(rng), rng.uniform(1.0, 2.0, N)
    damping = rng.uniform(1.0, 2.0, (N, N if coupled else 1))
    root = rng.normal(size=(3, 3))
    inertia = root @ root.T + np.eye(3)
    inverse_mass = np.zeros((6, 6))
    inverse_mass[:3, :3], inverse_mass[3:, 3:] = np.eye(3) / 7, np.linalg.inv(inertia)
    rigid, elastic = modal_dynamics.free_acceleration(
        x, stiffness, damping, inertia, inverse_mass, 9.81
    )
    w, eta, rate = x[10:13], x[13 : 13 + N], x[13 + N :]
    spin = np.linalg.solve(inertia, -np.cross(w, inertia @ w))
    lost = damping @ rate if coupled else damping[:, 0] * rate
    assert_allclose(rigid, [0, 0, -9.81, *spin], rtol=1e-12, atol=1e-12)
    assert_allclose(elastic, -stiffness * eta - lost, rtol=1e-13)


@pytest.mark.parametrize("coupled", [False, True])
def test_power_of_damping_is_that_of_the_free_acceleration(coupled):
    """dE/dt = -P, with the work of the springs taken away."""
    rng = np.random.default_rng(2)
    x = _state(rng)
    damping = rng.uniform(1.0, 2.0, (N, N if coupled else 1))
    mass, inertia = rng.uniform(1.0, 2.0, N), np.diag([1.0, 2.0, 3.0])
    _, elastic = modal_dynamics.free_acceleration(
        x, np.zeros(N), damping, inertia, np.eye(6), 0.0
    )
    power = modal_dynamics.damping_power(x, mass, damping)
    assert_allclose(power, -(mass * x[13 + N :]) @ elastic, rtol=1e-12)


def test_state_rate_turns_the_frame_with_its_angular_velocity():
    rng = np.random.default_rng(4)
    x, h = _state(rng), 1e-7
    rates = modal_dynamics.state_rate(x, np.arange(6.0), np.arange(5.0), 10.0)
    R = rotation_from_quaternion(x[3:7])
    R_dot = (rotation_from_quaternion(x[3:7] + h * rates[3:7]) - R) / h
    assert_allclose(R.T @ R_dot, skew(x[10:13]), atol=1e-5)
    assert_allclose(rates[:3], x[7:10])
    assert_allclose(rates[7:13], np.arange(6.0))
    assert_allclose(rates[13:], [*x[13 + N :], *np.arange(5.0)])


def test_a_quaternion_that_is_too_long_shrinks():
    x = _state(np.random.default_rng(5))
    x[3:7] *= 1.01
    rates = modal_dynamics.state_rate(x, np.zeros(6), np.zeros(5), 10.0)
    square = x[3:7] @ x[3:7]
    assert_allclose(2.0 * x[3:7] @ rates[3:7], 20.0 * (1.0 - square) * square)

"""Compiled functions against plain ones."""

import itertools

import numpy as np
import pytest
from numpy.testing import assert_allclose

from systems import kernels, rotations


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-3, 0.4, 0.499999, 0.500001, 2.0, 3.1])
def test_rotation_kinematics_agree_with_the_plain_ones(angle):
    axis = np.array([0.6, -0.48, 0.64])
    theta, rate = angle * axis, np.array([0.3, 2.0, -1.0])
    found = kernels._rotation_kinematics(tuple(theta), tuple(rate))
    R, J, bias = rotations.rotation_kinematics(theta[None], rate[None])
    for value, expected in zip(found, (R[0], J[0], J[0] @ rate, bias[0])):
        assert_allclose(value, expected, atol=4e-14)


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-6, 0.3, 1.6, 3.0, 3.14159])
@pytest.mark.parametrize("axis", np.vstack([np.eye(3), [[0.36, -0.48, 0.8]]]))
def test_rotation_vector_is_the_inverse_of_exp(angle, axis):
    theta = angle * axis
    R = rotations.exp(theta[None])[0]
    assert_allclose(kernels._rotation_vector(R), theta, rtol=1e-9, atol=1e-15)


def test_solve_positive():
    rng = np.random.default_rng(0)
    root = rng.normal(size=(18, 18))
    A, b = root @ root.T + np.eye(18), rng.normal(size=18)
    assert_allclose(kernels.solve_positive(A, b), np.linalg.solve(A, b), rtol=1e-9)


def test_matrix_that_is_not_positive_definite_gives_nan():
    A = np.diag([1.0, -1.0])
    assert np.isnan(kernels.solve_positive(A, np.ones(2))).any()


def test_response_of_fittings_solves_their_blocks_of_the_mass_matrix():
    rng = np.random.default_rng(1)
    starts = np.array([0, 8, 17])
    mass = np.zeros((17, 17))
    for a, b in itertools.pairwise(starts):
        root = rng.normal(size=(b - a, b - a))
        mass[a:b, a:b] = root @ root.T + np.eye(b - a)
    rows = np.concatenate([np.arange(8, 14), np.arange(6)])  # order of fittings is free
    force = rng.normal(size=17)
    response, free = kernels.fitting_response(mass, force, rows, starts)
    assert_allclose(response, np.linalg.inv(mass)[np.ix_(rows, rows)], atol=1e-10)
    assert_allclose(free, np.linalg.solve(mass, force)[rows], atol=1e-10)


@pytest.mark.parametrize("coupled", [False, True])
def test_power_of_damping_is_that_of_the_free_acceleration(coupled):
    """dE/dt = -P, with the work of the springs taken away."""
    rng = np.random.default_rng(2)
    n = 5
    x = rng.normal(size=13 + 2 * n)
    damping = rng.uniform(1.0, 2.0, (n, n if coupled else 1))
    mass, inertia = rng.uniform(1.0, 2.0, n), np.diag([1.0, 2.0, 3.0])
    _, elastic = kernels.free_acceleration(
        x, np.zeros(n), damping, inertia, np.eye(6), 0.0
    )
    power = kernels.damping_power(x, mass, damping)
    assert_allclose(power, -(mass * x[13 + n :]) @ elastic, rtol=1e-12)

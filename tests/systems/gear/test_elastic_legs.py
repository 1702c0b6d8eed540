"""The law of elastic legs: conservative but for its dampers, whatever the state."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose

from systems.gear.elastic_legs import elastic_forces, elastic_forces_of_floats

# Positions: [strut, three hinges] of one leg, then [strut, two hinges] of another.
PLACES = np.array([[[0, 1, 2, 3]] * 2, [[4, 5, -1, 6]] * 2])
RANGES = np.array([[0.0, 0.4], [0.0, -0.7]])
PLAY = np.array([[0.0, 0.0, 2e-3], [1e-3, 0.0, 0.0]])
N = 7


def _matrices() -> np.ndarray:
    """K and C of both legs at five positions, full and positive definite."""
    rng = np.random.default_rng(3)
    root = rng.normal(size=(2, 2, 5, 3, 3))
    definite = root @ root.transpose(0, 1, 2, 4, 3) + np.eye(3)
    return definite * np.array([1e6, 1e3])[None, :, None, None, None]


MATRICES = _matrices()
small = st.floats(-0.02, 0.02)


def law(q, v):
    given = np.concatenate([q, v]), PLACES, RANGES, MATRICES, PLAY, N, N
    found = elastic_forces(*given)
    for written, compiled in zip(found, elastic_forces_of_floats(*given)):
        assert_allclose(compiled, written, rtol=1e-9, atol=1e-9)
    return found


@settings(deadline=None, max_examples=50)
@given(arrays(float, N, elements=small), st.floats(0.01, 0.39), st.floats(-0.69, -0.01))
def test_forces_at_rest_are_the_slopes_of_the_energy(q, stroke, angle):
    q = q.copy()
    q[0], q[4] = stroke, angle
    force, _, power = law(q, np.zeros(N))
    assert power == 0.0
    h = 1e-7
    for i in range(N):
        step = h * np.eye(N)[i]
        forward, back = law(q + step, np.zeros(N))[1], law(q - step, np.zeros(N))[1]
        # Kinks of the tables and of the free play lie within a step.
        tolerance = 1e-4 * abs(force[i]) + 0.5
        kink = abs(forward + back - 2 * law(q, np.zeros(N))[1]) / h
        assert abs(force[i] + (forward - back) / (2 * h)) <= tolerance + kink


@settings(deadline=None, max_examples=50)
@given(arrays(float, N, elements=small), arrays(float, N, elements=st.floats(-9, 9)))
def test_power_lost_is_that_of_the_dampers(q, v):
    still, moving = law(q, np.zeros(N))[0], law(q, v)[0]
    power = law(q, v)[2]
    assert power >= 0.0
    assert_allclose(power, (still - moving) @ v, rtol=1e-9, atol=1e-6)


def test_nothing_elastic_acts_within_the_free_play():
    q = np.zeros(N)
    q[3] = 1.9e-3
    force, energy, _ = law(q, np.zeros(N))
    assert energy == 0.0
    assert not force.any()
    q[3] = 2.5e-3
    force, energy, _ = law(q, np.zeros(N))
    assert force[3] < 0.0 < energy


@pytest.mark.parametrize(("stroke", "at"), [(-0.1, 0), (0.9, 4), (0.2, 2)])
def test_stiffness_is_that_of_the_table_and_of_its_ends_beyond(stroke, at):
    q = np.zeros(N)
    q[0], q[1] = stroke, 0.01
    force = law(q, np.zeros(N))[0]
    assert_allclose(force[1:4], -MATRICES[0, 0, at, :, 0] * 0.01 * [1, 1, 0])
    if stroke in (-0.1, 0.9):
        assert force[0] == 0.0

"""Modes made slower: what stays, and what it does to a landing."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from benchmarks.landing_peers import BOUND_HZ, PUBLISHED
from benchmarks.lattice_landing import land, make_landing, modal_body
from systems.airframe.slow_modes import fastest_rate, with_slow_modes
from tests.systems.synthetic_body import aircraft_body


def _flexibility(body):
    stiffness = body.modal_mass * (2 * np.pi * body.frequency) ** 2
    shape = body.translation.reshape(-1, body.n)
    return (shape / stiffness) @ shape.T


def test_static_flexibility_and_slow_modes_stay():
    body = aircraft_body(40)
    slow = with_slow_modes(body, 15.0)
    assert slow.frequency.max() == 15.0
    assert_allclose(_flexibility(slow), _flexibility(body), rtol=1e-12)
    below = body.frequency < 15.0
    assert 3 < below.sum() < 40
    assert_allclose(slow.modal_mass[below], body.modal_mass[below], rtol=0)
    assert np.all(slow.modal_mass[~below] > body.modal_mass[~below])
    assert slow.modal_damping is body.modal_damping


def test_bound_must_be_positive():
    with pytest.raises(ValueError, match="highest_hz is 0"):
        with_slow_modes(aircraft_body(3), 0.0)


def test_rigid_body_has_no_modes_to_slow():
    assert with_slow_modes(aircraft_body(0), 10.0).n == 0
    assert fastest_rate(aircraft_body(0)) == 0.0


def test_fastest_rate_is_the_spectral_radius():
    for body in (aircraft_body(20), aircraft_body(60, 1.0)):
        n = body.n
        omega2 = np.diag((2 * np.pi * body.frequency) ** 2)
        damping = body.modal_damping / body.modal_mass[:, None]
        A = np.block([[np.zeros((n, n)), np.eye(n)], [-omega2, -damping]])
        radius = np.abs(np.linalg.eigvals(A)).max()
        assert_allclose(fastest_rate(body), radius, rtol=1e-6)


def test_landing_with_slow_modes_has_the_peaks_of_another_code():
    """Peaks of all gears, within 1 %, with a step that the fast modes forbid."""
    body = modal_body()
    slow = with_slow_modes(body, BOUND_HZ)
    assert fastest_rate(body) > 10 * fastest_rate(slow)
    landed = land(make_landing(slow), "runge_kutta3", 1e-3)
    assert landed.evaluations < 3000
    for name, expected in PUBLISHED.items():
        assert_allclose(landed.peaks[name], expected, rtol=3e-3)


@pytest.mark.slow
def test_slowing_modes_does_not_change_peak_loads():
    body = modal_body()
    exact = land(make_landing(body), "runge_kutta3", 1e-4).peaks
    slow = land(make_landing(with_slow_modes(body, BOUND_HZ)), "runge_kutta3", 1e-4)
    for name in PUBLISHED:
        assert_allclose(slow.peaks[name], exact[name], rtol=1e-4)

"""Resampling keeps impulse, shape and silence."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drake_landing.landing.handover import (
    AttachmentLoads,
    distinct_instants,
    resample,
    smooth_curve,
    time_grid,
)


def uneven(count: int, end: float, seed: int = 1) -> np.ndarray:
    steps = np.random.default_rng(seed).uniform(0.3, 1.7, count)
    time = np.concatenate([[0], np.cumsum(steps)])
    return time * end / time[-1]


@given(st.integers(0, 1000), st.floats(2e-4, 5e-3))
def test_impulse_and_first_moment_are_those_of_the_logged_curve(
    seed: int, step: float
) -> None:
    # A pulse that begins and ends at zero inside the grid, at unlucky instants.
    time = uneven(300, 0.5, seed)
    values = np.clip(np.sin(2 * np.pi * (time - 0.0511) / 0.713), 0, None) ** 2 * 1e5
    values[(time < 0.06) | (time > 0.4)] = 0
    curve = smooth_curve(time, values)
    grid = time_grid(step, 0.5)
    found = resample(time, values, grid)
    impulse = float(curve.integrate(0, time[-1]))
    assert step * found.sum() == pytest.approx(impulse, rel=1e-9)
    # integral of F t by parts: T I1(T) - I2(T) with the repeated integrals of F
    first, second = curve.antiderivative(1), curve.antiderivative(2)
    moment = 0.5 * float(first(0.5)) - float(second(0.5))
    assert step * found @ grid == pytest.approx(moment, rel=1e-7)


@pytest.mark.parametrize("frequency", [20.0, 50.0, 100.0])
def test_a_sine_keeps_amplitude_and_phase_to_fourth_order(frequency: float) -> None:
    time = uneven(40000, 0.5)
    grid = time_grid(1e-3, 0.5)
    found = resample(time, np.sin(2 * np.pi * frequency * time), grid)
    inside = slice(50, -50)
    basis = np.column_stack(
        [np.sin(2 * np.pi * frequency * grid), np.cos(2 * np.pi * frequency * grid)]
    )
    in_phase, quadrature = np.linalg.lstsq(basis[inside], found[inside], rcond=None)[0]
    x = np.pi * frequency * 1e-3
    assert in_phase == pytest.approx(1 - x**4 / 15, abs=0.1 * x**4 + 1e-6)
    assert quadrature == pytest.approx(0, abs=1e-6)


def test_averaging_weakens_what_the_grid_cannot_carry() -> None:
    time = uneven(100000, 0.2)
    grid = time_grid(1e-3, 0.2)
    found = resample(time, np.sin(2 * np.pi * 990.0 * time), grid)[20:-20]
    assert np.abs(found).max() < 5e-3  # sampling at the grid would give 1


def test_zero_before_touchdown_stays_zero() -> None:
    time = uneven(200, 0.5)
    values = np.where(time > 0.2, np.exp(time - 0.2) - 1, 0.0)
    found = resample(time, values, time_grid(1e-3, 0.5))
    before = time_grid(1e-3, 0.5) < 0.15
    assert np.abs(found[before]).max() < 1e-9


def test_a_linear_history_is_reproduced() -> None:
    time, grid = uneven(20, 1.0), time_grid(0.01, 1.0)
    found = resample(time, 3 * time, grid)
    assert found[5:-5] == pytest.approx(3 * grid[5:-5], rel=1e-6)


def test_event_duplicates_are_dropped() -> None:
    time = np.array([0.0, 0.1, 0.1 + 1e-17, 0.2, np.nextafter(0.2, 1), 0.3])
    assert distinct_instants(time).tolist() == [0, 2, 4, 5]
    values = np.array([0.0, 1.0, 1.0, 2.0, 2.0, 3.0])
    assert smooth_curve(time, values)(0.25) == pytest.approx(2.5)


def test_grid_reaches_the_duration() -> None:
    assert time_grid(0.1, 0.3) == pytest.approx([0, 0.1, 0.2, 0.3])
    assert time_grid(0.1, 0.31)[-1] == pytest.approx(0.4)


def test_loads_are_checked() -> None:
    with pytest.raises(ValueError, match="shape"):
        AttachmentLoads(
            time=np.arange(3.0), node_id=np.array([1]), load=np.zeros((3, 6))
        )
    with pytest.raises(ValueError, match="strictly increasing"):
        AttachmentLoads(
            time=np.array([0, 0.0]), node_id=np.array([1]), load=np.zeros((2, 1, 6))
        )
    uneven_loads = AttachmentLoads(
        time=np.array([0, 1.0, 3.0]), node_id=np.array([1]), load=np.zeros((3, 1, 6))
    )
    with pytest.raises(ValueError, match="even time grid"):
        _ = uneven_loads.step
    assert uneven_loads.resampled(0.5, 2.0).step == pytest.approx(0.5)

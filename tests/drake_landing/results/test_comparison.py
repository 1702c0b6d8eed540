"""Measures of agreement against closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drake_landing.results.comparison import (
    COLUMNS,
    RunLabel,
    agreement,
    comparison_table,
    correlation,
    peak,
    rms_error,
    shock_response_spectrum,
    sprague_geers,
)

# One whole period without its last instant: sums over it are exact.
TIME = np.arange(1000) / 1000
SINE = np.sin(2 * np.pi * TIME)


def shifted(fraction: float) -> np.ndarray:
    return np.sin(2 * np.pi * (TIME - fraction))


def test_peak_keeps_the_sign_and_the_instant() -> None:
    found = peak(TIME, np.where(TIME == 0.3, -2.0, SINE))
    assert (found.value, found.time) == (-2.0, 0.3)


@pytest.mark.parametrize("scale", [0.5, 1.0, 1.2])
def test_scaled_history(scale: float) -> None:
    found = agreement(TIME, SINE, scale * SINE)
    assert found.rms_error == pytest.approx(abs(scale - 1), abs=1e-12)
    assert found.peak_error == pytest.approx(scale - 1, abs=1e-12)
    assert found.correlation == pytest.approx(1)
    assert found.sprague_geers.magnitude == pytest.approx(scale - 1, abs=1e-12)
    # acos near 1 loses half of the digits
    assert found.sprague_geers.phase == pytest.approx(0, abs=1e-7)


@pytest.mark.parametrize("fraction", [0.05, 0.25, 0.5])
def test_late_history(fraction: float) -> None:
    late = shifted(fraction)
    found = sprague_geers(SINE, late)
    assert found.magnitude == pytest.approx(0, abs=1e-12)
    # a phase of pi is an error of 1
    assert found.phase == pytest.approx(2 * fraction, abs=1e-7)
    assert correlation(SINE, late) == pytest.approx(np.cos(2 * np.pi * fraction))
    # |sin(a) - sin(a-d)| has the amplitude 2 sin(d/2)
    assert rms_error(SINE, late) == pytest.approx(2 * np.sin(np.pi * fraction))


def test_combined_error_of_scaled_and_late_history() -> None:
    found = sprague_geers(SINE, 1.3 * shifted(0.1))
    assert found.combined == pytest.approx(np.hypot(0.3, 0.2), rel=1e-6)


def test_vanishing_reference_gives_nan_not_a_warning() -> None:
    found = agreement(TIME, 0 * SINE, SINE)
    assert np.isnan(found.rms_error)
    assert np.isnan(found.correlation)
    assert np.isnan(found.sprague_geers.combined)


@given(st.floats(0.1, 10), st.floats(-3, 3))
def test_measures_do_not_depend_on_units(unit: float, offset: float) -> None:
    candidate = SINE + offset * np.cos(6 * np.pi * TIME)
    a, b = (
        agreement(TIME, SINE, candidate),
        agreement(TIME, unit * SINE, unit * candidate),
    )
    assert a.rms_error == pytest.approx(b.rms_error, rel=1e-9, abs=1e-12)
    assert a.sprague_geers.combined == pytest.approx(
        b.sprague_geers.combined, rel=1e-6, abs=1e-6
    )


def test_shock_spectrum_of_a_step_is_the_overshoot_of_an_oscillator() -> None:
    quality, frequency = 10.0, np.array([5.0, 20.0, 40.0])
    zeta = 1 / (2 * quality)
    spectrum = shock_response_spectrum(
        np.ones(4000), 1e-3 / 4, frequency, quality=quality
    )
    # Absolute acceleration for a step of the base: damper and spring both pull, so
    # y'' = 1 - exp(-zeta w t)(cos(wd t) - zeta/sqrt(1-zeta²) sin(wd t)), largest where
    # its derivative vanishes: tan(wd t) = -2 zeta sqrt(1-zeta²)/(1-2 zeta²) + pi.
    root = np.sqrt(1 - zeta**2)
    angle = np.pi - np.arctan2(2 * zeta * root, 1 - 2 * zeta**2)
    overshoot = 1 - np.exp(-zeta / root * angle) * (
        np.cos(angle) - zeta / root * np.sin(angle)
    )
    assert spectrum == pytest.approx(overshoot, rel=2e-3)


def test_shock_spectrum_of_a_stiff_oscillator_is_the_peak_of_the_base() -> None:
    time = np.arange(0, 1, 1e-4)
    base = 9.0 * np.exp(-(((time - 0.4) / 0.05) ** 2))
    assert shock_response_spectrum(base, 1e-4, np.array([1500.0])) == pytest.approx(
        9.0, rel=1e-3
    )


def test_low_quality_is_refused() -> None:
    with pytest.raises(ValueError, match=r"quality 0\.4"):
        shock_response_spectrum(SINE, 1e-3, np.array([5.0]), quality=0.4)


def test_table_has_the_agreed_columns_and_hides_rounding_errors() -> None:
    label = RunLabel(
        run="a", aircraft="b", topology="1", basis="guyan", modes=3, highest_hz=9.5
    )
    fe = {"nose": np.column_stack([SINE, 1e-9 * SINE, 2 * SINE])}
    mbs = {"nose": np.column_stack([SINE, 1e-8 * SINE, 2.2 * SINE])}
    table = comparison_table(label, TIME, fe, mbs)
    assert list(table.columns) == COLUMNS
    assert table["axis"].tolist() == ["x", "y", "z"]
    assert table["rms_error"][2] == pytest.approx(0.1)
    assert table["peak_fe"][2] == pytest.approx(2, rel=1e-5)
    assert np.isnan(table["rms_error"][1])


def half_sine_response(frequency: float, duration: float, quality: float) -> float:
    """Largest absolute acceleration over the pulse's peak, in closed form."""
    omega, forced, zeta = 2 * np.pi * frequency, np.pi / duration, 0.5 / quality
    damped = omega * np.sqrt(1 - zeta**2)
    shape = -1 / (omega**2 - forced**2 + 2j * zeta * omega * forced)

    def ringing(t: np.ndarray, z: float, rate: float) -> tuple[np.ndarray, np.ndarray]:
        """Free motion from a displacement and a rate."""
        root = complex(-zeta * omega, damped)
        both = z - 1j * (rate + zeta * omega * z) / damped
        motion = both * np.exp(root * t)
        return motion.real, (root * motion).real

    inside = np.linspace(0.0, duration, 20001)
    steady = shape * np.exp(1j * forced * inside)
    start = ringing(inside, -shape.imag, -(1j * forced * shape).imag)
    z, rate = steady.imag + start[0], (1j * forced * steady).imag + start[1]
    after = np.linspace(0.0, 1 / frequency, 20001)
    left = ringing(after, z[-1], rate[-1])
    z, rate = np.append(z, left[0]), np.append(rate, left[1])
    return float(np.abs(2 * zeta * omega * rate + omega**2 * z).max())


@pytest.mark.parametrize("quality", [10.0, 1e5])
def test_shock_spectrum_of_a_half_sine_is_the_closed_form(quality: float) -> None:
    duration, step = 0.02, 1e-5
    time = step * np.arange(3001)
    pulse = np.sin(np.pi * time / duration) * (time < duration)
    frequency = np.array([3.0, 10.0, 40.5, 80.0, 300.0])
    found = shock_response_spectrum(pulse, step, frequency, quality=quality)
    true = [half_sine_response(f, duration, quality) for f in frequency]
    assert found == pytest.approx(true, rel=1e-4)


def test_undamped_half_sine_has_the_known_largest_amplification() -> None:
    # 1.768 where the oscillator swings 0.81 times within the pulse.
    frequency = np.linspace(0.7, 0.9, 41) / 0.02
    values = [half_sine_response(f, 0.02, 1e9) for f in frequency]
    assert max(values) == pytest.approx(1.768, abs=1e-3)
    assert 0.02 * frequency[np.argmax(values)] == pytest.approx(0.81, abs=0.01)

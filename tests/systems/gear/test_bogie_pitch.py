"""Pitch damper of a bogie: closed forms, energy, AutoDiff, ports."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.autodiffutils import AutoDiffXd

from systems.gear.bogie_pitch import (
    BogiePitch,
    BogiePitch_,
    BogiePitchParameters,
    pitch_energy,
    pitch_moment,
)

PARAMETERS = BogiePitchParameters(
    trim=0.1,
    stiffness=2e5,
    max_moment=1.5e4,
    damping=3e3,
    quadratic_damping=5e2,
    stop=0.3,
    stop_stiffness=4e6,
)


def test_spring_yields_at_its_limit():
    spring = BogiePitchParameters(trim=0.1, stiffness=2e5, max_moment=1.5e4)
    assert_allclose(pitch_moment(0.1001, 0.0, spring), -2e5 * 1e-4, rtol=1e-6)
    x = 0.15 - 0.1
    expected = -1.5e4 * math.tanh(2e5 * x / 1.5e4)
    assert_allclose(pitch_moment(0.15, 0.0, spring), expected, rtol=1e-12)
    assert_allclose(pitch_moment(-9.0, 0.0, spring), 1.5e4, rtol=1e-12)
    linear = replace(spring, max_moment=None)
    assert_allclose(pitch_moment(0.15, 0.0, linear), -2e5 * x, rtol=1e-12)


def test_damping_is_linear_and_quadratic():
    damper = BogiePitchParameters(damping=3e3, quadratic_damping=5e2)
    for rate in (-2.0, 0.7):
        expected = -(3e3 + 5e2 * abs(rate)) * rate
        assert_allclose(pitch_moment(0.2, rate, damper), expected)


@pytest.mark.parametrize("angle", [-0.35, -0.2, 0.05, 0.1, 0.29, 0.4])
def test_moment_is_the_slope_of_the_energy(angle):
    h = 1e-6
    slope = pitch_energy(angle + h, PARAMETERS) - pitch_energy(angle - h, PARAMETERS)
    moment = pitch_moment(angle, 0.0, PARAMETERS)
    assert_allclose(-slope / (2 * h), moment, rtol=1e-6, atol=1e-3)


def test_energy_balance_and_dissipation_at_every_rate():
    system = BogiePitch(PARAMETERS)
    context = system.CreateDefaultContext()
    for angle in (-0.34, 0.0, 0.33):
        for rate in (-8.0, -0.5, 0.5, 8.0):
            system.GetInputPort("pitch").FixValue(context, [angle, rate])
            torque, lost = (
                system.GetOutputPort(name).Eval(context)[0]
                for name in ("torque", "dissipated_power")
            )
            h = 1e-7
            stored = pitch_energy(angle + h * rate, PARAMETERS)
            stored -= pitch_energy(angle - h * rate, PARAMETERS)
            assert lost >= 0.0
            assert_allclose(stored / (2 * h) + lost, -torque * rate, rtol=1e-5)


def test_gradient_by_autodiff_is_the_difference_quotient():
    system = BogiePitch_[AutoDiffXd](PARAMETERS)
    context = system.CreateDefaultContext()
    x = np.array([0.31, 0.4])
    port = system.GetInputPort("pitch")
    port.FixValue(context, [AutoDiffXd(v, e) for v, e in zip(x, np.eye(2))])
    found = system.GetOutputPort("torque").Eval(context)[0].derivatives()
    h = 1e-6
    slopes = [
        (pitch_moment(*(x + e), PARAMETERS) - pitch_moment(*(x - e), PARAMETERS))
        / (2 * h)
        for e in h * np.eye(2)
    ]
    assert_allclose(found, slopes, rtol=1e-5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"stiffness": -1.0}, r"stiffness is -1.0 N m/rad, expected >= 0"),
        ({"max_moment": 0.0}, r"max_moment is 0.0 N m, expected > 0"),
        ({"stop": 0.05}, r"stop is 0.05 rad, expected >= 0.1"),
        ({"damping": float("nan")}, "damping is nan"),
    ],
)
def test_bad_parameters_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        replace(PARAMETERS, **change)

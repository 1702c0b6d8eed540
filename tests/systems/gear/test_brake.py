"""The brake: torque over time, anti-skid, standstill."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydrake.autodiffutils import InitializeAutoDiff
from scipy.integrate import solve_ivp

from systems.gear.brake import (
    AntiSkid,
    Brake,
    BrakeParameters,
    brake_torque,
    smooth_fall,
)
from systems.runway.runway import Runway
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters
from systems.tools.table import Table

RAMP = BrakeParameters(torque=Table((0.5, 1.5), (0.0, 8e3)))
SKID = BrakeParameters(torque=8e3, anti_skid=AntiSkid())


def torque(parameters, spin, *, time=0.0, contact=None, factor=None):
    system = Brake(parameters)
    context = system.CreateDefaultContext()
    context.SetTime(time)
    system.GetInputPort("wheel_spin").FixValue(context, [spin])
    if contact is not None:
        system.GetInputPort("contact").FixValue(context, contact)
    if factor is not None:
        context.get_mutable_numeric_parameter(0).SetAtIndex(0, factor)
    value = system.GetOutputPort("torque").Eval(context)[0]
    power = system.GetOutputPort("dissipated_power").Eval(context)[0]
    assert power == pytest.approx(-value * spin)
    return value


def test_torque_follows_the_table_over_time_against_the_spin():
    assert torque(RAMP, -100.0, time=0.2) == 0.0
    assert torque(RAMP, -100.0, time=1.0) == pytest.approx(4e3, rel=2e-5)
    assert torque(RAMP, 100.0, time=9.0) == pytest.approx(-8e3, rel=2e-5)
    assert torque(RAMP, -100.0, time=1.0, factor=0.5) == pytest.approx(2e3, rel=2e-5)


@given(
    spin=st.floats(-300.0, 300.0), slip=st.floats(-2.0, 2.0), load=st.floats(0.0, 3e5)
)
def test_brake_never_drives_the_wheel(spin, slip, load):
    value = brake_torque(8e3, spin, slip, load, SKID)
    assert value * spin <= 0.0
    assert abs(value) <= 8e3


def test_torque_is_smooth_and_zero_at_zero_spin():
    assert brake_torque(8e3, 0.0, 0.0, 0.0, RAMP) == 0.0
    slope = (brake_torque(8e3, 1e-6, 0, 0, RAMP)) / 1e-6
    assert slope == pytest.approx(-8e3 / 0.5)


def test_anti_skid_releases_over_slip_and_in_the_air():
    def at(slip, load):
        return torque(SKID, -100.0, contact=[0.05, load, 0.0, 0.0, slip, 0.0])

    assert at(0.05, 1e5) == pytest.approx(8e3, rel=2e-5)
    assert at(0.14, 1e5) == pytest.approx(4e3, rel=2e-5)
    assert at(0.25, 1e5) == 0.0
    assert at(0.0, 0.0) == 0.0


@given(x=st.floats(-1.0, 2.0), y=st.floats(-1.0, 2.0))
def test_fall_is_monotonic_between_one_and_nothing(x, y):
    low, high = sorted((x, y))
    assert 1.0 >= smooth_fall(low, 0.1, 0.9) >= smooth_fall(high, 0.1, 0.9) >= 0.0


def test_anti_skid_holds_the_wheel_near_the_peak_of_friction():
    """A braked wheel at constant speed: it locks without anti-skid, not with it."""
    law = TireLaw(TireParameters(radius=0.584, stiffness=2e6), Runway())
    speed, inertia = 60.0, 18.0

    def spin_down(parameters):
        def rate(t, y):
            wheel = [0, 0, 0.51, 0, 1, 0, -speed, 0, 0, 0, float(y[0]), 0]
            contact = law.contact(wheel, None, [1.0, 1.0, 1.0])
            brake = brake_torque(80e3, y[0], -contact[10], contact[7], parameters)
            return [(contact[1] + brake) / inertia]

        run = solve_ivp(rate, (0, 3.0), [-speed / 0.51], method="LSODA", rtol=1e-8)
        return 1.0 - abs(run.y[0, -1]) * 0.51 / speed

    assert spin_down(BrakeParameters(torque=80e3)) > 0.95
    assert 0.08 < spin_down(BrakeParameters(torque=80e3, anti_skid=AntiSkid())) < 0.2


def test_feedthrough_from_the_tire_exists_only_with_anti_skid():
    for parameters, expected in ((RAMP, False), (SKID, True)):
        system = Brake(parameters)
        spin = system.GetInputPort("wheel_spin").get_index()
        contact = system.GetInputPort("contact").get_index()
        for name in ("torque", "dissipated_power"):
            port = system.GetOutputPort(name).get_index()
            assert system.HasDirectFeedthrough(spin, port)
            assert system.HasDirectFeedthrough(contact, port) == expected


def test_gradient_agrees_with_finite_differences():
    system = Brake(SKID).ToAutoDiffXd()
    context = system.CreateDefaultContext()
    ad = InitializeAutoDiff(np.array([-0.4, 0.14, 6e3]))[:, 0]
    system.GetInputPort("wheel_spin").FixValue(context, ad[:1])
    zero = 0.0 * ad[0]
    system.GetInputPort("contact").FixValue(
        context, np.array([zero, ad[2], zero, zero, ad[1], zero])
    )
    gradient = system.GetOutputPort("torque").Eval(context)[0].derivatives()
    for i, h in enumerate((1e-6, 1e-6, 1e-2)):
        ends = []
        for sign in (1, -1):
            x = [-0.4, 0.14, 6e3]
            x[i] += sign * h
            ends.append(brake_torque(8e3, *x, SKID))
        assert gradient[i] == pytest.approx((ends[0] - ends[1]) / (2 * h), rel=1e-6)


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: BrakeParameters(torque=-1.0), "torque is -1.0 N m, expected >= 0.0"),
        (
            lambda: BrakeParameters(torque=Table((0, 1), (0, -5))),
            "torque table has -5.0 N m, expected >= 0",
        ),
        (lambda: AntiSkid(onset=0.3), "release is 0.2, expected > 0.3"),
        (
            lambda: BrakeParameters(torque=1.0, spin_transition=0.0),
            "spin_transition is 0.0 rad/s",
        ),
    ],
)
def test_bad_parameters_are_named_with_unit_and_range(build, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        build()

"""Pulses that elastic legs hand on to the airframe, expected before any landing."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drake_landing.airframe.pulses import through_leg, touchdown_pulses
from drake_landing.case.scenario import Scenario
from drake_landing.gears.leg_laws import leg_oscillators
from tests.drake_landing.gears.test_legs import FACTORS, KINDS, LEG, P_BA
from tests.drake_landing.landing_gears import aircraft_gears, changed

STEP = 1e-4


@pytest.mark.parametrize("ratio", FACTORS[0.0])
def test_spin_up_pulse_comes_out_with_the_factors_of_one_mass(ratio):
    rate, rise = 2 * np.pi * 12.0, ratio / 12.0
    time = STEP * np.arange(round((rise + 0.2) / STEP))
    drag = np.where(time <= rise, np.sin(0.5 * np.pi * time / rise), 0.0)
    out = through_leg(drag, STEP, (rate, 0.0))
    assert_allclose([out.max(), -out.min()], FACTORS[0.0][ratio], rtol=0.01)
    damped = through_leg(drag, STEP, (rate, 0.05))
    # Spring and damper together: within 1 % of the spring at 5 % of damping.
    assert_allclose([damped.max(), -damped.min()], FACTORS[0.05][ratio], rtol=0.015)
    # The impulse comes through a leg that ends at rest.
    after = through_leg(np.append(drag, np.zeros(20000)), STEP, (rate, 0.2))
    assert_allclose(after.sum(), drag.sum(), rtol=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_oscillators_have_the_frequencies_of_the_data(kind):
    found = leg_oscillators(changed(KINDS[kind](), leg=LEG), P_BA)
    for motion, hertz in (("fore_aft", 16.0), ("lateral", 20.0)):
        assert_allclose(found[motion], [2 * np.pi * hertz, 0.03], rtol=1e-9)
    assert leg_oscillators(KINDS[kind](), P_BA) == {}


def test_an_elastic_leg_changes_drag_alone_and_makes_it_swing_back():
    nose, left, right = aircraft_gears()
    elastic = changed(left, leg={"fore_aft": {"frequency": 16.0}})
    scenario = Scenario.model_validate({"sink_rate": 1.8, "forward_speed": 67.0})
    given = {"mass": 6.9e4, "p_AG": np.array([16.3, 0.0, -0.7]), "R_AB": np.eye(3)}
    places = {
        gear.attachment_node: np.mean(gear.axles, axis=0) + 1.5 * np.eye(3)[2]
        for gear in (nose, left, right)
    }
    rigid, bent = (
        touchdown_pulses([nose, gear, right], scenario, p_AN=places, **given)[1]
        for gear in (left, elastic)
    )
    assert_allclose(bent.load[0, :, 1:3], rigid.load[0, :, 1:3])
    forward = -bent.load[0, :, 0].min() / bent.load[0, :, 0].max()
    assert forward > 0.5
    assert -rigid.load[0, :, 0].min() < 0.2 * rigid.load[0, :, 0].max()

"""Landings whose lift follows the motion, with spoilers and reverse thrust."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError

from drake_landing.case.scenario import Scenario
from drake_landing.landing.trial import try_scenario
from tests.drake_landing.landing_gears import aircraft_gears
from tests.systems.synthetic_body import aircraft_body

WING = (*range(21, 28), *range(31, 38))
LIFT = {
    "nodes": WING,
    "decay_start": 0.05,
    "decay_duration": 0.1,
    "remaining": 0.5,
    "follows": {
        "area": 122.0,
        "slope": 5.2,
        "tail": {"nodes": (30, 40), "area": 31.0, "slope": 4.0, "lag": 0.2},
    },
    "reverse_thrust": {"nodes": (29, 39), "table": [(0.05, 0.0), (0.1, 1.5e5)]},
}


def test_lift_falls_as_the_sinking_stops_and_nothing_is_lost():
    scenario = Scenario(sink_rate=3.0, pitch=2.0, lift=LIFT)
    trial = try_scenario(
        aircraft_body(6), aircraft_gears(), scenario, duration=0.2, accuracy=1e-5
    )
    audit = trial.audit
    assert audit.energy < 1e-5
    assert np.abs(audit.momentum).max() < 1e-5
    assert audit.symmetry < 1e-7
    landing, context = trial.landing, trial.context
    lift = landing.loggers["lift.force"].FindLog(context)
    time, force = lift.sample_times(), lift.data()[0]
    weight = 9.80665 * (landing.body.mass + sum(g.mass for g in landing.gears))
    assert force[0] == pytest.approx(weight, rel=1e-9)
    before = force[time < 0.05]
    assert before[-1] < before[0]  # the sinking slows down
    assert force[-1] < 0.5 * weight
    thrust = landing.loggers["reverse_thrust.force"].FindLog(context).data()[0]
    assert_allclose([thrust[0], thrust[-1]], [0.0, 1.5e5])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"factor": 0.0}, "factor: found 0 beside follows"),
        (
            {"reverse_thrust": {"nodes": [1], "table": [(0.0, 1.0), (1.0, 2.0)]}},
            "table: begins with 1 N, expected 0 N",
        ),
        (
            {"reverse_thrust": {"nodes": [1], "table": [(0.0, 0.0), (0.0, 2.0)]}},
            "strictly ascending",
        ),
        ({"follows": {"area": -1.0, "slope": 5.0}}, "greater than 0"),
    ],
)
def test_bad_fields_are_named(changes, message):
    with pytest.raises(ValidationError, match=message):
        Scenario(sink_rate=1.0, lift=LIFT | changes)

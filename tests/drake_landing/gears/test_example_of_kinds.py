"""The shipped case with a levered nose gear and bogies lands, and bends its legs."""

from pathlib import Path

import numpy as np

from drake_landing.airframe.body import load_airframe
from drake_landing.case.reading import parse_case
from drake_landing.landing.trial import try_scenario
from drake_landing.process.aircraft import prepare_aircraft

CASE = Path(__file__).parents[3] / "cases" / "d150_bogie.yaml"


def test_levered_nose_gear_and_bogies_land(tmp_path):
    text = CASE.read_text(encoding="utf-8").replace("below 50 Hz", "count 2")
    case = parse_case(text)
    aircraft = prepare_aircraft(case, tmp_path)
    body = load_airframe(case.airframe, aircraft).body
    trial = try_scenario(
        body, aircraft.gears, case.scenario, duration=0.08, accuracy=1e-3
    )
    assert [gear.kind for gear in aircraft.gears] == ["levered", "bogie", "bogie"]
    logs = {
        name: log.FindLog(trial.context).data()
        for name, log in trial.landing.loggers.items()
    }
    # Trimmed front up, the rear wheels meet the ground first and turn the beam over.
    for side in ("left", "right"):
        rear, front = (
            logs[f"tire_main_{side}_{axle}_{side}.contact"][1]
            for axle in ("rear", "front")
        )
        assert np.argmax(rear > 1e3) < np.argmax(front > 1e3)
        assert logs[f"elastic_legs.deflection_main_{side}"][0].max() > 1e-3
    assert trial.audit.energy < 1e-4
    assert trial.audit.symmetry < 1e-6

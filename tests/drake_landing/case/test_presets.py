"""Presets of CS-25: what they keep, and what their loads must look like."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drake_landing.case.presets import PRESETS
from drake_landing.case.reading import parse_case
from drake_landing.case.scenario import Scenario
from drake_landing.landing.lift import aircraft_mass_center
from drake_landing.landing.start import make_scenario_diagram
from drake_landing.landing.trial import try_scenario
from fem.errors import InputError
from tests.drake_landing.landing_gears import aircraft_gears, changed
from tests.systems.synthetic_body import aircraft_body

G = 9.80665
WING = (*range(21, 28), *range(31, 38))
BRAKE = {"torque_table": [(0.05, 0.0), (0.1, 6.5e4)], "anti_skid": {}}


def _gears():
    nose, *mains = aircraft_gears()
    return (nose, *(changed(gear, brake=BRAKE) for gear in mains))


def _run(scenario, *, modes=8, duration=0.16, accuracy=1e-5):
    body = aircraft_body(modes)
    trial = try_scenario(body, _gears(), scenario, duration=duration, accuracy=accuracy)
    return trial.audit, trial.peaks


@pytest.fixture(scope="module", params=PRESETS)
def preset_run(request):
    given = {"preset": request.param}
    if lift := PRESETS[request.param].values.get("lift", "none") != "none":
        given["lift"] = {**PRESETS[request.param].values["lift"], "nodes": WING}
    scenario = Scenario.model_validate(given)
    duration = 0.4 if scenario.start == "rolling" else 0.16
    modes = 0 if lift else 8
    return request.param, *_run(scenario, modes=modes, duration=duration, accuracy=1e-4)


def test_energy_and_momentum_are_kept(preset_run):
    _, found, _ = preset_run
    assert found.energy < 1e-4
    assert np.abs(found.momentum).max() < 1e-4


def test_symmetric_conditions_stay_symmetric(preset_run):
    name, found, _ = preset_run
    if PRESETS[name].symmetric:
        assert found.symmetry < 1e-8
    elif PRESETS[name].values.get("start") != "rolling":  # roughness begins later
        assert found.symmetry > 0.1


def test_loads_are_those_of_the_condition(preset_run):
    name, _, loads = preset_run
    vertical, drag, side = loads["vertical"], loads["drag_ratio"], loads["side_ratio"]
    assert drag.max() < 0.8 + 1e-6  # friction that 25.473(e) allows
    if PRESETS[name].values.get("start") != "rolling" and name != "derotation":
        assert loads["stroke"]["main_right"] > 0.25
        assert drag["main_right"] > 0.6  # spin-up
    if name in ("tail_down", "rolled"):
        assert vertical["nose"] == 0.0
    if name == "rolled":
        assert vertical["main_right"] > 5 * vertical["main_left"]
    if name == "drift":
        # Nose to starboard of the track: the runway pushes to starboard, in line with
        # the slip to the side beside that of spin-up.
        assert side["main_left"] > 0.5
        assert drag["main_left"] > 0.4
    if name == "taxi_bump":
        assert loads["drag_ratio"].abs().max() < 0.05
        assert vertical["nose"] > 1.2 * 67.8e3
    if name == "braked_roll":
        assert_allclose(drag["main_left"], 0.8, atol=0.02)
        assert drag["nose"] < 0.05


def test_a_bounced_landing_touches_twice():
    lift = {**PRESETS["second_touchdown"].values["lift"], "nodes": WING}
    scenario = Scenario.model_validate({"preset": "second_touchdown", "lift": lift})
    trial = try_scenario(
        aircraft_body(0), _gears(), scenario, duration=1.55, accuracy=1e-3
    )
    vertical = trial.history("main_left").vertical
    touched = np.flatnonzero(np.diff((vertical > 0.0).astype(int)) == 1)
    assert len(touched) == 2
    left = np.flatnonzero(np.diff((vertical > 0.0).astype(int)) == -1)
    assert vertical.index[touched[1]] > vertical.index[left[0]] + 0.5  # in the air
    assert vertical.iloc[touched[1] :].max() > 0.5 * G * 68e3 / 2


def test_brakes_at_touchdown_keep_the_drag_until_the_vertical_peak():
    share = {}
    for name in ("two_point", "high_drag"):
        scenario = Scenario.model_validate({"preset": name})
        trial = try_scenario(
            aircraft_body(0), _gears(), scenario, duration=0.3, accuracy=1e-3
        )
        table = trial.history("main_left")
        at = table.vertical.idxmax()
        share[name] = table.drag[at] / table.vertical[at]
    assert share["two_point"] < 0.1
    assert share["high_drag"] > 0.5


def test_derotation_drives_the_nose_gear_by_its_rate():
    """The nose wheel comes down with ω times its distance to the main wheels."""
    peaks = {}
    for rate in (-6.0, -3.0):
        given = {"preset": "derotation", "pitch_rate": rate}
        scenario = Scenario.model_validate(given)
        _, loads = _run(scenario, modes=0, duration=0.85, accuracy=1e-3)
        peaks[rate] = loads["vertical"]["nose"]
    assert peaks[-6.0] > 1.2 * peaks[-3.0]


def test_tracks_of_a_rough_runway_load_both_sides_differently():
    scenario = Scenario.model_validate({"preset": "take_off_run"})
    found, loads = _run(scenario, modes=0, duration=0.6, accuracy=1e-3)
    left, right = (loads["vertical"][f"main_{side}"] for side in ("left", "right"))
    assert abs(left - right) > 0.01 * right
    assert found.energy < 1e-3


def test_braked_nose_load_is_about_that_of_the_dynamic_formula():
    """25.493(e): V_N = W/(A + B) [B + f μ A E/(A + B + μ E)], f = 2 undamped."""
    scenario = Scenario.model_validate({"preset": "braked_roll"})
    _, loads = _run(scenario, modes=0, duration=0.7, accuracy=1e-4)
    mass, center = aircraft_mass_center(aircraft_body(0), _gears())
    A, B = center[0] - 5.07, 17.71 - center[0]
    # Struts about static: the ground is some 0.55 m nearer than extended.
    E = center[2] + 4.30 - 0.55
    mu, friction = 0.8, 2.0
    dynamic = friction * mu * A * E / (A + B + mu * E)
    expected = mass * G / (A + B) * (B + dynamic)
    # f = 2 is the overshoot of a linear spring; gas stiffens toward the full stroke.
    found = loads["vertical"]["nose"]
    assert expected < found < 1.25 * expected


def test_lift_and_gravity_in_a_scenario():
    lift = {"nodes": WING, "decay_start": 0.02, "decay_duration": 0.1}
    scenario = Scenario.model_validate({"preset": "two_point", "lift": lift})
    found, loads = _run(scenario, modes=3, accuracy=1e-4)
    assert found.energy < 1e-4
    assert np.abs(found.momentum).max() < 1e-4
    plain = Scenario.model_validate({"preset": "two_point"})
    _, without = _run(plain, modes=3, accuracy=1e-4)
    assert loads["stroke"]["main_left"] > without["stroke"]["main_left"] + 0.005


def test_a_fall_of_the_lift_needs_its_duration():
    for lift in ({"decay_start": 0.1, "remaining": 0.3}, {"remaining": 0.3}):
        with pytest.raises(ValueError, match="decay_duration: found none beside"):
            Scenario.model_validate({"lift": {"nodes": WING} | lift})


def test_heights_in_another_unit_are_said_to_be_the_profiles(tmp_path):
    file = tmp_path / "heights.csv"
    file.write_text("0,0\n1,50\n2,0\n3,50\n4,0\n")
    profile = {"kind": "measured", "file": str(file)}
    scenario = Scenario.model_validate(
        {"sink_rate": 1.0, "runway": {"profile": profile}}
    )
    message = r"scenario.runway.profile: heights.csv: radius .* heights in m"
    with pytest.raises(InputError, match=message):
        try_scenario(aircraft_body(0), _gears(), scenario, duration=0.01)


def test_history_of_a_gear_has_its_peaks():
    scenario = Scenario.model_validate({"preset": "two_point"})
    trial = try_scenario(
        aircraft_body(0), _gears(), scenario, duration=0.12, accuracy=1e-3
    )
    table, peaks = trial.history("main_left"), trial.peaks.loc["main_left"]
    for column in ("vertical", "drag", "stroke"):
        assert table[column].max() == peaks[column]
    assert table["vertical"].idxmax() == peaks["time"]
    # Spring-back: the largest forward load on the airframe comes after spin-up.
    change = table["fx"] - table["fx"].iloc[0]
    assert peaks["spring_back"] == -change.min() > 0.0
    assert change.idxmin() > table["drag"].idxmax()
    assert peaks["spring_back"] < change.max()
    # Sprung and unsprung masses are between tires and airframe.
    assert_allclose(table["fz"].max(), peaks["vertical"], rtol=0.15)
    with pytest.raises(ValueError, match="no gear 'main', expected one of nose, main"):
        trial.history("main")


def test_values_beside_a_preset_override_it():
    scenario = Scenario.model_validate({"preset": "tail_down", "pitch": 8.0})
    assert scenario.pitch == 8.0
    assert scenario.sink_rate == 3.048
    assert scenario.forward_speed == 58.0
    again = Scenario.model_validate(scenario.model_dump())
    assert again == scenario


def test_every_preset_is_valid_and_says_what_it_is():
    for name, preset in PRESETS.items():
        scenario = Scenario.model_validate({"preset": name})
        for field, value in preset.values.items():
            if not isinstance(value, dict):
                assert getattr(scenario, field) == value
        assert "25." in preset.paragraph
        assert preset.mass
        assert preset.remarks


def test_bump_lies_ahead_of_the_foremost_tire():
    scenario = Scenario.model_validate({"preset": "taxi_bump"})
    landing = make_scenario_diagram(aircraft_body(0), _gears(), scenario)
    nose = 5.07 - landing.body.p_BG[0]
    assert landing.runway.height(nose - 4.9, 0.0) == 0.0
    assert_allclose(landing.runway.height(nose - 10.0, 0.0), 0.05)


def _case(scenario: str) -> str:
    return f"name: a\nairframe:\n  model: con\nscenario:\n{scenario}"


@pytest.mark.parametrize(
    ("scenario", "message"),
    [
        ("  preset: tail_dwn", "did you mean 'tail_down'"),
        ("  preset: taxi_bump\n  pitch: 3", "pitch: an aircraft that rolls"),
        ("  preset: taxi_bump\n  lift: weight", "gravity must act"),
        ("  sink_rate: 2\n  lift: {nods: [1]}", "did you mean 'nodes'"),
        ("  sink_rate: 2\n  lift: {nodes: [1, 2], shares: [1]}", "1 for 2 nodes"),
        ("  sink_rate: 2\n  braking: -1", "scenario.braking: found -1"),
        (
            "  sink_rate: 2\n  runway: {profile: {kind: measured, file: no.csv}}",
            "no.csv, expected a file that is there",
        ),
        ("  sink_rate: 2\n  runway: {profile: {kind: bumb}}", "bump, waves, step"),
        ("  sink_rate: 2\n  runway: {surface: oily}", "'dry', 'wet' or 'icy'"),
    ],
)
def test_bad_scenarios_have_one_message(scenario, message):
    with pytest.raises(InputError) as caught:
        parse_case(_case(scenario))
    assert message in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_braking_without_brakes_is_refused():
    scenario = Scenario.model_validate({"preset": "braked_roll"})
    with pytest.raises(ValueError, match="no gear has a brake"):
        make_scenario_diagram(aircraft_body(0), aircraft_gears(), scenario)


def test_bump_narrower_than_a_wheel_is_refused():
    profile = {"kind": "bump", "height": 0.2, "length": 0.5}
    scenario = Scenario.model_validate(
        {"preset": "taxi_bump", "runway": {"profile": profile}}
    )
    with pytest.raises(ValueError, match="longer"):
        make_scenario_diagram(aircraft_body(0), _gears(), scenario)

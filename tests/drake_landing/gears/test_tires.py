"""Tires in a case: what follows from width and pressure, a tire per wheel, messages."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.case.reading import parse_case
from drake_landing.gears.parameters import tire_parameters
from drake_landing.gears.tire_data import Tire
from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.reference.d150.gears import landing_gears
from fem.errors import InputError
from systems.runway.runway import Runway
from systems.tire.aircraft_tire import TireSize
from systems.tire.tire_law import TireLaw
from tests.drake_landing.landing_gears import aircraft_gears, changed
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import aircraft_body

HERE = Path(__file__).parents[1]
SIZED = {"radius": 0.584, "stiffness": 2e6, "width": 0.4318, "pressure": 1.531e6}


def test_cornering_trail_and_carcass_follow_from_width_and_pressure():
    found = tire_parameters(Tire(**SIZED, carcass="elastic"))
    size = TireSize(diameter=1.168, width=0.4318, rated_pressure=1.531e6)
    load = TireLaw(found, Runway()).elastic_force(0.1)
    assert found.cornering.value(0.1) == pytest.approx(
        size.cornering_power(load), rel=1e-3
    )
    trail = 0.8 * size.half_contact_length(0.1)
    assert found.trail.value(0.1) == pytest.approx(trail, rel=1e-3)
    assert found.lateral_stiffness.value(0.1) == pytest.approx(
        size.lateral_stiffness(0.1), rel=1e-3
    )


def test_given_figures_come_before_those_of_the_size():
    data = Tire(
        **SIZED,
        cornering_slope=6.5,
        pneumatic_trail=0.1,
        carcass="elastic",
        lateral_stiffness=1.8e6,
    )
    found = tire_parameters(data)
    law = TireLaw(found, Runway())
    assert law.ratios(0.1, 0.0, -1e-3)[1] == pytest.approx(6.5e-3, rel=1e-3)
    assert found.trail.value(0.1) == 0.1
    assert found.lateral_stiffness == 1.8e6
    table = tire_parameters(
        Tire(**SIZED, cornering_table=[(0.0, 1e3), (1e5, 8e5), (3e5, 9e5)])
    )
    assert table.cornering.value(0.1) == pytest.approx(8.5e5, rel=1e-3)


def test_plain_tire_has_no_states_and_the_slope_of_its_friction():
    found = tire_parameters(Tire(radius=0.5, stiffness=1e6))
    assert not found.lagged
    assert TireLaw(found, Runway()).ratios(0.05, 0.0, -1e-4)[1] == pytest.approx(
        16e-4, rel=1e-3
    )
    assert found.rolling_radius == pytest.approx(1 / 3)


def test_paper_set_has_the_laws_of_the_paper_and_the_other_one_has_not():
    for paper in (True, False):
        for gear in landing_gears(paper):
            found = tire_parameters(gear.tyre)
            assert (found.rolling_radius == 1.0) == paper
            assert (found.cornering is None) == paper
            assert found.lagged == (not paper)
            assert (found.hysteresis == 0.0) == paper


def test_a_flat_tire_leaves_the_load_to_the_other_one():
    gears = list(aircraft_gears())
    sized = gears[1].tyre.model_dump(exclude_unset=True) | {
        "width": 0.43,
        "pressure": 1.5e6,
    }
    gears[1] = changed(gears[1], tyre=sized, tyres={"main_left_left": {"inflation": 0}})
    assert gears[1].tire_of("main_left_left").inflation == 0.0
    assert gears[1].tire_of("main_left_right").inflation == 1.0
    run = land(
        MakeLandingDiagram(aircraft_body(0), gears), duration=0.05, accuracy=1e-3
    )
    flat, full = (
        run[f"tire_main_left_{side}.contact"][1].max() for side in ("left", "right")
    )
    assert 0.05 * full < flat < 0.12 * full


# --- messages

CASE = (HERE / "tiny_case.yaml").read_text()
TIRE = "    tyre: {radius: 0.35, stiffness: 500000.0, damping: 600.0"
LINE = 1 + CASE[: CASE.index(TIRE)].count("\n")


@pytest.mark.parametrize(
    ("added", "expected"),
    [
        ("width: 0.2", "tyre: pressure: found none, expected width and pressure"),
        ("width: 0.2, pressure: 14", "tyre.pressure: found 14, expected greater than"),
        ("width: 0.9, pressure: 1.0e+6", "width: found 0.9 m, expected less than"),
        ("inflation: 0.5", "inflation: found 0.5, which needs width and pressure"),
        ("carcass: soft", "tyre.carcass: found 'soft', expected 'rigid' or 'elastic'"),
        ("carcass: elastic", "an elastic one needs fore_aft_stiffness and"),
        ("lateral_stiffness: 1.0e+6", "found rigid, expected elastic beside"),
        ("hysteresis: 2", "tyre.hysteresis: found 2, expected less than or equal"),
        ("rolling_resistance: -1", "tyre.rolling_resistance: found -1, expected"),
        ("cornering_slope: 0", "tyre.cornering_slope: found 0, expected greater"),
        ("pneumatic_trail: -0.1", "tyre.pneumatic_trail: found -0.1, expected"),
        ("cornering_table: [[0, 1], [1, 0]]", "values > 0"),
        ("rolling_radius: [[0, 0.35], [0.1, 0.1]]", "found 0.1 to 0.35 m, expected"),
        ("magic_formula: no.tir", "tyre.magic_formula: found"),
        ("rolling_radius: middle", "rolling_radius"),
        ("fore_aft_stiffness: x", "tyre.fore_aft_stiffness: found 'x', expected"),
    ],
)
def test_bad_tire_is_named_with_its_line(added, expected):
    text = CASE.replace(TIRE, f"{TIRE}, {added}", 1)
    with pytest.raises(InputError) as error:
        parse_case(text, file="tiny.yaml", folder=HERE)
    assert any(
        expected in p and p.startswith(f"tiny.yaml:{LINE}: gears.main_right")
        for p in error.value.problems
    ), error.value.problems


def test_bad_property_file_is_named_with_its_line(tmp_path):
    (tmp_path / "bad.tir").write_text("[MODEL]\nFITTYP = 3\n")
    text = CASE.replace(TIRE, f"{TIRE}, magic_formula: bad.tir", 1)
    with pytest.raises(InputError, match=rf":{LINE}: .*line 2: found FITTYP 3"):
        parse_case(text, file="tiny.yaml", folder=tmp_path)


def test_tire_of_an_unknown_wheel_is_named():
    text = CASE.replace(TIRE, f"    tyres: {{main_right: {{damping: 0}}}}\n{TIRE}", 1)
    with pytest.raises(InputError, match="one of the wheels main_right_left, main"):
        parse_case(text, file="tiny.yaml", folder=HERE)
    text = CASE.replace(
        TIRE, f"    tyres: {{main_right_left: {{dampin: 0}}}}\n{TIRE}", 1
    )
    with pytest.raises(InputError, match=rf"tiny.yaml:{LINE}.*did you mean 'damping"):
        parse_case(text, file="tiny.yaml", folder=HERE)


def test_schema_lets_a_single_tire_say_only_what_differs():
    field = type(aircraft_gears()[0]).model_json_schema()["properties"]["tyres"]
    assert field["additionalProperties"] == {"type": "object"}


def test_flat_tire_survives_a_round_trip_of_the_case():
    gear = changed(
        aircraft_gears()[1],
        tyre=SIZED,
        tyres={"main_left_left": {"inflation": 0.5}},
    )
    again = type(gear).model_validate(gear.model_dump(mode="json"))
    assert again == gear
    assert np.isclose(again.tire_of("main_left_left").inflation, 0.5)

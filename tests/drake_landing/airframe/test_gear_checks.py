"""Gears that do not fit their aircraft: wrong units, wrong places, odd loads."""

import json

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError

from drake_landing.airframe.gear_checks import (
    gear_problems,
    gear_remarks,
    leg_problems,
    static_loads,
)
from drake_landing.airframe.gear_places import (
    clearances,
    pitch_of_all,
    place_remarks,
    shell_attachments,
)
from drake_landing.case.reading import load_case
from drake_landing.gears.attachment_points import attachment_places
from drake_landing.landing.initial_state import attitude
from drake_landing.process.explain import explain
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure
from tests.drake_landing.landing_gears import (
    aircraft_gears,
    bogie_main,
    changed,
    levered_main,
)
from tests.systems.synthetic_body import aircraft_body

BODY = aircraft_body(0)
NOSE, LEFT, RIGHT = aircraft_gears()


def _places(gears):
    return attachment_places(BODY, gears)


def _remarks(*gears):
    return gear_remarks(gears, BODY.mass, BODY.p_BG)


def _absorber(gear, **changes):
    return changed(gear, shock_absorber=gear.shock_absorber.model_dump() | changes)


def _tire(gear, **changes):
    return changed(gear, tyre=gear.tyre.model_dump() | changes)


@pytest.mark.parametrize("main", [lambda name: None, levered_main, bogie_main])
def test_gears_that_fit_have_neither_problems_nor_remarks(main):
    left, right = (main(g.name) or g for g in (LEFT, RIGHT))
    gears = (NOSE, left, right)
    assert gear_problems(gears, _places(gears)) == []
    assert _remarks(*gears) == ()


def test_static_loads_balance_the_weight():
    gears = (NOSE, LEFT, RIGHT)
    loads = static_loads(gears, BODY.mass, BODY.p_BG)
    weight = 9.80665 * (BODY.mass + sum(gear.mass for gear in gears))
    assert_allclose(sum(loads.values()), weight)
    assert_allclose(loads["main_left"], loads["main_right"])
    # The reference aircraft's nose gear carries a tenth of it.
    assert 0.08 < loads["nose"] / weight < 0.13


def test_a_deck_that_points_the_other_way_is_noticed():
    aft = changed(NOSE, axle=(30.0, 0.0, NOSE.axle[2]))
    (remark,) = (r for r in _remarks(aft, LEFT, RIGHT) if "forward" in r)
    assert remark.startswith("airframe.axes.forward: gear nose lies ")


def test_one_gear_alone_cannot_carry_an_aircraft():
    assert static_loads([LEFT], BODY.mass, BODY.p_BG) is None
    assert _remarks(LEFT) == ()
    (beside,) = place_remarks([LEFT], _places([LEFT]), BODY.mass, BODY.p_BG)[-1:]
    assert "of all wheels: it cannot stand on them" in beside


def _places_told(*gears):
    return place_remarks(gears, _places(gears), BODY.mass, BODY.p_BG)


def test_gears_that_stand_well_have_no_remarks_on_places():
    assert _places_told(NOSE, LEFT, RIGHT) == []


def test_two_gears_on_one_grid_and_a_wheel_on_the_other_side_are_said():
    both = changed(RIGHT, attachment_node=LEFT.attachment_node)
    told = _places_told(NOSE, LEFT, both)
    assert any(f"is that of {LEFT.name} too" in text for text in told)
    assert any("m to port" in text and "m to starboard" in text for text in told)


@pytest.mark.parametrize(("x", "where"), [(60.0, "ahead of"), (-5.0, "behind")])
def test_a_center_of_gravity_outside_all_wheels_is_said(x, where):
    gears = [changed(g, axle=(x, *g.axle[1:])) for g in (LEFT, RIGHT)]
    assert any(f"m {where} all wheels" in text for text in _places_told(*gears))


def test_all_gears_touch_at_the_pitch_that_is_told():
    gears = (NOSE, LEFT, RIGHT)
    raised = changed(NOSE, axle=(*NOSE.axle[:2], NOSE.axle[2] + 0.08))
    level = clearances((raised, LEFT, RIGHT), np.eye(3))
    before = clearances(gears, np.eye(3))
    assert level["nose"] - before["nose"] == pytest.approx(0.08, abs=1e-9)
    pitch = pitch_of_all((raised, LEFT, RIGHT))
    assert pitch is not None
    assert pitch < pitch_of_all(gears)
    found = clearances((raised, LEFT, RIGHT), attitude(0.0, pitch, 0.0))
    assert max(found.values()) < 1e-9
    assert pitch_of_all((LEFT, RIGHT)) is None


def test_a_bare_shell_grid_is_no_fitting(tmp_path):
    text = """BEGIN BULK
MAT1,1,7.+10,,.3,2700.
PSHELL,1,1,.01,1,,1
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,9,,.5,.5,0.
CQUAD4,1,1,1,2,3,4
RBE3,7,,9,123456,1.,123,1,2
,3,4
ENDDATA
"""
    (tmp_path / "a.bdf").write_text(text)
    structure = Structure.from_deck(read_deck(tmp_path / "a.bdf"))
    (told,) = shell_attachments(structure, {2: "gears.a", 9: "gears.b"})
    assert told.startswith("gears.a: grid 2 belongs to shells only (CQUAD4)")


@pytest.mark.parametrize(
    ("gear", "field"),
    [
        (changed(LEFT, axle=(17710.0, -3795.0, -3716.0)), "axle"),
        (
            changed(LEFT, piston=LEFT.piston.model_dump() | {"cg": (17.7, -3.8, -315)}),
            "piston.cg",
        ),
        (changed(levered_main(), absorber_upper=(17.3, 37.0, -1.9)), "absorber_upper"),
    ],
)
def test_millimetres_for_metres_are_found(gear, field):
    (problem, *_) = gear_problems([gear], _places([gear]))
    assert problem.startswith(f"gears.main_left.{field}: found a point ")
    assert "expected less than 10 m; all lengths are in m" in problem


def test_axle_above_its_attachment_is_found():
    x, y, z = LEFT.axle
    gear = changed(LEFT, axle=(x, y, -z))
    (problem,) = gear_problems([gear], _places([gear]))
    assert problem.startswith("gears.main_left.axle: found an axle ")
    assert "above the attachment node 102, expected it below" in problem
    bogie = bogie_main()
    high = tuple((x, y, -z) for x, y, z in bogie.axle_positions)
    (problem,) = gear_problems([changed(bogie, axle_positions=high)], _places([gear]))
    assert problem.startswith("gears.main_left.axle_positions: ")


def test_root_of_a_leg_lies_above_its_axle_and_near():
    x, y, z = LEFT.axle
    law = {"frequency": 9.0}
    for root, message in (
        ((x, y, z - 0.5), "found a point 0.5 m below the axle, expected it above"),
        ((x, y, 1e3 * z), "found a point 3715 m away from the attachment node 102"),
    ):
        gear = changed(LEFT, leg={"root": root, "fore_aft": law})
        problem = gear_problems([gear], _places([gear]))[0]
        assert problem.startswith(f"gears.main_left.leg.root: {message}")


@pytest.mark.parametrize(
    ("left", "message"),
    [
        (
            _absorber(LEFT, precharge_force=400e3),
            "shock_absorber.precharge_force: found 400 kN, but the shock absorber "
            "carries 313.6 kN at rest: it stays extended",
        ),
        (
            _absorber(LEFT, precharge_force=45.0),
            "shock_absorber: the gas gives 1.19",
        ),
        (
            _absorber(LEFT, precharge_force=2e3, gas_length=0.475),
            "shock_absorber.precharge_force: found 2000 N, but ",
        ),
        (
            _absorber(LEFT, gas_length=2.0),
            "shock_absorber: the gas gives 65",
        ),
        (_tire(LEFT, stiffness=2000.0), "tyre.stiffness: at rest 160"),
        (_tire(LEFT, stiffness=2e9), "tyre.stiffness: at rest 160"),
        (
            changed(LEFT, tyres={"main_left_right": {"stiffness": 2e9}}),
            "tyres.main_left_right.stiffness: at rest 160",
        ),
    ],
)
def test_odd_loads_at_rest_are_remarked(left, message):
    (remark, *_) = _remarks(NOSE, left, RIGHT)
    assert remark.startswith(f"gears.main_left.{message}")


def test_a_gear_heavier_than_the_airframe_is_remarked():
    heavy = changed(LEFT, fitting=LEFT.fitting.model_dump() | {"mass": 1e20})
    (remark, *_) = _remarks(NOSE, heavy, RIGHT)
    assert remark.startswith("gears.main_left: found 1e+20 kg, more than the airframe")
    # Not the difference of two masses: its drop divides by it.
    assert heavy.unsprung_mass == LEFT.unsprung_mass > 0.0


def test_gas_of_a_levered_gear_is_held_against_the_load_on_its_absorber():
    gear = levered_main()
    assert not any("precharge" in r for r in _remarks(NOSE, gear, RIGHT))
    stiff = _absorber(gear, precharge_force=700e3)
    (remark,) = _remarks(NOSE, stiff, RIGHT)
    # The absorber sits at a shorter arm than the axle: it carries more than the wheel.
    carried = float(remark.split("carries ")[1].split(" kN")[0])
    assert 320.0 < carried < 700.0


def test_a_center_of_gravity_behind_the_main_wheels_is_remarked():
    behind = BODY.p_BG + np.array([3.0, 0.0, 0.0])
    found = gear_remarks([NOSE, LEFT, RIGHT], BODY.mass, behind)
    assert found[0].startswith("gears.nose: carries -")
    assert "outside the wheels" in found[0]


@pytest.mark.parametrize(
    ("part", "change", "message"),
    [
        ("shock_absorber", {"stroke": 313.0, "gas_length": 520.0}, "equal to 2"),
        ("shock_absorber", {"gas_length": 520.0}, "equal to 10"),
        ("tyre", {"radius": 584.0}, "equal to 2"),
        (
            "tyre",
            {"stiffness": None, "load_table": [(0, 0), (100, 2e5)]},
            "deflection of 100 m, expected less than the radius, 0.584 m",
        ),
        ("tyre", {"bottoming_deflection": 250.0}, "deflection of 250 m"),
        (
            "shock_absorber",
            {"compression_metering": [(0, 1), (400, 3)]},
            "stroke of 400 m, expected about 0.47 m",
        ),
    ],
)
def test_lengths_in_millimetres_are_refused(part, change, message):
    data = getattr(LEFT, part).model_dump() | change
    with pytest.raises(ValidationError, match=message):
        changed(LEFT, **{part: data})


def test_wheels_far_apart_are_refused():
    with pytest.raises(ValidationError, match="within 5 m of the middle of the axle"):
        changed(LEFT, wheel_offsets=(-465.0, 465.0))


def test_check_of_a_case_says_file_line_and_field(tmp_path):
    gears = [gear.model_dump(mode="json") for gear in (NOSE, LEFT, RIGHT)]
    for gear, node in zip(gears, (17001, 17002, 17003)):
        gear["attachment_node"] = node
    gears[1]["axle"] = [17.71, -3.795, 3.716]
    file = tmp_path / "case.yaml"
    lines = ["name: a", "airframe: {model: con}", "scenario: {sink_rate: 1}", "gears:"]
    for gear in gears:
        items = [f"{key}: {json.dumps(value)}" for key, value in gear.items()]
        lines += ["  - " + items[0], *("    " + item for item in items[1:])]
    file.write_text("\n".join(lines))
    case = load_case(file)
    with pytest.raises(InputError) as caught, case.places.located():
        explain(case)
    (problem,) = caught.value.problems
    line = 1 + lines.index("    axle: [17.71, -3.795, 3.716]")
    assert problem.startswith(f"{file}:{line}: gears.main_left.axle: found an axle ")


def test_remarks_do_not_depend_on_the_frame_of_the_deck():
    moved = [np.array([100.0, 0.0, 5.0])] * 3
    shifted = []
    for gear, by in zip((NOSE, LEFT, RIGHT), moved):
        data = gear.model_dump()
        for part in ("fitting", "piston"):
            data[part]["cg"] = tuple(np.array(data[part]["cg"]) + by)
        shifted.append(changed(gear, **data | {"axle": tuple(gear.axle + by)}))
    found = static_loads(shifted, BODY.mass, BODY.p_BG + moved[0])
    wanted = static_loads((NOSE, LEFT, RIGHT), BODY.mass, BODY.p_BG)
    assert_allclose(list(found.values()), list(wanted.values()), rtol=1e-9)


def _soft(leg):
    gear = changed(LEFT, leg=leg)
    return leg_problems([NOSE, gear, RIGHT], _places([NOSE, gear, RIGHT]))


def test_a_leg_whose_stiffness_is_in_kilonewtons_is_refused():
    (problem,) = _soft({"fore_aft": {"stiffness": 4500.0}})
    assert problem.startswith("gears.main_left.leg.fore_aft: found a leg that swings")
    assert problem.endswith("expected more than 2 Hz: is its stiffness in N/m?")
    lengths = {"cylinder_length": 1.6, "overhang": 1.066, "bearing_distance": 0.5}
    beam = {"cylinder_bending": 2.5e7, "piston_bending": 1e7} | lengths
    assert _soft({"beam": beam}) == []
    told = _soft({"beam": beam | {"cylinder_bending": 2.5e4, "piston_bending": 1e4}})
    assert [text.split(":")[0] for text in told] == ["gears.main_left.leg.beam"]
    assert _soft({"fore_aft": {"frequency": 1.5}}) == []  # as it is meant

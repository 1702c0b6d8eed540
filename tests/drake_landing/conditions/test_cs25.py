"""Every paragraph of CS-25 against a hand calculation of one transport, to 0.1 %."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from drake_landing.conditions import (
    flat_tires25,
    landing25,
    rolling25,
    towing25,
    turning25,
)
from drake_landing.conditions.cs23 import CS23
from drake_landing.conditions.cs25 import CS25
from drake_landing.conditions.ground import BookCase
from drake_landing.conditions.statics import resultant
from tests.drake_landing.conditions.aircraft import G, taildragger, transport

W = 60e3 * G  # 588.4 kN
CLOSE = 1e-3


def totals(case: BookCase) -> dict[str, np.ndarray]:
    """Gear -> sum of its forces: drag, side, vertical."""
    found: dict[str, np.ndarray] = {}
    for one in case.loads:
        found[one.gear] = found.get(one.gear, np.zeros(3)) + one.force
    return found


def approx(*values: float):
    """(3,) to 0.1 % of the largest."""
    size = max(map(abs, values))
    return pytest.approx(np.array(values), rel=CLOSE, abs=CLOSE * size)


def test_479_d1_level_landing_has_a_quarter_of_the_vertical_load_aft_at_the_axle():
    two, three = landing25.level_drag(transport())
    assert totals(two) == {
        "left": approx(125e3, 0, 500e3),
        "right": approx(125e3, 0, 500e3),
    }
    assert totals(three)["nose"] == approx(50e3, 0, 200e3)
    assert totals(three)["left"] == approx(100e3, 0, 400e3)
    assert {one.at for one in two.loads} == {"axle"}
    assert two.lift == 1.0


def test_479_d2_drift_takes_75_percent_and_of_that_40_and_25():
    right, left = landing25.drift(transport())
    assert totals(right)["left"] == approx(150e3, 93.75e3, 375e3)
    assert totals(left)["left"] == approx(150e3, -93.75e3, 375e3)
    assert right.pose == "reduced"
    assert {one.at for one in right.loads} == {"ground"}


def test_481_tail_down_adds_no_drag():
    (case,) = landing25.tail_down(transport())
    assert totals(case)["left"] == approx(0, 0, 550e3)
    assert case.pose == "tail_down"


def test_483_one_gear_has_the_very_load_of_479_d1_and_the_other_none():
    left, right = landing25.one_gear(transport())
    assert totals(left) == {"left": approx(125e3, 0, 500e3)}
    assert totals(right) == {"right": approx(125e3, 0, 500e3)}


def test_485_side_load_is_80_percent_inward_and_60_outward_of_half_the_vertical():
    starboard, port = landing25.side(transport())
    # To starboard: inward on the port gear.
    assert totals(starboard)["left"] == approx(0, 200e3, 250e3)
    assert totals(starboard)["right"] == approx(0, 150e3, 250e3)
    assert totals(port)["right"] == approx(0, -200e3, 250e3)
    assert totals(port)["left"] == approx(0, -150e3, 250e3)


def test_487_rebound_is_20_g_of_the_unsprung_parts_as_they_extend():
    mains, nose = landing25.rebound(transport())
    assert totals(mains)["left"] == approx(0, 0, -20 * 800 * G)
    assert totals(nose)["nose"] == approx(0, 0, -20 * 200 * G)


def test_491_discrete_taxi_load_is_1_7_of_rest():
    (case,) = rolling25.taxi(transport())
    assert totals(case)["nose"] == approx(0, 0, 1.7 * W / 12)


@pytest.mark.parametrize(("design", "n"), [("take_off", 1.0), ("landing", 1.2)])
def test_493_b_braked_roll(design: str, n: float):
    every, mains = rolling25.braked_roll(transport(design=design))
    # V_N = n W (B + µE)/(A + B + µE) = n W 3.4/14.4
    nose = n * W * 3.4 / 14.4
    main = (n * W - nose) / 2
    assert totals(every)["nose"] == approx(0, 0, nose)
    assert totals(every)["left"] == approx(0.8 * main, 0, main)
    assert totals(mains)["left"] == approx(0.4 * n * W, 0, n * W / 2)
    assert "nose" not in totals(mains)
    moment = resultant(every.loads, transport().poses["static"])[1]
    assert abs(moment[1]) < 1e-9 * W


def test_493_c_drag_is_no_more_than_the_brakes_give():
    every, mains = rolling25.braked_roll(transport(torque=50e3))
    # 100 kN each; V_N = (W B + 2 D E)/(A + B)
    nose = (W * 1.0 + 2 * 100e3 * 3.0) / 12.0
    assert totals(every)["nose"] == approx(0, 0, nose)
    assert totals(every)["left"] == approx(100e3, 0, (W - nose) / 2)
    assert totals(mains)["right"] == approx(100e3, 0, W / 2)
    assert mains.note == (
        "drag limited by the brakes' torque, 0.34 of the vertical load (left, right) "
        "instead of 0.8"
    )
    assert all(not case.note for case in rolling25.braked_roll(transport()))


def test_493_e_formula_and_its_statics_at_f_of_one():
    (case,) = rolling25.sudden_braking(transport())
    # W/12 (1 + 2·0.8·11·3/14.4) = 49 033·4.6667
    assert totals(case)["nose"] == approx(0, 0, 228.822e3)
    # The drag stays that of V_N = W (B + 0.8 E)/14.4, so that it is above 0.8 V.
    share = 0.8 * (1.0 - 3.4 / 14.4) / (1.0 - 228.822e3 / W)
    assert f"{share:.2f} of the vertical load" in case.note
    assert sum(f[2] for f in totals(case).values()) == pytest.approx(W)
    damped = rolling25.sudden_nose_load(transport(damping=0.3))
    f = 1 + math.exp(-math.pi * 0.3 / math.sqrt(1 - 0.09))
    assert damped == pytest.approx(W / 12 * (1 + f * 26.4 / 14.4), rel=CLOSE)
    (static,) = [c for c in rolling25.braked_roll(transport()) if "(1)" in c.paragraph]
    heavy = rolling25.sudden_nose_load(transport(damping=0.999999))
    assert heavy == pytest.approx(totals(static)["nose"][2], rel=CLOSE)


def test_495_turn_moves_half_w_e_over_track_to_the_outer_gear():
    starboard, port = turning25.turning(transport())
    shift = 0.5 * W * 3.0 / 7.0
    main = W * 11 / 24
    assert totals(starboard)["left"] == approx(0, 0.5 * (main + shift), main + shift)
    assert totals(port)["left"] == approx(0, -0.5 * (main - shift), main - shift)
    assert totals(starboard)["nose"] == approx(0, W / 24, W / 12)
    moment = resultant(starboard.loads, transport().poses["static"])[1]
    assert np.abs(moment).max() < 1e-9 * W


def test_497_tail_wheel_has_its_load_at_rest_to_the_side():
    cases = list(turning25.tail_wheel_yaw(taildragger()))
    assert totals(cases[0])["tail"] == approx(0, 980.665, 980.665)
    assert [c.loads[2].at for c in cases[:2]] == ["axle", "ground"]


def test_499_a_nose_wheel_has_80_percent_to_the_side():
    starboard, _ = turning25.nose_yaw(transport())
    assert totals(starboard)["nose"] == approx(0, 0.8 * W / 12, W / 12)
    assert totals(starboard)["left"] == approx(0, 0, W * 11 / 24)


def test_499_b_brakes_of_one_side_are_held_by_the_nose_wheel():
    aircraft = transport()
    starboard, port = turning25.one_side_braked(aircraft)
    # V_N = W (B + 0.4 E)/(A + B + 0.4 E) = W 2.2/13.2; D = 0.4 V_M; Y = D 3.5/12
    nose, drag = W * 2.2 / 13.2, 0.4 * W * 11 / 13.2
    assert totals(starboard)["nose"] == approx(0, -drag * 3.5 / 12, nose)
    assert totals(port)["nose"] == approx(0, drag * 3.5 / 12, nose)
    assert totals(starboard)["right"][0] == pytest.approx(drag, rel=CLOSE)
    assert totals(starboard)["left"][0] == 0.0
    force, moment = resultant(starboard.loads, aircraft.poses["static"])
    assert abs(force[1]) < 1e-9 * W
    assert np.abs(moment).max() < 1e-9 * W


def test_499_e_steering_is_the_full_torque_with_1_33_of_rest():
    starboard, _ = turning25.steering(transport())
    assert totals(starboard)["nose"] == approx(0, 0, 1.33 * W / 12)
    assert starboard.loads[0].moment[2] == pytest.approx(-5e3)


def test_503_pivoting_torque_is_friction_times_the_wheels_distance():
    aircraft = transport()
    case = next(turning25.pivoting(aircraft))
    torque = 0.8 * W * 11 / 24 * 0.45
    assert case.name.endswith("torque turns nose to starboard")
    assert case.loads[1].moment[2] < 0.0  # about up: negative is to starboard
    locked = next(one for one in case.loads if one.gear == "left")
    assert abs(locked.moment[2]) == pytest.approx(torque, rel=CLOSE)
    assert abs(totals(case)["nose"][1]) == pytest.approx(torque / 12, rel=CLOSE)
    force, moment = resultant(case.loads, aircraft.poses["static"])
    assert abs(force[1]) < 1e-9 * W
    assert abs(moment[2]) < 1e-9 * W


def test_507_reversed_braking_is_55_percent_forward_or_1_2_times_the_torque():
    (case,) = rolling25.reversed_braking(transport())
    main = W * 11 / 24
    assert totals(case)["left"] == approx(-0.55 * main, 0, main)
    assert totals(case)["nose"] == approx(0, 0, W / 12)
    (weak,) = rolling25.reversed_braking(transport(torque=50e3))
    assert totals(weak)["left"][0] == pytest.approx(-1.2 * 50e3 / 0.5)


@pytest.mark.parametrize(
    ("pounds", "tow"),
    [(20e3, 6000.0), (30e3, 9000.0), (60e3, 11571.43), (100e3, 15e3), (150e3, 22.5e3)],
)
def test_509_towing_load_is_continuous_in_the_weight(pounds: float, tow: float):
    newton = towing25.POUND_FORCE
    assert towing25.towing_load(pounds * newton) == pytest.approx(
        tow * newton, rel=CLOSE
    )


def test_509_towing_reactions():
    cases = {c.name: c for c in towing25.towing(transport())}
    assert len(cases) == 24
    tow = 0.15 * W
    held, free = (
        cases[f"towed at main gears, forward, {how}"]
        for how in ("(i) held at the axle", "(ii) by inertia")
    )
    main = W * 11 / 24
    assert totals(free)["left"] == approx(-0.75 * tow, 0, main)
    assert totals(held)["left"] == approx(0, 0, main)
    oblique = cases["towed at main gears, aft at 30° to starboard, (ii) by inertia"]
    along = 0.75 * tow * math.cos(math.radians(30))
    assert totals(oblique)["left"] == approx(along, 0, main)  # side at its ground line
    for case in cases.values():  # named by where the tow pulls
        pulled = next(one for one in case.loads if one.what == "tow")
        if "30°" in case.name:
            assert ("starboard" in case.name) == (pulled.force[1] > 0.0)
    nose = cases["towed at nose, aft, (ii) by inertia"]
    assert totals(nose)["nose"] == approx(tow, 0, W / 12)
    nose = cases["towed at nose, aft, (i) held at the axle"]
    assert totals(nose)["nose"] == approx(tow - W / 12, 0, W / 12)
    turned = cases["towed at nose, forward, wheel turned +45°, (ii) by inertia"]
    part = 0.5 * tow / math.sqrt(2)
    assert totals(turned)["nose"] == approx(-part, -part, W / 12)


def test_511_flat_tires():
    cases = list(landing25.flat_tire_landing(transport()))
    assert totals(cases[0])["left"] == approx(0.6 * 125e3, 0, 0.6 * 500e3)
    side = next(c for c in cases if "25.485" in c.name)
    assert totals(side)["left"] == approx(0, 0.6 * 200e3, 250e3)
    handling = {c.name: c for c in flat_tires25.flat_tire_handling(transport())}
    turn = handling["one flat: 25.495 turn, load to starboard"]
    assert totals(turn)["nose"] == approx(0, W / 48, W / 12)
    # Of twins one tire is left with its own drag, more than 40 % of both.
    braked = handling["one flat: 25.493(b)(2) braked, main gears, n = 1"]
    assert totals(braked)["left"] == approx(0.5 * 0.4 * W, 0, W / 2)
    # All gears: 11 N = (1 + 0.4 * 3) M, with N + M = W.
    every = handling["one flat: 25.493(b)(1) braked, all gears, no pitching, n = 1"]
    assert totals(every)["left"] == approx(W / 6, 0, 5 * W / 12)
    assert totals(every)["nose"] == approx(0, 0, W / 6)
    towed = handling["one flat: 25.509 towed at nose, aft, (ii) by inertia"]
    assert totals(towed)["nose"] == approx(0.6 * 0.15 * W, 0, W / 12)


def test_511_without_brakes_turns_and_tows():
    cases = flat_tires25.flat_tire_handling(transport(torque=0.0))
    assert {c.name.split(": ")[1][:6] for c in cases} == {"25.495", "25.509"}


def test_519_jacking_is_1_33_with_a_third_any_way():
    cases = [c for c in towing25.jacking(transport()) if "jacked at left" in c.name]
    main = W * 11 / 24
    assert totals(cases[0])["left"] == approx(0, 0, 1.33 * main)
    assert totals(cases[3])["left"] == approx(0, 0.33 * main, 1.33 * main)
    assert len(cases) == 5


def test_every_reason_names_what_to_set():
    whole = [transport(torque=0.0), transport(design="landing"), taildragger()]
    empty = replace(transport(), gears=(), steering_torque=None)
    aircraft = [*whole, empty, replace(empty, stall_speed=None)]
    single = [replace(g, wheels=1, largest=None) for g in transport().gears]
    aircraft.append(replace(transport(), gears=tuple(single), stall_speed=50.0))
    reasons = {p.missing(a) for p in (*CS25, *CS23) for a in aircraft if p.cases}
    reasons.discard("")
    assert len(reasons) >= 8
    for text in reasons:
        assert re.search(r"\b(conditions\.\w+|gears)\b", text), text


def test_what_cannot_apply_says_why():
    by_number = {p.number: p for p in CS25}
    bare = transport(torque=0.0)
    assert "brakes" in by_number["25.493(b)"].missing(bare)
    assert by_number["25.497"].missing(bare).startswith("no tail wheel (")
    assert by_number["25.499(a)"].missing(taildragger()).startswith("no nose gear (")
    landing = transport(design="landing")
    assert "ramp weight" in by_number["25.495"].missing(landing)
    assert not by_number["25.479(d)(1)"].missing(landing)


def test_every_paragraph_from_471_to_519_stands_in_the_table():
    wanted = [471, 473, 477, 479, 481, 483, 485, 487, 489, 491, 493, 495, 497, 499]
    wanted += [503, 507, 509, 511, 519]
    found = {int(p.number[3:6]) for p in CS25}
    assert found == set(wanted)

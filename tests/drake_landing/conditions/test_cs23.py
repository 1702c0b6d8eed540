"""Every paragraph of CS-23 against a hand calculation of one commuter, to 0.1 %."""

import math

import numpy as np
import pytest

from drake_landing.conditions import cases23
from drake_landing.conditions.cs23 import CS23
from drake_landing.conditions.statics import resultant
from tests.drake_landing.conditions.aircraft import G, commuter, taildragger
from tests.drake_landing.conditions.test_cs25 import CLOSE, approx, totals

W = 12500 * 0.45359237 * G  # 55.603 kN
GROUND = 140e3 / W  # 2.5178
INERTIA = GROUND + 2 / 3
DRAG = 0.33 * INERTIA * W  # 58.43 kN


@pytest.mark.parametrize(
    ("mass", "area", "feet"),
    [(1000.0, 16.0, 8.3228), (5670.0, 28.0, 10.0), (400.0, 30.0, 7.0)],
)
def test_473_sink_rate(mass: float, area: float, feet: float):
    assert cases23.sink_rate(mass, area) == pytest.approx(feet * 0.3048, rel=CLOSE)


def test_473_least_factors():
    slow = taildragger()  # 28 kN over 9.8 kN
    assert cases23.ground_factor(slow) == pytest.approx(28e3 / (1000 * G), rel=CLOSE)
    assert max(2.67 - 2 / 3, 2.0) == pytest.approx(2.0033, rel=CLOSE)


def test_507_jacks_are_called_so():
    cases = list(cases23.jacking(commuter()))
    jacked = [one.what for case in cases for one in case.loads if one.at == "axle"]
    assert jacked == ["jack"] * len(cases)


def test_appendix_c_drag_factor():
    pounds = [2000.0, 3000.0, 4500.0, 6000.0, 9000.0]
    found = [cases23.drag_factor(p * cases23.POUND_FORCE) for p in pounds]
    assert found == pytest.approx([0.25, 0.25, 0.29, 0.33, 0.33])


def test_479_nose_clear_and_inclined_reactions():
    clear, inclined = cases23.level(commuter())
    assert totals(clear)["left"] == approx(DRAG / 2, 0, 70e3)
    # Parallel reactions, aft by κ: arms about the c.g. 1.5 m above them.
    kappa = DRAG / 140e3
    ahead, behind = 5.0 - 1.5 * kappa, 0.5 + 1.5 * kappa
    nose = 140e3 * behind / (ahead + behind)
    assert totals(inclined)["nose"] == approx(kappa * nose, 0, nose)
    moment = resultant(inclined.loads, commuter().poses["largest"])[1]
    assert abs(moment[1]) < 1e-6 * W
    assert clear.lift == pytest.approx(2 / 3)


def test_479_c_spin_up_by_appendix_d():
    up, back = cases23.spin_up(commuter())
    # √(2·1.5·48·0.8·70e3/0.1)/0.3 = 29 933 N
    force = math.sqrt(2 * 1.5 * 1.2 * 40 * 0.8 * 70e3 / 0.1) / 0.3
    assert force == pytest.approx(29933, rel=CLOSE)
    assert totals(up)["left"] == approx(force, 0, 70e3)
    assert totals(back)["left"] == approx(-force, 0, 70e3)


def test_481_483_tail_down_and_one_wheel():
    (down,) = cases23.tail_down(commuter())
    assert totals(down)["left"] == approx(0, 0, 70e3)
    left, _ = cases23.one_wheel(commuter())
    assert totals(left) == {"left": approx(DRAG / 2, 0, 70e3)}
    (three,) = cases23.tail_down(taildragger())
    assert totals(three)["tail"] == approx(0, 0, 2.8e3)


def test_485_side_load_counts_from_the_weight():
    starboard, _ = cases23.side(commuter())
    assert totals(starboard)["left"] == approx(0, 0.5 * W, 0.665 * W)
    assert totals(starboard)["right"] == approx(0, 0.33 * W, 0.665 * W)


def test_493_braked_roll_at_1_33():
    mains, every = cases23.braked_roll(commuter())
    assert totals(mains)["left"] == approx(0.8 * 0.665 * W, 0, 0.665 * W)
    nose = 1.33 * W * (0.5 + 1.2) / (5.5 + 1.2)
    assert totals(every)["nose"] == approx(0, 0, nose)


def test_497_tail_wheel():
    obstruction, starboard, _ = cases23.tail_wheel(taildragger())
    part = 2.8e3 / math.sqrt(2)
    assert totals(obstruction)["tail"] == approx(part, 0, part)
    assert totals(starboard)["tail"] == approx(0, 0.1 * 1e3 * G, 0.1 * 1e3 * G)


def test_499_nose_wheel():
    aft, forward, starboard, _ = cases23.nose_wheel(commuter())
    z = 2.25 * W / 11
    assert totals(aft)["nose"] == approx(0.8 * z, 0, z)
    assert totals(forward)["nose"] == approx(-0.4 * z, 0, z)
    assert totals(starboard)["nose"] == approx(0, 0.7 * z, z)
    steered, _ = cases23.steering(commuter())
    assert totals(steered)["nose"] == approx(0, 0, 1.33 * W / 11)
    assert steered.loads[0].moment[2] == pytest.approx(-1.33 * 800)


def test_507_509_jacking_and_towing():
    cases = list(cases23.jacking(commuter()))
    assert len(cases) == 27
    assert totals(cases[4])["nose"] == approx(0.4 * W / 11, 0.4 * W / 11, 1.35 * W / 11)
    tow = {c.name: c for c in cases23.towing23(commuter())}
    main = tow["towed at main gears, forward, (ii) by inertia"]
    assert totals(main)["left"] == approx(-0.225 * W, 0, W * 5 / 11)
    nose = tow["towed at nose, aft, wheel turned +45°, (ii) by inertia"]
    assert np.hypot(*totals(nose)["nose"][:2]) == pytest.approx(0.15 * W, rel=CLOSE)


def test_511_pivoting_unequal_and_flat_tires():
    pivot = next(cases23.pivoting23(commuter()))
    locked = next(one for one in pivot.loads if one.gear == "left")
    assert abs(locked.moment[2]) == pytest.approx(0.8 * W * 5 / 11 * 0.15, rel=CLOSE)
    cases = {(c.paragraph, c.name): c for c in cases23.unequal_tires(commuter())}
    name = "60 % on starboard wheels: 23.479 level, nose wheel clear"
    one = cases["23.511(b)", name].loads[0]
    # 60 and 40 % 0.15 m off the middle: 0.03 m of shift.
    assert one.moment == pytest.approx([0.03 * 70e3, 0, -0.03 * DRAG / 2], rel=CLOSE)
    flat = cases["23.511(c)", "one flat: 23.479 level, nose wheel clear"]
    assert totals(flat)["left"] == approx(0.6 * DRAG / 2, 0, 42e3)
    side = cases["23.511(c)", "one flat: 23.485 side load to starboard"]
    assert totals(side)["left"] == approx(0, 0.3 * W, 0.665 * W)


def test_every_paragraph_from_471_to_511_stands_in_the_table():
    wanted = {471, 473, 477, 479, 481, 483, 485, 493, 497, 499, 505, 507, 509, 511}
    assert {int(p.number[3:6]) for p in CS23} == wanted

"""The Magic Formula: what holds for any coefficients, signs on the wheel, bad files."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydrake.autodiffutils import InitializeAutoDiff

from systems.runway.runway import Runway
from systems.tire.magic_formula import MagicFormula
from systems.tire.tire import Tire
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters
from tests.systems.tire.test_tire import ONES, evaluate, rolling

TIR = """[MDI_HEADER]
FILE_TYPE = 'tir'
! written for this test
[UNITS]
LENGTH = 'meter'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'second'
[MODEL]
FITTYP = 61
[DIMENSION]
UNLOADED_RADIUS = 0.584  $ m
[VERTICAL]
FNOMIN = 200000
[LONGITUDINAL_COEFFICIENTS]
PCX1 = 1.6
PDX1 = 0.8
PDX2 = -0.05
PEX1 = 0.2
PKX1 = 16.0
PKX2 = -1.0
RBX1 = 12.0
RBX2 = -9.0
RCX1 = 1.1
[LATERAL_COEFFICIENTS]
PCY1 = 1.3
PDY1 = -0.75
PDY2 = 0.04
PEY1 = -0.8
PKY1 = -9.0
PKY2 = 1.6
PKY4 = 2.0
PKY6 = -0.6
RBY1 = 7.0
RBY2 = 2.5
RCY1 = 1.05
[ALIGNING_COEFFICIENTS]
QBZ1 = 8.0
QCZ1 = 1.2
QDZ1 = 0.12
QEZ1 = -2.0
"""


@pytest.fixture(scope="module")
def formula(tmp_path_factory):
    path = tmp_path_factory.mktemp("tir") / "tire.tir"
    path.write_text(TIR)
    return MagicFormula.from_file(path)


def tire(formula, **changes) -> TireParameters:
    return TireParameters(radius=0.584, stiffness=2e6, magic_formula=formula, **changes)


@pytest.mark.parametrize("load", [5e4, 2e5, 3e5])
def test_slopes_and_peaks_are_those_of_the_coefficients(formula, load):
    along, across = formula.slopes(load, 0.1)
    h = 1e-5
    assert formula.forces(load, h, 0.0, 0.0)[0] / h == pytest.approx(along, rel=1e-3)
    # ISO: sliding to the left is pushed to the right.
    assert formula.forces(load, 0.0, h, 0.0)[1] / h == pytest.approx(-across, rel=1e-3)
    dfz = load / 2e5 - 1.0
    slips = [i / 1000 for i in range(1, 3000)]
    drag = max(formula.forces(load, s, 0.0, 0.0)[0] for s in slips)
    assert drag == pytest.approx((0.8 - 0.05 * dfz) * load, rel=1e-3)
    side = max(abs(formula.forces(load, 0.0, s, 0.0)[1]) for s in slips)
    assert side == pytest.approx((0.75 - 0.04 * dfz) * load, rel=1e-3)


@given(kappa=st.floats(-1.0, 1.0), tangent=st.floats(-1.0, 1.0))
def test_slip_in_one_direction_takes_from_the_force_in_the_other(
    formula, kappa, tangent
):
    both = formula.forces(2e5, kappa, tangent, 0.0)
    along = formula.forces(2e5, kappa, 0.0, 0.0)
    across = formula.forces(2e5, 0.0, tangent, 0.0)
    assert abs(both[0]) <= abs(along[0]) + 1e-6
    assert abs(both[1]) <= abs(across[1]) + 1e-6
    mirrored = formula.forces(2e5, kappa, -tangent, 0.0)
    assert mirrored[0] == pytest.approx(both[0], abs=1e-6)
    assert mirrored[1:] == pytest.approx((-both[1], -both[2]), abs=1e-6)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_forces_on_the_wheel_oppose_sliding_and_turn_it_into_its_travel(formula, sense):
    wheel = [float(x) for x in rolling(side=3.0, share=0.8)]
    wheel[6], wheel[10] = sense * wheel[6], sense * wheel[10]
    result = TireLaw(tire(formula), Runway()).contact(wheel, None, ONES)
    assert result[8] * sense > 0.0
    assert result[9] < 0.0
    assert result[13] > 0.0
    assert result[2] * wheel[6] * wheel[7] > 0.0


def test_free_rolling_has_no_force_and_wet_runways_scale_it(formula):
    wheel = [float(x) for x in rolling(height=0.5)]
    wheel[10] = -70.0 / (0.584 - 0.084 / 3)
    law = TireLaw(tire(formula), Runway())
    assert law.contact(wheel, None, ONES)[8:10] == pytest.approx((0.0, 0.0), abs=1e-6)
    wheel[7] = 5.0
    dry, wet = (
        TireLaw(tire(formula), Runway(surface=name)).contact(wheel, None, ONES)[9]
        for name in ("dry", "wet")
    )
    assert wet / dry == pytest.approx(0.6)


def test_carcass_gives_it_relaxation_lengths(formula):
    law = TireLaw(
        tire(formula, fore_aft_stiffness=2.5e6, lateral_stiffness=2e6), Runway()
    )
    wheel = [float(x) for x in rolling(height=0.484, side=0.07)]
    rates = law.contact(wheel, [0.0, 0.0], ONES)[14:]
    length = law.slopes(0.1)[1] / 2e6
    assert rates[1] == pytest.approx(0.07 / length, rel=1e-3)


def test_gradients_agree_with_differences(formula):
    system = Tire(tire(formula))
    wheel = [float(x) for x in rolling(side=3.0, share=0.95, sink=1.0)]
    wrench = evaluate(
        system.ToAutoDiffXd(), "wrench", InitializeAutoDiff(wheel)[:, 0], None
    )
    h = 1e-6
    for i in (2, 6, 7, 10):
        up, down = list(wheel), list(wheel)
        up[i], down[i] = wheel[i] + h, wheel[i] - h
        slope = (evaluate(system, "wrench", up) - evaluate(system, "wrench", down)) / (
            2 * h
        )
        gradient = [value.derivatives()[i] for value in wrench]
        assert gradient == pytest.approx(slope, rel=1e-4, abs=10.0)


def test_camber_thrust_leans_with_the_wheel(formula):
    # PKY6 < 0: a wheel that leans to the right is pushed to the right.
    leaning = formula.forces(2e5, 0.0, 0.0, math.radians(3.0))[1]
    assert leaning < 0.0


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("FITTYP = 61", "FITTYP = 7", r"line 11: found FITTYP 7, expected one of 5"),
        ("LENGTH = 'meter'", "LENGTH = 'mm'", r"line 5: found LENGTH in 'mm'.*meter"),
        ("PCX1 = 1.6", "PCX1 = x", r"line 17: found PCX1 = 'x', expected a number"),
        ("PKY1 = -9.0", "", r"found no PKY1, expected the coefficients"),
        ("FNOMIN = 200000", "FNOMIN = 0", r"FNOMIN is 0.0, expected > 0"),
    ],
)
def test_bad_files_are_named_with_their_line(tmp_path, old, new, message):
    path = tmp_path / "bad.tir"
    path.write_text(TIR.replace(old, new))
    with pytest.raises(ValueError, match=message) as error:
        MagicFormula.from_file(path)
    assert str(path) in str(error.value)

"""The shock absorber: each part against its closed form, then the system alone."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydrake.autodiffutils import InitializeAutoDiff

from systems.shock_absorber.friction import bearing_reactions
from systems.shock_absorber.gas_spring import GasSpring, SecondChamber, series_split
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.strut_law import StrutLaw
from systems.shock_absorber.strut_parameters import (
    ShockAbsorberParameters,
    ShockAbsorberTunables,
)
from systems.tools.table import Table

ONE_CHAMBER = GasSpring(precharge=45e3, gas_length=0.52, area=0.02)
TWO_CHAMBERS = GasSpring(
    precharge=12e3,
    gas_length=0.31,
    exponent=1.1,
    second=SecondChamber(precharge=90e3, gas_length=0.15, exponent=1.3),
)


def strut(gas: GasSpring = ONE_CHAMBER, **changes) -> ShockAbsorberParameters:
    values = {
        "gas": gas,
        "max_stroke": 0.9 * gas.total_length,
        "compression_damping": 45e3,
        "rebound_damping": 180e3,
    } | changes
    return ShockAbsorberParameters(**values)


FULL = strut(
    seal_friction=0.05,
    bearing_friction=0.08,
    axle_arm=0.9,
    bearing_distance=0.6,
    compression_metering=Table((0.0, 0.2, 0.4), (0.5, 1.0, 3.0)),
    rebound_metering=Table((0.0, 0.1), (2.0, 1.0)),
)
ALL = [strut(), strut(TWO_CHAMBERS), FULL]


def test_gas_follows_the_polytropic_law():
    law = StrutLaw(strut())
    for s in (0.01, 0.2, 0.4):
        gas = law.forces(s, 0.0, 0.0, strut().tunables)[0]
        assert gas == pytest.approx(45e3 * (1 - s / 0.52) ** -1.4, rel=1e-14)


def test_isothermal_energy_is_a_logarithm():
    parameters = strut(GasSpring(precharge=45e3, gas_length=0.52, exponent=1.0))
    law = StrutLaw(parameters)
    # Beyond the release of the extension stop its energy is a constant.
    stop = 0.5 * 45e3**2 / parameters.extension_stop_stiffness
    work = -45e3 * 0.52 * math.log(1 - 0.3 / 0.52)
    assert law.energy(0.3, parameters.tunables) == pytest.approx(work - stop, rel=1e-13)


def test_energy_is_continuous_in_the_exponent_at_isothermal():
    law = StrutLaw(strut())
    near, at = (
        law.energy(0.3, [45e3, 0.52, n, 0.0, 0.0, 0.0, 0.0]) for n in (1 + 1e-6, 1.0)
    )
    assert near == pytest.approx(at, rel=1e-5)


@given(s=st.floats(0.0, 0.455))
def test_two_chambers_in_series_have_one_pressure_and_share_the_stroke(s):
    main, second = (12e3, 0.31, 1.1), (90e3, 0.15, 1.3)
    force, s1 = series_split(s, main, second)
    assert force == pytest.approx(12e3 * (1 - s1 / 0.31) ** -1.1, rel=1e-9)
    s2 = s - s1
    if s2 > 0:
        assert force == pytest.approx(90e3 * (1 - s2 / 0.15) ** -1.3, rel=1e-7)
    else:
        assert force <= 90e3


def test_second_chamber_softens_the_spring_once_its_piston_moves():
    alone = StrutLaw(
        strut(GasSpring(precharge=12e3, gas_length=0.31, exponent=1.1), max_stroke=0.3)
    )
    both = StrutLaw(strut(TWO_CHAMBERS))
    p, q = alone._p.tunables, both._p.tunables
    assert both.forces(0.2, 0, 0, q)[0] == alone.forces(0.2, 0, 0, p)[0]
    assert both.forces(0.29, 0, 0, q)[0] < 0.5 * alone.forces(0.29, 0, 0, p)[0]


@pytest.mark.parametrize("parameters", ALL)
def test_force_is_exactly_zero_at_rest(parameters):
    law = StrutLaw(parameters)
    assert law.forces(0.0, 0.0, 0.0, parameters.tunables).total == 0.0
    assert law.energy(0.0, parameters.tunables) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("parameters", ALL)
@given(share=st.floats(-0.05, 1.2), rate=st.floats(-4.0, 4.0))
def test_force_is_continuous_in_stroke_and_rate(parameters, share, rate):
    law, p = StrutLaw(parameters), parameters.tunables
    s = share * parameters.max_stroke
    f = law.forces(s, rate, 3e4, p).total
    step = 1e-9
    # Largest slope: gas tangent and stop, with damping at 4 m/s; friction over rate.
    slope = abs(law.forces(s + 1e-5, rate, 3e4, p).total - f) / 1e-5 + 1e9
    assert abs(law.forces(s + step, rate, 3e4, p).total - f) < 10 * slope * step
    assert abs(law.forces(s, rate + step, 3e4, p).total - f) < 10 * slope * step


@pytest.mark.parametrize("parameters", ALL)
@given(share=st.floats(-0.02, 1.1))
def test_static_force_rises_with_stroke(parameters, share):
    law, p = StrutLaw(parameters), parameters.tunables
    s = share * parameters.max_stroke
    assert law.forces(s + 1e-4, 0.0, 0.0, p).total > law.forces(s, 0.0, 0.0, p).total


@pytest.mark.parametrize("parameters", ALL)
@given(
    share=st.floats(-0.05, 1.2),
    rate=st.floats(-5.0, 5.0),
    side=st.floats(-1e5, 1e5),
)
def test_strut_never_makes_energy(parameters, share, rate, side):
    law, p = StrutLaw(parameters), parameters.tunables
    s = share * parameters.max_stroke
    assert law.forces(s, rate, side, p).dissipating * rate >= 0.0


@pytest.mark.parametrize("parameters", ALL)
@given(share=st.floats(-0.03, 1.1), rate=st.floats(-3.0, 3.0))
def test_stored_plus_dissipated_is_the_power_of_the_force(parameters, share, rate):
    law, p = StrutLaw(parameters), parameters.tunables
    s, h = share * parameters.max_stroke, 1e-6
    stored = (law.energy(s + h, p) - law.energy(s - h, p)) / (2 * h) * rate
    power = law.forces(s, rate, 2e4, p).total * rate
    balance = stored + law.forces(s, rate, 2e4, p).dissipating * rate - power
    # Central difference over a kink: half the jump of slope (1e8 N/m) times h.
    assert abs(balance) < 1e-6 * abs(power) + 60.0 * abs(rate) + 1e-6


@given(rate=st.floats(0.01, 5.0), depth=st.floats(1e-4, 0.02))
def test_stops_push_only(rate, depth):
    parameters = strut(stop_damping=5.0)
    law, p = StrutLaw(parameters), parameters.tunables
    *_, elastic, damper = law.forces(0.468 + depth, -rate, 0.0, p)
    assert elastic + damper >= 0.0
    *_, elastic, damper = law.forces(-depth, rate, 0.0, p)
    assert elastic + damper <= 0.0


def test_damping_is_quadratic_with_two_coefficients_and_metering():
    law, p = StrutLaw(FULL), FULL.tunables
    assert law.forces(0.3, 2.0, 0.0, p)[1] == pytest.approx(2.0 * 45e3 * 4.0)
    assert law.forces(0.3, -2.0, 0.0, p)[1] == pytest.approx(-180e3 * 4.0)
    assert law.forces(0.05, -1.0, 0.0, p)[1] == pytest.approx(-1.5 * 180e3)


def test_bearing_reactions_are_those_of_a_lever():
    # Axle 0.9 m below the lower bearing, bearings 0.6 m apart, stroke 0.1 m:
    # upper 30 kN * 0.8/0.7, lower the sum.
    upper = 30e3 * 0.8 / 0.7
    assert bearing_reactions(-30e3, 0.1, 0.9, 0.6) == pytest.approx(2 * upper + 30e3)


def test_friction_is_the_share_of_gas_force_and_reactions_against_the_rate():
    law, p = StrutLaw(FULL), FULL.tunables
    gas = law.forces(0.1, 0.0, 0.0, p)[0]
    full = 0.05 * gas + 0.08 * bearing_reactions(2e4, 0.1, 0.9, 0.6)
    assert law.forces(0.1, 1.0, 2e4, p)[2] == pytest.approx(full, rel=3e-4)
    assert law.forces(0.1, -1.0, 2e4, p)[2] == pytest.approx(-full, rel=3e-4)
    assert law.forces(0.1, 0.0, 2e4, p)[2] == 0.0


def evaluate(system, ports, strut_state, side_load=None, change=None):
    context = system.CreateDefaultContext()
    system.GetInputPort("strut_state").FixValue(context, strut_state)
    if side_load is not None:
        system.GetInputPort("side_load").FixValue(context, [side_load, 0.0, 0.0])
    if change:
        change(context)
    return [system.GetOutputPort(name).Eval(context) for name in ports]


def test_system_gives_the_law_on_its_ports():
    system, law, p = ShockAbsorber(FULL), StrutLaw(FULL), FULL.tunables
    force, energy, power, parts, pressure = evaluate(
        system,
        ("force", "energy", "dissipated_power", "components", "gas_pressure"),
        [0.2, 1.5],
        1e4,
    )
    assert force[0] == law.forces(0.2, 1.5, 1e4, p).total
    assert parts.sum() == pytest.approx(force[0], rel=1e-14)
    assert energy[0] == law.energy(0.2, p)
    assert power[0] == law.forces(0.2, 1.5, 1e4, p).dissipating * 1.5
    assert pressure[0] == parts[0] / 0.02


def test_unconnected_side_load_is_none():
    system = ShockAbsorber(FULL)
    (without,) = evaluate(system, ["force"], [0.2, 1.0])
    (zero,) = evaluate(system, ["force"], [0.2, 1.0], 0.0)
    assert without == zero


def test_pressure_port_exists_only_where_the_area_is_given():
    assert not ShockAbsorber(strut(TWO_CHAMBERS)).HasOutputPort("gas_pressure")


def test_numeric_parameters_change_the_force():
    system = ShockAbsorber(strut())

    def triple_damping(context):
        values = context.get_mutable_numeric_parameter(0)
        view = ShockAbsorberTunables(values.CopyToVector())
        view.compression_damping *= 3.0
        values.SetFromVector(view[:])

    (parts,) = evaluate(system, ["components"], [0.2, 1.0], change=triple_damping)
    assert parts[1] == pytest.approx(135e3)


def test_tunables_are_set_by_name_and_checked():
    system = ShockAbsorber(strut())
    context = system.CreateDefaultContext()
    before = context.get_numeric_parameter(0).CopyToVector()
    system.set_tunables(context, precharge=50e3, seal_friction=0.1)
    found = ShockAbsorberTunables(context.get_numeric_parameter(0).CopyToVector())
    assert (found.precharge, found.seal_friction) == (50e3, 0.1)
    changed = np.flatnonzero(before != found[:])
    assert changed.tolist() == [0, 5]
    for name, value, message in (
        ("rebound_damping", -1.0, "rebound_damping is -1.0"),
        ("gas_length", 0.4, "expected < 0.4 m, the length of the gas"),
        ("exponent", 3.0, "exponent is 3.0, expected >= 1.0 and <= 2.0"),
    ):
        with pytest.raises(ValueError, match=re.escape(message)):
            system.set_tunables(context, **{name: value})
    assert found[:].tolist() == context.get_numeric_parameter(0).CopyToVector().tolist()


def test_gas_length_tuned_below_the_stroke_is_refused():
    system = ShockAbsorber(strut())

    def shorten(context):
        context.get_mutable_numeric_parameter(0).SetAtIndex(1, 0.4)

    with pytest.raises(ValueError, match=r"0\.4 m of gas, expected > 0\.468 m"):
        evaluate(system, ["force"], [0.2, 1.0], change=shorten)


@pytest.mark.parametrize("parameters", ALL)
@pytest.mark.parametrize(
    "state", [(0.21, 1.0), (0.3, -0.5), (0.0004, 0.2), (-0.01, -1)]
)
def test_gradient_agrees_with_finite_differences(parameters, state):
    system = ShockAbsorber(parameters)
    (value,) = evaluate(
        system.ToAutoDiffXd(), ["force"], InitializeAutoDiff(np.array(state))[:, 0]
    )
    gradient = value[0].derivatives()
    for i, h in enumerate((1e-7, 1e-6)):
        ends = []
        for sign in (1, -1):
            moved = np.array(state, dtype=float)
            moved[i] += sign * h
            ends.append(evaluate(system, ["force"], moved)[0][0])
        expected = (ends[0] - ends[1]) / (2 * h)
        assert gradient[i] == pytest.approx(expected, rel=1e-5, abs=1.0)


def test_feedthrough_is_what_the_ports_say():
    system = ShockAbsorber(FULL)
    state = system.GetInputPort("strut_state").get_index()
    side = system.GetInputPort("side_load").get_index()
    for name, from_side in (
        ("force", True),
        ("energy", False),
        ("dissipated_power", True),
        ("components", True),
        ("gas_pressure", False),
    ):
        port = system.GetOutputPort(name).get_index()
        assert system.HasDirectFeedthrough(state, port)
        assert system.HasDirectFeedthrough(side, port) == from_side


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: strut(max_stroke=0.55), "max_stroke is 0.55 m, expected < 0.52 m"),
        (
            lambda: strut(compression_damping=-1.0),
            "compression_damping is -1.0 N s²/m²",
        ),
        (lambda: strut(seal_friction=1.5), "seal_friction is 1.5, expected >= 0.0 and"),
        (lambda: strut(stop_damping=math.nan), "stop_damping is nan s/m"),
        (lambda: GasSpring(precharge=-1.0, gas_length=0.5), "precharge is -1.0 N"),
        (lambda: GasSpring(precharge=1e4, gas_length=0.0), "gas_length is 0.0 m"),
        (
            lambda: GasSpring(precharge=1e4, gas_length=0.5, exponent=0.9),
            "exponent is 0.9, expected >= 1.0 and <= 2.0",
        ),
        (
            lambda: GasSpring(
                precharge=1e4,
                gas_length=0.5,
                second=SecondChamber(precharge=5e3, gas_length=0.1),
            ),
            "second chamber's precharge is 5000.0 N, expected >=",
        ),
        (lambda: Table((0.0, 0.2, 0.1), (1, 1, 1)), "0.1 follows 0.2"),
        (lambda: Table((0.0,), (1.0,)), "expected two or more"),
        (
            lambda: strut(compression_metering=Table((0, 1), (1, -1))),
            "compression_metering has the factor -1.0",
        ),
    ],
)
def test_bad_parameters_are_named_with_unit_and_range(build, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        build()

"""A tire that rolls, drifts and loses energy: laws against closed forms, signs, power.

The figures of NASA TR R-64 for the A320's tire sizes are those worked out beside it.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from systems.runway.runway import Runway
from systems.tire.aircraft_tire import TireSize, side_force_share, trail_share
from systems.tire.slip import TabulatedSlip
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters
from systems.tools.table import Table
from tests.systems.tire.test_tire import ONES, rolling, tilted

INCH, POUND, PSI = 0.0254, 4.4482216, 6894.757
MAIN = TireSize(diameter=46 * INCH, width=17 * INCH, rated_pressure=222 * PSI)
NOSE = TireSize(diameter=30 * INCH, width=8.8 * INCH, rated_pressure=203 * PSI)
SIZE = TireSize(diameter=1.168, width=0.4318, rated_pressure=1.531e6)


def aircraft_tire(**changes) -> TireParameters:
    """The main tire of the A320 class, all of it."""
    size = changes.pop("size", SIZE)
    load = 2e6 * size.stiffness_factor
    values = {
        "radius": 0.584,
        "stiffness": load,
        "cornering": size.over_deflection(lambda d: size.cornering_power(load * d)),
        "trail": size.over_deflection(lambda d: 0.8 * size.half_contact_length(d)),
        "fore_aft_stiffness": size.over_deflection(size.fore_aft_stiffness),
        "lateral_stiffness": size.over_deflection(size.lateral_stiffness),
        "hysteresis": 0.1,
        "rolling_resistance": 0.012,
    }
    return TireParameters(**values | changes)


def quasi_static(**changes) -> TireParameters:
    """Without states: steady rolling."""
    return aircraft_tire(fore_aft_stiffness=None, lateral_stiffness=None, **changes)


def contact(parameters, wheel, state=None, runway=None):
    law = TireLaw(parameters, runway or Runway())
    return law.contact([float(x) for x in wheel], state, ONES)


def wheel_at(deflection, speed=70.0, radius=0.584, **motion):
    """Rolling freely at the effective radius, 70 m/s toward -x."""
    wheel = rolling(height=radius - deflection, speed=speed, **motion)
    wheel[10] = -speed / (radius - deflection / 3.0)
    return wheel


# --- NASA TR R-64


@pytest.mark.parametrize(
    ("size", "rated", "deflection", "stiffness", "contact_length", "power", "lateral"),
    [
        (MAIN, 46000 * POUND, 0.086, 2.82e6, 0.517, 1.05e6, 2.1e6),
        (NOSE, 14340 * POUND, 0.049, 1.50e6, 0.319, 0.26e6, 0.98e6),
    ],
)
def test_tires_of_the_a320_have_the_figures_worked_out_by_hand(
    size, rated, deflection, stiffness, contact_length, power, lateral
):
    found = size.deflection(rated)
    assert found == pytest.approx(deflection, rel=0.01)
    h = 1e-4
    slope = size.vertical_force(found + h) - size.vertical_force(found - h)
    assert slope / (2 * h) == pytest.approx(stiffness, rel=0.01)
    length = 2 * size.half_contact_length(found)
    assert length == pytest.approx(contact_length, rel=0.01)
    assert size.cornering_power(rated) == pytest.approx(power, rel=0.03)
    assert size.lateral_stiffness(found) == pytest.approx(lateral, rel=0.03)


@given(x=st.floats(1e-3, 0.25))
def test_deflection_is_the_inverse_of_the_vertical_force(x):
    assert MAIN.deflection(MAIN.vertical_force(x)) == pytest.approx(x, rel=1e-9)


def test_pieces_of_the_formulas_meet():
    for law, breaks in (
        (lambda x: MAIN.vertical_force(x * MAIN.width), (0.1,)),
        (side_force_share, (1.5,)),
        (lambda phi: trail_share(phi) * side_force_share(phi), (0.1, 0.55)),
        (
            lambda r: MAIN.cornering_power(MAIN.vertical_force(r * MAIN.diameter)),
            (0.0875,),
        ),
    ):
        for at in breaks:
            below, above = law(at * (1 - 1e-9)), law(at * (1 + 1e-9))
            assert below == pytest.approx(above, rel=2e-3)


def test_flat_tire_keeps_a_thirteenth_of_its_stiffness():
    flat = TireSize(diameter=1.2, width=0.45, rated_pressure=1.5e6, inflation=0.0)
    assert flat.stiffness_factor == pytest.approx(0.08 / 1.08)
    assert flat.vertical_force(0.05) > 0.0


# --- rolling


@given(deflection=st.floats(0.002, 0.2), speed=st.floats(5.0, 90.0))
def test_free_rolling_at_the_effective_radius_has_no_force(deflection, speed):
    wheel = wheel_at(deflection, speed)
    result = contact(quasi_static(rolling_resistance=0.0), wheel)
    assert result[8] == pytest.approx(0.0, abs=1e-6 * result[7])
    assert result[:3] == pytest.approx((0.0, 0.0, 0.0), abs=1e-6 * result[7])
    assert result[13] == pytest.approx(0.0, abs=1e-4 * result[7])


def test_rolling_radius_is_loaded_effective_or_of_a_table():
    table = Table((0.0, 0.1, 0.3), (0.584, 0.56, 0.53))
    for given_radius, expected in (
        (1.0, 0.484),
        (1 / 3, 0.584 - 0.1 / 3),
        (table, 0.56),
    ):
        law = TireLaw(quasi_static(rolling_radius=given_radius), Runway())
        assert law.rolling_radius(0.1) == pytest.approx(expected)


def test_drag_turns_the_wheel_with_the_rolling_radius_as_its_arm():
    wheel = rolling(height=0.484, share=0.0)
    result = contact(quasi_static(rolling_resistance=0.0), wheel)
    radius = 0.584 - 0.1 / 3
    assert result[8] > 0.0
    assert result[:3] == pytest.approx((0.0, -radius * result[8], 0.0))


def test_rolling_resistance_is_a_torque_against_the_spin_and_costs_power():
    wheel = wheel_at(0.1)
    result = contact(quasi_static(), wheel)
    radius = 0.584 - 0.1 / 3
    assert result[1] == pytest.approx(0.012 * radius * result[7], rel=1e-3)
    assert result[13] == pytest.approx(0.012 * 70.0 * result[7], rel=1e-3)
    # Steady rolling: the ground drags with 1.2 % of the load.
    share = 1.0 - 0.012 / 16.0
    wheel[10] *= share
    dragged = contact(quasi_static(), wheel)
    assert dragged[1] == pytest.approx(0.0, abs=2e-4 * radius * dragged[7])
    assert dragged[8] / dragged[7] == pytest.approx(0.012, rel=5e-3)


# --- drift


@pytest.mark.parametrize("deflection", [0.02, 0.05, 0.1, 0.15])
def test_side_force_begins_with_the_cornering_power(deflection):
    wheel = wheel_at(deflection, side=0.07)
    parameters = quasi_static()
    result = contact(parameters, wheel)
    power = parameters.cornering.value(deflection)
    assert result[9] == pytest.approx(-power * 0.001, rel=2e-3)


@pytest.mark.parametrize("load", [0.6, 0.8, 1.0])
def test_cornering_slope_lies_between_five_and_eight_per_radian_of_load(load):
    force = load * 204.6e3
    assert 5.0 <= MAIN.cornering_power(force) / force <= 8.6
    assert SIZE.cornering_power(force) / force == pytest.approx(
        MAIN.cornering_power(force) / force, rel=0.1
    )


def test_side_force_over_angles_is_that_of_the_report_within_a_tenth():
    parameters = quasi_static()
    law = TireLaw(parameters, Runway())
    load = law.elastic_force(0.1)
    power = parameters.cornering.value(0.1)
    for degrees in (1, 2, 5, 8, 11):
        psi = math.radians(degrees)
        theirs = 0.8 * side_force_share(power * psi / (0.8 * load))
        ours = law.ratios(0.1, 0.0, -math.tan(psi))[1]
        assert ours == pytest.approx(theirs, rel=0.1)


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize("side", [2.0, -2.0])
def test_aligning_moment_turns_the_wheel_into_its_travel(sense, side):
    wheel = wheel_at(0.1, side=side)
    wheel[6], wheel[10] = sense * wheel[6], sense * wheel[10]
    result = contact(quasi_static(), wheel)
    # Travel is turned about z by the sign of v_x × v_y: so must the wheel be.
    turned = wheel[6] * wheel[7]
    assert result[2] * turned > 0.0
    trail = result[2] / result[9]
    assert abs(trail) < 0.8 * SIZE.half_contact_length(0.1)


def test_trail_begins_at_its_value_and_is_gone_where_the_tire_slides():
    parameters = quasi_static()
    small = contact(parameters, wheel_at(0.1, side=0.01))
    assert abs(small[2] / small[9]) == pytest.approx(
        0.8 * SIZE.half_contact_length(0.1), rel=0.01
    )
    assert contact(parameters, wheel_at(0.1, side=60.0))[2] == 0.0


def test_deflated_tire_carries_and_corners_less():
    flat = TireSize(diameter=1.168, width=0.4318, rated_pressure=1.531e6, inflation=0.0)
    full, soft = (
        contact(quasi_static(size=size), wheel_at(0.1, side=3.0))
        for size in (SIZE, flat)
    )
    assert soft[7] / full[7] == pytest.approx(0.08 / 1.08)
    assert abs(soft[9]) < 0.25 * abs(full[9])


# --- power


angles, rates = st.floats(-0.2, 0.2), st.floats(-20.0, 20.0)


@given(
    camber=angles,
    yaw=st.floats(-3.0, 3.0),
    sway=rates,
    sink=rates,
    turn=rates,
    spin=st.floats(-200.0, 200.0),
    height=st.floats(0.42, 0.58),
)
@settings(max_examples=60)
def test_power_is_stored_or_dissipated(camber, yaw, sway, sink, turn, spin, height):
    v, w = np.array([-60.0, sway, 0.2 * sink]), np.array([0.3, spin, 0.1 * turn])
    wheel = tilted(camber, yaw, height, v, w)
    law, h = TireLaw(quasi_static(damping=3e3), Runway()), 1e-7

    def energy(t):
        turned = wheel.copy()
        turned[:3] += t * wheel[6:9]
        axle = wheel[3:6] + t * np.cross(wheel[9:], wheel[3:6])
        turned[3:6] = axle / np.linalg.norm(axle)
        return law.energy(law.deflection(turned.tolist()))

    result = law.contact(wheel.tolist(), None, ONES)
    power = np.dot(result[:3], wheel[9:]) + np.dot(result[3:6], wheel[6:9])
    stored = (energy(h) - energy(-h)) / (2 * h)
    scale = np.linalg.norm(result[3:6]) * 60.0 + abs(stored) + 1.0
    assert abs(power + stored + result[13]) < 1e-5 * scale


def test_slow_cycle_of_load_loses_the_hysteresis():
    law = TireLaw(quasi_static(hysteresis=0.12), Runway())
    x = np.linspace(0.0, 0.1, 401)
    x = 0.5 * (x[1:] + x[:-1])

    def force(deflection, rate):
        wheel = wheel_at(deflection)
        wheel[8] = -rate
        return law.contact([float(v) for v in wheel], None, ONES)[7]

    loading, unloading = (
        sum(force(d, rate) for d in x) * (x[1] - x[0]) for rate in (2.0, -2.0)
    )
    assert loading == pytest.approx(0.5 * 2e6 * 0.1**2, rel=1e-3)
    assert 1.0 - unloading / loading == pytest.approx(0.12, rel=1e-3)


# --- the carcass


def test_relaxation_length_is_cornering_power_over_lateral_stiffness():
    parameters = aircraft_tire()
    law = TireLaw(parameters, Runway())
    power, stiffness = law.slopes(0.1)[1], SIZE.lateral_stiffness(0.1)
    length = power / stiffness
    wheel = [float(v) for v in wheel_at(0.1, side=0.07)]

    def rate(_, slips):
        return law.contact(wheel, slips.tolist(), ONES)[14:]

    run = solve_ivp(rate, (0.0, length / 70.0), [0.0, 0.0], rtol=1e-8, atol=1e-12)
    assert run.y[1, -1] / 0.001 == pytest.approx(1.0 - math.exp(-1.0), rel=2e-3)


@pytest.mark.parametrize(("row", "direction"), [(8, 0), (9, 1)])
def test_locked_tire_at_rest_is_a_spring_of_the_carcass(row, direction):
    parameters = aircraft_tire()
    law = TireLaw(parameters, Runway())
    stiffness = (SIZE.fore_aft_stiffness, SIZE.lateral_stiffness)[direction](0.1)
    wheel = [0.0, 0.0, 0.484, 0.0, 1.0, 0.0, *[0.0] * 6]
    wheel[6 + direction] = 1e-3

    def rate(_, slips):
        return law.contact(wheel, slips.tolist(), ONES)[14:]

    run = solve_ivp(rate, (0.0, 1.0), [0.0, 0.0], rtol=1e-8, atol=1e-12)
    slow = law.contact(wheel, run.y[:, -1].tolist(), ONES)
    # 1 mm of displacement; the damping of standstill adds a hundredth of a second.
    assert -slow[row] / 1e-3 == pytest.approx(stiffness, rel=0.03)


def test_steady_states_are_those_of_the_algebraic_law():
    wheel = wheel_at(0.1, side=3.0)
    wheel[10] *= 0.97
    steady = contact(quasi_static(), wheel)
    lagged = contact(aircraft_tire(), wheel, [steady[10], steady[11] / 70.0])
    assert lagged[:14] == pytest.approx(steady[:14], rel=1e-12)
    assert lagged[14:] == pytest.approx((0.0, 0.0), abs=1e-9)


# --- bad values


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"rolling_radius": 1.5}, "rolling_radius is 1.5, expected >= 0.0 and <= 1.0"),
        ({"hysteresis": -0.1}, "hysteresis is -0.1"),
        ({"lateral_stiffness": None}, "expected both or none"),
        ({"relaxation_length": 0.3}, "one or the other"),
        ({"trail": Table((0.0, 1.0), (0.0, -1.0))}, "trail has a negative value"),
    ],
)
def test_bad_values_are_named(changes, message):
    with pytest.raises(ValueError, match=message):
        aircraft_tire(**changes)


def test_tire_without_friction_slides_freely():
    parameters = quasi_static(
        slip=TabulatedSlip(table=Table((0.0, 0.1), (0.0, 1e-6))), rolling_resistance=0.0
    )
    result = contact(parameters, wheel_at(0.1, side=10.0))
    assert abs(result[9]) < 1e-5 * result[7]

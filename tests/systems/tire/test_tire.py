"""The tire: laws against closed forms, power balance for any motion, the system alone.

Motions are drawn at random, tilted, skidding and over a profile: what holds there holds
for an aircraft that rolls straight.
"""

import math
import re

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from pydrake.autodiffutils import InitializeAutoDiff
from pydrake.math import RollPitchYaw, RotationMatrix
from scipy.integrate import solve_ivp

from systems.runway.runway import Runway
from systems.runway.runway_profile import Waves
from systems.tire.slip import SineSlip, TabulatedSlip, reference_speed, secant
from systems.tire.tire import Tire, TireContact, TireTunables
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters, inflated_stiffness
from systems.tools.table import Table

ONES = [1.0, 1.0, 1.0]
RADIUS = 0.584
FLAT = Runway()
WAVY = Runway(profile=Waves(amplitude=0.02, wavelength=4.0), direction=(1.0, 0.3))


def tire(**changes) -> TireParameters:
    values = {
        "radius": RADIUS,
        "stiffness": 2e6,
        "damping": 3e3,
        "rolling_radius": 1.0,
    } | changes
    return TireParameters(**values)


FULL = tire(
    stiffness=inflated_stiffness(
        c1=8.469e-9, c2=0.5346, pressure=1.15e6, max_deflection=0.3
    ),
    bottoming_deflection=0.15,
    lateral_friction_ratio=0.8,
    lateral_slip_scale=0.7,
)


def rolling(height=0.5, speed=70.0, share=1.0, sink=0.0, side=0.0) -> list[float]:
    """A wheel that rolls toward -x, spinning with a share of free rolling."""
    spin = -share * speed / height
    return [0, 0, height, 0, 1.0, 0, -speed, side, -sink, 0, spin, 0]


def values(parameters, wheel, runway=FLAT, state=None, factors=ONES):
    floats = [float(x) for x in wheel]
    return TireLaw(parameters, runway).contact(floats, state, factors)


# --- vertical


@given(x=st.floats(0.0, 0.4))
def test_linear_tire_is_linear_down_to_the_nominal_force(x):
    law = TireLaw(tire(), FLAT)
    assert law.elastic_force(x) == pytest.approx(2e6 * x, rel=1e-13)
    offset = TireLaw(tire(nominal_force=20e3), FLAT)
    assert offset.elastic_force(x) == pytest.approx(
        max(2e6 * x - 20e3, 0.0), rel=1e-12, abs=1e-8
    )


@given(x=st.floats(1e-4, 0.149))
def test_inflated_tire_follows_its_formula(x):
    exact = x * x / (8.469e-9 + 0.5346 * x / 1.15e6)
    # Chords of 0.75 mm: error at most F'' h²/8 = 2/c1 h²/8.
    bound = 0.25 / 8.469e-9 * 0.00075**2
    assert abs(TireLaw(FULL, FLAT).elastic_force(x) - exact) <= bound


@given(x=st.floats(0.0, 0.5))
def test_energy_is_the_integral_of_the_elastic_force(x):
    law, h = TireLaw(FULL, FLAT), 1e-6
    slope = (law.energy(x + h) - law.energy(max(x - h, 0.0))) / (h + min(h, x))
    assert slope == pytest.approx(law.elastic_force(x), rel=1e-4, abs=50.0)


@given(x=st.floats(0.0, 0.4), y=st.floats(0.0, 0.4))
def test_elastic_force_is_monotonic(x, y):
    law = TireLaw(FULL, FLAT)
    low, high = sorted((x, y))
    assert law.elastic_force(low) <= law.elastic_force(high)


def test_bottoming_adds_the_rim():
    law = TireLaw(tire(bottoming_deflection=0.1, bottoming_stiffness=2e7), FLAT)
    assert law.elastic_force(0.11) == pytest.approx(0.11 * 2e6 + 0.01 * 2e7)


def test_touchdown_brings_no_jump_and_the_air_no_force():
    sink = rolling(height=RADIUS + 1e-9, sink=3.0, share=0.0)
    air = values(tire(), sink)
    assert not any(air[:6])
    assert air[6] == pytest.approx(-1e-9)
    ground = values(tire(), rolling(height=RADIUS - 1e-9, sink=3.0, share=0.0))
    assert math.hypot(*ground[3:6]) < 0.01


@given(depth=st.floats(0.0, 0.2), rate=st.floats(-30.0, 10.0))
def test_tire_never_pulls(depth, rate):
    wheel = rolling(height=RADIUS - depth, sink=rate)
    assert values(tire(damping=1e5), wheel)[7] >= 0.0


# --- slip


def test_default_slip_curve_has_the_stated_figures():
    curve = SineSlip()
    slips = np.linspace(0.0, 1.0, 10001)
    mu = np.array([curve.mu(s) for s in slips.tolist()])
    assert mu.max() == pytest.approx(0.8, abs=1e-6)
    assert slips[mu.argmax()] == pytest.approx(0.12, abs=0.003)
    assert mu[-1] == pytest.approx(0.55, abs=0.01)
    assert secant(curve, 0.0, 0.0) == curve.initial_slope == pytest.approx(16.0)


def test_free_rolling_toward_minus_x_spins_negative_about_the_axle():
    wheel = rolling()
    assert wheel[10] < 0
    result = values(tire(), wheel)
    assert result[8] == pytest.approx(0.0, abs=1e-6)
    assert result[3] == pytest.approx(0.0, abs=1e-6)


def test_wheel_without_spin_is_dragged_aft_and_spun_up():
    result = values(tire(damping=0.0), rolling(share=0.0))
    load = 2e6 * (RADIUS - 0.5)
    drag = 0.8 * math.sin(1.6 * math.atan(12.5)) * load
    assert result[3:6] == pytest.approx((drag, 0.0, load))
    # [torque] = r × F: about +y toward free rolling, which is negative.
    assert result[:3] == pytest.approx((0.0, -0.5 * drag, 0.0))


@given(share=st.floats(-1.0, 2.5))
def test_drag_follows_the_curve_over_slip(share):
    slip = 1.0 - share
    result = values(tire(), rolling(share=share))
    mu = math.copysign(SineSlip().mu(abs(slip)), slip)
    assert result[8] / result[7] == pytest.approx(mu, abs=1e-12)


@given(side=st.floats(-60.0, 60.0))
def test_side_force_of_a_free_rolling_wheel_follows_the_slip_angle(side):
    result = values(tire(), rolling(side=side))
    mu = math.copysign(SineSlip().mu(abs(side) / 70.0), side)
    assert result[9] / result[7] == pytest.approx(-mu, abs=1e-12)


@given(share=st.floats(-1.0, 3.0), side=st.floats(-80, 80), speed=st.floats(0.0, 80))
def test_combined_slip_stays_in_the_ellipse_and_opposes_sliding(share, side, speed):
    result = values(FULL, rolling(speed=speed, share=share, side=side))
    load, along, across = result[7:10]
    assert math.hypot(along / load, across / (0.8 * load)) <= 0.8 + 1e-12
    assert result[13] >= 0.0
    assert across * result[11] <= 0.0


def test_tabulated_slip_curve():
    curve = TabulatedSlip(table=Table((0.0, 0.1, 1.0), (0.0, 0.7, 0.5)))
    result = values(tire(slip=curve), rolling(share=0.95))
    assert result[8] / result[7] == pytest.approx(0.35)
    result = values(tire(slip=curve), rolling(share=-2.0))
    assert result[8] / result[7] == pytest.approx(0.5)


@given(v=st.floats(-2.0, 2.0))
def test_reference_speed_is_smooth_and_exact_above_the_limit(v):
    h = 1e-7
    slope = (reference_speed(v + h, 0.5) - reference_speed(v - h, 0.5)) / (2 * h)
    assert abs(slope) <= 1.0 + 1e-6
    assert reference_speed(v, 0.5) >= 0.25
    if abs(v) >= 0.5:
        assert reference_speed(v, 0.5) == abs(v)


def test_wet_and_icy_runways_scale_the_drag():
    dry, wet, icy = (
        values(tire(), rolling(share=0.0), Runway(surface=s))[8]
        for s in ("dry", "wet", "icy")
    )
    assert (wet / dry, icy / dry) == pytest.approx((0.6, 0.12))


# --- any attitude


angles = st.floats(-0.25, 0.25)
headings = st.floats(-math.pi, math.pi)
rates = st.floats(-20.0, 20.0)


def tilted(camber, yaw, height, velocity, spin):
    """A wheel that leans and heads anywhere."""
    R = RotationMatrix(RollPitchYaw(camber, 0.0, yaw)).matrix()
    return np.r_[0.3, -0.2, height, R[:, 1], R @ velocity, R @ spin]


def test_leaning_wheel_has_a_longer_loaded_radius_and_the_same_radial_force():
    wheel = tilted(0.2, 0.0, 0.5, np.array([-70.0, 0, 0]), np.zeros(3))
    result = values(tire(damping=0.0), wheel)
    assert result[6] == pytest.approx(RADIUS - 0.5 / math.cos(0.2))
    assert result[7] * math.cos(0.2) == pytest.approx(2e6 * result[6])


@given(yaw=headings, x=st.floats(-3e3, 3e3), camber=angles, vy=rates, vz=rates)
def test_wrench_turns_with_the_heading_and_ignores_the_position(yaw, x, camber, vy, vz):
    v, w = np.array([-60.0, vy, 0.1 * vz]), np.array([0.4, -50.0, 0.2])
    here = tilted(camber, 0.0, 0.5, v, w)
    there = tilted(camber, yaw, 0.5, v, w)
    # The velocity must turn about the vertical, not with the tilted wheel alone.
    R = RotationMatrix.MakeZRotation(yaw).matrix()
    there[:3] = R @ here[:3] + [x, -0.5 * x, 0.0]
    first, second = values(FULL, here), values(FULL, there)
    scale = np.linalg.norm(first[3:6])
    assert np.allclose(R @ first[3:6], second[3:6], atol=1e-9 * scale)
    assert np.allclose(R @ first[:3], second[:3], atol=1e-9 * scale)
    assert second[6:14] == pytest.approx(first[6:14], rel=1e-8, abs=1e-7)


@pytest.mark.parametrize("runway", [FLAT, WAVY])
@given(
    camber=angles,
    yaw=headings,
    sway=rates,
    sink=rates,
    roll=rates,
    turn=rates,
    spin=st.floats(-200.0, 200.0),
    height=st.floats(0.42, 0.6),
)
@settings(max_examples=60)
def test_wrench_power_plus_stored_plus_dissipated_is_nothing(
    runway, camber, yaw, sway, sink, roll, turn, spin, height
):
    v, w = np.array([-60.0, sway, 0.2 * sink]), np.array([0.1 * roll, spin, 0.1 * turn])
    wheel = tilted(camber, yaw, height, v, w)
    law = TireLaw(FULL, runway)
    h = 1e-7

    def energy(t):
        turned = wheel.copy()
        turned[:3] += t * wheel[6:9]
        axle = wheel[3:6] + t * np.cross(wheel[9:], wheel[3:6])
        turned[3:6] = axle / np.linalg.norm(axle)
        return law.energy(law.deflection(turned.tolist()))

    result = law.contact(wheel.tolist(), None, ONES)
    assume(abs(result[6]) > 1e-4)
    power = np.dot(result[:3], wheel[9:]) + np.dot(result[3:6], wheel[6:9])
    stored = (energy(h) - energy(-h)) / (2 * h)
    scale = np.linalg.norm(result[3:6]) * 60.0 + abs(stored) + 1.0
    assert result[13] >= 0.0
    # Kinks of the table within h of the deflection: 1e-5 of the power at 60 m/s.
    assert abs(power + stored + result[13]) < 1e-5 * scale


# --- relaxation


LAGGED = tire(relaxation_length=0.3)


def test_steady_lagged_slip_is_the_algebraic_one():
    wheel = rolling(share=0.97, side=2.0)
    algebraic = values(tire(), wheel)
    lagged = values(LAGGED, wheel, state=[algebraic[10], algebraic[11] / 70.0])
    assert lagged[:14] == pytest.approx(algebraic[:14], rel=1e-12)
    assert lagged[14:] == pytest.approx((0.0, 0.0), abs=1e-9)


def test_small_slip_builds_up_over_the_relaxation_length():
    wheel = [float(x) for x in rolling(share=0.999)]
    law = TireLaw(LAGGED, FLAT)
    end = 0.3 / 70.0
    run = solve_ivp(
        lambda t, k: law.contact(wheel, k.tolist(), ONES)[14:],
        (0, end),
        [0.0, 0.0],
        rtol=1e-8,
        atol=1e-12,
    )
    # The lag shortens a little as the curve bends: 1 - 1/e within 0.1 %.
    assert run.y[0, -1] / -0.001 == pytest.approx(1 - math.exp(-1), rel=1e-3)


def test_locked_wheel_stops_and_stays_at_rest():
    law, mass = TireLaw(LAGGED, FLAT), 16e3

    def motion(t, y):
        wheel = [y[0], 0.0, 0.5, 0.0, 1.0, 0.0, y[1], 0.0, 0.0, 0.0, 0.0, 0.0]
        result = law.contact(wheel, [y[2], y[3]], ONES)
        return [y[1], result[3] / mass, *result[14:]]

    run = solve_ivp(
        motion,
        (0.0, 8.0),
        [0.0, -10.0, 0.0, 0.0],
        method="LSODA",
        rtol=1e-6,
        atol=1e-8,
        dense_output=True,
    )
    late = run.sol(np.linspace(6.0, 8.0, 200))
    assert np.abs(late[1]).max() < 1e-3
    # The carcass lets go of the last of its deflection: a part of its 0.3 m length.
    assert run.y[0].min() == pytest.approx(late[0, -1], abs=0.1)
    # Within an eighth of braking at the sliding friction 0.55 to 0.8 throughout.
    assert 10.0**2 / 2 / (0.8 * 168e3 / mass) < -late[0, -1]
    assert -late[0, -1] < 10.0**2 / 2 / (0.55 * 168e3 / mass)


def test_lagged_slip_dies_out_in_the_air():
    result = values(LAGGED, rolling(height=0.7), state=[0.5, -0.2])
    assert result[14] < 0 < result[15]


# --- the system


def evaluate(system, port, wheel, state=None, factors=None):
    context = system.CreateDefaultContext()
    system.GetInputPort("wheel").FixValue(context, wheel)
    if state is not None:
        context.get_mutable_continuous_state_vector().SetFromVector(state)
    if factors is not None:
        context.get_mutable_numeric_parameter(0).SetFromVector(factors)
    return system.GetOutputPort(port).Eval(context)


def test_system_gives_the_law_on_its_ports():
    wheel = rolling(share=0.4, side=5.0, sink=1.0)
    result, system = values(FULL, wheel), Tire(FULL)
    assert evaluate(system, "wrench", wheel) == pytest.approx(result[:6], rel=1e-14)
    contact = TireContact(evaluate(system, "contact", wheel))
    assert contact.deflection == pytest.approx(RADIUS - 0.5)
    assert contact.slip == pytest.approx(0.6)
    assert contact.slip_angle == pytest.approx(math.atan2(5.0, 70.0))
    assert contact.F_x > 0 > contact.F_y
    assert evaluate(system, "dissipated_power", wheel)[0] == pytest.approx(result[13])
    energy = TireLaw(FULL, FLAT).energy(RADIUS - 0.5)
    assert evaluate(system, "energy", wheel)[0] == pytest.approx(energy)


def test_numeric_parameters_scale_the_law():
    wheel, system = rolling(share=0.0), Tire(tire())
    plain = evaluate(system, "wrench", wheel)
    factors = TireTunables([2.0, 1.0, 0.5])
    scaled = evaluate(system, "wrench", wheel, factors=factors[:])
    assert scaled[5] == pytest.approx(2 * plain[5])
    assert scaled[3] == pytest.approx(plain[3])
    assert evaluate(system, "energy", wheel, factors=factors[:])[0] == pytest.approx(
        2 * evaluate(system, "energy", wheel)[0]
    )


def test_factors_are_set_by_name_in_a_context():
    wheel, system = rolling(share=0.0), Tire(tire())
    context = system.CreateDefaultContext()
    system.GetInputPort("wheel").FixValue(context, wheel)
    system.set_factors(context, stiffness=2.0, friction=0.5)
    factors = TireTunables(context.get_numeric_parameter(0).CopyToVector())
    assert (factors.stiffness, factors.damping, factors.friction) == (2.0, 1.0, 0.5)
    plain = evaluate(system, "wrench", wheel)
    found = system.GetOutputPort("wrench").Eval(context)
    assert found[5] == pytest.approx(2 * plain[5])
    with pytest.raises(ValueError, match=r"friction is -1\.0, expected >= 0\.0"):
        system.set_factors(context, friction=-1.0)


@pytest.mark.parametrize("runway", [FLAT, WAVY])
@pytest.mark.parametrize("camber", [0.0, 0.3])
def test_clearance_is_that_of_the_lowest_point(runway, camber):
    system = Tire(tire(), runway)
    context = system.CreateDefaultContext()
    axle = [0.0, math.cos(camber), math.sin(camber)]
    wheel = [3.0, 1.0, 2.0, *axle, *np.zeros(6)]
    system.GetInputPort("wheel").FixValue(context, wheel)
    lowest = 2.0 - RADIUS * math.cos(camber)
    expected = lowest - runway.height(3.0, 1.0)
    assert system.clearance(context) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("parameters", "runway", "state"),
    [(FULL, FLAT, None), (FULL, WAVY, None), (LAGGED, FLAT, [0.02, -0.01])],
)
def test_gradients_agree_with_finite_differences(parameters, runway, state):
    system = Tire(parameters, runway)
    wheel = tilted(
        0.1, 0.3, 0.51, np.array([-60.0, 2.0, -1.0]), np.array([0.2, -90, 0])
    )
    wrench = evaluate(
        system.ToAutoDiffXd(), "wrench", InitializeAutoDiff(wheel)[:, 0], state
    )
    gradient = np.array([value.derivatives() for value in wrench])
    expected = np.empty((6, 12))
    for i in range(12):
        ends = []
        for sign in (1, -1):
            moved = wheel.copy()
            moved[i] += sign * 1e-6
            ends.append(evaluate(system, "wrench", moved, state))
        expected[:, i] = (ends[0] - ends[1]) / 2e-6
    assert np.allclose(
        gradient, expected, rtol=1e-5, atol=1e-6 * np.abs(expected).max()
    )


def test_gradient_at_rest_on_the_ground_is_finite():
    wheel = InitializeAutoDiff([0, 0, 0.5, 0, 1.0, 0, 0, 0, 0, 0, 0, 0])[:, 0]
    for value in evaluate(Tire(tire()).ToAutoDiffXd(), "wrench", wheel):
        assert np.all(np.isfinite(value.derivatives()))


def test_feedthrough_and_states():
    for parameters, states in ((tire(), 0), (LAGGED, 2)):
        system = Tire(parameters)
        assert system.num_continuous_states() == states
        for name in ("wrench", "contact", "energy", "dissipated_power"):
            port = system.GetOutputPort(name).get_index()
            assert system.HasDirectFeedthrough(0, port)


def test_lagged_state_reaches_the_wrench_and_its_derivative():
    system, wheel = Tire(LAGGED), rolling(share=0.99)
    context = system.CreateDefaultContext()
    system.GetInputPort("wheel").FixValue(context, wheel)
    wrench = system.GetOutputPort("wrench")
    assert wrench.Eval(context)[3] == 0.0
    context.get_mutable_continuous_state_vector().SetFromVector([-0.01, 0.0])
    # Stale without the ticket of the state.
    assert wrench.Eval(context)[3] > 0.0
    rate = system.EvalTimeDerivatives(context).CopyToVector()
    assert rate == pytest.approx(values(LAGGED, wheel, state=[-0.01, 0.0])[14:])


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: tire(radius=0.0), "radius is 0.0 m, expected > 0.0"),
        (lambda: tire(stiffness=-2e6), "stiffness is -2000000.0 N/m"),
        (lambda: tire(damping=-1.0), "damping is -1.0 N s/m, expected >= 0.0"),
        (lambda: tire(relaxation_length=-0.1), "relaxation_length is -0.1 m"),
        (
            lambda: tire(bottoming_deflection=0.7),
            "is 0.7 m, expected > 0.0 and <= 0.58",
        ),
        (lambda: tire(stiffness=Table((0, 1), (1, 2))), "starts at (0.0 m, 1.0 N)"),
        (lambda: tire(stiffness=Table((0, 1, 2), (0, 2, 1))), "must not decrease"),
        (lambda: tire(damping=Table((0, 1), (1, 1))), "must start at (0, 0)"),
        (
            lambda: tire(stiffness=Table((0, 1), (0, 1)), nominal_force=1.0),
            "nominal_force is 1.0 N, expected 0",
        ),
        (lambda: SineSlip(peak=3.0), "peak is 3.0, expected >= 0.0 and <= 2.0"),
        (
            lambda: TabulatedSlip(table=Table((0.1, 1), (0.0, 1))),
            "starts at (0.1, 0.0), expected (0, 0)",
        ),
        (lambda: values(tire(), [0, 0, 0.5, 0, 0, 1, *[0] * 6]), "lies on its side"),
    ],
)
def test_bad_input_is_named_with_unit_and_range(build, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        build()


def test_no_tires_and_a_tire_that_is_not_there():
    with pytest.raises(ValueError, match="tire: found no parameters"):
        Tire([])
    tire = Tire(TireParameters(radius=0.5, stiffness=1e6))
    with pytest.raises(ValueError, match="which 1, expected 0 to 0"):
        tire.set_factors(tire.CreateDefaultContext(), which=1, friction=0.5)

"""The landing diagram: conservation, symmetry, invariance, consistency, errors."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.initial_state import (
    angular_velocity,
    attitude,
    set_initial_state,
)
from systems.runway.runway import Runway
from systems.runway.runway_profile import Waves
from systems.tools.rotations import exp
from tests.drake_landing.landing_gears import aircraft_gears
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import (
    LEFT_TIP,
    NOSE_TIP,
    RIGHT_TIP,
    TAIL_TIP,
    aircraft_body,
)

MONITORS = (NOSE_TIP, TAIL_TIP, LEFT_TIP, RIGHT_TIP)
SINK_RATE = 1.83
LOAD = "attachment.load_in_airframe_axes"


@pytest.fixture(scope="module")
def flexible():
    """Three gears, 73 modes."""
    return MakeLandingDiagram(aircraft_body(), aircraft_gears(), monitor_nodes=MONITORS)


@pytest.fixture(scope="module")
def three_point(flexible):
    """The landing of the flexible aircraft at the default accuracy."""
    return land(flexible, duration=0.5, sink_rate=SINK_RATE)


@pytest.fixture(scope="module")
def small():
    """Eight modes, for runs with many small fixed steps."""
    return MakeLandingDiagram(
        aircraft_body(8), aircraft_gears(), monitor_nodes=MONITORS
    )


def _integral(signal, time):
    """Trapezoidal, over the last axis."""
    return ((signal[..., 1:] + signal[..., :-1]) * np.diff(time)).sum(axis=-1) / 2


def _mass(landing):
    return landing.body.mass + sum(gear.mass for gear in landing.gears)


def test_energy_budget_closes(flexible, three_point):
    total = three_point["energy_budget.total"][0]
    sink_energy = 0.5 * _mass(flexible) * SINK_RATE**2
    assert np.abs(total - total[0]).max() < 1e-4 * sink_energy
    # The audit is no idle one: several times that energy went through it.
    assert three_point["energy_budget.dissipated"][0, -1] > 2.0 * sink_energy


def test_impulse_of_the_runway_is_the_change_of_momentum(flexible, three_point):
    forces = sum(three_point[f"tire_{wheel}.wrench"][3:] for wheel in flexible.tires)
    impulse = _integral(forces, three_point.time)
    plant, context = flexible.plant, three_point.context
    gears = plant.CalcSpatialMomentumInWorldAboutPoint(
        plant.GetMyContextFromRoot(context), np.zeros(3)
    ).translational()
    v = flexible.airframe.GetMyContextFromRoot(context)
    v = v.get_continuous_state_vector().CopyToVector()[7:10]
    start = _mass(flexible) * np.array([-67.0, 0.0, -SINK_RATE])
    change = gears + flexible.body.mass * v - start
    assert_allclose(impulse[2], change[2], rtol=1e-4)
    assert_allclose(impulse[0], change[0], rtol=1e-3)


def test_symmetric_landing_stays_symmetric(three_point):
    load = three_point[LOAD].reshape(3, 6, -1)
    mirrored = load[1] * np.array([1, -1, 1, -1, 1, -1])[:, None]
    assert_allclose(load[2], mirrored, atol=1e-8 * np.abs(load).max())
    monitor = three_point["airframe.monitor_acceleration"].reshape(4, 6, -1)
    scale = np.abs(monitor).max()
    assert np.abs(monitor[:2, [1, 3, 5]]).max() < 1e-8 * scale
    assert_allclose(monitor[2, 2], monitor[3, 2], atol=1e-8 * scale)


def test_no_load_before_touchdown_and_no_jump_after(three_point):
    clearance_time = 1e-3 / SINK_RATE
    load = three_point[LOAD]
    before = three_point.time < 0.999 * clearance_time
    peak = np.abs(load[2]).max()
    assert before.sum() >= 2
    assert np.abs(load[:, before]).max() < 1e-6 * peak
    early = three_point.time < clearance_time + 1e-3
    steps = np.abs(np.diff(load[2, early])) / peak
    assert steps.max() < 0.05


def test_wheels_spin_up_by_the_drag(flexible, three_point):
    gear = flexible.gears[1]
    wheel = gear.wheel_names[0]
    drag_moment = three_point[f"tire_{wheel}.wrench"][1]
    angular_impulse = _integral(drag_moment, three_point.time)
    plant = flexible.plant.GetMyContextFromRoot(three_point.context)
    rate = flexible.bodies[gear.name].spins[wheel].get_angular_rate(plant)
    assert_allclose(angular_impulse, gear.wheel.spin_inertia * rate, rtol=2e-2)
    # Rolling toward -x about the axle that points to starboard: negative.
    rolling = -67.0 / gear.tyre.radius
    assert 1.1 * rolling < rate < 0.95 * rolling


def test_fitting_acceleration_equals_node_acceleration(flexible):
    accelerations = flexible.plant.get_body_spatial_accelerations_output_port()
    for duration in (0.01, 0.05, 0.12):
        context = land(flexible, duration=duration).context
        plant = flexible.plant.GetMyContextFromRoot(context)
        airframe = flexible.airframe.GetMyContextFromRoot(context)
        of_bodies = accelerations.Eval(plant)
        found = [
            of_bodies[int(b.fitting.index())].get_coeffs()
            for b in flexible.bodies.values()
        ]
        node = flexible.airframe.GetOutputPort("node_acceleration").Eval(airframe)
        scale = np.abs(node).max()
        gap = flexible.attachment.GetOutputPort("gap").Eval(
            flexible.attachment.GetMyContextFromRoot(context)
        )
        assert scale > 1.0
        # Baumgarte's terms, which take back the drift of the integration, are wanted.
        gap, rate = gap.reshape(3, 2, 6).swapaxes(0, 1)
        stabilised = 2.0 * 60.0 * rate + 60.0**2 * gap
        found = np.reshape(found, (3, 6)) + stabilised
        assert_allclose(found, node.reshape(3, 6), atol=1e-9 * scale)
        assert np.abs(stabilised).max() < 1e-5 * scale


def test_fittings_stay_at_their_nodes(three_point):
    gap = np.abs(three_point["attachment.gap"]).reshape(3, 12, -1)
    assert gap[:, :6].max() < 1e-8


def test_runs_do_not_depend_on_heading_and_position(small):
    heading = exp(np.array([[0.0, 0.0, 2.2]]))[0]
    R_WB = attitude(np.radians(3.0), np.radians(2.0), np.radians(4.0))
    w_B = angular_velocity(0.05, -0.02, 0.03)
    v = np.array([-67.0, 1.5, -SINK_RATE])
    case = {"duration": 0.12, "step": 5e-4, "w_B": w_B}
    one = land(small, v_WG=v, R_WB=R_WB, **case)
    other = land(small, v_WG=heading @ v, R_WB=heading @ R_WB, xy=(300, -40), **case)
    load = one[LOAD]
    assert_allclose(other[LOAD], load, atol=1e-7 * np.abs(load).max())


def test_order_of_gears_does_not_matter(small):
    gears = aircraft_gears()
    turned = MakeLandingDiagram(aircraft_body(8), gears[::-1])
    case = {
        "duration": 0.1,
        "step": 5e-4,
        "R_WB": attitude(np.radians(2.0), 0.0, 0.0),
    }
    load = land(small, **case)[LOAD].reshape(3, 6, -1)
    found = land(turned, **case)[LOAD].reshape(3, 6, -1)[::-1]
    assert_allclose(found, load, atol=1e-8 * np.abs(load).max())


def test_one_diagram_serves_many_runs(small):
    case = {"duration": 0.05, "step": 1e-3}
    first = land(small, **case)[LOAD]
    land(small, sink_rate=3.0, **case)
    np.testing.assert_array_equal(land(small, **case)[LOAD], first)


def test_bushings_give_nearly_the_rigid_loads():
    rigid, elastic = (
        MakeLandingDiagram(aircraft_body(0), aircraft_gears(), bushing=bushing)
        for bushing in (None, {})
    )
    runs = [land(d, duration=0.15, accuracy=1e-4) for d in (rigid, elastic)]
    peaks = [run[LOAD][[2, 8, 14]].max(axis=1) for run in runs]
    assert_allclose(peaks[1], peaks[0], rtol=0.1)
    total = runs[1]["energy_budget.total"][0]
    assert np.abs(total - total[0]).max() < 1e-3 * 0.5 * 72500 * SINK_RATE**2


def test_one_gear_landing_loads_one_gear_first(small):
    run = land(
        small, duration=0.04, step=1e-3, R_WB=attitude(np.radians(5.0), 0.0, 0.0)
    )
    deflection = {
        name: run[f"tire_{name}.contact"][0].max()
        for name in ("main_left_left", "main_right_right", "nose_left")
    }
    assert deflection["main_right_right"] > 0
    assert deflection["main_left_left"] < 0
    assert deflection["nose_left"] < 0


def test_initial_state_sets_the_lowest_tire_at_the_clearance():
    runway = Runway(profile=Waves(amplitude=0.2, wavelength=40.0, start=3.0))
    landing = MakeLandingDiagram(aircraft_body(3), aircraft_gears(), runway)
    context = landing.diagram.CreateDefaultContext()
    for R_WB in (np.eye(3), attitude(np.radians(4.0), np.radians(8.0), 0.3)):
        set_initial_state(landing, context, v_WG=[-60, 0, -1], R_WB=R_WB, clearance=0.1)
        deflection = [
            tire.contact(context).deflection for tire in landing.tires.values()
        ]
        # The nearest point of a slope is nearer than the one straight below.
        assert -0.1 <= max(deflection) < -0.09


def test_attitude_signs():
    R_WB = attitude(np.radians(3.0), np.radians(5.0), np.radians(7.0))
    forward, starboard = -R_WB[:, 0], R_WB[:, 1]
    assert forward[2] > 0  # nose up
    assert starboard[2] < 0  # starboard wing down
    assert forward[1] > 0  # nose to starboard
    h = 1e-6
    turned = R_WB @ exp(h * angular_velocity(1.0, 2.0, 3.0)[None])[0]
    rates = attitude(h * 1.0, h * 2.0, h * 3.0)
    assert_allclose(R_WB.T @ turned, rates, atol=1e-11)


def test_bearing_friction_feels_the_side_load():
    gears = []
    for gear in aircraft_gears():
        absorber = gear.shock_absorber.model_copy(update={"bearing_friction": 0.1})
        gears.append(gear.model_copy(update={"shock_absorber": absorber}))
    landing = MakeLandingDiagram(aircraft_body(0), gears)
    run = land(landing, duration=0.06, accuracy=1e-4)
    friction = run["shock_absorber_main_left.components"][2]
    drag = run["tire_main_left_left.contact"][2]
    spinning_up = drag > 0.5 * drag.max()
    assert friction[spinning_up].min() > 0.1 * drag[spinning_up].min()
    total = run["energy_budget.total"][0]
    assert np.abs(total - total[0]).max() < 1e-4 * 0.5 * 72500 * SINK_RATE**2


def test_tires_and_struts_together_are_the_same_landing():
    """One system for each wheel and gear, or one for all: the same laws."""
    gears = []
    for gear in aircraft_gears():
        absorber = gear.shock_absorber.model_copy(update={"bearing_friction": 0.1})
        gears.append(gear.model_copy(update={"shock_absorber": absorber}))
    apart, together = (
        land(
            MakeLandingDiagram(aircraft_body(3), gears, together=together),
            duration=0.05,
            accuracy=1e-4,
        )
        for together in (False, True)
    )
    for name in ("attachment.load_in_airframe_axes", "plant.state"):
        assert apart[name].shape == together[name].shape
        scale = np.abs(apart[name]).max(axis=1, keepdims=True) + 1e-9
        assert np.abs((apart[name] - together[name]) / scale).max() < 1e-9
    stored = sum(
        v[0]
        for k, v in apart.signals.items()
        if k.startswith("tire_") and "energy" in k
    )
    assert_allclose(stored, together["tires.energy"][0], rtol=1e-9, atol=1e-6)


def test_picture_names_the_systems(small):
    picture = small.graphviz()
    for name in ("plant", "airframe", "attachment", "tire_", "gear_forces"):
        assert name in picture


def test_gravity_acts_on_airframe_and_gears():
    landing = MakeLandingDiagram(aircraft_body(3), aircraft_gears(), gravity=9.81)
    context = landing.diagram.CreateDefaultContext()
    set_initial_state(landing, context, v_WG=[-60, 0, -1], clearance=1.0)
    airframe = landing.airframe.GetMyContextFromRoot(context)
    fall = landing.airframe.GetOutputPort("node_acceleration").Eval(airframe)
    # Free fall, but for the gas springs' stops: the struts are not extended by weight.
    assert_allclose(fall.reshape(3, 6)[:, 5], -9.81, atol=0.02)


def test_bad_input_is_named():
    body, gears = aircraft_body(3), aircraft_gears()
    with pytest.raises(ValueError, match="expected unique names"):
        MakeLandingDiagram(body, (gears[0], gears[0]))
    with pytest.raises(ValueError, match="expected unique names"):
        MakeLandingDiagram(body, ())
    lost = gears[0].model_copy(update={"attachment_node": 999})
    with pytest.raises(ValueError, match="no node \\[999\\]"):
        MakeLandingDiagram(body, (lost, *gears[1:]))
    with pytest.raises(ValueError, match="mass"):
        replace(body, mass=-1.0)
    landing = MakeLandingDiagram(body, gears)
    context = landing.diagram.CreateDefaultContext()
    with pytest.raises(ValueError, match="clearance is -1"):
        set_initial_state(landing, context, v_WG=[-60, 0, -1], clearance=-1.0)

"""States of rest and flight under gravity and lift; lift in a landing."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.equilibrium import (
    set_flight_equilibrium,
    set_static_equilibrium,
)
from drake_landing.landing.initial_state import (
    attitude,
    set_initial_state,
    tire_clearances,
)
from drake_landing.landing.lift import Lift, aircraft_mass_center, decaying
from tests.drake_landing.landing_gears import aircraft_gears
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import aircraft_body

G = 9.80665
WING = (*range(21, 28), *range(31, 38))
LOAD = "attachment.load_in_airframe_axes"
SINK_RATE = 1.83


def _loads(landing, context) -> np.ndarray:
    """Vertical load of each gear's tires, N."""
    loads = []
    for gear in landing.gears:
        tires = [landing.tires[wheel] for wheel in gear.wheel_names]
        loads.append(sum(tire.contact(context).F_z for tire in tires))
    return np.array(loads)


@pytest.mark.parametrize("modes", [0, 20])
def test_standing_aircraft_obeys_the_lever_rule(modes):
    body, gears = aircraft_body(modes), aircraft_gears()
    landing = MakeLandingDiagram(body, gears, gravity=G)
    context = landing.diagram.CreateDefaultContext()
    set_static_equilibrium(landing, context)
    mass, center = aircraft_mass_center(body, gears)
    nose, left, right = _loads(landing, context)
    assert_allclose(nose + left + right, G * mass, rtol=1e-9)
    assert_allclose(left, right, rtol=1e-9)
    # Wheelbase 12.64 m; the struts' closing moves the c.g. by a millimetre or so.
    share = (17.71 - center[0]) / 12.64
    assert_allclose(nose, share * G * mass, rtol=0.03)
    rates = landing.diagram.EvalTimeDerivatives(context).CopyToVector()
    assert np.abs(rates).max() < 1e-6


def test_rolling_aircraft_keeps_its_height_and_attitude():
    landing = MakeLandingDiagram(aircraft_body(0), aircraft_gears(), gravity=G)
    run = land(landing, duration=0.2, rolling=20.0)
    pose = run["airframe.pose"]
    pose[4] += 20.0 * run.time
    assert np.abs(pose - pose[:, :1]).max() < 1e-7


def test_rolling_aircraft_rolls_on_without_slip():
    landing = MakeLandingDiagram(aircraft_body(0), aircraft_gears(), gravity=G)
    context = landing.diagram.CreateDefaultContext()
    set_static_equilibrium(landing, context, speed=30.0, xy=(5.0, 2.0), heading=0.4)
    for tire in landing.tires.values():
        contact = tire.contact(context)[:]
        assert_allclose(contact[[2, 3]], 0.0, atol=1.0)
        assert_allclose(contact[4:], 0.0, atol=1e-6)
    airframe = landing.airframe.GetMyContextFromRoot(context)
    x = airframe.get_continuous_state_vector().CopyToVector()
    assert_allclose(x[:2], [5.0, 2.0])
    assert_allclose(x[7:10], 30.0 * np.array([-np.cos(0.4), np.sin(0.4), 0.0]))


def test_equilibrium_needs_gravity_and_a_stable_stance():
    body, gears = aircraft_body(0), aircraft_gears()
    landing = MakeLandingDiagram(body, gears)
    with pytest.raises(ValueError, match=r"gravity is 0.0 m/s², expected > 0"):
        set_static_equilibrium(landing, landing.diagram.CreateDefaultContext())
    # Without its nose gear the aircraft falls on its nose.
    falling = MakeLandingDiagram(body, gears[1:], gravity=G)
    with pytest.raises(ValueError, match="no state of rest"):
        set_static_equilibrium(falling, falling.diagram.CreateDefaultContext())


@pytest.fixture(scope="module")
def lifted():
    return MakeLandingDiagram(
        aircraft_body(20), aircraft_gears(), gravity=G, lift=Lift(nodes=WING)
    )


def _in_flight(landing, R_WB=None):
    context = landing.diagram.CreateDefaultContext()
    v = [-67.0, 0.0, -SINK_RATE]
    set_initial_state(landing, context, v_WG=v, R_WB=R_WB, clearance=0.05)
    set_flight_equilibrium(landing, context)
    return context


@pytest.mark.parametrize("angles", [(0.0, 0.0, 0.0), (0.05, 0.12, 0.1)])
def test_flight_with_lift_is_steady(lifted, angles):
    context = _in_flight(lifted, attitude(*angles))
    airframe = lifted.airframe.GetMyContextFromRoot(context)
    rates = lifted.airframe.EvalTimeDerivatives(airframe).CopyToVector()
    assert_allclose(rates[7:10], 0.0, atol=1e-3)  # the c.g. is that of the rigid shape
    assert_allclose(rates[13:33], 0.0, atol=1e-12)
    velocity = airframe.get_continuous_state_vector().CopyToVector()[7:10]
    assert_allclose(velocity, [-67.0, 0.0, -SINK_RATE])
    # The wing bends up, and the gears hang on it.
    monitor = lifted.airframe.GetOutputPort("modal_amplitudes").Eval(airframe)
    body = lifted.body
    tip, root = body.rows([27, 6])
    bend = (body.translation[tip] - body.translation[root])[2] @ monitor
    assert bend > 0.1
    attachment = lifted.attachment.GetMyContextFromRoot(context)
    load = lifted.attachment.GetOutputPort("load_in_airframe_axes").Eval(attachment)
    down = load.reshape(3, 6)[:, :3]
    weights = [G * gear.mass for gear in lifted.gears]
    # The lift passes the c.g. of the undeformed aircraft: it turns a little.
    assert_allclose(np.linalg.norm(down, axis=1), weights, rtol=5e-3)
    assert_allclose(min(tire_clearances(lifted, context).values()), 0.05)


def test_landing_with_lift_and_gravity_is_that_of_neither(lifted):
    """Increments of the loads of a light touchdown, up to the bending of flight."""
    case = {"duration": 0.12, "sink_rate": SINK_RATE, "accuracy": 1e-5}
    plain = MakeLandingDiagram(aircraft_body(20), aircraft_gears())
    without = land(plain, **case)
    run = land(lifted, flying=True, **case)
    peak = [r[LOAD][[2, 8, 14]] for r in (without, run)]
    weights = G * np.array([gear.mass for gear in lifted.gears])
    found = (peak[1] + weights[:, None]).max(axis=1)
    assert_allclose(found, peak[0].max(axis=1), rtol=0.05)
    assert_allclose(run[LOAD][[2, 8, 14], 0], -weights, rtol=5e-3)
    mass, _ = aircraft_mass_center(lifted.body, lifted.gears)
    total = run["energy_budget.total"][0]
    assert np.abs(total - total[0]).max() < 1e-4 * 0.5 * mass * SINK_RATE**2
    # Lift works against the sinking: some hundred kJ that the budget must not miss.
    fallen = run["airframe.pose"][6, -1] - run["airframe.pose"][6, 0]
    supplied = run["energy_budget.supplied"][0, -1]
    assert_allclose(supplied, G * mass * fallen, rtol=0.05)
    assert supplied < -5e4


def test_lift_that_decays_loads_the_gears():
    lift = Lift(nodes=WING, factor=decaying(start=0.02, duration=0.1))
    landing = MakeLandingDiagram(
        aircraft_body(0), aircraft_gears(), gravity=G, lift=lift
    )
    run = land(landing, duration=0.4, accuracy=1e-4, flying=True)
    total = run["energy_budget.total"][0]
    mass, _ = aircraft_mass_center(landing.body, landing.gears)
    assert np.abs(total - total[0]).max() < 1e-3 * 0.5 * mass * SINK_RATE**2
    vertical = sum(run[f"tire_{w}.wrench"][5, -1] for w in landing.tires)
    assert vertical > 0.8 * G * mass


def test_bad_lift_is_refused():
    body, gears = aircraft_body(3), aircraft_gears()
    with pytest.raises(ValueError, match="lift with gravity 0"):
        MakeLandingDiagram(body, gears, lift=Lift(nodes=WING))
    with pytest.raises(ValueError, match="cannot carry a resultant"):
        MakeLandingDiagram(body, gears, gravity=G, lift=Lift(nodes=[2, 3]))
    with pytest.raises(ValueError, match=r"no node \[77\]"):
        MakeLandingDiagram(body, gears, gravity=G, lift=Lift(nodes=[77]))
    with pytest.raises(
        ValueError, match=r"factor is -1.0 , expected >= 0|factor is -1"
    ):
        Lift(nodes=WING, factor=-1.0)
    with pytest.raises(ValueError, match="no nodes"):
        Lift(nodes=())
    with pytest.raises(ValueError, match="duration is 0"):
        decaying(duration=0.0)


def test_a_wheel_below_the_runway_is_refused():
    landing = MakeLandingDiagram(aircraft_body(0), aircraft_gears())
    context = landing.diagram.CreateDefaultContext()
    state = {"v_WG": [-60.0, 0.0, -1.0]}
    set_initial_state(landing, context, height=8.0, **state)
    with pytest.raises(ValueError, match=r"wheel main_\w+ is .* m below the runway"):
        set_initial_state(landing, context, height=3.0, **state)

"""Levered gears, bogies, brakes and steering: alone and in whole landings."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydantic import ValidationError
from pydrake.common.eigen_geometry import AngleAxis
from pydrake.math import RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import LinearSpringDamper, MultibodyForces
from pydrake.systems.framework import DiagramBuilder

from drake_landing.gears.bodies import (
    AddLandingGear,
    mass_points,
    strut_axis,
    wheel_centers,
)
from drake_landing.gears.landing_gear import TelescopicGear, read_gear
from drake_landing.gears.systems import AddGearSystems
from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.equilibrium import set_static_equilibrium
from tests.drake_landing.landing_gears import (
    aircraft_gears,
    bogie_main,
    changed,
    levered_main,
)
from tests.drake_landing.landing_run import land
from tests.systems.small_gears import violent_state
from tests.systems.synthetic_body import aircraft_body

P_BA = np.array([17.6, -3.795, -1.05])
LOAD = "attachment.load_in_airframe_axes"
SINK_RATE = 1.83


def _plant(gear):
    plant = MultibodyPlant(0.0)
    bodies = AddLandingGear(plant, gear, P_BA)
    return plant, bodies


def _gear_systems(gear):
    """Diagram of one gear whose fitting is free, with its context."""
    builder = DiagramBuilder()
    plant = builder.AddSystem(MultibodyPlant(0.0))
    bodies = {gear.name: AddLandingGear(plant, gear, P_BA)}
    plant.Finalize()
    systems = AddGearSystems(builder, plant, [gear], bodies)
    builder.Connect(
        systems.gear_forces.GetOutputPort("spatial_forces"),
        plant.GetInputPort("applied_spatial_force"),
    )
    diagram = builder.Build()
    return diagram, plant, bodies[gear.name], systems, diagram.CreateDefaultContext()


@pytest.fixture(scope="module", params=["levered", "bogie"])
def landing(request):
    """Three gears, the main gears of another kind, eight modes."""
    kind = {"levered": levered_main, "bogie": bogie_main}[request.param]
    nose = aircraft_gears()[0]
    gears = (nose, kind("main_left"), kind("main_right"))
    return MakeLandingDiagram(aircraft_body(8), gears)


@pytest.fixture(scope="module")
def run(landing):
    return land(landing, duration=0.22, sink_rate=SINK_RATE)


def _mass(landing):
    return landing.body.mass + sum(gear.mass for gear in landing.gears)


def test_energy_budget_closes(landing, run):
    total = run["energy_budget.total"][0]
    sink_energy = 0.5 * _mass(landing) * SINK_RATE**2
    assert np.abs(total - total[0]).max() < 1e-4 * sink_energy
    stroke = run["strut_main_left.strut"][0].max()
    assert stroke > 0.15


def test_landing_is_symmetric(run):
    load = run[LOAD].reshape(3, 6, -1)
    mirrored = load[1] * np.array([1, -1, 1, -1, 1, -1])[:, None]
    assert_allclose(load[2], mirrored, atol=1e-8 * np.abs(load).max())


def test_runway_forces_change_the_momentum(landing, run):
    forces = sum(run[f"tire_{wheel}.wrench"][3:] for wheel in landing.tires)
    impulse = ((forces[:, 1:] + forces[:, :-1]) * np.diff(run.time)).sum(axis=1) / 2
    plant = landing.plant.GetMyContextFromRoot(run.context)
    gears = landing.plant.CalcSpatialMomentumInWorldAboutPoint(plant, np.zeros(3))
    airframe = landing.airframe.GetMyContextFromRoot(run.context)
    v = airframe.get_continuous_state_vector().CopyToVector()[7:10]
    change = gears.translational() + landing.body.mass * v
    change -= _mass(landing) * np.array([-67.0, 0.0, -SINK_RATE])
    assert_allclose(impulse[2], change[2], rtol=2e-4)
    assert_allclose(impulse[0], change[0], rtol=2e-3)


def test_static_loads_are_those_of_the_lever_rule(landing):
    gears = landing.gears
    standing = MakeLandingDiagram(aircraft_body(8), gears, gravity=9.80665)
    context = standing.diagram.CreateDefaultContext()
    set_static_equilibrium(standing, context)
    wheels, contact = [], []
    for name, tire in standing.tires.items():
        contact.append(tire.contact(context).F_z)
        wheel = standing.wheel_kinematics
        port = wheel.GetOutputPort(f"wheel_{name}")
        wheels.append(port.Eval(wheel.GetMyContextFromRoot(context))[:3])
    weight = 9.80665 * _mass(standing)
    assert_allclose(np.sum(contact), weight, rtol=1e-9)
    rates = standing.diagram.EvalTimeDerivatives(context).CopyToVector()
    assert np.abs(rates).max() < 1e-6
    # The bogie's axles share its load as the moments about its pivot want.
    if gears[1].kind == "bogie":
        front, rear = np.reshape(contact[2:6], (2, 2)).sum(axis=1)
        pitch = standing.pitch_dampers["main_left"]
        torque = pitch.GetOutputPort("torque").Eval(pitch.GetMyContextFromRoot(context))
        assert_allclose((front - rear) * 0.68, -torque[0], rtol=0.05, atol=300.0)
        assert abs(front - rear) > 1e3


def test_lever_force_is_that_of_a_spring_between_two_points():
    gear = levered_main()
    plant, bodies = _plant(gear)
    stiffness, damping, free = 3e5, 4e3, 1.2
    upper, lower = np.array(gear.absorber_upper), np.array(gear.absorber_lower)
    spring = LinearSpringDamper(
        bodies.fitting,
        upper - P_BA,
        bodies.parts["arm"],
        lower - np.array(gear.pivot),
        free,
        stiffness,
        damping,
    )
    plant.AddForceElement(spring)
    plant.mutable_gravity_field().set_gravity_vector(np.zeros(3))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    state = violent_state(plant)
    plant.SetPositionsAndVelocities(context, state)
    joint = bodies.strut.joint
    joint.set_angle(context, -0.2)
    forces = MultibodyForces(plant)
    plant.CalcForceElementsContribution(context, forces)
    zero = np.zeros(plant.num_velocities())
    tau = plant.CalcInverseDynamics(context, zero, forces)
    tau -= plant.CalcInverseDynamics(context, zero, MultibodyForces(plant))

    angle, rate = joint.get_angle(context), joint.get_angular_rate(context)
    geometry = bodies.strut.geometry
    length = geometry.length(0.0) - geometry.stroke(angle)
    s_rate = geometry.ratio(angle) * rate
    push = stiffness * (free - length) + damping * s_rate
    found = -push * geometry.ratio(angle)
    expected = -tau[joint.velocity_start()]
    assert_allclose(found, expected, rtol=1e-9)
    # Nothing but the joint feels a force between two bodies that it joins.
    others = np.delete(tau, joint.velocity_start())
    assert np.abs(others).max() < 1e-6 * abs(expected)


def test_ports_of_a_levered_gear_follow_its_geometry():
    gear = levered_main()
    _, _, bodies, systems, root = _gear_systems(gear)
    plant = systems.wheel_kinematics
    plant_context = plant.GetMyContextFromRoot(root)

    def port(name):
        return plant.GetOutputPort(name).Eval(plant_context)

    extended = port("wheel_main_left_left")[:3]
    of_plant = root  # the joints are set in the root's plant
    joint = bodies.strut.joint
    model = joint.parent_body().GetParentPlant()
    context = model.GetMyMutableContextFromRoot(of_plant)
    angle = bodies.strut.geometry.angle(0.25)
    joint.set_angle(context, angle)
    joint.set_angular_rate(context, -0.7)
    stroke, rate = port("strut_main_left")
    assert_allclose(stroke, 0.25, atol=1e-12)
    assert_allclose(rate, -0.7 * port("strut_ratio_main_left")[0])
    assert rate > 0
    assert port("wheel_main_left_left")[2] > extended[2] + 0.2
    axis = port("strut_axes")
    turned = np.array([np.cos(angle), 0.0, -np.sin(angle)])
    up = np.array([np.sin(angle), 0.0, np.cos(angle)])
    d = np.array(gear.absorber_lower) - np.array(gear.pivot)
    lower = np.array(gear.pivot) + d[0] * turned + d[2] * up
    span = np.array(gear.absorber_upper) - lower
    assert_allclose(axis, span / np.linalg.norm(span), atol=1e-12)


def test_bogie_touches_down_on_the_axle_that_hangs_lower():
    nose = aircraft_gears()[0]
    for trim, first, second in ((8.0, "rear", "front"), (-8.0, "front", "rear")):
        gears = (nose, *(bogie_main(f"main_{s}", trim_deg=trim) for s in SIDES))
        landing = MakeLandingDiagram(aircraft_body(0), gears)
        run = land(landing, duration=0.03, accuracy=1e-4)
        deflection = {
            axle: run[f"tire_main_left_{axle}_left.contact"][0]
            for axle in (first, second)
        }
        assert deflection[first].max() > 0
        assert deflection[second].max() < deflection[first].max()
        begin = 2 * 0.68 * np.sin(np.radians(8.0)) / SINK_RATE
        assert run.time[np.argmax(deflection[second] > -0.02)] < begin


SIDES = ("left", "right")


def test_bogie_has_four_named_wheels_where_the_axles_are():
    gear = bogie_main()
    assert gear.wheel_names == (
        "main_left_front_left",
        "main_left_front_right",
        "main_left_rear_left",
        "main_left_rear_right",
    )
    centers = wheel_centers(gear)
    x, y, z = 17.71, -3.795, -3.716
    assert_allclose(centers["main_left_rear_right"], [x + 0.68, y + 0.465, z])
    plant, _ = _plant(gear)
    plant.Finalize()
    assert plant.num_velocities() == 6 + 1 + 1 + 4
    assert_allclose(plant.CalcTotalMass(plant.CreateDefaultContext()), gear.mass)
    six = changed(gear, axle_positions=((16.5, y, z), (17.7, y, z), (18.9, y, z)))
    assert six.wheel_names[2] == "main_left_axle2_left"


def test_brake_torque_over_time_slows_the_aircraft():
    torque = 8e3
    brake = {"torque_table": [(0.05, 0.0), (0.1, torque)]}
    nose, *mains = aircraft_gears()
    gears = (nose, *(changed(gear, brake=brake) for gear in mains))
    landing = MakeLandingDiagram(aircraft_body(0), gears, gravity=9.80665, brakes=True)
    run = land(landing, duration=0.4, rolling=40.0)
    found = run["brake_main_left_left.torque"][0]
    assert_allclose(found[run.time > 0.11], torque, rtol=1e-3)
    drag = sum(run[f"tire_{w}.contact"][2] for w in landing.tires)
    # Four braked wheels; drag over torque is the loaded radius.
    radius = 0.584 - run["tire_main_left_left.contact"][0][-1]
    late = run.time > 0.3
    assert_allclose(drag[late].mean(), 4 * torque / radius, rtol=0.05)
    total = run["energy_budget.total"][0]
    braking = 0.5 * _mass(landing) * 40.0**2
    assert np.abs(total - total[0]).max() < 1e-6 * braking
    assert run["energy_budget.dissipated"][0][-1] > 1e5


def test_anti_skid_keeps_the_wheels_turning():
    skid = {"onset": 0.08, "release": 0.2, "protection_load": 1e4}
    nose, *mains = aircraft_gears()
    runs = {}
    for name, anti_skid, duration in (("locked", None, 0.06), ("held", skid, 0.15)):
        brake = {"torque": 1.2e5, "anti_skid": anti_skid}
        gears = (nose, *(changed(gear, brake=brake) for gear in mains))
        landing = MakeLandingDiagram(
            aircraft_body(0), gears, gravity=9.80665, brakes=True
        )
        runs[name] = land(landing, duration=duration, accuracy=1e-4, rolling=40.0)
    slip = {n: run["tire_main_left_left.contact"][4][-1] for n, run in runs.items()}
    assert slip["locked"] > 0.95
    assert 0.05 < slip["held"] < 0.2
    drag = {n: run["tire_main_left_left.contact"][2][-1] for n, run in runs.items()}
    load = {n: run["tire_main_left_left.contact"][1][-1] for n, run in runs.items()}
    assert_allclose(drag["held"] / load["held"], 0.8, atol=0.05)
    assert drag["locked"] / load["locked"] < 0.6


def test_brakes_are_not_applied_unless_asked_for():
    nose, *mains = aircraft_gears()
    gears = (nose, *(changed(gear, brake={"torque": 5e4}) for gear in mains))
    assert MakeLandingDiagram(aircraft_body(0), gears).brakes == {}


RAKE = np.radians(9.0)
NOSE_KINDS = {
    "telescopic": lambda: changed(aircraft_gears()[0], rake_deg=9.0),
    "levered": lambda: levered_main("nose"),
    "bogie": lambda: bogie_main("nose"),
}


@pytest.mark.parametrize("kind", NOSE_KINDS)
@pytest.mark.parametrize("angle", [5.0, -3.0])
def test_steered_wheels_slide_by_the_steering_angle(kind, angle):
    _, *mains = aircraft_gears()
    gears = (changed(NOSE_KINDS[kind](), steering_deg=angle), *mains)
    landing = MakeLandingDiagram(aircraft_body(0), gears)
    context = landing.diagram.CreateDefaultContext()
    kinematics = landing.wheel_kinematics.GetMyContextFromRoot(context)
    wheel = next(iter(landing.tires))
    axle = landing.wheel_kinematics.GetOutputPort(f"wheel_{wheel}").Eval(kinematics)
    # The wheel's forward direction is up × axle: nose to starboard is toward +y. The
    # heading of a raked strut's wheels is that of the turn seen from above.
    psi = np.radians(angle)
    seen = psi if kind != "telescopic" else np.arctan(np.tan(psi) * np.cos(RAKE))
    forward = np.cross([0.0, 0.0, 1.0], axle[3:6])
    expected = [-np.cos(seen), np.sin(seen), 0.0]
    assert_allclose(forward / np.linalg.norm(forward), expected, atol=1e-3)
    run = land(landing, duration=0.05, accuracy=1e-4)
    contact = run[f"tire_{wheel}.contact"]
    late = contact[1] > 0.5 * contact[1].max()
    assert_allclose(np.abs(contact[5][late]), abs(psi), rtol=0.05)
    # It moves to port of where it points: the runway pushes it to starboard.
    assert np.all(np.sign(run[f"tire_{wheel}.wrench"][4][late]) == np.sign(angle))
    total = run["energy_budget.total"][0]
    sink_energy = 0.5 * _mass(landing) * SINK_RATE**2
    assert np.abs(total - total[0]).max() < 1e-4 * sink_energy


def _strut_moved(plant, bodies, context):
    """Positions with 0.1 (m or rad) at the strut's joint."""
    q = plant.GetPositions(context)
    q[bodies.joints["strut"].position_start()] = 0.1
    return q


@pytest.mark.parametrize("kind", NOSE_KINDS)
def test_steering_turns_all_below_the_fitting_about_one_axis(kind):
    """Against the unsteered gear, turned as a whole about the steering axis."""
    straight = NOSE_KINDS[kind]()
    turned = changed(straight, steering_deg=20.0)
    axis = np.array([0.0, 0.0, 1.0]) if kind == "levered" else strut_axis(straight)
    center = np.array(getattr(straight, "pivot", straight.axles[0]))
    R = RotationMatrix(AngleAxis(-np.radians(20.0), axis)).matrix()
    poses, inertia = {}, {}
    for gear in (straight, turned):
        plant, bodies = _plant(gear)
        plant.Finalize()
        context = plant.CreateDefaultContext()
        plant.SetPositions(context, _strut_moved(plant, bodies, context))
        for name, body in {**bodies.parts, **bodies.wheels}.items():
            poses[gear, name] = body.EvalPoseInWorld(context)
        moving = [body.index() for body in bodies.parts.values()]
        spatial = plant.CalcSpatialInertia(context, plant.world_frame(), moving)
        about = spatial.Shift(center - P_BA).CalcRotationalInertia()
        inertia[gear] = about.CopyToFullMatrix3()
    for (gear, name), pose in poses.items():
        if gear is straight:
            p = center - P_BA + R @ (pose.translation() - center + P_BA)
            assert_allclose(poses[turned, name].translation(), p, atol=1e-12)
            found = poses[turned, name].rotation().matrix()
            assert_allclose(found, R @ pose.rotation().matrix(), atol=1e-12)
    assert_allclose(inertia[turned], R @ inertia[straight] @ R.T, atol=1e-9)


@pytest.mark.parametrize("kind", NOSE_KINDS)
def test_center_of_gravity_of_a_steered_gear_is_that_of_its_bodies(kind):
    gear = changed(NOSE_KINDS[kind](), steering_deg=35.0)
    plant, bodies = _plant(gear)
    plant.Finalize()
    context = plant.CreateDefaultContext()
    if bodies.pitch is not None:
        bodies.pitch.set_angle(context, 0.0)
    points = mass_points(gear)
    expected = sum(m * p for m, p in points) / gear.mass - P_BA
    found = plant.CalcCenterOfMassPositionInWorld(context)
    assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("gear", "change", "message"),
    [
        (levered_main, {"kind": "leverd"}, "telescopic, levered or bogie"),
        (levered_main, {"pivot": None}, "valid tuple"),
        (bogie_main, {"axle_positions": ()}, "at least 1 item"),
        (bogie_main, {"wheel_offsets": (0.4, 0.4)}, "strictly ascending"),
        (
            bogie_main,
            {"pitch_damper": {"trim_deg": 9, "stop_deg": 5}},
            "within stop_deg",
        ),
        (
            levered_main,
            {"brake": {}},
            "found none, expected one of torque, torque_table",
        ),
        (
            levered_main,
            {"brake": {"torque_table": [(0, 1.0), (0, 2.0)]}},
            "found 0 after 0, expected strictly ascending",
        ),
        (
            levered_main,
            {"brake": {"torque": 1.0, "anti_skid": {"onset": 0.3}}},
            "release: found 0.2, expected more than the onset, 0.3",
        ),
        (levered_main, {"attachment": "ball"}, "expected 6 or more"),
    ],
)
def test_bad_data_is_refused(gear, change, message):
    with pytest.raises(ValidationError, match=message):
        changed(gear(), **change)


def test_bearing_friction_has_no_place_in_a_pin_ended_absorber():
    gear = levered_main()
    absorber = gear.shock_absorber.model_dump() | {"bearing_friction": 0.1}
    with pytest.raises(ValidationError, match="carries no side load"):
        changed(gear, shock_absorber=absorber)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"absorber_lower": (17.0, -3.795, -3.0)}, "main_left: lever"),
        ({"pivot": (17.3, -3.795, -2.0)}, "almost no lever arm|beyond what the arm"),
        ({"absorber_lower": (16.4, -3.795, -3.4)}, "gets longer as the wheel goes up"),
    ],
)
def test_levers_that_cannot_work_are_refused(change, message):
    with pytest.raises(ValueError, match=message):
        _plant(changed(levered_main(), **change))


def test_telescopic_is_the_default_kind():
    data = aircraft_gears()[0].model_dump()
    del data["kind"]
    assert isinstance(read_gear(data), TelescopicGear)

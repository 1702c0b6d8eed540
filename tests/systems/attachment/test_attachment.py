"""Rigid and bushing attachment alone: constraint, power, ports."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import SpatialInertia
from pydrake.systems.framework import DiagramBuilder

from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.attachment.attachment import RigidAttachment
from systems.attachment.bushing_attachment import BushingAttachment
from systems.gear.gear_forces import spatial_forces
from systems.tools.rotations import (
    exp,
    quaternion_from_rotation,
    rotation_from_quaternion,
)
from tests.systems.small_gears import two_gears, violent_state
from tests.systems.synthetic_body import LEFT_GEAR, RIGHT_GEAR, aircraft_body


def _fixed(kind, gap=0.0, gap_rate=0.0, **options):
    """The attachment of a violently moving plant to nodes that deviate by the gap."""
    plant, fittings, wheels, *_ = two_gears(gravity=9.81)
    system = kind(plant, list(fittings.values()), **options)
    context = system.CreateDefaultContext()
    rng = np.random.default_rng(8)
    state = violent_state(plant)
    of_plant = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(of_plant, state)
    deviation, rate = gap * rng.normal(size=(2, 6)), gap_rate * rng.normal(size=12)
    pose, velocity = [], []
    for fitting, d in zip(fittings.values(), deviation):
        X = fitting.EvalPoseInWorld(of_plant)
        R_WN = exp(d[None, :3])[0].T @ X.rotation().matrix()
        pose += [*R_WN.ravel(), *(X.translation() - d[3:])]
        velocity += [*fitting.EvalSpatialVelocityInWorld(of_plant).get_coeffs()]
    half = rng.normal(size=(12, 12))
    inputs = {
        "plant_state": state,
        "generalized_force": 1e3 * rng.normal(size=plant.num_velocities()),
        "node_pose": pose,
        "node_velocity": np.array(velocity) - rate,
        "node_free_acceleration": 10.0 * rng.normal(size=12),
        "node_compliance": (1e-3 * half @ half.T).ravel(),
        "airframe_pose": [*quaternion_from_rotation(exp(np.ones((1, 3)))[0]), 0, 0, 0],
    }
    for name, value in inputs.items():
        system.GetInputPort(name).FixValue(context, value)
    bodies = [wheel.index() for wheel in wheels.values()]
    others = spatial_forces(bodies, 1e3 * rng.normal(size=(2, 6)))
    system.GetInputPort("spatial_forces").FixValue(context, others)
    return system, context, plant, of_plant, inputs, others, (deviation, rate)


def _eval(system, context, port):
    return system.GetOutputPort(port).Eval(context)


def test_both_sides_accelerate_alike():
    system, context, plant, of_plant, inputs, others, _ = _fixed(RigidAttachment)
    on_gear = _eval(system, context, "wrench_on_gear")
    plant.get_applied_spatial_force_input_port().FixValue(of_plant, others + on_gear)
    plant.get_applied_generalized_force_input_port().FixValue(
        of_plant, inputs["generalized_force"]
    )
    accelerations = plant.get_body_spatial_accelerations_output_port().Eval(of_plant)
    fitting = np.ravel([accelerations[int(f.body_index)].get_coeffs() for f in on_gear])
    wrench = _eval(system, context, "wrench_on_airframe")
    compliance = inputs["node_compliance"].reshape(12, 12)
    node = inputs["node_free_acceleration"] + compliance @ wrench
    assert np.abs(node).max() > 1.0
    assert_allclose(fitting, node, atol=1e-10 * np.abs(node).max())
    opposite = [f.F_Bq_W.get_coeffs() for f in on_gear]
    assert_allclose(wrench, -np.ravel(opposite))
    # The same as a generalised force.
    other = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(other, inputs["plant_state"])
    plant.get_applied_spatial_force_input_port().FixValue(other, others)
    plant.get_applied_generalized_force_input_port().FixValue(
        other,
        inputs["generalized_force"]
        + _eval(system, context, "generalized_force_on_gear"),
    )
    assert_allclose(
        plant.EvalTimeDerivatives(other).CopyToVector(),
        plant.EvalTimeDerivatives(of_plant).CopyToVector(),
        rtol=1e-10,
        atol=1e-9,
    )


def test_drift_is_taken_back_at_the_given_rates():
    case = {"gap": 1e-3, "gap_rate": 1e-2, "alpha": 30.0, "beta": 50.0}
    system, context, plant, of_plant, inputs, others, (gap, rate) = _fixed(
        RigidAttachment, **case
    )
    on_gear = _eval(system, context, "wrench_on_gear")
    plant.get_applied_spatial_force_input_port().FixValue(of_plant, others + on_gear)
    plant.get_applied_generalized_force_input_port().FixValue(
        of_plant, inputs["generalized_force"]
    )
    accelerations = plant.get_body_spatial_accelerations_output_port().Eval(of_plant)
    fitting = np.ravel([accelerations[int(f.body_index)].get_coeffs() for f in on_gear])
    wrench = _eval(system, context, "wrench_on_airframe")
    compliance = inputs["node_compliance"].reshape(12, 12)
    node = inputs["node_free_acceleration"] + compliance @ wrench
    expected = -2 * 30.0 * rate - 50.0**2 * gap.ravel()
    assert_allclose(fitting - node, expected, atol=1e-9 * np.abs(node).max())
    found = _eval(system, context, "gap").reshape(2, 2, 6)
    assert_allclose(found[:, 0], gap, atol=1e-12)
    assert_allclose(found[:, 1].ravel(), rate, atol=1e-12)


def test_loads_are_given_in_airframe_axes_force_first():
    (
        system,
        context,
        *_,
    ) = _fixed(RigidAttachment)
    wrench = _eval(system, context, "wrench_on_airframe").reshape(2, 2, 3)
    R_WB = exp(np.ones((1, 3)))[0]
    load = _eval(system, context, "load_in_airframe_axes").reshape(2, 2, 3)
    assert_allclose(load[:, 0], wrench[:, 1] @ R_WB, rtol=1e-12)
    assert_allclose(load[:, 1], wrench[:, 0] @ R_WB, rtol=1e-12)


def test_an_ideal_constraint_neither_stores_nor_dissipates():
    system, context, *_ = _fixed(RigidAttachment, gap=1e-3, gap_rate=1e-2)
    assert _eval(system, context, "energy")[0] == 0.0
    assert _eval(system, context, "dissipated_power")[0] == 0.0


def test_bushing_is_a_spring_and_a_damper():
    options = {
        "translational_stiffness": 2e8,
        "rotational_stiffness": 3e7,
        "translational_damping": 1e4,
        "rotational_damping": 2e3,
    }
    system, context, *_, (gap, rate) = _fixed(
        BushingAttachment, gap=1e-3, gap_rate=1e-2, **options
    )
    k, d = np.repeat([3e7, 2e8], 3), np.repeat([2e3, 1e4], 3)
    rate = rate.reshape(2, 6)
    wrench = _eval(system, context, "wrench_on_airframe").reshape(2, 6)
    assert_allclose(wrench, k * gap + d * rate, rtol=1e-8)
    assert_allclose(
        _eval(system, context, "energy"), 0.5 * (k * gap**2).sum(), rtol=1e-8
    )
    assert_allclose(
        _eval(system, context, "dissipated_power"), (d * rate**2).sum(), rtol=1e-8
    )


@pytest.mark.parametrize("angle", [1e-3, 0.8, 2.0])
def test_bushing_moment_has_a_potential_at_any_angle(angle):
    """Power of the moment is the rate of the stored energy, exactly."""
    system, context, _plant, _, inputs, *_ = _fixed(
        BushingAttachment, gap=angle, gap_rate=1.0, rotational_stiffness=1e3
    )
    gap = _eval(system, context, "gap").reshape(2, 2, 6)
    wrench = -_eval(system, context, "wrench_on_airframe").reshape(2, 6)
    h = 1e-6
    energies = []
    for t in (-h, h):
        turned = inputs["plant_state"].copy()
        for first, rate in zip(system._positions, gap[:, 1]):
            q = slice(first, first + 4)
            R = exp(t * rate[None, :3])[0] @ rotation_from_quaternion(turned[q])
            turned[q] = quaternion_from_rotation(R)
            turned[first + 4 : first + 7] += t * rate[3:]
        system.GetInputPort("plant_state").FixValue(context, turned)
        energies.append(_eval(system, context, "energy")[0])
    power = -(wrench * gap[:, 1]).sum()
    assert_allclose(np.diff(energies)[0] / (2 * h), power, rtol=1e-6)


@pytest.mark.parametrize(
    ("kind", "port", "expected"),
    [
        (RigidAttachment, "wrench_on_airframe", True),
        (RigidAttachment, "gap", False),
        (BushingAttachment, "wrench_on_airframe", False),
    ],
)
def test_feedthrough_of_the_free_acceleration(kind, port, expected):
    plant, fittings, *_ = two_gears()
    system = kind(plant, list(fittings.values()))
    source = system.GetInputPort("node_free_acceleration").get_index()
    target = system.GetOutputPort(port).get_index()
    assert system.HasDirectFeedthrough(source, target) is expected


def test_bad_attachments_are_refused():
    plant, fittings, wheels, *_ = two_gears()
    with pytest.raises(ValueError, match="left_wheel must be a free body"):
        RigidAttachment(plant, [wheels["left"]])
    with pytest.raises(ValueError, match="expected > 0"):
        BushingAttachment(plant, [fittings["left"]], translational_stiffness=0.0)
    with pytest.raises(ValueError, match="expected >= 0"):
        BushingAttachment(plant, [fittings["left"]], rotational_damping=-1.0)
    other = MultibodyPlant(0.0)
    body = other.AddRigidBody("beam", SpatialInertia.SolidSphereWithMass(1.0, 1.0))
    other.WeldFrames(other.world_frame(), body.body_frame())
    other.Finalize()
    with pytest.raises(ValueError, match="beam must be a free body"):
        RigidAttachment(other, [body])


def test_fittings_are_placed_on_moving_turned_nodes():
    """In a diagram made by hand: no gap, and none opens, whatever the airframe does."""
    builder = DiagramBuilder()
    plant, fittings, *_ = two_gears()
    builder.AddNamedSystem("plant", plant)
    body = aircraft_body(3)
    nodes = [LEFT_GEAR, RIGHT_GEAR]
    airframe = builder.AddNamedSystem("airframe", FlexibleAirframe(body, nodes))
    attachment = RigidAttachment(plant, list(fittings.values()))
    builder.AddNamedSystem("attachment", attachment)
    wires = [(plant, "state", "plant_state"), (airframe, "pose", "airframe_pose")]
    for port in ("pose", "velocity", "free_acceleration", "compliance"):
        wires.append((airframe, f"node_{port}", f"node_{port}"))
    for source, output, port in wires:
        builder.Connect(source.GetOutputPort(output), attachment.GetInputPort(port))
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    airframe.set_state(
        airframe.GetMyMutableContextFromRoot(context),
        p_WG=[1.0, 2.0, 9.0],
        quaternion=quaternion_from_rotation(exp(np.array([[0.1, 0.2, -0.3]]))[0]),
        v_WG=[-60.0, 1.0, -3.0],
        w_B=[0.1, 0.2, 0.3],
        modal_amplitudes=[3.0, -2.0, 1.0],
        modal_rates=[10.0, 20.0, -10.0],
    )
    attachment.place_fittings(context)
    gap = attachment.GetOutputPort("gap").Eval(attachment.GetMyContextFromRoot(context))
    assert_allclose(gap, 0.0, atol=1e-12)

"""Forces reach the plant with the right sign and at the right place."""

import numpy as np
from numpy.testing import assert_allclose

from systems.gear.gear_forces import GearForces
from systems.gear.wheel_kinematics import WheelKinematics
from tests.systems.small_gears import two_gears, violent_state


def _forces():
    plant, _, wheels, struts, spins = two_gears()
    system = GearForces(plant, wheels, struts, {"right": spins["right"]})
    context = system.CreateDefaultContext()
    inputs = {
        "wrench": np.concatenate([np.arange(6.0), -np.arange(6.0)]),
        "strut_force": [1e4, 2e4],
        "brake_right": [300.0],
    }
    for name, value in inputs.items():
        system.GetInputPort(name).FixValue(context, value)
    return plant, wheels, struts, spins, system, context


def test_strut_force_extends_the_strut_and_brake_torque_turns_the_wheel():
    plant, _, struts, spins, system, context = _forces()
    tau = system.GetOutputPort("generalized_force").Eval(context)
    expected = np.zeros(plant.num_velocities())
    expected[struts["left"].velocity_start()] = -1e4
    expected[struts["right"].velocity_start()] = -2e4
    expected[spins["right"].velocity_start()] = 300.0
    assert_allclose(tau, expected)


def test_tire_wrenches_act_at_the_wheel_centers():
    plant, wheels, _, _, system, context = _forces()
    forces = system.GetOutputPort("spatial_forces").Eval(context)
    assert [f.body_index for f in forces] == [w.index() for w in wheels.values()]
    for force, sign in zip(forces, (1.0, -1.0)):
        assert not np.any(force.p_BoBq_B)
        assert_allclose(force.F_Bq_W.get_coeffs(), sign * np.arange(6.0))
    # The plant feels the power of the wrenches at the wheels' velocities.
    of_plant = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(of_plant, violent_state(plant))
    plant.get_applied_spatial_force_input_port().FixValue(of_plant, forces)
    h = 1e-6
    kinetic = []
    x = plant.GetPositionsAndVelocities(of_plant)
    rate = plant.EvalTimeDerivatives(of_plant).CopyToVector()
    for t in (-h, h):
        other = plant.CreateDefaultContext()
        plant.SetPositionsAndVelocities(other, x + t * rate)
        kinetic.append(plant.EvalKineticEnergy(other))
    power = sum(
        sign * wheel.EvalSpatialVelocityInWorld(of_plant).get_coeffs() @ np.arange(6.0)
        for wheel, sign in zip(wheels.values(), (1.0, -1.0))
    )
    assert_allclose((kinetic[1] - kinetic[0]) / (2 * h), power, rtol=1e-5)


def test_feedthrough_of_each_output_is_its_own():
    *_, system, _ = _forces()
    spatial = system.GetOutputPort("spatial_forces").get_index()
    general = system.GetOutputPort("generalized_force").get_index()
    for name, to_spatial in (
        ("wrench", True),
        ("strut_force", False),
        ("brake_right", False),
    ):
        port = system.GetInputPort(name).get_index()
        assert system.HasDirectFeedthrough(port, spatial) is to_spatial
        assert system.HasDirectFeedthrough(port, general) is not to_spatial


def test_one_generalised_force_moves_the_plant_as_both_kinds_together():
    plant, wheels, struts, _, system, context = _forces()
    kinematics = WheelKinematics(plant, wheels, struts)
    of_kinematics = kinematics.CreateDefaultContext()
    state = violent_state(plant)
    kinematics.GetInputPort("plant_state").FixValue(of_kinematics, state)
    jacobian = kinematics.GetOutputPort("wheel_jacobian").Eval(of_kinematics)
    system.GetInputPort("wheel_jacobian").FixValue(context, jacobian)
    rates = []
    for together in (False, True):
        of_plant = plant.CreateDefaultContext()
        plant.SetPositionsAndVelocities(of_plant, state)
        spatial = system.GetOutputPort("spatial_forces").Eval(context)
        port = "all_generalized_force" if together else "generalized_force"
        plant.get_applied_spatial_force_input_port().FixValue(
            of_plant, [] if together else spatial
        )
        plant.get_applied_generalized_force_input_port().FixValue(
            of_plant, system.GetOutputPort(port).Eval(context)
        )
        rates.append(plant.EvalTimeDerivatives(of_plant).CopyToVector())
    assert_allclose(rates[1], rates[0], rtol=1e-11, atol=1e-11)

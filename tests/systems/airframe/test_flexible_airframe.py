"""The airframe alone: kinematics, conservation, frequencies, ports."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig

from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.tools.rotations import exp, log, rotation_from_quaternion
from tests.systems.synthetic_body import (
    LEFT_GEAR,
    NOSE_GEAR,
    NOSE_TIP,
    RIGHT_GEAR,
    TAIL_TIP,
    aircraft_body,
)

GEARS = (NOSE_GEAR, LEFT_GEAR, RIGHT_GEAR)
QUATERNION = np.array([0.8, 0.1, -0.3, 0.5]) / np.sqrt(0.99)


def _moving(modes=20, load_seed=None, loss_factor=0.03):
    """An airframe in a violent motion, with its context and wrench fixed."""
    body = aircraft_body(modes, loss_factor)
    airframe = FlexibleAirframe(body, GEARS, (NOSE_TIP, TAIL_TIP))
    context = airframe.CreateDefaultContext()
    rng = np.random.default_rng(1)
    # Amplitudes up to 0.3 m and nodal rotations up to about 0.1 rad.
    amplitude = 0.3 * rng.normal(size=modes) * airframe._scale
    airframe.set_state(
        context,
        p_WG=[5.0, -3.0, 2.0],
        quaternion=QUATERNION,
        v_WG=[-60.0, 1.0, -3.0],
        w_B=[0.3, -0.2, 0.4],
        modal_amplitudes=amplitude,
        modal_rates=5.0 * amplitude[::-1],
    )
    wrench = np.zeros(18)
    if load_seed is not None:
        wrench = 1e5 * np.random.default_rng(load_seed).normal(size=18)
    airframe.GetInputPort("attachment_wrench").FixValue(context, wrench)
    return airframe, context, wrench


def _eval(airframe, context, port):
    return airframe.GetOutputPort(port).Eval(context)


def _displaced(airframe, context, dt):
    """A context whose state is dt along the time derivative."""
    other = context.Clone()
    x = context.get_continuous_state_vector().CopyToVector()
    dx = airframe.EvalTimeDerivatives(context).CopyToVector()
    other.SetContinuousState(x + dt * dx)
    return other


@pytest.mark.parametrize(("kind", "count"), [("node", 3), ("monitor", 2)])
def test_node_velocity_is_the_rate_of_the_pose(kind, count):
    airframe, context, _ = _moving()
    h = 1e-6
    poses = [
        _eval(airframe, _displaced(airframe, context, t), f"{kind}_pose").reshape(
            -1, 12
        )
        for t in (-h, h)
    ]
    R = [p[:, :9].reshape(count, 3, 3) for p in poses]
    turn = log(R[1] @ R[0].swapaxes(1, 2)) / (2 * h)
    shift = (poses[1][:, 9:] - poses[0][:, 9:]) / (2 * h)
    velocity = _eval(airframe, context, f"{kind}_velocity").reshape(count, 2, 3)
    assert_allclose(velocity[:, 0], turn, atol=1e-7)
    assert_allclose(velocity[:, 1], shift, atol=1e-6)


def test_node_accelerations_are_the_rates_of_the_velocities():
    airframe, context, _ = _moving(load_seed=7)
    h = 1e-6
    for kind in ("node", "monitor"):
        before, after = (
            _eval(airframe, _displaced(airframe, context, t), f"{kind}_velocity")
            for t in (-h, h)
        )
        slope = ((after - before) / (2 * h)).reshape(-1, 2, 3)
        found = _eval(airframe, context, f"{kind}_acceleration").reshape(-1, 2, 3)
        if kind == "monitor":
            R_WB = rotation_from_quaternion(QUATERNION)
            found = found[:, ::-1] @ R_WB.T
        assert_allclose(found, slope, rtol=1e-6, atol=1e-6 * np.abs(slope).max())


def test_free_acceleration_and_compliance_give_the_loaded_acceleration():
    airframe, context, wrench = _moving(load_seed=3)
    free = _eval(airframe, context, "node_free_acceleration")
    compliance = _eval(airframe, context, "node_compliance").reshape(18, 18)
    loaded = _eval(airframe, context, "node_acceleration")
    assert_allclose(free + compliance @ wrench, loaded, rtol=1e-12, atol=1e-10)
    assert_allclose(compliance, compliance.T, atol=1e-18 + 1e-14 * compliance.max())
    assert np.linalg.eigvalsh(compliance).min() > 0


@pytest.mark.parametrize("modes", [0, 20])
def test_power_of_the_wrench_is_the_rate_of_energy_plus_dissipation(modes):
    airframe, context, wrench = _moving(modes=modes, load_seed=5)
    h = 1e-5
    rate = np.diff(
        [
            _eval(airframe, _displaced(airframe, context, t), "energy")[0]
            for t in (-h, h)
        ]
    )[0] / (2 * h)
    power = wrench @ _eval(airframe, context, "node_velocity")
    dissipated = _eval(airframe, context, "dissipated_power")[0]
    assert dissipated >= 0
    assert_allclose(rate + dissipated, power, rtol=1e-6)


def test_free_flight_keeps_momentum_and_energy():
    airframe, context, _ = _moving(modes=10, loss_factor=0.0)
    airframe.set_gravity(context, 9.81)
    simulator = Simulator(airframe, context)
    config = SimulatorConfig(
        integration_scheme="runge_kutta3", accuracy=1e-7, max_step_size=5e-3
    )
    ApplySimulatorConfig(config, simulator)

    def invariants():
        x = context.get_continuous_state_vector().CopyToVector()
        R = rotation_from_quaternion(x[3:7])
        spin = R @ airframe._inertia @ x[10:13]
        return spin, x[7:10], _eval(airframe, context, "energy")[0]

    spin0, v0, energy0 = invariants()
    simulator.AdvanceTo(1.0)
    spin, v, energy = invariants()
    assert_allclose(spin, spin0, rtol=1e-5)
    assert_allclose(v, v0 - [0, 0, 9.81], atol=1e-9)
    # Elastic and rotational energy, the part that the integrator can spoil.
    internal = energy0 - 0.5 * airframe._mass * v0 @ v0 - airframe._mass * 9.81 * 2.0
    assert abs(energy - energy0) < 2e-5 * internal


@pytest.mark.parametrize("mode", [0, 6])
def test_a_single_mode_rings_at_its_frequency(mode):
    body = aircraft_body(8, 0.0)
    airframe = FlexibleAirframe(body, GEARS)
    context = airframe.CreateDefaultContext()
    amplitude = np.eye(8)[mode] * airframe._scale[mode] * 0.01
    airframe.set_state(context, modal_amplitudes=amplitude)
    airframe.GetInputPort("attachment_wrench").FixValue(context, np.zeros(18))
    simulator = Simulator(airframe, context)
    ApplySimulatorConfig(
        SimulatorConfig(integration_scheme="runge_kutta3", accuracy=1e-8), simulator
    )
    quarter = 0.25 / body.frequency[mode]
    simulator.AdvanceTo(5 * quarter)
    found = _eval(airframe, context, "modal_amplitudes")[mode]
    assert abs(found) < 1e-5 * amplitude[mode]
    simulator.AdvanceTo(8 * quarter)
    found = _eval(airframe, context, "modal_amplitudes")
    assert_allclose(found, amplitude, atol=1e-5 * amplitude[mode])


def test_damping_matrix_may_couple_modes():
    body = aircraft_body(6)
    full = body.modal_damping + 0.2 * np.outer(np.ones(6), np.ones(6))
    coupled = type(body)(**{**body.__dict__, "modal_damping": full})
    airframe = FlexibleAirframe(coupled, GEARS)
    context = airframe.CreateDefaultContext()
    rate = np.arange(1.0, 7.0)
    airframe.set_state(context, modal_rates=rate)
    airframe.GetInputPort("attachment_wrench").FixValue(context, np.zeros(18))
    dx = airframe.EvalTimeDerivatives(context).CopyToVector()
    assert_allclose(airframe._scale * dx[-6:], -full @ rate, rtol=1e-12)
    assert_allclose(
        _eval(airframe, context, "dissipated_power"), rate @ full @ rate, rtol=1e-12
    )


def test_external_load_is_in_the_amplitudes_of_the_modal_body():
    body = aircraft_body(6, 0.0)
    airframe = FlexibleAirframe(body, GEARS)
    context = airframe.CreateDefaultContext()
    airframe.set_state(context, quaternion=QUATERNION)
    row = int(body.rows(RIGHT_GEAR)[0])
    R_WB = rotation_from_quaternion(QUATERNION)
    force = np.array([1e4, -2e4, 3e5])
    wrench = np.zeros(18)
    wrench[15:] = force
    airframe.GetInputPort("attachment_wrench").FixValue(context, wrench)
    at_node = airframe.EvalTimeDerivatives(context).CopyToVector()
    arm = body.p_BN[row] - body.p_BG
    modal = body.translation[row].T @ R_WB.T @ force
    load = np.concatenate([force, np.cross(arm, R_WB.T @ force), modal])
    airframe.GetInputPort("attachment_wrench").FixValue(context, np.zeros(18))
    airframe.GetInputPort("external_load").FixValue(context, load)
    as_load = airframe.EvalTimeDerivatives(context).CopyToVector()
    assert_allclose(as_load, at_node, rtol=1e-10, atol=1e-12)


def test_rotation_of_nodes_is_that_of_the_modes():
    body = aircraft_body(4)
    airframe = FlexibleAirframe(body, GEARS)
    context = airframe.CreateDefaultContext()
    amplitude = np.array([20.0, -10.0, 5.0, 3.0])
    airframe.set_state(context, modal_amplitudes=amplitude)
    pose = _eval(airframe, context, "node_pose").reshape(3, 12)
    rows = body.rows(GEARS)
    assert_allclose(
        pose[:, :9].reshape(3, 3, 3), exp(body.rotation[rows] @ amplitude), atol=1e-14
    )
    shift = body.p_BN[rows] - body.p_BG + body.translation[rows] @ amplitude
    assert_allclose(pose[:, 9:], shift, atol=1e-13)
    assert_allclose(_eval(airframe, context, "modal_amplitudes"), amplitude, rtol=1e-14)


def test_only_accelerations_under_load_feed_the_wrench_through():
    airframe = FlexibleAirframe(aircraft_body(3), GEARS, (NOSE_TIP,))
    wrench = airframe.GetInputPort("attachment_wrench").get_index()
    through = {
        airframe.get_output_port(i).get_name()
        for i in range(airframe.num_output_ports())
        if airframe.HasDirectFeedthrough(wrench, i)
    }
    assert through == {"node_acceleration", "monitor_acceleration"}


def test_default_state_is_at_rest_and_valid():
    airframe = FlexibleAirframe(aircraft_body(3), GEARS)
    context = airframe.CreateDefaultContext()
    airframe.GetInputPort("attachment_wrench").FixValue(context, np.zeros(18))
    assert not airframe.EvalTimeDerivatives(context).CopyToVector().any()


def test_unknown_node_is_named():
    with pytest.raises(ValueError, match="no node \\[999\\]"):
        FlexibleAirframe(aircraft_body(3), (999,))

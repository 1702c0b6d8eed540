"""Lift that follows the motion: a hand model of two freedoms, power, signs."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import LogVectorOutput
from scipy.integrate import solve_ivp

from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_body import ModalBody
from systems.airframe.quasi_steady_lift import QuasiSteadyLift, Surface
from systems.tools.rotations import exp, quaternion_from_rotation
from systems.tools.table import Table
from tests.systems.synthetic_body import aircraft_body

G, V, MASS, INERTIA = 9.81, 67.0, 7e4, 3e6
# Wing to port and starboard, a little aft of the center of gravity; tail.
X_WING, X_TAIL = 0.4, 17.0
WING = Surface(nodes=[1, 2], shares=[0.5, 0.5], area=120.0, slope=5.0)
TAIL = Surface(nodes=[3], shares=[1.0], area=30.0, slope=4.0)
DOWNWASH, LAG, DAMPING = 0.35, 0.25, 1e6


def rigid_body() -> ModalBody:
    places = [[X_WING, -6.0, 0.0], [X_WING, 6.0, 0.0], [X_TAIL, 0.0, 0.0]]
    return ModalBody(
        mass=MASS,
        p_BG=np.zeros(3),
        inertia_G=np.diag([2e6, INERTIA, 4e6]),
        frequency=np.zeros(0),
        modal_mass=np.zeros(0),
        modal_damping=np.zeros((0, 0)),
        node_id=np.array([1, 2, 3]),
        p_BN=np.array(places),
        translation=np.zeros((3, 3, 0)),
        rotation=np.zeros((3, 3, 0)),
    )


def flight(body, lift):
    """An airframe in flight with this lift, and what is logged of it."""
    builder = DiagramBuilder()
    airframe = FlexibleAirframe(body, [int(body.node_id[0])], gravity=G)
    builder.AddNamedSystem("airframe", airframe)
    builder.AddNamedSystem("lift", lift)
    for i in range(lift.num_input_ports()):
        port = lift.get_input_port(i)
        builder.Connect(airframe.GetOutputPort(port.get_name()), port)
    builder.Connect(lift.GetOutputPort("load"), airframe.GetInputPort("external_load"))
    builder.ExportInput(airframe.GetInputPort("attachment_wrench"), "wrench")
    logs = [
        LogVectorOutput(airframe.GetOutputPort(name), builder)
        for name in ("pose", "velocity")
    ]
    return builder.Build(), airframe, logs


def test_heave_and_pitch_are_those_of_the_hand_model():
    lift = QuasiSteadyLift(
        rigid_body(),
        MASS * G,
        WING,
        TAIL,
        downwash=DOWNWASH,
        lag=LAG,
        pitch_damping=DAMPING,
    )
    diagram, airframe, logs = flight(rigid_body(), lift)
    simulator = Simulator(diagram)
    config = SimulatorConfig(
        integration_scheme="runge_kutta3", accuracy=1e-8, max_step_size=1e-2
    )
    ApplySimulatorConfig(config, simulator)
    context = simulator.get_mutable_context()
    diagram.GetInputPort("wrench").FixValue(context, np.zeros(6))
    own = airframe.GetMyMutableContextFromRoot(context)
    airframe.set_state(own, p_WG=[0, 0, 10], v_WG=[-V, 0, -2.0])
    lift.set_reference(lift.GetMyMutableContextFromRoot(context))
    pitch, extra = 1e-3, 0.05
    turned = quaternion_from_rotation(exp(np.array([[0.0, pitch, 0.0]]))[0])
    airframe.set_state(
        own, p_WG=[0, 0, 10], v_WG=[-V, 0, -2.0 + extra], quaternion=turned
    )
    simulator.AdvanceTo(2.0)

    q = 0.5 * 1.225 * V**2
    wing, tail = q * WING.area * WING.slope, q * TAIL.area * TAIL.slope

    def rates(_, x):
        rise, theta, turn, washed = x
        # Aft of the center of gravity a nose that rises lets the node sink.
        of_wing = theta - (rise - X_WING * turn) / V
        of_tail = theta - (rise - X_TAIL * turn) / V - washed
        lifting, steady = wing * of_wing, MASS * G
        force = lifting + tail * of_tail
        moment = -X_WING * (lifting + steady) - X_TAIL * tail * of_tail
        moment -= DAMPING * turn
        return [
            force / MASS,
            turn,
            moment / INERTIA,
            (DOWNWASH * of_wing - washed) / LAG,
        ]

    time = logs[0].FindLog(context).sample_times()
    hand = solve_ivp(
        rates, [0, 2], [extra, pitch, 0, 0], t_eval=time, rtol=1e-9, atol=1e-12
    )
    velocity = logs[1].FindLog(context).data()
    theta = 2.0 * np.arcsin(logs[0].FindLog(context).data()[2])
    for found, expected in (
        (velocity[5] + 2.0, hand.y[0]),
        (theta, hand.y[1]),
        (velocity[1], hand.y[2]),
    ):
        # Cosines of the pitch angle, which reaches some hundredths, are left out.
        assert_allclose(found, expected, atol=3e-3 * np.abs(expected).max())
    assert np.abs(theta).max() > 5 * pitch


def of_airframe(n=8):
    body = aircraft_body(n)
    nodes = [*range(21, 28), *range(31, 38)]
    wing = Surface(nodes=nodes, shares=np.full(14, 1 / 14), area=120.0, slope=5.0)
    tail = Surface(nodes=[30, 40], shares=[0.5, 0.5], area=30.0, slope=4.0)
    lift = QuasiSteadyLift(body, 7e5, wing, tail, downwash=0.3)
    airframe = FlexibleAirframe(body, nodes, gravity=G)
    return body, lift, airframe


def test_power_on_the_airframe_is_force_times_velocity_of_the_nodes():
    body, lift, _ = of_airframe()
    airframe = FlexibleAirframe(body, lift.nodes, gravity=G)
    rng = np.random.default_rng(4)
    context, of_lift = airframe.CreateDefaultContext(), lift.CreateDefaultContext()

    def fly(**state):
        airframe.set_state(context, v_WG=[-60.0, 1.0, -2.0], **state)
        for name in ("pose", "velocity", "modal_amplitudes", "modal_rates"):
            value = airframe.GetOutputPort(name).Eval(context)
            lift.GetInputPort(name).FixValue(of_lift, value)

    fly()
    lift.set_reference(of_lift)
    assert_allclose(lift.GetOutputPort("force").Eval(of_lift), 7e5)
    turned = quaternion_from_rotation(exp(0.05 * rng.normal(size=(1, 3)))[0])
    fly(
        quaternion=turned,
        w_B=0.1 * rng.normal(size=3),
        modal_amplitudes=rng.normal(size=8),
        modal_rates=10.0 * rng.normal(size=8),
    )
    load = lift.GetOutputPort("load").Eval(of_lift)
    airframe.GetInputPort("external_load").FixValue(context, load)
    force = lift.GetOutputPort("node_force").Eval(of_lift)
    rising = airframe.GetOutputPort("node_velocity").Eval(context).reshape(-1, 6)[:, 5]
    power = airframe.GetOutputPort("external_power").Eval(context)[0]
    assert power == pytest.approx(force @ rising, rel=1e-9)
    assert load[2] == pytest.approx(force.sum())


def test_rolling_turning_and_bending_are_damped():
    _, lift, airframe = of_airframe()
    context, of_lift = airframe.CreateDefaultContext(), lift.CreateDefaultContext()

    def load(**state):
        airframe.set_state(context, v_WG=[-60.0, 0.0, -2.0], **state)
        for name in ("pose", "velocity", "modal_amplitudes", "modal_rates"):
            value = airframe.GetOutputPort(name).Eval(context)
            lift.GetInputPort(name).FixValue(of_lift, value)
        return lift.GetOutputPort("load").Eval(of_lift)

    load()
    lift.set_reference(of_lift)
    still = load()
    for axis in (0, 1):
        turning = 0.1 * np.eye(3)[axis]
        assert (load(w_B=turning) - still)[3 + axis] < -1e3
    rate = np.eye(8)[0]
    assert (load(modal_rates=rate) - still)[6] < 0.0


def test_schedule_takes_the_lift_and_bad_values_are_named():
    body, _, _ = of_airframe(0)
    wing = Surface(nodes=[21, 31], shares=[0.5, 0.5], area=120.0, slope=5.0)
    lift = QuasiSteadyLift(body, Table((0.1, 0.2), (7e5, 1e5)), wing)
    context = lift.CreateDefaultContext()
    for name, value in (
        ("pose", [1.0, 0, 0, 0, 0, 0, 0]),
        ("velocity", [0.0, 0, 0, -60, 0, -2]),
        ("modal_amplitudes", []),
        ("modal_rates", []),
    ):
        lift.GetInputPort(name).FixValue(context, value)
    lift.set_reference(context)
    for time, expected in ((0.0, 7e5), (0.15, 4e5), (1.0, 1e5)):
        context.SetTime(time)
        assert_allclose(lift.GetOutputPort("force").Eval(context), expected)
    with pytest.raises(ValueError, match="lag is -1"):
        QuasiSteadyLift(body, 1.0, wing, lag=-1.0)
    with pytest.raises(ValueError, match="1 shares for 2 nodes"):
        Surface(nodes=[1, 2], shares=[1.0], area=1.0, slope=1.0)

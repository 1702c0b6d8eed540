"""Attachment loads against one multibody plant in which the gears are welded.

The oracle is a rigid airframe as a body of the same plant, WeldJoints instead of the
attachment, and the plant's own reaction forces. Kinematics, laws and data of the gears
are the same systems.
"""

from typing import Any, cast

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    RotationalInertia,
    SpatialInertia,
    WeldJoint,
)
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import DiagramBuilder, EventStatus

from drake_landing.gears.bodies import AddLandingGear
from drake_landing.gears.parameters import shock_absorber_parameters, tire_parameters
from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.initial_state import angular_velocity, attitude
from systems.gear.gear_forces import GearForces
from systems.gear.wheel_kinematics import WheelKinematics
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.tire.tire import Tire
from tests.drake_landing.landing_gears import aircraft_gears
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import aircraft_body

STEP, DURATION = 2.5e-4, 0.1
R_WB = attitude(np.radians(1.5), np.radians(2.0), np.radians(3.0))
W_B = angular_velocity(0.06, 0.02, -0.04)
V_WG = np.array([-67.0, 1.0, -2.5])


def _oracle(body, gears):
    builder = DiagramBuilder()
    plant = builder.AddNamedSystem("plant", MultibodyPlant(0.0))
    moments, products = body.inertia_G.diagonal(), body.inertia_G[[0, 0, 1], [1, 2, 2]]
    airframe = plant.AddRigidBody(
        "airframe",
        SpatialInertia.MakeFromCentralInertia(
            body.mass, np.zeros(3), RotationalInertia(*moments, *products)
        ),
    )
    welds, bodies = [], {}
    for gear in gears:
        p_BA = body.p_BN[body.rows(gear.attachment_node)[0]]
        bodies[gear.name] = AddLandingGear(plant, gear, p_BA)
        node = plant.AddFrame(
            FixedOffsetFrame(
                f"{gear.name}_node",
                airframe.body_frame(),
                RigidTransform(p_BA - body.p_BG),
            )
        )
        welds.append(
            plant.AddJoint(
                WeldJoint(
                    f"{gear.name}_weld",
                    node,
                    bodies[gear.name].fitting.body_frame(),
                    RigidTransform(),
                )
            )
        )
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, 0.0])
    plant.Finalize()
    wheels = {n: w for b in bodies.values() for n, w in b.wheels.items()}
    struts = {name: b.strut for name, b in bodies.items()}
    kinematics = builder.AddSystem(WheelKinematics(plant, wheels, struts))
    forces = builder.AddSystem(GearForces(plant, wheels, struts))

    def connect(a, out, b, port):
        builder.Connect(a.GetOutputPort(out), b.GetInputPort(port))

    connect(plant, "state", kinematics, "plant_state")
    laws = [shock_absorber_parameters(gear.shock_absorber) for gear in gears]
    absorber = builder.AddSystem(cast(Any, ShockAbsorber)(laws))
    connect(kinematics, "struts", absorber, "strut_state")
    connect(absorber, "force", forces, "strut_force")
    laws = [tire_parameters(gear.tyre) for gear in gears for _ in gear.wheel_names]
    tire = builder.AddSystem(cast(Any, Tire)(laws))
    connect(kinematics, "wheels", tire, "wheel")
    connect(tire, "wrench", forces, "wrench")
    connect(forces, "spatial_forces", plant, "applied_spatial_force")
    connect(forces, "generalized_force", plant, "applied_generalized_force")
    return builder.Build(), plant, airframe, welds


def _oracle_loads(body, gears, p_WG):
    """(18, times) [force; moment] on the airframe at each node, B."""
    diagram, plant, airframe, welds = _oracle(body, gears)
    simulator = Simulator(diagram)
    config = SimulatorConfig(
        integration_scheme="runge_kutta3", max_step_size=STEP, use_error_control=False
    )
    ApplySimulatorConfig(config, simulator)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetFreeBodyPose(context, airframe, RigidTransform(RotationMatrix(R_WB), p_WG))
    plant.SetFreeBodySpatialVelocity(
        context, airframe, SpatialVelocity(R_WB @ W_B, V_WG)
    )
    reactions = plant.get_reaction_forces_output_port()
    loads = []

    def record(_):
        of_joints = reactions.Eval(context)
        wrenches = [of_joints[int(weld.index())].get_coeffs() for weld in welds]
        loads.append(-np.reshape(wrenches, (3, 2, 3))[:, ::-1].ravel())
        return EventStatus.DidNothing()

    simulator.set_monitor(record)
    simulator.Initialize()
    simulator.AdvanceTo(DURATION)
    return np.array(loads).T


def test_attachment_loads_are_the_reactions_of_welds():
    body, gears = aircraft_body(0), aircraft_gears()
    landing = MakeLandingDiagram(body, gears)
    run = land(landing, duration=DURATION, step=STEP, v_WG=V_WG, R_WB=R_WB, w_B=W_B)
    p_WG = run["airframe.pose"][4:, 0]
    expected = _oracle_loads(body, gears, p_WG).reshape(3, 2, 3, -1)
    found = run["attachment.load_in_airframe_axes"].reshape(3, 2, 3, -1)
    assert found.shape == expected.shape
    for part in (0, 1):  # forces, moments
        peak = np.abs(expected[:, part]).max()
        assert peak > 1e5
        assert np.abs(found[:, part] - expected[:, part]).max() < 1e-8 * peak

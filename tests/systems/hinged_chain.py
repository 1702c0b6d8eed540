"""A free-flying chain of rigid bodies with spring hinges, exact and as a modal body.

Drake's MultibodyPlant solves the chain without any approximation of kinematics: large
rotations, centrifugal and gyroscopic forces, change of inertia by deformation. Its
linearisation about the straight state gives the modal body: what the two do differently
is the error of the formulation of FlexibleAirframe, truncation not among it.
"""

from dataclasses import dataclass

import numpy as np
from pydrake.common.value import Value
from pydrake.math import RigidTransform
from pydrake.multibody.math import SpatialForce
from pydrake.multibody.plant import ExternallyAppliedSpatialForce, MultibodyPlant
from pydrake.multibody.tree import (
    BodyIndex,
    FixedOffsetFrame,
    ForceElementIndex,
    JacobianWrtVariable,
    RevoluteJoint,
    RevoluteSpring,
    SpatialInertia,
    UnitInertia,
)
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import DiagramBuilder, LeafSystem

from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_body import ModalBody

BODIES, LENGTH, MASS, RADIUS = 11, 36.0, 60e3, 2.0
MIDDLE, TIP = BODIES // 2, 0
FIRST_HZ = 2.5
PULSE = 0.2  # s, half a sine of force on the middle body
DURATION = 1.0
INSTANTS = np.linspace(0.0, DURATION, 401)


class Push(LeafSystem):
    """Half a sine of force along z in W: as a wrench (6) and as the plant takes it."""

    def __init__(self, peak: float, body: BodyIndex) -> None:
        super().__init__()
        self._peak, self._body = peak, body
        time = {self.time_ticket()}
        self.DeclareVectorOutputPort("wrench", 6, self._calc_wrench, time)
        self.DeclareAbstractOutputPort(
            "spatial_force",
            lambda: Value([ExternallyAppliedSpatialForce()]),
            self._calc_spatial,
            time,
        )

    def _wrench(self, t: float) -> np.ndarray:
        wrench = np.zeros(6)
        if t < PULSE:
            wrench[5] = self._peak * np.sin(np.pi * t / PULSE)
        return wrench

    def _calc_wrench(self, context, output) -> None:
        output.SetFromVector(self._wrench(context.get_time()))

    def _calc_spatial(self, context, output) -> None:
        force = ExternallyAppliedSpatialForce()
        force.body_index = self._body
        force.F_Bq_W = SpatialForce(self._wrench(context.get_time()))
        output.set_value([force])


def chain_plant(stiffness: float, ratio: float) -> MultibodyPlant:
    """The chain along x, of universal joints.

    Args:
        stiffness: of each joint about y, N m/rad.
        ratio: of the stiffness about z to that.
    """
    plant = MultibodyPlant(0.0)
    piece = LENGTH / BODIES
    inertia = UnitInertia.SolidCylinder(RADIUS, piece, [1.0, 0.0, 0.0])
    solid = SpatialInertia(MASS / BODIES, np.zeros(3), inertia)
    # Massless knuckles would make M singular at no motion; these weigh next to nothing.
    knuckle = SpatialInertia(1e-3, np.zeros(3), UnitInertia.SolidSphere(0.1))
    pieces = [plant.AddRigidBody(f"piece{i}", solid) for i in range(BODIES)]

    def hinge(name, parent, child, before, after, axis, spring):
        joint = plant.AddJoint(
            RevoluteJoint(
                name,
                _offset(plant, name + "_p", parent, before),
                _offset(plant, name + "_c", child, after),
                axis,
            )
        )
        plant.AddForceElement(RevoluteSpring(joint, 0.0, spring))

    # Outwards from the middle, which is the free body.
    for step in (1, -1):
        i = MIDDLE
        while 0 <= i + step < BODIES:
            name = f"{i}_{i + step}"
            between = plant.AddRigidBody("knuckle" + name, knuckle)
            half = step * piece / 2
            nextone = pieces[i + step]
            hinge("y" + name, pieces[i], between, half, 0.0, _Y, stiffness)
            hinge("z" + name, between, nextone, 0.0, -half, _Z, ratio * stiffness)
            i += step
    plant.mutable_gravity_field().set_gravity_vector(np.zeros(3))
    plant.Finalize()
    return plant


_Y, _Z = np.eye(3)[1:]


def _offset(plant, name, body, x):
    X = RigidTransform([x, 0.0, 0.0])
    return plant.AddFrame(FixedOffsetFrame(name, body.body_frame(), X))


@dataclass(frozen=True)
class Chain:
    """Stiffnesses of the joints about y and their ratio; the modal body."""

    stiffness: float
    ratio: float
    body: ModalBody


def make_chain(ratio: float) -> Chain:
    """Scaled so that the first mode is at FIRST_HZ; ratio: see `chain_plant`."""
    frequency = _modes(chain_plant(1.0, ratio))[0]
    stiffness = (FIRST_HZ / frequency[0]) ** 2
    plant = chain_plant(stiffness, ratio)
    frequency, shape = _modes(plant)
    context = plant.CreateDefaultContext()
    world, places, jacobians = plant.world_frame(), [], []
    for i in range(BODIES):
        piece = plant.GetBodyByName(f"piece{i}")
        places.append(plant.EvalBodyPoseInWorld(context, piece).translation())
        J = plant.CalcJacobianSpatialVelocity(
            context,
            JacobianWrtVariable.kV,
            piece.body_frame(),
            np.zeros(3),
            world,
            world,
        )
        jacobians.append(J @ shape)
    places, motion = np.array(places), np.array(jacobians)
    n = len(frequency)
    inertia = plant.CalcSpatialInertia(
        context,
        world,
        [plant.GetBodyByName(f"piece{i}").index() for i in range(BODIES)],
    )
    body = ModalBody(
        mass=inertia.get_mass(),
        p_BG=np.zeros(3),
        inertia_G=inertia.CalcRotationalInertia().CopyToFullMatrix3(),
        frequency=frequency,
        modal_mass=np.ones(n),
        modal_damping=np.zeros((n, n)),
        node_id=np.arange(1, BODIES + 1),
        p_BN=places,
        translation=motion[:, 3:],
        rotation=motion[:, :3],
    )
    return Chain(stiffness, ratio, body)


def _modes(plant: MultibodyPlant) -> tuple[np.ndarray, np.ndarray]:
    """Elastic frequencies (Hz) and mass-normal modes (nv, n) of the straight chain."""
    context = plant.CreateDefaultContext()
    M = plant.CalcMassMatrix(context)
    K = np.zeros_like(M)
    for i in range(plant.num_force_elements()):
        element = plant.get_force_element(ForceElementIndex(i))
        if isinstance(element, RevoluteSpring):
            row = element.joint().velocity_start()
            K[row, row] = element.default_stiffness()
    L = np.linalg.inv(np.linalg.cholesky(M))
    values, vectors = np.linalg.eigh(L @ K @ L.T)
    assert abs(values[5]) < 1e-6 * values[6]
    return np.sqrt(values[6:]) / (2 * np.pi), L.T @ vectors[:, 6:]


@dataclass(frozen=True)
class Motion:
    """Of middle and tip: (t, 2, 3) places, (t, 3, 3) attitude of the middle, W."""

    place: np.ndarray
    attitude: np.ndarray

    @property
    def acceleration(self) -> np.ndarray:
        """(t - 2, 2, 3) by second differences, m/s²."""
        return np.diff(self.place, 2, axis=0) / INSTANTS[1] ** 2

    @property
    def deflection(self) -> np.ndarray:
        """(t, 3) of the tip against the middle, in the axes of the middle, m."""
        arm = self.place[:, 1] - self.place[:, 0]
        seen = np.einsum("tji,tj->ti", self.attitude, arm)
        return seen - seen[0]


def _simulate(diagram, initialise, observe) -> list:
    simulator = Simulator(diagram)
    config = SimulatorConfig(
        integration_scheme="runge_kutta3", accuracy=1e-7, max_step_size=2e-3
    )
    ApplySimulatorConfig(config, simulator)
    context = simulator.get_mutable_context()
    initialise(context)
    simulator.Initialize()
    found = []
    for t in INSTANTS:
        simulator.AdvanceTo(t)
        found.append(observe(context))
    return found


def exact_motion(chain: Chain, peak: float, spin: np.ndarray) -> Motion:
    """The plant's; spin is the initial angular velocity, rad/s."""
    builder = DiagramBuilder()
    plant = builder.AddSystem(chain_plant(chain.stiffness, chain.ratio))
    pieces = [plant.GetBodyByName(f"piece{i}") for i in (MIDDLE, TIP)]
    push = builder.AddSystem(Push(peak, pieces[0].index()))
    builder.Connect(
        push.GetOutputPort("spatial_force"),
        plant.GetInputPort("applied_spatial_force"),
    )

    def initialise(context):
        own = plant.GetMyMutableContextFromRoot(context)
        rates = np.zeros(plant.num_velocities())
        start = pieces[0].floating_velocities_start_in_v()
        rates[start : start + 3] = spin
        plant.SetVelocities(own, rates)

    def observe(context):
        own = plant.GetMyContextFromRoot(context)
        poses = [plant.EvalBodyPoseInWorld(own, piece) for piece in pieces]
        return [p.translation() for p in poses], poses[0].rotation().matrix()

    place, attitude = zip(*_simulate(builder.Build(), initialise, observe))
    return Motion(np.array(place), np.array(attitude))


def modal_motion(chain: Chain, peak: float, spin: np.ndarray) -> Motion:
    """That of a FlexibleAirframe."""
    builder = DiagramBuilder()
    airframe = builder.AddSystem(
        FlexibleAirframe(chain.body, [1 + MIDDLE], [1 + MIDDLE, 1 + TIP])
    )
    push = builder.AddSystem(Push(peak, BodyIndex(1)))
    builder.Connect(
        push.GetOutputPort("wrench"), airframe.GetInputPort("attachment_wrench")
    )

    def initialise(context):
        own = airframe.GetMyMutableContextFromRoot(context)
        airframe.set_state(own, w_B=spin)

    def observe(context):
        own = airframe.GetMyContextFromRoot(context)
        pose = airframe.GetOutputPort("monitor_pose").Eval(own).reshape(2, 12)
        return pose[:, 9:], pose[0, :9].reshape(3, 3)

    place, attitude = zip(*_simulate(builder.Build(), initialise, observe))
    return Motion(np.array(place), np.array(attitude))


@dataclass(frozen=True)
class Difference:
    """Of modal and exact motion, relative to the largest exact value of each.

    Attributes:
        amplitude: largest deflection of the tip over half the length.
        deflection: across the chain (y and z).
        shortening: along it (x), over the largest deflection.
        middle: acceleration of the middle, where the force acts.
        tip: acceleration of the tip across the undeformed, unturned chain (y and z).
    """

    amplitude: float
    deflection: float
    shortening: float
    middle: float
    tip: float


def difference(chain: Chain, peak: float, spin: np.ndarray) -> Difference:
    """Modal against exact: force of that peak (N), initial spin (rad/s)."""
    exact, modal = exact_motion(chain, peak, spin), modal_motion(chain, peak, spin)
    largest = np.abs(exact.deflection).max()
    across = np.abs(modal.deflection - exact.deflection)
    a, b = exact.acceleration, modal.acceleration
    gap = np.abs(b - a)
    return Difference(
        amplitude=largest / (LENGTH / 2),
        deflection=across[:, 1:].max() / largest,
        shortening=across[:, 0].max() / largest,
        middle=gap[:, 0].max() / np.abs(a[:, 0]).max(),
        tip=gap[:, 1, 1:].max() / np.abs(a[:, 1]).max(),
    )

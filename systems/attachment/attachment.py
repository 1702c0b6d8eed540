"""Landing gears held by the airframe: the attachment loads.

Each gear's fitting, a free body of the plant, is to follow a node of the airframe. The
load between them is found from what both would do without it, in one solve for all
gears, since they move each other through the airframe:

    (J M⁻¹ Jᵀ + C_N) λ = a_N,free - a_F,free - 2 α g' - β² g,

λ on the fittings, C_N the compliance of the nodes, g the gap and g' its rate. The last
two terms (Baumgarte) take back the drift of the numerical integration; with a perfect
integrator they are zero. Only inputs that do not depend on λ enter, so the diagram has
no algebraic loop.

A fitting may be held at several nodes, see `attachment_points`: then J and the nodes'
quantities are multiplied by the rows of those conditions, and elastic rows join the
known forces.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.common.value import Value
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import ExternallyAppliedSpatialForce, MultibodyPlant
from pydrake.multibody.tree import MultibodyForces, RigidBody
from pydrake.systems.framework import Context, LeafSystem, ValueProducer

from systems.attachment import attachment_solve
from systems.attachment.attachment_points import AttachmentPoint, HoldPattern, Rows
from systems.gear.gear_forces import spatial_forces
from systems.tools.plant_context import declare_plant_context
from systems.tools.rotations import rotation_from_quaternion
from systems.tools.weak_methods import weakly

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Gap:
    """Fittings relative to nodes.

    Attributes:
        points: (k, 2, 6) rotation and translation, and their rates, W.
        gap, rate: (m,) along the rows of the conditions.
        rows: the rows; None where they are the identity.
    """

    points: Float64
    gap: Float64
    rate: Float64
    rows: Rows | None


class Attachment(LeafSystem):
    """Common ports of the ways to attach gears at k nodes; vectors node after node.

    | port | size | unit | frame and sign |
    |---|---|---|---|
    | in `plant_state` | nq + nv | | positions and velocities of the plant |
    | in `generalized_force` | nv | N, N m | all other forces on the gears, as the plant
      gets them |
    | in `spatial_forces` (optional) | abstract | | these too, as a list |
    | in `node_pose` | 12 k | -, m | R_WN by rows, p_WN of the airframe's nodes |
    | in `node_velocity` | 6 k | rad/s, m/s | [angular; linear], W |
    | in `node_free_acceleration` | 6 k | rad/s², m/s² | the same without the loads, W |
    | in `node_compliance` | (6 k)² | | acceleration per wrench, W |
    | in `airframe_pose` | 7 | -, m | quaternion of R_WB, p_WG |
    | out `wrench_on_airframe` | 6 k | N m, N | [torque; force] at the nodes, W |
    | out `wrench_on_gear` | abstract | | the opposite on the fittings, for the plant |
    | out `generalized_force_on_gear` | nv | N, N m | the same; use one of both |
    | out `load_in_airframe_axes` | 6 k | N, N m | [force; moment] on the airframe, B |
    | out `gap` | 12 k | rad, m, 1/s | fitting less node: [rotation; translation] and
      their rates, W |
    | out `energy` | 1 | J | stored in the attachment |
    | out `dissipated_power` | 1 | W | >= 0 |

    Args:
        plant: finalised; the fittings are free bodies on quaternion floating joints.
        points: of each node how it holds which fitting; a mere body is one whose frame
            is to coincide with the node.

    Raises:
        ValueError: a fitting is not a free body, or is left free to move.
    """

    def __init__(
        self, plant: MultibodyPlant, points: Sequence[RigidBody | AttachmentPoint]
    ) -> None:
        super().__init__()
        self._plant = plant
        self._pattern = pattern = HoldPattern([_point(point) for point in points])
        self._k = k = len(points)
        fittings = pattern.fittings
        self._bodies = tuple(body.index() for body in fittings)
        for body in fittings:
            if not (body.is_floating_base_body() and body.has_quaternion_dofs()):
                raise ValueError(
                    f"attachment: {body.name()} must be a free body of the plant, with "
                    "a quaternion floating joint"
                )
        starts = np.array([body.floating_positions_start() for body in fittings])
        self._positions = starts[pattern.fitting_of]
        v = np.array([body.floating_velocities_start_in_v() for body in fittings])
        self._rows = np.add.outer(v, np.arange(6)).ravel()
        self._velocities = plant.num_positions() + v[pattern.fitting_of]

        vector: Any = self.DeclareVectorInputPort
        self._state = vector("plant_state", plant.num_multibody_states())
        self._spatial: Any = self.DeclareAbstractInputPort(
            "spatial_forces", Value([ExternallyAppliedSpatialForce()])
        )
        self._generalized = vector("generalized_force", plant.num_velocities())
        self._pose = vector("node_pose", 12 * k)
        self._velocity = vector("node_velocity", 6 * k)
        self._acceleration = vector("node_free_acceleration", 6 * k)
        self._compliance = vector("node_compliance", 36 * k * k)
        self._airframe_pose = vector("airframe_pose", 7)
        self._gap: Any = self._entry(
            "gap", weakly(self._calc_gap), {self._state, self._pose, self._velocity}
        )
        self._wrench: Any = self._entry(
            "wrench", weakly(self._calc_wrench), {self._gap, *self._sources()}
        )
        self._declare_outputs(k)

    def place_fittings(self, root_context: Context) -> None:
        """Puts the fittings on their nodes and lets them move with these.

        For initial states: set that of the airframe first. What hangs on a fitting
        moves along; joints keep their positions and rates.

        Args:
            root_context: of the diagram that holds airframe, plant and this system.

        Raises:
            ValueError: a fitting is held along directions alone, nowhere at its origin.
        """
        own = self.GetMyContextFromRoot(root_context)
        plant = self._plant.GetMyMutableContextFromRoot(root_context)
        poses = self._pose.Eval(own).reshape(-1, 12)
        velocities = self._velocity.Eval(own).reshape(-1, 6)
        for i, fitting in self._pattern.origins.items():
            R_WN, p_WN = RotationMatrix(poses[i, :9].reshape(3, 3)), poses[i, 9:]
            V_WN = SpatialVelocity(velocities[i, :3], velocities[i, 3:])
            self._plant.SetFreeBodyPose(plant, fitting, RigidTransform(R_WN, p_WN))
            self._plant.SetFreeBodySpatialVelocity(plant, fitting, V_WN)

    def _entry(self, name: str, calc, sources) -> Any:
        producer = ValueProducer(allocate=lambda: Value(object()), calc=calc)
        return self.DeclareCacheEntry(name, producer, {s.ticket() for s in sources})

    def _declare_outputs(self, k: int) -> None:
        wrench, gap = {self._wrench.ticket()}, {self._gap.ticket()}
        vector = self.DeclareVectorOutputPort
        vector("wrench_on_airframe", 6 * k, weakly(self._calc_on_airframe), wrench)
        self.DeclareAbstractOutputPort(
            "wrench_on_gear",
            lambda: Value([ExternallyAppliedSpatialForce()]),
            weakly(self._calc_on_gear),
            wrench,
        )
        vector(
            "generalized_force_on_gear",
            self._plant.num_velocities(),
            weakly(self._calc_generalized_on_gear),
            wrench,
        )
        vector(
            "load_in_airframe_axes",
            6 * k,
            weakly(self._calc_load_in_airframe_axes),
            wrench | {self._airframe_pose.ticket()},
        )
        vector("gap", 12 * k, weakly(self._calc_gap_port), gap)
        vector("energy", 1, weakly(self._calc_energy), gap)
        vector("dissipated_power", 1, weakly(self._calc_dissipated_power), gap)

    @abstractmethod
    def _sources(self) -> set:
        """Whatever the wrench depends on beside the gap, made where necessary."""

    @abstractmethod
    def _load(self, context: Context, gap: Gap) -> Float64:
        """(m,) loads on the fittings along the rows of the gap."""

    def _stored_energy(self, gap: Gap) -> float:
        if gap.rows is None:  # held rigidly, without stays
            return 0.0
        return 0.5 * float((self._pattern.stiffness * gap.gap**2).sum())

    def _power_loss(self, gap: Gap) -> float:
        if gap.rows is None:
            return 0.0
        return float((self._pattern.damping * gap.rate**2).sum())

    def _calc_gap(self, context, value) -> None:
        state, pose = self._state.Eval(context), self._pose.Eval(context)
        velocity = self._velocity.Eval(context)
        points, gap, rate, R_WF = attachment_solve.fitting_gaps(
            state, self._positions, self._velocities, pose, velocity
        )
        if self._pattern.plain:
            value.set_value(Gap(points, gap, rate, None))
            return
        six, three = np.arange(6), np.arange(4, 7)
        rows = self._pattern.rows(
            points,
            R_WF,
            state[np.add.outer(self._positions, three)],
            state[np.add.outer(self._velocities, six)],
            pose.reshape(-1, 12)[:, 9:],
            velocity.reshape(-1, 6),
        )
        value.set_value(Gap(points, rows.gap, rows.rate, rows))

    def _calc_wrench(self, context, value) -> None:
        """Wrenches on the fittings (6 f,) and on the nodes (6 k,), W."""
        gap = self._gap.Eval(context)
        load = self._load(context, gap)
        if gap.rows is None:
            value.set_value((load, -load))
        else:
            value.set_value((load @ gap.rows.on_fitting, -(load @ gap.rows.on_node)))

    def _calc_on_airframe(self, context, output) -> None:
        output.SetFromVector(self._wrench.Eval(context)[1])

    def _calc_on_gear(self, context, output) -> None:
        wrenches = self._wrench.Eval(context)[0].reshape(-1, 6)
        output.set_value(spatial_forces(self._bodies, wrenches))

    def _calc_generalized_on_gear(self, context, output) -> None:
        # The velocities of a floating joint are the spatial velocity: the wrench is
        # its generalised force.
        force = np.zeros(self._plant.num_velocities())
        force[self._rows] = self._wrench.Eval(context)[0]
        output.SetFromVector(force)

    def _calc_load_in_airframe_axes(self, context, output) -> None:
        R_WB = rotation_from_quaternion(self._airframe_pose.Eval(context)[:4])
        in_B = self._wrench.Eval(context)[1].reshape(self._k, 2, 3) @ R_WB
        output.SetFromVector(in_B[:, ::-1].ravel())

    def _calc_gap_port(self, context, output) -> None:
        output.SetFromVector(self._gap.Eval(context).points.ravel())

    def _calc_energy(self, context, output) -> None:
        output.SetAtIndex(0, self._stored_energy(self._gap.Eval(context)))

    def _calc_dissipated_power(self, context, output) -> None:
        output.SetAtIndex(0, self._power_loss(self._gap.Eval(context)))


class RigidAttachment(Attachment):
    """Holds the fittings at the nodes without any play; ports of `Attachment`.

    Energy and dissipated power are those of elastic stays alone: an ideal constraint
    does no work.

    Args:
        plant, points: see `Attachment`.
        alpha, beta: Baumgarte's rates, 1/s; drift decays within a few 1/60 s.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        points: Sequence[RigidBody | AttachmentPoint],
        alpha: float = 60.0,
        beta: float = 60.0,
    ) -> None:
        self._alpha, self._beta = alpha, beta
        self._world = plant.world_frame()
        self._zero = np.zeros(plant.num_velocities())
        super().__init__(plant, points)
        self._rigid = self._pattern.stiffness == 0.0
        # Fittings are roots of the plant's trees, whose velocities are contiguous.
        starts = sorted({0, *self._rows[::6].tolist()})
        self._blocks = np.array([*starts, plant.num_velocities()])

    def _sources(self) -> set:
        self._context = declare_plant_context(self, self._plant)
        return {
            self._context,
            self._spatial,
            self._generalized,
            self._acceleration,
            self._compliance,
        }

    def _free_force(self, context, plant_context) -> Float64:
        """(nv,) generalised force M v'_free of everything but the attachments."""
        plant = self._plant
        forces = MultibodyForces(plant)
        plant.CalcForceElementsContribution(plant_context, forces)
        generalized = forces.mutable_generalized_forces()
        generalized += self._generalized.Eval(context)
        if self._spatial.HasValue(context):
            world, get_body = self._world, plant.get_body
            for force in self._spatial.Eval(context):
                get_body(force.body_index).AddInForce(
                    plant_context, force.p_BoBq_B, force.F_Bq_W, world, forces
                )
        return -plant.CalcInverseDynamics(plant_context, self._zero, forces)

    def _load(self, context: Context, gap: Gap) -> Float64:
        plant_context = self._context.Eval(context)
        # The velocities of a fitting on its floating joint are its spatial velocity in
        # W: J picks rows, and no velocity-dependent acceleration arises.
        fittings = (
            self._plant.CalcMassMatrix(plant_context),
            self._free_force(context, plant_context),
            self._rows,
            self._blocks,
        )
        compliance = self._compliance.Eval(context)
        acceleration = self._acceleration.Eval(context)
        if gap.rows is None:
            return attachment_solve.plain_load(
                *fittings,
                compliance,
                acceleration,
                gap.gap,
                gap.rate,
                self._alpha,
                self._beta,
            )
        return self._general_load(gap, gap.rows, fittings, compliance, acceleration)

    def _general_load(
        self,
        gap: Gap,
        held: Rows,
        fittings: tuple,
        compliance: Float64,
        acceleration: Float64,
    ) -> Float64:
        response, free = attachment_solve.fitting_response(*fittings)
        k = 6 * self._k
        matrix = held.on_fitting @ response @ held.on_fitting.T
        matrix += held.on_node @ compliance.reshape(k, k) @ held.on_node.T
        wanted = held.on_node @ acceleration - held.bias - held.on_fitting @ free
        wanted -= 2.0 * self._alpha * gap.rate + self._beta**2 * gap.gap
        rigid = self._rigid
        if rigid.all():
            return attachment_solve.solve_positive(matrix, wanted)
        load = -(self._pattern.stiffness * gap.gap + self._pattern.damping * gap.rate)
        wanted = wanted - matrix[:, ~rigid] @ load[~rigid]
        load[rigid] = attachment_solve.solve_positive(
            matrix[np.ix_(rigid, rigid)], wanted[rigid]
        )
        return load


def _point(point: RigidBody | AttachmentPoint) -> AttachmentPoint:
    return AttachmentPoint(fitting=point) if isinstance(point, RigidBody) else point

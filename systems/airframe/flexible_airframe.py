"""A free-flying flexible airframe: Newton-Euler plus elastic modes in mean axes.

The equations are in `modal_dynamics`, the motion of its nodes in `modal_kinematics`:
loads act at the places of the deformed body, whereby power is conserved at any
deformation; what is neglected is of the order of deformation over size of the body.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.common.value import Value
from pydrake.systems.framework import (
    BasicVector,
    Context,
    ContinuousState,
    LeafSystem,
    NumericParameterIndex,
    ValueProducer,
)

from systems.airframe import modal_dynamics
from systems.airframe.modal_body import ModalBody
from systems.airframe.modal_kinematics import Nodes, mode_scales, node_motion
from systems.tools.weak_methods import weakly

Float64 = npt.NDArray[np.float64]

# Rate at which the quaternion's length is pulled back to one, 1/s.
_STABILISATION = 10.0
# A damping matrix is taken as diagonal where its other elements are below this share of
# the geometric mean of their diagonal ones: rounding of the projection.
_UNCOUPLED = 1e-8


class FlexibleAirframe(LeafSystem):
    """Six rigid freedoms and n modes; n = 0 is a rigid aircraft.

    State, all in z: p_WG (3, m), quaternion of R_WB (4), v_WG (3, m/s), ω_B (3, rad/s),
    n modal amplitudes and n rates, scaled by `modal_kinematics.mode_scales`.

    With k_a attachment and k_m monitoring nodes; vectors node after node, angular parts
    first unless said otherwise.

    | port | size | unit | frame and sign |
    |---|---|---|---|
    | in `attachment_wrench` | 6 k_a | N m, N | on the airframe at the nodes, W |
    | in `external_load` (optional) | 6 + n | N, N m | force in W, moment about G in B,
      modal forces in the amplitudes of the ModalBody |
    | out `node_pose` | 12 k_a | -, m | R_WN by rows, p_WN |
    | out `node_velocity` | 6 k_a | rad/s, m/s | W |
    | out `node_acceleration` | 6 k_a | rad/s², m/s² | W |
    | out `node_free_acceleration` | 6 k_a | rad/s², m/s² | W, as if attachment_wrench
      were zero |
    | out `node_compliance` | (6 k_a)² | | acceleration per wrench, W |
    | out `monitor_pose` | 12 k_m | -, m | R_WN by rows, p_WN |
    | out `monitor_velocity` | 6 k_m | rad/s, m/s | W |
    | out `monitor_acceleration` | 6 k_m | m/s², rad/s² | [linear; angular] relative to
      inertial space, in B axes |
    | out `pose` | 7 | -, m | quaternion of R_WB, p_WG |
    | out `velocity` | 6 | rad/s, m/s | ω_B in B, v_WG in W |
    | out `modal_amplitudes` | n | | in the amplitudes of the ModalBody |
    | out `modal_rates` | n | 1/s | likewise |
    | out `energy` | 1 | J | kinetic, strain and gravity |
    | out `dissipated_power` | 1 | W | of the modes, >= 0 |
    | out `external_power` | 1 | W | of external_load, into the airframe |

    Only node_acceleration and monitor_acceleration depend on attachment_wrench: no
    algebraic loop arises from solving for the wrench with the other ports.

    Args:
        body: the modal body.
        attachment_nodes: grid ids where landing gears are attached.
        monitor_nodes: grid ids to watch.
        gravity: acceleration, m/s²; numeric parameter. 0, the default, stands for lift
            equal to weight.
        height: of the center of gravity in the default state, m.

    Raises:
        ValueError: a node is not one of the body's.
    """

    def __init__(
        self,
        body: ModalBody,
        attachment_nodes: Sequence[int],
        monitor_nodes: Sequence[int] = (),
        gravity: float = 0.0,
        height: float = 0.0,
    ) -> None:
        super().__init__()
        self.n = n = body.n
        self._scale = scale = mode_scales(body)
        self._nodes = Nodes.from_body(body, attachment_nodes, scale)
        self._monitors = Nodes.from_body(body, monitor_nodes, scale)
        self._mass, self._inertia = body.mass, body.inertia_G
        self._modal_mass = body.modal_mass * scale**2
        self._stiffness = (2.0 * np.pi * body.frequency) ** 2
        self._damping = _damping_per_mass(body, scale)
        self._inverse_mass = np.zeros((6, 6))
        self._inverse_mass[:3, :3] = np.eye(3) / body.mass
        self._inverse_mass[3:, 3:] = np.linalg.inv(body.inertia_G)

        x0 = np.zeros(13 + 2 * n)
        x0[2], x0[3] = height, 1.0
        self.DeclareContinuousState(BasicVector(x0))
        self._gravity = NumericParameterIndex(
            self.DeclareNumericParameter(BasicVector([gravity]))
        )
        k_a, k_m = len(self._nodes), len(self._monitors)
        self._wrench = self.DeclareVectorInputPort("attachment_wrench", 6 * k_a)
        self._external = self.DeclareVectorInputPort("external_load", 6 + n)
        self._declare_cache()
        self._declare_node_ports(k_a)
        self._declare_monitor_ports(k_m)
        self._declare_state_ports()

    def _declare_cache(self) -> None:
        def entry(name: str, calc, *tickets) -> Any:
            producer = ValueProducer(allocate=lambda: Value(object()), calc=calc)
            return self.DeclareCacheEntry(name, producer, set(tickets))

        state = self.xc_ticket()
        self._motion = entry("motion", weakly(self._calc_motion), state)
        motion = self._motion.ticket()
        self._free = entry(
            "free_acceleration",
            weakly(self._calc_free),
            motion,
            self._external.ticket(),
            self.numeric_parameter_ticket(self._gravity),
        )
        self._loaded = entry(
            "acceleration",
            weakly(self._calc_loaded),
            motion,
            self._free.ticket(),
            self._wrench.ticket(),
        )
        self._monitor_motion = entry(
            "monitor_motion", weakly(self._calc_monitor_motion), state
        )

    def _declare_node_ports(self, k: int) -> None:
        motion = {self._motion.ticket()}
        free = {self._motion.ticket(), self._free.ticket()}
        loaded = {self._motion.ticket(), self._loaded.ticket()}
        declare = self.DeclareVectorOutputPort
        declare("node_pose", 12 * k, weakly(self._calc_node_pose), motion)
        declare("node_velocity", 6 * k, weakly(self._calc_node_velocity), motion)
        declare(
            "node_compliance", 36 * k * k, weakly(self._calc_node_compliance), motion
        )
        declare(
            "node_free_acceleration",
            6 * k,
            weakly(self._calc_node_free_acceleration),
            free,
        )
        declare(
            "node_acceleration", 6 * k, weakly(self._calc_node_acceleration), loaded
        )

    def _declare_monitor_ports(self, k: int) -> None:
        motion = {self._monitor_motion.ticket()}
        loaded = motion | {self._loaded.ticket()}
        declare = self.DeclareVectorOutputPort
        declare("monitor_pose", 12 * k, weakly(self._calc_monitor_pose), motion)
        declare("monitor_velocity", 6 * k, weakly(self._calc_monitor_velocity), motion)
        declare(
            "monitor_acceleration",
            6 * k,
            weakly(self._calc_monitor_acceleration),
            loaded,
        )

    def _declare_state_ports(self) -> None:
        state = {self.xc_ticket()}
        declare = self.DeclareVectorOutputPort
        declare("pose", 7, weakly(self._calc_pose), state)
        declare("velocity", 6, weakly(self._calc_velocity), state)
        declare("modal_rates", self.n, weakly(self._calc_modal_rates), state)
        declare("modal_amplitudes", self.n, weakly(self._calc_modal_amplitudes), state)
        declare("dissipated_power", 1, weakly(self._calc_dissipated_power), state)
        external = state | {self._external.ticket()}
        declare("external_power", 1, weakly(self._calc_external_power), external)
        declare(
            "energy",
            1,
            weakly(self._calc_energy),
            state | {self.numeric_parameter_ticket(self._gravity)},
        )

    def set_state(
        self,
        context: Context,
        *,
        p_WG: npt.ArrayLike = (0.0, 0.0, 0.0),
        quaternion: npt.ArrayLike = (1.0, 0.0, 0.0, 0.0),
        v_WG: npt.ArrayLike = (0.0, 0.0, 0.0),
        w_B: npt.ArrayLike = (0.0, 0.0, 0.0),
        modal_amplitudes: npt.ArrayLike | None = None,
        modal_rates: npt.ArrayLike | None = None,
    ) -> None:
        """Sets the state in a context of this system.

        Args:
            context: of this system.
            p_WG: (3,) position of the center of gravity, m.
            quaternion: (4,) of R_WB, scalar first.
            v_WG: (3,) velocity of the center of gravity in W, m/s.
            w_B: (3,) angular velocity in B, rad/s.
            modal_amplitudes: (n,) in the amplitudes of the ModalBody; default zero.
            modal_rates: (n,) their rates, 1/s.
        """
        zero = np.zeros(self.n)
        eta = zero if modal_amplitudes is None else np.asarray(modal_amplitudes)
        rate = zero if modal_rates is None else np.asarray(modal_rates)
        modal = (eta / self._scale, rate / self._scale)
        x = np.concatenate([p_WG, quaternion, v_WG, w_B, *modal])
        context.SetContinuousState(x)

    def set_gravity(self, context: Context, gravity: float) -> None:
        """Sets the acceleration of gravity, m/s², in a context of this system."""
        context.get_mutable_numeric_parameter(self._gravity).SetAtIndex(0, gravity)

    def _calc_motion(self, context, value) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        value.set_value((x, node_motion(self._nodes, x)))

    def _calc_monitor_motion(self, context, value) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        value.set_value(node_motion(self._monitors, x))

    def _calc_free(self, context, value) -> None:
        """Generalised accelerations [a_WG in W; ω' in B] (6) and η" (n), no wrench."""
        rigid, elastic = modal_dynamics.free_acceleration(
            self._motion.Eval(context)[0],
            self._stiffness,
            self._damping,
            self._inertia,
            self._inverse_mass,
            context.get_numeric_parameter(self._gravity).GetAtIndex(0),
        )
        if self._external.HasValue(context):
            load = self._external.Eval(context)
            rigid += self._inverse_mass @ load[:6]
            elastic += self._scale * load[6:] / self._modal_mass
        value.set_value((rigid, elastic))

    def _calc_loaded(self, context, value) -> None:
        motion = self._motion.Eval(context)[1]
        loaded = modal_dynamics.loaded_acceleration(
            motion.R_WB,
            motion.rigid,
            motion.turn,
            self._nodes.shape,
            self._inverse_mass,
            self._modal_mass,
            *self._free.Eval(context),
            self._wrench.Eval(context),
        )
        value.set_value(loaded)

    def DoCalcTimeDerivatives(
        self, context: Context, derivatives: ContinuousState
    ) -> None:
        x = self._motion.Eval(context)[0]
        rate = modal_dynamics.state_rate(x, *self._loaded.Eval(context), _STABILISATION)
        derivatives.SetFromVector(rate)

    def _calc_node_pose(self, context, output) -> None:
        output.SetFromVector(self._motion.Eval(context)[1].pose)

    def _calc_node_velocity(self, context, output) -> None:
        output.SetFromVector(self._motion.Eval(context)[1].velocity)

    def _calc_node_compliance(self, context, output) -> None:
        motion = self._motion.Eval(context)[1]
        compliance = motion.compliance(self._nodes, self._inverse_mass)
        output.SetFromVector(compliance.ravel())

    def _calc_node_free_acceleration(self, context, output) -> None:
        motion, free = self._motion.Eval(context)[1], self._free.Eval(context)
        output.SetFromVector(motion.acceleration(self._nodes, *free))

    def _calc_node_acceleration(self, context, output) -> None:
        motion, loaded = self._motion.Eval(context)[1], self._loaded.Eval(context)
        output.SetFromVector(motion.acceleration(self._nodes, *loaded))

    def _calc_monitor_pose(self, context, output) -> None:
        output.SetFromVector(self._monitor_motion.Eval(context).pose)

    def _calc_monitor_velocity(self, context, output) -> None:
        output.SetFromVector(self._monitor_motion.Eval(context).velocity)

    def _calc_monitor_acceleration(self, context, output) -> None:
        motion = self._monitor_motion.Eval(context)
        in_W = motion.acceleration(self._monitors, *self._loaded.Eval(context))
        in_B = in_W.reshape(-1, 2, 3) @ motion.R_WB
        output.SetFromVector(in_B[:, ::-1].ravel())

    def _calc_pose(self, context, output) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        q = x[3:7]
        output.SetFromVector(np.concatenate([q / np.sqrt(q @ q), x[:3]]))

    def _calc_velocity(self, context, output) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        output.SetFromVector(np.concatenate([x[10:13], x[7:10]]))

    def _calc_modal_rates(self, context, output) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        output.SetFromVector(self._scale * x[13 + self.n :])

    def _calc_modal_amplitudes(self, context, output) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        output.SetFromVector(self._scale * x[13 : 13 + self.n])

    def _calc_dissipated_power(self, context, output) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        power = modal_dynamics.damping_power(x, self._modal_mass, self._damping)
        output.SetAtIndex(0, power)

    def _calc_external_power(self, context, output) -> None:
        power = 0.0
        if self._external.HasValue(context):
            x = context.get_continuous_state_vector().CopyToVector()
            load = self._external.Eval(context)
            power = load[:6] @ x[7:13] + load[6:] @ (self._scale * x[13 + self.n :])
        output.SetAtIndex(0, power)

    def _calc_energy(self, context, output) -> None:
        x = context.get_continuous_state_vector().CopyToVector()
        v, w = x[7:10], x[10:13]
        eta, rate = x[13:].reshape(2, self.n)
        g = context.get_numeric_parameter(self._gravity).GetAtIndex(0)
        twice = self._mass * (v @ v + 2.0 * g * x[2]) + w @ self._inertia @ w
        twice += self._modal_mass @ (rate**2 + self._stiffness * eta**2)
        output.SetAtIndex(0, 0.5 * twice)


def _damping_per_mass(body: ModalBody, scale: Float64) -> Float64:
    """(n, 1) per scaled modal mass, or (n, n) where it couples modes, 1/s."""
    damping, diagonal = body.modal_damping, np.diag(body.modal_damping)
    others = np.abs(damping - np.diag(diagonal))
    root = np.sqrt(np.abs(diagonal))
    if (others <= _UNCOUPLED * np.outer(root, root)).all():
        return np.ascontiguousarray((diagonal / body.modal_mass)[:, None])
    mass = body.modal_mass * scale**2
    return damping * np.outer(scale, scale) / mass[:, None]

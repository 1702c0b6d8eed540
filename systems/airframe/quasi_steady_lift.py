"""Lift that follows the motion: quasi-steady strips at nodes of wing and tail.

About a steady flight that carries a given lift L_0 at the speed V_0, the pitch angle
θ_0 and the flight-path angle γ_0 = sink rate over speed, a node i of the wing lifts

    f_i = s(t) [w_i L_0 q/q_0 + q S w_i a (α_i - α_0)],
    α_i - α_0 = θ - θ_0 + u_i/V - γ_0,

with w_i its share, u_i its velocity downward (rigid, turning and elastic), q the
dynamic pressure of the forward speed V, S the area and a the lift slope, s(t) a
schedule such as that of spoilers. As the sink stops, α falls and so does the lift;
roll, pitch and the bending of the wing are damped by what they add to u_i. A tail has
the same without L_0, in a downwash that follows the wing's mean angle with a lag:

    f_j = q S_t w_j a_t (α_j - α_0 - ε),   τ ε' = (dε/dα) mean(α_i - α_0) - ε.

Forces point up in the world; a pitching moment -M_q (V/V_0) ω_y stands for what the
strips leave out. Neglected: drag, wind, ground effect, stall, unsteady wakes.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.common.containers import namedview
from pydrake.common.value import Value
from pydrake.systems.framework import (
    BasicVector,
    Context,
    LeafSystem,
    NumericParameterIndex,
    ValueProducer,
)

from systems.airframe.modal_body import ModalBody
from systems.tools.checks import require
from systems.tools.rotations import rotation_from_quaternion
from systems.tools.table import Table
from systems.tools.weak_methods import weakly

Float64 = npt.NDArray[np.float64]

LiftReference = namedview("LiftReference", ["factor", "speed", "pitch", "path"])
"""Numeric parameters: factor on the lift, 1; V_0, m/s; θ_0 and γ_0, rad. Without a
speed the lift is that of the steady flight, whatever the aircraft does."""


@dataclass(frozen=True, kw_only=True)
class Surface:
    """A lifting surface.

    Attributes:
        nodes: grids that carry it.
        shares: (k,) of each, of force and area; their sum is one.
        area: m².
        slope: lift coefficient over angle of attack, 1/rad.

    Raises:
        ValueError: a value is out of range.
    """

    nodes: Sequence[int]
    shares: Sequence[float]
    area: float
    slope: float

    def __post_init__(self) -> None:
        require("lifting surface", "area", self.area, "m²", above=0.0)
        require("lifting surface", "slope", self.slope, "1/rad", at_least=0.0)
        if len(self.nodes) != len(self.shares) or not len(self.nodes):
            raise ValueError(
                f"lifting surface: {len(self.shares)} shares for {len(self.nodes)} "
                "nodes, expected one each"
            )


class QuasiSteadyLift(LeafSystem):
    """Lift of a `FlexibleAirframe`, for its input `external_load`.

    | port | size | unit | frame |
    |---|---|---|---|
    | in `pose` | 7 | -, m | quaternion of R_WB, p_WG of the airframe |
    | in `velocity` | 6 | rad/s, m/s | ω_B in B, v_WG in W |
    | in `modal_amplitudes` | n | | in the amplitudes of the ModalBody |
    | in `modal_rates` | n | | likewise |
    | out `load` | 6 + n | N, N m | force W, moment about G in B, modal forces |
    | out `force` | 1 | N | all, up |
    | out `node_force` | k | N | up, nodes of the wing, then those of the tail |

    State: the downwash ε, where it lags. Numeric parameters: `LiftReference`;
    `set_reference`, `set_factor`.

    Args:
        body: the modal body of that airframe.
        force: L_0, N, over time (s): with a schedule.
        wing: its surface.
        tail: another one, without force in steady flight.
        downwash: dε/dα.
        lag: τ, s; 0: none.
        pitch_damping: M_q at V_0, N m s/rad, >= 0.
        density: of the air, kg/m³.

    Raises:
        ValueError: a node is not one of the body's, or a value is out of range.
    """

    def __init__(
        self,
        body: ModalBody,
        force: float | Table,
        wing: Surface,
        tail: Surface | None = None,
        *,
        downwash: float = 0.0,
        lag: float = 0.0,
        pitch_damping: float = 0.0,
        density: float = 1.225,
    ) -> None:
        super().__init__()
        for name, value, unit in (
            ("downwash", downwash, ""),
            ("lag", lag, "s"),
            ("pitch_damping", pitch_damping, "N m s/rad"),
        ):
            require("quasi-steady lift", name, value, unit, at_least=0.0)
        require("quasi-steady lift", "density", density, "kg/m³", above=0.0)
        require("quasi-steady lift", "force", _first(force), "N", above=0.0)
        surfaces = [wing] if tail is None else [wing, tail]
        self.nodes = tuple(node for s in surfaces for node in s.nodes)
        self._wing = len(wing.nodes)
        self._shares = np.array(wing.shares, dtype=float)
        self._force, self._density = force, density
        self._lifting = np.concatenate(
            [s.area * s.slope * np.array(s.shares, dtype=float) for s in surfaces]
        )
        self._downwash, self._lag, self._damping = downwash, lag, pitch_damping
        rows = body.rows(self.nodes)
        self._p_GN = body.p_BN[rows] - body.p_BG
        # By direction, node, mode.
        self._shape = np.ascontiguousarray(body.translation[rows].transpose(1, 0, 2))
        self._reference = NumericParameterIndex(
            self.DeclareNumericParameter(BasicVector([1.0, 0.0, 0.0, 0.0]))
        )
        if lag > 0.0:
            self.DeclareContinuousState(BasicVector([0.0]))
        self._declare_ports(body.n)

    def _declare_ports(self, n: int) -> None:
        declare: Any = self.DeclareVectorInputPort
        self._pose, self._velocity = declare("pose", 7), declare("velocity", 6)
        self._amplitudes = declare("modal_amplitudes", n)
        self._rates = declare("modal_rates", n)
        inputs = (self._pose, self._velocity, self._amplitudes, self._rates)
        tickets = {port.ticket() for port in inputs}
        tickets |= {self.numeric_parameter_ticket(self._reference), self.time_ticket()}
        if self._lag > 0.0:
            tickets.add(self.xc_ticket())
        producer = ValueProducer(
            allocate=lambda: Value(object()), calc=weakly(self._calc_lift)
        )
        self._lift: Any = self.DeclareCacheEntry("lift", producer, tickets)
        lift = {self._lift.ticket()}
        vector = self.DeclareVectorOutputPort
        vector("load", 6 + n, weakly(self._calc_load), lift)
        vector("force", 1, weakly(self._calc_force), lift)
        vector("node_force", len(self.nodes), weakly(self._calc_node_force), lift)

    def set_factor(self, context: Context, factor: float) -> None:
        """Sets the factor on all of the lift in a context of this system."""
        context.get_mutable_numeric_parameter(self._reference).SetAtIndex(0, factor)

    def set_reference(self, context: Context) -> None:
        """Takes the flight of now as the steady one: it carries the force L_0.

        The context is one of this system, inputs connected or fixed.

        Raises:
            ValueError: the aircraft does not move forward.
        """
        up, speed, w = self._flight(context)
        if not speed > 0.0:
            raise ValueError("quasi-steady lift: the aircraft does not fly forward")
        vector = context.get_mutable_numeric_parameter(self._reference)
        reference = LiftReference(vector.CopyToVector())
        reference.speed, reference.pitch = speed, _pitch(up)
        reference.path = w / speed
        vector.SetFromVector(reference[:])
        if self._lag > 0.0:
            context.SetContinuousState([0.0])

    def _flight(self, context: Context) -> tuple[Float64, float, float]:
        """Up in B (3,), speed forward over ground, sink rate, m/s."""
        up = rotation_from_quaternion(self._pose.Eval(context)[:4])[2]
        x, y, z = self._velocity.Eval(context)[3:]
        return up, math.hypot(x, y), -float(z)

    def _calc_lift(self, context: Context, value) -> None:
        """Force of each node, up in B, arms, pitching moment, rate of the downwash."""
        up, speed, _ = self._flight(context)
        reference = LiftReference(
            context.get_numeric_parameter(self._reference).CopyToVector()
        )
        force = self._force
        if isinstance(force, Table):
            force = force.value(context.get_time())
        arms = self._p_GN + (self._shape @ self._amplitudes.Eval(context)).T
        out = np.zeros(len(self.nodes))
        moment, rate = 0.0, 0.0
        wing = slice(0, self._wing)
        if not reference.speed > 0.0:
            out[wing] = force * self._shares
        else:
            angle = self._angles(context, up, speed, reference, arms)
            pressure = 0.5 * self._density * speed**2
            mean = float(self._shares @ angle[wing])
            washed = self._downwash * mean
            if self._lag > 0.0:
                state = context.get_continuous_state_vector().GetAtIndex(0)
                washed, rate = state, (washed - state) / self._lag
            angle[self._wing :] -= washed
            out[:] = pressure * self._lifting * angle
            # The schedule is relative to the force at the beginning.
            share = force / _first(self._force)
            steady = _first(self._force) * (speed / reference.speed) ** 2
            out[wing] = share * (out[wing] + steady * self._shares)
            turning = self._velocity.Eval(context)[1]
            moment = -self._damping * speed / reference.speed * turning
        value.set_value((reference.factor * out, up, arms, moment, rate))

    def _angles(
        self,
        context: Context,
        up: Float64,
        speed: float,
        reference: Any,
        arms: Float64,
    ) -> Float64:
        """(k,) angles of attack over those of the steady flight, rad."""
        velocity = self._velocity.Eval(context)
        x, y, z = velocity[:3].tolist()
        turning = arms @ np.array(
            # up · (ω × r) = r · (up × ω)
            [up[1] * z - up[2] * y, up[2] * x - up[0] * z, up[0] * y - up[1] * x]
        )
        elastic = up @ (self._shape @ self._rates.Eval(context))
        rising = velocity[5] + turning + elastic
        return _pitch(up) - reference.pitch - rising / speed - reference.path

    def _calc_load(self, context: Context, output) -> None:
        force, up, arms, pitching, _ = self._lift.Eval(context)
        total = float(force.sum())
        x, y, z = (force @ arms).tolist()
        a, b, c = up.tolist()
        moment = [y * c - z * b, z * a - x * c + pitching, x * b - y * a]
        modal = up @ (force @ self._shape)
        output.SetFromVector(np.concatenate([[0.0, 0.0, total], moment, modal]))

    def _calc_force(self, context: Context, output) -> None:
        output.SetAtIndex(0, self._lift.Eval(context)[0].sum())

    def _calc_node_force(self, context: Context, output) -> None:
        output.SetFromVector(self._lift.Eval(context)[0])

    def DoCalcTimeDerivatives(self, context: Context, derivatives) -> None:
        if self._lag > 0.0:
            derivatives.SetFromVector([self._lift.Eval(context)[4]])


def _pitch(up: Float64) -> float:
    """Nose above the horizon, rad; `up` in B, x aft."""
    return math.atan2(-up[0], up[2])


def _first(force: float | Table) -> float:
    return force.y[0] if isinstance(force, Table) else force

"""Gears whose wheels are point masses, as several multibody codes model them.

A wheel W hangs from a node A of the airframe by a shock absorber along the line
between them; across, in the directions x and y of the world, springs hold it below the
node. Neither passes a moment.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from pydrake.common.value import Value
from pydrake.systems.framework import BasicVector, LeafSystem, ValueProducer

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PointWheel:
    """Data of one gear.

    Attributes:
        name: in the names of ports.
        mass: of the wheel, kg.
        length: distance of wheel and node at zero stroke, m.
        side_stiffness, side_damping: N/m, N s/m.
    """

    name: str
    mass: float
    length: float
    side_stiffness: float
    side_damping: float


class PointWheels(LeafSystem):
    """Point masses below the attachment nodes of a FlexibleAirframe.

    | port | size | |
    |---|---|---|
    | in `node_pose`, `node_velocity` | 12 k, 6 k | of the nodes, W |
    | in `strut_<name>` | 1 | force of the shock absorber, positive apart, N |
    | in `tire_<name>` | 6 | wrench on the wheel, W |
    | out `wrench` | 6 k | on the airframe at the nodes, W |
    | out `strut_<name>` | 2 | stroke and rate, positive in compression |
    | out `wheel_<name>` | 12 | p_WC, axle direction (always y), v_WC, zero |

    State: places (3 k, m) and velocities (3 k, m/s) of the wheels, W.
    """

    def __init__(self, wheels: Sequence[PointWheel]) -> None:
        super().__init__()
        self._k = k = len(wheels)
        self._mass = np.array([wheel.mass for wheel in wheels])[:, None]
        self._length = np.array([wheel.length for wheel in wheels])
        self._side = np.array(
            [[wheel.side_stiffness, wheel.side_damping] for wheel in wheels]
        )[:, :, None]
        vector: Any = self.DeclareVectorInputPort
        self._pose = vector("node_pose", 12 * k)
        self._velocity = vector("node_velocity", 6 * k)
        self._struts = [vector(f"strut_{wheel.name}", 1) for wheel in wheels]
        self._tires = [vector(f"tire_{wheel.name}", 6) for wheel in wheels]
        self.DeclareContinuousState(BasicVector(np.zeros(6 * k)))
        # State by wheel: places, then velocities.
        self._motion: Any = self._entry(
            "motion",
            self._calc_motion,
            {self.xc_ticket(), self._pose.ticket(), self._velocity.ticket()},
        )
        motion = {self._motion.ticket()}
        loads = motion | {port.ticket() for port in self._struts}
        self._force: Any = self._entry("force", self._calc_force, loads)
        declare = self.DeclareVectorOutputPort
        declare("wrench", 6 * k, self._calc_wrench, {self._force.ticket()})
        for i, wheel in enumerate(wheels):
            declare(f"strut_{wheel.name}", 2, self._strut_port(i), motion)
            port = self._wheel_port(i)
            declare(f"wheel_{wheel.name}", 12, port, {self.xc_ticket()})

    def _entry(self, name: str, calc, tickets: set) -> Any:
        producer = ValueProducer(allocate=lambda: Value(object()), calc=calc)
        return self.DeclareCacheEntry(name, producer, tickets)

    def _state(self, context) -> Float64:
        """(2, k, 3) places and velocities."""
        x = context.get_continuous_state_vector().CopyToVector()
        return x.reshape(2, self._k, 3)

    def _calc_motion(self, context, value) -> None:
        """Node less wheel (2, k, 3), directions up the struts, strut states."""
        relative = -self._state(context)
        relative[0] += self._pose.Eval(context).reshape(-1, 12)[:, 9:]
        relative[1] += self._velocity.Eval(context).reshape(-1, 6)[:, 3:]
        span, rate = relative
        distance = np.sqrt((span * span).sum(axis=1))
        up = span / distance[:, None]
        closing = -(up * rate).sum(axis=1)
        struts = np.stack([self._length - distance, closing], axis=1)
        value.set_value((relative, up, struts))

    def _calc_force(self, context, value) -> None:
        """(k, 3) on the nodes; the opposite acts on the wheels."""
        relative, up, _ = self._motion.Eval(context)
        apart = np.array([port.Eval(context) for port in self._struts])
        force = apart * up
        force[:, :2] -= self._side[:, 0] * relative[0, :, :2]
        force[:, :2] -= self._side[:, 1] * relative[1, :, :2]
        value.set_value(force)

    def _calc_wrench(self, context, output) -> None:
        wrench = np.zeros((self._k, 6))
        wrench[:, 3:] = self._force.Eval(context)
        output.SetFromVector(wrench.ravel())

    def _strut_port(self, i: int):
        def calc(context, output):
            output.SetFromVector(self._motion.Eval(context)[2][i])

        return calc

    def _wheel_port(self, i: int):
        def calc(context, output):
            place, velocity = self._state(context)[:, i]
            wheel = np.zeros(12)
            wheel[:3], wheel[4], wheel[6:9] = place, 1.0, velocity
            output.SetFromVector(wheel)

        return calc

    def DoCalcTimeDerivatives(self, context, derivatives) -> None:
        tires = np.array([port.Eval(context) for port in self._tires])[:, 3:]
        acceleration = (tires - self._force.Eval(context)) / self._mass
        velocity = self._state(context)[1]
        derivatives.SetFromVector(
            np.concatenate([velocity.ravel(), acceleration.ravel()])
        )

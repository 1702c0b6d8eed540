"""A wheel brake: torque over time, optionally held by an anti-skid law.

The torque on the wheel about its axle, and its reaction on the piston, oppose the spin
of the wheel against the piston:

    T = -T_d(t) g(|slip|) p(F_z) Ω/√(Ω² + Ω_0²)

T_d is the demanded torque. g falls smoothly from 1 at the onset slip to 0 at the
release slip; p keeps the brake off until the wheel carries load (touchdown
protection). Both are 1 without anti-skid. The fraction in Ω stands for the sign: it is
smooth at zero spin, so a standing aircraft creeps rather than sticks.
"""

from dataclasses import dataclass

from pydrake.systems.framework import (
    BasicVector_,
    LeafSystem_,
    NumericParameterIndex,
)

from systems.tools.checks import require
from systems.tools.scalar import Scalar, sqrt
from systems.tools.table import Table
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly


@dataclass(frozen=True, kw_only=True)
class AntiSkid:
    """Release of the brake over slip.

    Attributes:
        onset: slip up to which the demanded torque acts.
        release: slip from which on the brake is off.
        protection_load: N, vertical load at which the brake is fully available.
    """

    onset: float = 0.08
    release: float = 0.2
    protection_load: float = 1e4

    def __post_init__(self) -> None:
        require("anti-skid", "onset", self.onset, "", at_least=0.0)
        require("anti-skid", "release", self.release, "", above=self.onset, at_most=1.0)
        require("anti-skid", "protection_load", self.protection_load, "N", above=0.0)


@dataclass(frozen=True, kw_only=True)
class BrakeParameters:
    """Parameters of the brake of one wheel.

    Attributes:
        torque: N m, demanded torque, constant or a table over time (s).
        anti_skid: None brakes without regard to slip.
        spin_transition: rad/s, spin within which the torque changes sign.
    """

    torque: float | Table
    anti_skid: AntiSkid | None = None
    spin_transition: float = 0.5

    def __post_init__(self) -> None:
        if isinstance(self.torque, Table):
            if min(self.torque.y) < 0.0:
                raise ValueError(
                    f"brake: torque table has {min(self.torque.y)} N m, expected >= 0"
                )
        else:
            require("brake", "torque", self.torque, "N m", at_least=0.0)
        require("brake", "spin_transition", self.spin_transition, "rad/s", above=0.0)


def smooth_fall(x: Scalar, start: float, end: float) -> Scalar:
    """1 up to start, 0 from end on, a cubic with zero slopes between."""
    if x <= start:
        return 1.0
    if x >= end:
        return 0.0
    u = (x - start) / (end - start)
    return 1.0 - u * u * (3.0 - 2.0 * u)


def brake_torque(
    demand: Scalar,
    spin: Scalar,
    slip: Scalar,
    load: Scalar,
    parameters: BrakeParameters,
) -> Scalar:
    """Torque on the wheel about its axle, N m.

    Args:
        demand: N m, >= 0.
        spin: rad/s, of the wheel against the piston about the axle.
        slip, load: slip and vertical load (N) of the tire, for the anti-skid.
    """
    skid = parameters.anti_skid
    if skid is not None:
        demand = demand * smooth_fall(abs(slip), skid.onset, skid.release)
        demand = demand * (1.0 - smooth_fall(load, 0.0, skid.protection_load))
    transition = parameters.spin_transition
    return -demand * spin / sqrt(spin * spin + transition * transition)


@for_scalars
def Brake_(T):
    class Impl(LeafSystem_[T]):
        """The brake of one wheel: `Brake(parameters)`.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `wheel_spin` | 1 | rad/s | wheel against piston, about the axle direction |
        | in `contact` (optional) | 6 | of `Tire` | read by the anti-skid alone |
        | out `torque` | 1 | N m | on the wheel about the axle direction; the piston |
        |  |  |  | takes the opposite: a joint torque |
        | out `dissipated_power` | 1 | W | >= 0 |

        No state. Numeric parameter: factor on the torque, 1. With anti-skid, `contact`
        must be connected.
        """

        def _construct(self, parameters: BrakeParameters, converter=None):
            LeafSystem_[T].__init__(self, converter=converter)
            self._parameters = parameters
            self._factor = NumericParameterIndex(
                self.DeclareNumericParameter(BasicVector_[T]([1.0]))
            )
            self._spin = self.DeclareVectorInputPort("wheel_spin", 1)
            self._contact = self.DeclareVectorInputPort("contact", 6)
            tickets = {
                self._spin.ticket(),
                self.numeric_parameter_ticket(self._factor),
            }
            if parameters.anti_skid is not None:
                tickets.add(self._contact.ticket())
            if isinstance(parameters.torque, Table):
                tickets.add(self.time_ticket())
            for name, calc in (
                ("torque", weakly(self._calc_torque)),
                ("dissipated_power", weakly(self._calc_dissipated_power)),
            ):
                self.DeclareVectorOutputPort(
                    name, 1, calc, prerequisites_of_calc=tickets
                )

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, other._parameters, converter=converter)

        @property
        def parameters(self) -> BrakeParameters:
            return self._parameters

        def set_factor(self, context, factor: float) -> None:
            """Sets the factor on the torque in a context of this system."""
            parameter = context.get_mutable_numeric_parameter(self._factor)
            parameter.SetAtIndex(0, factor)

        def _torque(self, context):
            p = self._parameters
            spin = self._spin.Eval(context).tolist()[0]
            demand = (
                p.torque.value(context.get_time())
                if isinstance(p.torque, Table)
                else p.torque
            )
            demand = context.get_numeric_parameter(self._factor).GetAtIndex(0) * demand
            slip = load = 0.0
            if p.anti_skid is not None:
                _, load, _, _, slip, _ = self._contact.Eval(context).tolist()
            return spin, brake_torque(demand, spin, slip, load, p)

        def _calc_torque(self, context, output):
            output.SetAtIndex(0, self._torque(context)[1])

        def _calc_dissipated_power(self, context, output):
            spin, torque = self._torque(context)
            output.SetAtIndex(0, -torque * spin)

    return Impl


Brake = default_instantiation(Brake_)

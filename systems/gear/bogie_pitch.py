"""Pitch damper and positioner of a bogie beam.

Moment on the beam against the piston, about the axle direction:

    M = -[spring(θ - θ_0) + d_1 θ' + d_2 |θ'| θ' + stops]

θ_0 is the trim angle. The spring has the stiffness k at the trim and yields at the
moment M_max: M_max tanh(k x/M_max), the positioner's pressure being limited. Beyond
±θ_s the beam meets its stops. Pitch is positive with the front axle up, a rotation
about the axle direction (port to starboard).

Energy: d(energy)/dt + dissipated_power = -M θ'.
"""

import math
from dataclasses import dataclass

from pydrake.systems.framework import BasicVector_, LeafSystem_

from systems.tools.checks import require
from systems.tools.scalar import Scalar, log, power
from systems.tools.stops import contact_elastic, contact_energy, never_pulling
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly

_E = math.e


@dataclass(frozen=True, kw_only=True)
class BogiePitchParameters:
    """Parameters of the pitch damper of one bogie.

    Attributes:
        trim: rad, θ_0.
        stiffness: N m/rad, of the positioner.
        max_moment: N m, that it yields at; None: never.
        damping: N m s/rad.
        quadratic_damping: N m s²/rad².
        stop: rad, travel to either side of θ = 0; None: no stops.
        stop_stiffness: N m/rad.
        stop_damping: s/rad, χ of the stops.

    Raises:
        ValueError: a value is out of range; the message names it, its unit and range.
    """

    trim: float = 0.0
    stiffness: float = 0.0
    max_moment: float | None = None
    damping: float = 0.0
    quadratic_damping: float = 0.0
    stop: float | None = None
    stop_stiffness: float = 5e7
    stop_damping: float = 0.5

    def __post_init__(self) -> None:
        owner = "bogie pitch"
        require(owner, "trim", self.trim, "rad")
        for name, unit in (
            ("stiffness", "N m/rad"),
            ("damping", "N m s/rad"),
            ("quadratic_damping", "N m s²/rad²"),
            ("stop_damping", "s/rad"),
        ):
            require(owner, name, getattr(self, name), unit, at_least=0.0)
        require(owner, "stop_stiffness", self.stop_stiffness, "N m/rad", above=0.0)
        if self.max_moment is not None:
            require(owner, "max_moment", self.max_moment, "N m", above=0.0)
        if self.stop is not None:
            require(owner, "stop", self.stop, "rad", at_least=abs(self.trim))


def positioner_moment(x: Scalar, stiffness: float, limit: float | None) -> Scalar:
    """Moment against the deviation x (rad) from the trim, N m."""
    if limit is None or stiffness == 0.0:
        return stiffness * x
    # tanh y = 1 - 2/(1 + e^2y), of |y| so that nothing overflows.
    y = stiffness / limit * abs(x)
    moment = limit * (1.0 - 2.0 / (1.0 + power(_E, 2.0 * y))) if y < 18.0 else limit
    return moment if x >= 0.0 else -moment


def positioner_energy(x: Scalar, stiffness: float, limit: float | None) -> Scalar:
    """Integral of `positioner_moment` over x, J: (M²/k) log cosh(k x/M)."""
    if limit is None or stiffness == 0.0:
        return 0.5 * stiffness * x * x
    y = stiffness / limit * abs(x)
    # log cosh y = y + log((1 + e^-2y)/2)
    return limit * limit / stiffness * (y + log(0.5 + 0.5 * power(_E, -2.0 * y)))


def _stop_elastic(angle: Scalar, p: BogiePitchParameters) -> Scalar:
    if p.stop is None:
        return 0.0 * angle
    k = p.stop_stiffness
    return contact_elastic(angle - p.stop, k) - contact_elastic(-angle - p.stop, k)


def damping_moment(angle: Scalar, rate: Scalar, p: BogiePitchParameters) -> Scalar:
    """All that turns power into heat, positive against a positive rate, N m."""
    moment = (p.damping + p.quadratic_damping * abs(rate)) * rate
    stop = _stop_elastic(angle, p)
    if stop > 0.0:
        moment = moment + never_pulling(stop, stop * p.stop_damping * rate)
    if stop < 0.0:
        moment = moment - never_pulling(-stop, stop * p.stop_damping * rate)
    return moment


def pitch_moment(angle: Scalar, rate: Scalar, p: BogiePitchParameters) -> Scalar:
    """Moment on the beam, N m.

    Args:
        angle, rate: rad and rad/s, beam against piston.
        p: parameters.
    """
    spring = positioner_moment(angle - p.trim, p.stiffness, p.max_moment)
    return -(spring + _stop_elastic(angle, p) + damping_moment(angle, rate, p))


def pitch_energy(angle: Scalar, p: BogiePitchParameters) -> Scalar:
    """Stored in positioner and stops, J."""
    energy = positioner_energy(angle - p.trim, p.stiffness, p.max_moment)
    if p.stop is not None:
        for beyond in (angle - p.stop, -angle - p.stop):
            energy = energy + contact_energy(beyond, p.stop_stiffness)
    return energy


@for_scalars
def BogiePitch_(T):
    class Impl(LeafSystem_[T]):
        """Pitch damper and positioner of one bogie: `BogiePitch(parameters)`.

        | port | size | unit | frame and sign |
        |---|---|---|---|
        | in `pitch` | 2 | rad, rad/s | beam against piston, about the axle direction |
        | out `torque` | 1 | N m | on the beam about that axis; the piston takes the |
        |  |  |  | opposite: a joint torque |
        | out `energy` | 1 | J | stored |
        | out `dissipated_power` | 1 | W | >= 0 |

        No state, no parameters.
        """

        def _construct(self, parameters: BogiePitchParameters, converter=None):
            LeafSystem_[T].__init__(self, converter=converter)
            self._parameters = parameters
            self._pitch = self.DeclareVectorInputPort("pitch", 2)
            for name, calc in (
                ("torque", weakly(self._calc_torque)),
                ("energy", weakly(self._calc_energy)),
                ("dissipated_power", weakly(self._calc_dissipated_power)),
            ):
                self.DeclareVectorOutputPort(
                    name,
                    BasicVector_[T](1),
                    calc,
                    prerequisites_of_calc={self._pitch.ticket()},
                )

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, other._parameters, converter=converter)

        @property
        def parameters(self) -> BogiePitchParameters:
            return self._parameters

        def _calc_torque(self, context, output):
            angle, rate = self._pitch.Eval(context).tolist()
            output.SetAtIndex(0, pitch_moment(angle, rate, self._parameters))

        def _calc_energy(self, context, output):
            angle, _ = self._pitch.Eval(context).tolist()
            output.SetAtIndex(0, pitch_energy(angle, self._parameters))

        def _calc_dissipated_power(self, context, output):
            angle, rate = self._pitch.Eval(context).tolist()
            moment = damping_moment(angle, rate, self._parameters)
            output.SetAtIndex(0, moment * rate)

    return Impl


BogiePitch = default_instantiation(BogiePitch_)

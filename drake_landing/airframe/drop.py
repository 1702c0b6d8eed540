"""The load pulse of one landing gear that is dropped with its share of the aircraft.

Two masses and a wheel, the tests of landing gears since N. S. Currey: the share of the
airframe that the gear stops, on shock absorber, unsprung mass and tyre; the wheel is
spun up by the tyre's drag. Laws of shock absorber, tyre and friction are those of the
multibody model. Nothing else of the aircraft enters: the pulse is known before any
landing is simulated. Levered gears and bogies are taken as telescopic ones: good for
the spectrum of the pulse, not for loads.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.gears.data import LandingGear
from drake_landing.gears.parameters import (
    shock_absorber_parameters,
    tire_parameters,
)
from fem.errors import InputError
from systems.runway.runway import Runway
from systems.shock_absorber.strut_law import StrutLaw
from systems.tire.tire_law import TireLaw

Float64 = npt.NDArray[np.float64]

_SUBSTEP = 1e-4  # s; tyre and unsprung mass vibrate at 10 to 50 Hz, the wheel slips out
_LOW_SPEED = 0.5  # m/s, below which there is no spin-up


@dataclass(frozen=True, kw_only=True)
class DropPulse:
    """Loads of a dropped gear on the airframe.

    Attributes:
        time: (t,) even, s, from touchdown.
        vertical: (t,) N, up.
        drag: (t,) N, aft, all wheels.
        stroke: (t,) m.
    """

    time: Float64
    vertical: Float64
    drag: Float64
    stroke: Float64


def drop_pulse(
    gear: LandingGear,
    share: float,
    sink_rate: float,
    forward_speed: float,
    *,
    friction: float = 1.0,
    step: float,
    duration: float,
) -> DropPulse:
    """One gear touches down.

    Args:
        gear: any kind.
        share: mass of the airframe that it stops, kg, without the gear.
        sink_rate, forward_speed: m/s.
        friction: factor on the tyres' friction.
        step: of the result, s.
        duration: s.
    """
    law = _DropLaw(gear, share, forward_speed, friction)
    count = round(duration / step)
    inner = max(1, int(np.ceil(step / _SUBSTEP)))
    h = step / inner
    x = [0.0, 0.0, sink_rate, sink_rate, 0.0]
    rows = [law.loads(x)]
    with np.errstate(over="ignore", invalid="ignore"):  # looked at below
        for _ in range(count):
            for _ in range(inner):
                x = _runge_kutta(law.rate, x, h)
            rows.append(law.loads(x))
            if not np.isfinite(rows[-1]).all():
                raise InputError(
                    f"gears.{gear.name}: dropped by itself, its forces pass all bounds "
                    f"after {step * (len(rows) - 1):.3g} s; expected softer damping or "
                    "stiffness of its shock absorber or tire"
                )
    vertical, drag, stroke = np.array(rows).T
    return DropPulse(
        time=step * np.arange(count + 1), vertical=vertical, drag=drag, stroke=stroke
    )


class _DropLaw:
    """Equations of motion; state: drop of airframe and of axle, their rates, spin."""

    def __init__(
        self, gear: LandingGear, share: float, speed: float, friction: float
    ) -> None:
        self._wheels = len(gear.wheel_names)
        self._share = share
        self._sprung = share + gear.sprung_mass
        self._unsprung = gear.mass - gear.sprung_mass
        self._spin = gear.wheel.spin_inertia
        self._speed, self._friction = speed, friction
        strut = shock_absorber_parameters(gear.shock_absorber)
        self._strut, self._tunables = StrutLaw(strut), strut.tunables
        self._tyre = tire_parameters(gear.tyre)
        self._tyre_law = TireLaw(self._tyre, Runway())

    def rate(self, x: Sequence[float]) -> list[float]:
        _, _, v, w, _ = x
        strut, normal, drag, radius = self._forces(x)
        return [
            v,
            w,
            -strut / self._sprung,
            (strut - normal) / self._unsprung,
            drag * radius / (self._wheels * self._spin),
        ]

    def loads(self, x: Sequence[float]) -> tuple[float, float, float]:
        """Vertical load and drag on the airframe (N), stroke (m)."""
        strut, _, drag, _ = self._forces(x)
        return strut * self._share / self._sprung, drag, x[0] - x[1]

    def _forces(self, x: Sequence[float]) -> tuple[float, float, float, float]:
        """Force of the strut, of all tyres: normal and drag; radius of the wheel."""
        z, u, v, w, omega = x
        strut = self._strut.forces(z - u, v - w, 0.0, self._tunables).total
        normal = 0.0
        if u > 0.0:
            damping = min(u / self._tyre.damping_ramp, 1.0) * self._damping
            elastic = self._tyre_law.elastic_force(u)
            normal = self._wheels * max(elastic + damping * w, 0.0)
        radius = max(
            self._tyre_law.rolling_radius(max(u, 0.0)), 0.5 * self._tyre.radius
        )
        drag = 0.0
        if normal > 0.0 and self._speed > _LOW_SPEED:
            slip = (self._speed - radius * omega) / self._speed
            ratio, _ = self._tyre_law.ratios(u, -slip, 0.0)
            drag = self._friction * normal * ratio
        return strut, normal, drag, radius

    @property
    def _damping(self) -> float:
        damping = self._tyre.damping
        return damping if isinstance(damping, int | float) else max(damping.y)


def _runge_kutta(rate, x: list[float], h: float) -> list[float]:
    """One step of the classical fourth-order scheme."""
    a = rate(x)
    b = rate([p + 0.5 * h * q for p, q in zip(x, a)])
    c = rate([p + 0.5 * h * q for p, q in zip(x, b)])
    d = rate([p + h * q for p, q in zip(x, c)])
    return [
        p + h / 6.0 * (k + 2.0 * (m + n) + o) for p, k, m, n, o in zip(x, a, b, c, d)
    ]

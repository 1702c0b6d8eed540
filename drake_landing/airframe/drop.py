"""The load pulse of one landing gear that is dropped with its share of the aircraft.

Two masses and a wheel, the tests of landing gears since N. S. Currey: the share of the
airframe that the gear stops, on shock absorber, unsprung mass and tire; the wheel is
spun up by the tire's drag. Laws of shock absorber, tire and friction are those of the
multibody model. Nothing else of the aircraft enters: the pulse is known before any
landing is simulated. Levered gears and bogies are taken as telescopic ones: good for
the spectrum of the pulse, not for loads.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import numpy.typing as npt

from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.parameters import (
    shock_absorber_parameters,
    tire_parameters,
)
from fem.errors import InputError
from systems.runway.runway import Runway
from systems.shock_absorber.strut_law import StrutLaw
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.tire_law import TireLaw
from systems.tire.tire_parameters import TireParameters

Float64 = npt.NDArray[np.float64]

# s; tire and unsprung mass vibrate at 10 to 50 Hz, the wheel slips out: 1e-5 of the
# peaks. The finer one is for gears of stiffer parts.
_SUBSTEPS = (2.5e-4, 2.5e-5)
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
        friction: factor on the tires' friction.
        step: of the result, s.
        duration: s.
    """
    count = round(duration / step)
    for substep in _SUBSTEPS:
        rows = _fall(
            _DropLaw.from_gear(gear, share, forward_speed, friction),
            sink_rate,
            step / max(1, int(np.ceil(step / substep))),
            step,
            count,
        )
        if len(rows) > count:
            vertical, drag, stroke = rows.T
            return DropPulse(
                time=step * np.arange(count + 1),
                vertical=vertical,
                drag=drag,
                stroke=stroke,
            )
    raise InputError(
        f"gears.{gear.name}: dropped by itself, its forces pass all bounds after "
        f"{step * len(rows):.3g} s; expected softer damping or stiffness of its shock "
        "absorber or tire"
    )


@lru_cache(maxsize=32)  # mirror images, and the same gear asked for again
def _fall(
    law: "_DropLaw", sink_rate: float, substep: float, step: float, count: int
) -> Float64:
    """Rows (count + 1, 3) of the law's loads; fewer where they pass all bounds."""
    inner = round(step / substep)
    x = [0.0, 0.0, sink_rate, sink_rate, 0.0]
    rows = [law.loads(x)]
    with np.errstate(over="ignore", invalid="ignore"):
        for _ in range(count):
            for _ in range(inner):
                x = _runge_kutta(law.rate, x, substep)
            loads = law.loads(x)
            if not np.isfinite(loads).all():
                break
            rows.append(loads)
    found = np.array(rows)
    found.flags.writeable = False
    return found


@dataclass(frozen=True)
class _DropLaw:
    """Equations of motion; state: drop of airframe and of axle, their rates, spin.

    Attributes:
        strut, tire: of one shock absorber and each tire.
        wheels: of the gear.
        share, sprung, unsprung: kg; sprung is the share and the gear's own part.
        spin: kg m², of one wheel.
        speed: forward, m/s.
        friction: factor on the tires' friction.
    """

    strut: ShockAbsorberParameters
    tire: TireParameters
    wheels: int
    share: float
    sprung: float
    unsprung: float
    spin: float
    speed: float
    friction: float

    @classmethod
    def from_gear(
        cls, gear: LandingGear, share: float, speed: float, friction: float
    ) -> "_DropLaw":
        return cls(
            strut=shock_absorber_parameters(gear.shock_absorber),
            tire=tire_parameters(gear.tyre),
            wheels=len(gear.wheel_names),
            share=float(share),
            sprung=float(share + gear.sprung_mass),
            unsprung=float(gear.unsprung_mass),
            spin=float(gear.wheel.spin_inertia),
            speed=float(speed),
            friction=float(friction),
        )

    @cached_property
    def _strut_law(self) -> StrutLaw:
        return StrutLaw(self.strut)

    @cached_property
    def _tunables(self) -> list[float]:
        return self.strut.tunables

    @cached_property
    def _tire_law(self) -> TireLaw:
        return TireLaw(self.tire, Runway())

    @cached_property
    def _damping(self) -> float:
        damping = self.tire.damping
        return damping if isinstance(damping, int | float) else max(damping.y)

    def rate(self, x: Sequence[float]) -> list[float]:
        _, _, v, w, _ = x
        strut, normal, drag, radius = self._forces(x)
        return [
            v,
            w,
            -strut / self.sprung,
            (strut - normal) / self.unsprung,
            drag * radius / (self.wheels * self.spin),
        ]

    def loads(self, x: Sequence[float]) -> tuple[float, float, float]:
        """Vertical load and drag on the airframe (N), stroke (m)."""
        strut, _, drag, _ = self._forces(x)
        return strut * self.share / self.sprung, drag, x[0] - x[1]

    def _forces(self, x: Sequence[float]) -> tuple[float, float, float, float]:
        """Force of the strut, of all tires: normal and drag; radius of the wheel."""
        z, u, v, w, omega = x
        strut = self._strut_law.forces(z - u, v - w, 0.0, self._tunables).total
        law = self._tire_law
        normal = 0.0
        if u > 0.0:
            damping = min(u / self.tire.damping_ramp, 1.0) * self._damping
            normal = self.wheels * max(law.elastic_force(u) + damping * w, 0.0)
        radius = max(law.rolling_radius(max(u, 0.0)), 0.5 * self.tire.radius)
        drag = 0.0
        if normal > 0.0 and self.speed > _LOW_SPEED:
            slip = (self.speed - radius * omega) / self.speed
            ratio, _ = law.ratios(u, -slip, 0.0)
            drag = self.friction * normal * ratio
        return strut, normal, drag, radius


def _runge_kutta(rate, x: list[float], h: float) -> list[float]:
    """One step of the classical fourth-order scheme."""
    a = rate(x)
    b = rate([p + 0.5 * h * q for p, q in zip(x, a)])
    c = rate([p + 0.5 * h * q for p, q in zip(x, b)])
    d = rate([p + h * q for p, q in zip(x, c)])
    return [
        p + h / 6.0 * (k + 2.0 * (m + n) + o) for p, k, m, n, o in zip(x, a, b, c, d)
    ]

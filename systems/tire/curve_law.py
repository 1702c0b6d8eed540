"""Forces of slip by a friction curve, with cornering power and pneumatic trail.

The curve of `slip` serves both directions; across the wheel the slip is scaled, so that
the side force has the cornering power of the tire where that is known. The side force
acts behind the middle of the footprint by the trail, which falls with the slip as it
does with the slip angle (`aircraft_tire.trail_share`).
"""

from typing import Any, NamedTuple, Self

from numba import types
from numba.extending import overload

from systems.tire.aircraft_tire import trail_share
from systems.tire.slip import SlipCurve, constants, secant, slope
from systems.tire.slip_law import relaxation_share, wheel_forces
from systems.tools.compiled import law
from systems.tools.scalar import Scalar, sqrt
from systems.tools.table import Table, look_up

# Points of the trail's share, up to this angle φ (`aircraft_tire.trail_share`).
_POINTS, _LAST_ANGLE = 81, 4.0


class CurveLaw(NamedTuple):
    """A `SlipLaw`, see `TireParameters`.

    Compiled, tables are their rows, the curve of a sine is (peak, shape, stiffness).

    Attributes:
        lateral_ratio: ν, friction across over friction along the wheel.
        lateral_scale: c, slope of the side force over that of the drag, where `scale`
            is none.
        low_speed: m/s, below which the trail has no sense of travel.
        curve: friction over slip.
        cornering: side force per angle at small angles (N/rad) over deflection (m).
        scale: c over deflection (m), from `cornering`.
        trail: pneumatic trail at small angles (m) over deflection (m).
        trail_share: of it, over slip.
    """

    lateral_ratio: float
    lateral_scale: float
    low_speed: float
    curve: SlipCurve
    cornering: Table | None
    scale: Table | None
    trail: Table | None
    trail_share: Table

    @classmethod
    def of_curve(cls, curve: SlipCurve, **given: Any) -> Self:
        """With the share of the trail that belongs to a friction curve."""
        per_slip = curve.initial_slope / curve.peak if curve.peak else 1.0
        last = _POINTS - 1
        slips = [_LAST_ANGLE / per_slip * i / last for i in range(_POINTS)]
        shares = [trail_share(per_slip * slip) for slip in slips]
        return cls(curve=curve, trail_share=Table(slips, shares), **given)

    @property
    def compiled_form(self) -> Self:
        """See `SlipLaw`; without the cornering power, which `scale` stands for."""
        tables = {
            name: table and table.rows
            for name, table in self._asdict().items()
            if name in ("scale", "trail", "trail_share")
        }
        return self._replace(curve=constants(self.curve), cornering=None, **tables)

    def slopes(self, load: float, deflection: float) -> tuple[float, float]:
        """See `SlipLaw`."""
        along = self.curve.initial_slope * load
        if self.cornering is not None:
            return along, self.cornering.value(deflection)
        return along, along * self.lateral_ratio * self.lateral_scale

    def relaxation_share(self, k_t: Scalar, k_l: Scalar, deflection: Scalar) -> Scalar:
        """See `SlipLaw`: the carcass deflects by force over stiffness, and the force
        falls short of the slope of small slip by the secant of the curve.
        """
        return _relaxation_share(self, k_t, k_l, deflection)

    def wheel_forces(
        self,
        k_t: Scalar,
        k_l: Scalar,
        travel: Scalar,
        deflection: Scalar,
        load: Scalar,
        factor: Scalar,
        tilt: Scalar,
    ) -> tuple[Scalar, Scalar, Scalar]:
        """See `SlipLaw`; the tilt has no part in it."""
        return _wheel_forces(self, k_t, k_l, travel, deflection, load, factor)


# Numba leaves out what a missing table does not need where the table is an argument.
@law
def _stretch(scale: Table | None, constant: float, deflection: Scalar) -> Scalar:
    """c at a deflection."""
    if scale is not None:
        return look_up(scale, deflection)
    return constant + 0.0 * deflection


@law
def _turning(
    trail: Table | None,
    share: Table,
    low_speed: float,
    deflection: Scalar,
    k_t: Scalar,
    across: Scalar,
    travel: Scalar,
    side: Scalar,
) -> Scalar:
    """Moment of the side force about the normal, N m."""
    if trail is None:
        return 0.0 * side
    arm = look_up(trail, deflection)
    square = k_t * k_t + across * across
    # The root of zero has no slope.
    combined = sqrt(square) if square > 0.0 else 0.0 * square
    arm = arm * look_up(share, combined)
    sense = travel / sqrt(travel * travel + low_speed * low_speed)
    return -sense * arm * side


@law
def _relaxation_share(
    law: CurveLaw, k_t: Scalar, k_l: Scalar, deflection: Scalar
) -> Scalar:
    initial = slope(law.curve)
    if initial > 0.0:
        across = _stretch(law.scale, law.lateral_scale, deflection) * k_l
        return secant(law.curve, k_t, across) / initial
    return 1.0 + 0.0 * deflection


@law
def _wheel_forces(
    law: CurveLaw,
    k_t: Scalar,
    k_l: Scalar,
    travel: Scalar,
    deflection: Scalar,
    load: Scalar,
    factor: Scalar,
) -> tuple[Scalar, Scalar, Scalar]:
    across = _stretch(law.scale, law.lateral_scale, deflection) * k_l
    share = load * factor * secant(law.curve, k_t, across)
    side = -share * law.lateral_ratio * across
    trail = law.trail, law.trail_share, law.low_speed
    turning = _turning(*trail, deflection, k_t, across, travel, side)
    return -share * k_t, side, turning


def _is_curve_law(law: Any) -> bool:
    """Whether the type of a compiled law's argument is a curve law."""
    return isinstance(law, types.BaseNamedTuple) and law.instance_class is CurveLaw


@overload(relaxation_share)
def _compiled_share(law, k_t, k_l, deflection):
    if _is_curve_law(law):
        return lambda law, k_t, k_l, deflection: _relaxation_share(
            law, k_t, k_l, deflection
        )


@overload(wheel_forces)
def _compiled_forces(law, k_t, k_l, travel, deflection, load, factor, tilt):
    if _is_curve_law(law):
        return lambda law, k_t, k_l, travel, deflection, load, factor, tilt: (
            _wheel_forces(law, k_t, k_l, travel, deflection, load, factor)
        )

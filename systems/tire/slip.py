"""Friction of a tire over slip, and how both directions of slip share it.

Slip is the sliding velocity of the contact point over the speed of travel. Along the
wheel it is σ = (v_x - r_r ω)/v_x, across it the tangent of the slip angle. One curve
μ(ρ) serves both through the combined slip

    ρ = √(κ² + (c τ)²),  F_x = F_z μ(ρ) κ/ρ,  F_y = F_z ν μ(ρ) c τ/ρ,

so that pure slip follows the curve, the force never leaves the ellipse with the half
axes μ F_z and ν μ F_z, and always opposes sliding.
"""

from dataclasses import dataclass

from numba import types
from numba.extending import overload

from systems.tools.checks import require
from systems.tools.compiled import law
from systems.tools.scalar import Scalar, atan, sin, sqrt
from systems.tools.table import Table, look_up

# Below this slip μ(ρ)/ρ is its limit, the initial slope.
_TINY = 1e-9


@dataclass(frozen=True, kw_only=True)
class SineSlip:
    """μ = peak sin(shape atan(stiffness ρ)), the default curve.

    With 0.8, 1.6, 12.5: peak 0.80 at ρ = 0.12, 0.55 at ρ = 1; the peak is the limit of
    CS 25.473(e).

    Attributes:
        peak: largest friction coefficient.
        shape: 1 to 2; above 1 the curve falls beyond its peak.
        stiffness: initial slope over (peak × shape).
    """

    peak: float = 0.8
    shape: float = 1.6
    stiffness: float = 12.5

    def __post_init__(self) -> None:
        require("slip curve", "peak", self.peak, "", at_least=0.0, at_most=2.0)
        require("slip curve", "shape", self.shape, "", at_least=1.0, at_most=2.0)
        require("slip curve", "stiffness", self.stiffness, "", above=0.0)

    @property
    def initial_slope(self) -> float:
        """dμ/dρ at zero slip."""
        return self.peak * self.shape * self.stiffness

    def mu(self, slip: Scalar) -> Scalar:
        """Friction coefficient at slip >= 0."""
        return self.peak * sin(self.shape * atan(self.stiffness * slip))


@dataclass(frozen=True, kw_only=True)
class TabulatedSlip:
    """μ from a table over slip, held beyond its last point.

    Attributes:
        table: starts at (0, 0), μ >= 0.
    """

    table: Table

    def __post_init__(self) -> None:
        if self.table.x[0] != 0.0 or self.table.y[0] != 0.0:
            raise ValueError(
                f"slip curve: table starts at ({self.table.x[0]}, {self.table.y[0]}), "
                "expected (0, 0)"
            )
        if min(self.table.y) < 0.0 or not self.table.y[1] > 0.0:
            raise ValueError(
                "slip curve: table needs μ >= 0 everywhere and > 0 at its second point"
            )

    @property
    def initial_slope(self) -> float:
        """dμ/dρ at zero slip."""
        return self.table.slope(0.0)

    @property
    def peak(self) -> float:
        """Largest friction coefficient."""
        return max(self.table.y)

    def mu(self, slip: Scalar) -> Scalar:
        """Friction coefficient at slip >= 0."""
        return self.table.value(slip)


SlipCurve = SineSlip | TabulatedSlip


def slope(curve: SlipCurve) -> float:
    """dμ/dρ at zero slip."""
    return curve.initial_slope


def mu(curve: SlipCurve, slip: Scalar) -> Scalar:
    """Friction coefficient at slip >= 0."""
    return curve.mu(slip)


def constants(curve: SlipCurve) -> object:
    """What stands for the curve in compiled laws."""
    if isinstance(curve, TabulatedSlip):
        return curve.table.rows
    return float(curve.peak), float(curve.shape), float(curve.stiffness)


@overload(slope)
def _slope(curve):
    if isinstance(curve, types.Array):
        return lambda curve: curve[2, 0]
    return lambda curve: curve[0] * curve[1] * curve[2]


@overload(mu)
def _mu(curve, slip):
    if isinstance(curve, types.Array):
        return lambda curve, slip: look_up(curve, slip)
    return lambda curve, slip: curve[0] * sin(curve[1] * atan(curve[2] * slip))


@law
def secant(curve: SlipCurve, along: Scalar, across: Scalar) -> Scalar:
    """μ(ρ)/ρ at the slip components (κ, c τ)."""
    square = along * along + across * across
    if square < _TINY * _TINY:
        return slope(curve) + 0.0 * square
    slip = sqrt(square)
    return mu(curve, slip) / slip


@law
def reference_speed(speed: Scalar, low_speed: float) -> Scalar:
    """|v| in the denominator of slip; a parabola below `low_speed` (m/s).

    Exact above low_speed, at least half of it below: the force becomes viscous where
    the speed goes to zero, and continuous in value and slope.
    """
    magnitude = abs(speed)
    if magnitude >= low_speed:
        return magnitude
    return 0.5 * (low_speed + speed * speed / low_speed)

"""A shock absorber between a pivoting arm and the fitting: stroke from geometry.

An arm turns by θ about the axis a through the pivot. The shock absorber spans the point
U of the fitting and the point L of the arm, u and l from the pivot at θ = 0. Then

    length² = u² + l² - 2 u·R(θ) l,    u·R(θ) l = c + p cos θ + q sin θ
    c = (u·a)(l·a),  p = u·l - c,  q = u·(a × l),

stroke s = length(0) - length(θ), and a force F that drives U and L apart acts on the
joint with the moment -F ds/dθ: its power is -F s', that of the shock absorber.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydrake.multibody.tree import RevoluteJoint

from systems.tools.scalar import Scalar, cos, sin, sqrt

# Least length of the shock absorber over its extended one, and least lever arm over the
# largest one, on the way to full stroke.
_LEAST_SHARE = 0.05


@dataclass(frozen=True, slots=True)
class LeverGeometry:
    """Length² = square - 2 (p cos θ + q sin θ), m².

    Attributes:
        square, p, q: m², see the module.
    """

    square: float
    p: float
    q: float

    @classmethod
    def between(
        cls, upper: npt.ArrayLike, lower: npt.ArrayLike, axis: npt.ArrayLike
    ) -> "LeverGeometry":
        """From the ends (3,) seen from the pivot, m, and the axis (3,) of the joint.

        Raises:
            ValueError: an end lies on the axis, or both ends coincide.
        """
        u, v, a = (np.asarray(x, dtype=float) for x in (upper, lower, axis))
        a = a / math.sqrt(a @ a)
        along = float((u @ a) * (v @ a))
        p, q = float(u @ v) - along, float(u @ np.cross(a, v))
        geometry = cls(float(u @ u + v @ v) - 2.0 * along, p, q)
        if not math.hypot(p, q) > 1e-9:
            raise ValueError("lever: an end of the shock absorber lies on the pivot")
        if not geometry.square - 2.0 * p > 1e-9:
            raise ValueError("lever: the ends of the shock absorber coincide")
        return geometry

    def length(self, angle: Scalar) -> Scalar:
        """Distance of the ends, m, at the angle θ of the joint, rad."""
        return sqrt(self.square - 2.0 * (self.p * cos(angle) + self.q * sin(angle)))

    def stroke(self, angle: Scalar) -> Scalar:
        """Shortening since θ = 0, m."""
        return math.sqrt(self.square - 2.0 * self.p) - self.length(angle)

    def ratio(self, angle: Scalar) -> Scalar:
        """ds/dθ, m/rad."""
        moment = self.q * cos(angle) - self.p * sin(angle)
        return moment / self.length(angle)

    def angle(self, stroke: float) -> float:
        """θ at a stroke, on the branch that θ = 0 lies on, rad.

        Raises:
            ValueError: the ends cannot come that close.
        """
        length = math.sqrt(self.square - 2.0 * self.p) - stroke
        amplitude = math.hypot(self.p, self.q)
        cosine = 0.5 * (self.square - length * length) / amplitude
        if length <= 0.0 or abs(cosine) > 1.0:
            raise ValueError(
                f"lever: stroke {stroke} m is beyond what the arm can give, expected "
                f"less than {self.reach:.4g} m"
            )
        # ds/dθ has the sign of sin(φ - θ), φ the direction of (p, q).
        turn = math.acos(cosine)
        direction = math.atan2(self.q, self.p)
        return direction - math.copysign(turn, direction)

    @property
    def reach(self) -> float:
        """Largest stroke of the branch, m."""
        least = max(self.square - 2.0 * math.hypot(self.p, self.q), 0.0)
        return math.sqrt(self.square - 2.0 * self.p) - math.sqrt(least)

    def require_stroke(self, stroke: float) -> None:
        """Checks that the arm gives this stroke (m) with some lever arm left.

        Raises:
            ValueError: it does not, or the joint passes a dead center on the way.
        """
        end = self.angle(stroke)
        ratios = [abs(self.ratio(end * i / 20)) for i in range(21)]
        if min(ratios) < _LEAST_SHARE * max(ratios):
            raise ValueError(
                "lever: the shock absorber has almost no lever arm somewhere on the "
                f"way to its stroke of {stroke} m: {min(ratios):.3g} m of "
                f"{max(ratios):.3g} m"
            )


@dataclass(frozen=True)
class LeverStrut:
    """A shock absorber over a revolute joint of a plant.

    Attributes:
        joint: of the arm; parent is the fitting.
        geometry: of the shock absorber.
        p_upper: (3,) its end on the fitting, in the joint's frame on the parent, m.
        p_lower: (3,) its end on the arm, in the joint's frame on the child, m.
    """

    joint: RevoluteJoint
    geometry: LeverGeometry
    p_upper: npt.NDArray[np.float64]
    p_lower: npt.NDArray[np.float64]

    @classmethod
    def over(
        cls, joint: RevoluteJoint, p_upper: npt.ArrayLike, p_lower: npt.ArrayLike
    ) -> "LeverStrut":
        """From the ends (3,) in the joint's frames on parent and child, m."""
        geometry = LeverGeometry.between(p_upper, p_lower, joint.revolute_axis())
        return cls(joint, geometry, np.asarray(p_upper), np.asarray(p_lower))

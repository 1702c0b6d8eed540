"""Runways: height over distance, and the friction of their surface.

A profile (`runway_profile`) gives height over the distance d along the runway
(`direction`, default -x, from `origin`). The tyre touches it at the nearest point in
the plane of the wheel: then the radial deflection has the surface normal as its
gradient, and the contact force of an elastic tyre is conservative over any profile.
"""

import math
from dataclasses import dataclass

from systems.runway.runway_profile import Profile
from systems.tools.checks import require
from systems.tools.scalar import Scalar, sqrt

SURFACE_FRICTION = {"dry": 1.0, "wet": 0.6, "icy": 0.12}
"""Factors on the friction of the dry surface; estimates (peaks near 0.8, 0.5, 0.1)."""

# The wheel is within this angle of lying flat: no loaded radius exists.
_LEAST_COSINE = 0.05


@dataclass(frozen=True, kw_only=True)
class Runway:
    """The ground under the tyres, at rest in the world frame.

    Attributes:
        profile: heights over distance; None is flat, z = 0.
        surface: "dry", "wet" or "icy".
        friction_factor: factor on the tyres' friction in place of the surface's.
        direction: horizontal direction of increasing distance, W; default -x.
        origin: point of zero distance, W, m.
    """

    profile: Profile | None = None
    surface: str = "dry"
    friction_factor: float | None = None
    direction: tuple[float, float] = (-1.0, 0.0)
    origin: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        if self.surface not in SURFACE_FRICTION:
            raise ValueError(
                f"runway: surface is {self.surface!r}, expected one of "
                f"{', '.join(SURFACE_FRICTION)}"
            )
        if self.friction_factor is not None:
            require("runway", "friction_factor", self.friction_factor, "", at_least=0.0)
        length = math.hypot(*self.direction)
        if not length > 0.0:
            raise ValueError("runway: direction is (0, 0), expected any other vector")
        unit = (self.direction[0] / length, self.direction[1] / length)
        object.__setattr__(self, "direction", unit)

    @property
    def friction(self) -> float:
        """Factor on the friction coefficient of the tyres."""
        if self.friction_factor is not None:
            return self.friction_factor
        return SURFACE_FRICTION[self.surface]

    def require_rollable(self, radius: float) -> None:
        """Checks that a wheel of this radius (m) touches in one point everywhere.

        Raises:
            ValueError: a hollow is narrower than the wheel.
        """
        if self.profile and self.profile.max_curvature * radius >= 1.0:
            raise ValueError(
                f"runway: radius of curvature is {1.0 / self.profile.max_curvature:.4g}"
                f" m in a hollow, expected > {radius} m, the radius of the tyre: make "
                "the bump or ramp longer"
            )

    def height(self, x: Scalar, y: Scalar) -> Scalar:
        """Height at (x, y), W, m."""
        if self.profile is None:
            return 0.0
        return self.profile.shape(self._distance(x, y))[0]

    def _distance(self, x: Scalar, y: Scalar) -> Scalar:
        ux, uy = self.direction
        return (x - self.origin[0]) * ux + (y - self.origin[1]) * uy

    def nearest(
        self, px: Scalar, py: Scalar, pz: Scalar, ax: Scalar, ay: Scalar, az: Scalar
    ) -> tuple[Scalar, Scalar, Scalar, Scalar]:
        """Distance of a wheel's centre from the ground in the wheel's plane.

        Args:
            px, py, pz: m, centre of the wheel, W.
            ax, ay, az: unit vector along the axle, W.

        Returns:
            The distance (m) and the surface normal (unit vector, W) where it is
            least.

        Raises:
            ValueError: the wheel lies on its side.
        """
        if self.profile is None:
            return pz / _upright(1.0 - az * az), 0.0, 0.0, 1.0
        ux, uy = self.direction
        d_centre = self._distance(px, py)
        d = d_centre
        for _ in range(30):
            h, slope, curvature = self.profile.shape(d)
            nz = 1.0 / sqrt(1.0 + slope * slope)
            nx, ny = -slope * ux * nz, -slope * uy * nz
            tilt = nx * ax + ny * ay + nz * az
            cosine = _upright(1.0 - tilt * tilt)
            # The tangent plane at d, seen from the centre.
            distance = (pz - h - slope * (d_centre - d)) * nz / cosine
            foot = d_centre - distance / cosine * (
                (nx - tilt * ax) * ux + (ny - tilt * ay) * uy
            )
            # Newton's method: the foot moves with the normal, r h'' per unit of d.
            stretch = 1.0 - distance * curvature
            step = (foot - d) / (stretch if stretch > 0.1 else 0.1)
            d = d + step
            if abs(step) < 1e-10:
                break
        return distance, nx, ny, nz


def _upright(square: Scalar) -> Scalar:
    """Cosine of the angle between wheel plane and surface normal, from its square."""
    if square < _LEAST_COSINE * _LEAST_COSINE:
        raise ValueError(
            "tire: the wheel lies on its side; expected an axle at least "
            f"{math.degrees(math.asin(_LEAST_COSINE)):.0f} degrees off the normal of "
            "the runway"
        )
    return sqrt(square)

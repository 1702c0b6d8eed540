"""Runways: height over distance, and the friction of their surface.

A profile (`runway_profile`) gives height over the distance d along the runway
(`direction`, default -x, from `origin`); with a second one, `right`, the first is that
of the left track, and between the tracks one goes over into the other. A crown falls to
either side of the center line. The tire touches it at the nearest point in
the plane of the wheel: then the radial deflection has the surface normal as its
gradient, and the contact force of an elastic tire is conservative over any profile.
"""

import math
from dataclasses import dataclass

from systems.runway.runway_profile import Profile
from systems.tools.checks import require
from systems.tools.scalar import Scalar, sqrt

SURFACE_FRICTION = {"dry": 1.0, "wet": 0.6, "icy": 0.12}
"""Factors on the friction of the dry surface; estimates (peaks near 0.8, 0.5, 0.1)."""

# Half the width over which the crown is rounded, m.
_ROUNDED = 1.0
# The wheel is within this angle of lying flat: no loaded radius exists.
_LEAST_COSINE = 0.05


@dataclass(frozen=True, kw_only=True)
class Runway:
    """The ground under the tires, at rest in the world frame.

    Attributes:
        profile: heights over distance; None is flat, z = 0.
        surface: "dry", "wet" or "icy".
        friction_factor: factor on the tires' friction in place of the surface's.
        right: heights of the right track; None: `profile` is as wide as the runway.
        track_spacing: m, between left and right track.
        crown: fall over distance from the center line, to either side.
        direction: horizontal direction of increasing distance, W; default -x.
        origin: point of the center line at zero distance, W, m.
    """

    profile: Profile | None = None
    surface: str = "dry"
    friction_factor: float | None = None
    right: Profile | None = None
    track_spacing: float = 7.6
    crown: float = 0.0
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
        require("runway", "track_spacing", self.track_spacing, "m", above=0.0)
        require("runway", "crown", self.crown, "", at_least=0.0, at_most=0.1)
        if self.right is not None and self.profile is None:
            raise ValueError("runway: a right track without a left one, `profile`")
        length = math.hypot(*self.direction)
        if not length > 0.0:
            raise ValueError("runway: direction is (0, 0), expected any other vector")
        unit = (self.direction[0] / length, self.direction[1] / length)
        object.__setattr__(self, "direction", unit)

    @property
    def friction(self) -> float:
        """Factor on the friction coefficient of the tires."""
        if self.friction_factor is not None:
            return self.friction_factor
        return SURFACE_FRICTION[self.surface]

    def require_rollable(self, radius: float) -> None:
        """Checks that a wheel of this radius (m) touches in one point everywhere.

        Raises:
            ValueError: a hollow is narrower than the wheel.
        """
        for profile in (self.profile, self.right):
            if profile and profile.max_curvature * radius >= 1.0:
                raise ValueError(
                    f"runway: radius of curvature is {1.0 / profile.max_curvature:.4g} "
                    f"m in a hollow, expected > {radius} m, the radius of the tire: "
                    "make the bump, the ramp or the shortest waves longer"
                )

    @property
    def flat(self) -> bool:
        """Everywhere at z = 0."""
        return self.profile is None and self.crown == 0.0

    def height(self, x: Scalar, y: Scalar) -> Scalar:
        """Height at (x, y), W, m."""
        return 0.0 if self.flat else self._shape(*self._along_and_across(x, y))[0]

    def _along_and_across(self, x: Scalar, y: Scalar) -> tuple[Scalar, Scalar]:
        """Distance, and offset from the center line to the right of it, m."""
        (ux, uy), dx, dy = self.direction, x - self.origin[0], y - self.origin[1]
        return dx * ux + dy * uy, dx * uy - dy * ux

    def _shape(
        self, d: Scalar, e: Scalar
    ) -> tuple[Scalar, Scalar, Scalar, Scalar, Scalar]:
        """Height, its slopes along and across, its curvatures along and across."""
        h, slope, curvature = 0.0, 0.0, 0.0
        across, bend = 0.0, 0.0
        if self.profile is not None:
            h, slope, curvature = self.profile.shape(d)
        if self.right is not None:
            t = 0.5 + e / self.track_spacing
            if t >= 1.0:
                h, slope, curvature = self.right.shape(d)
            elif t > 0.0:
                far, far_slope, far_curvature = self.right.shape(d)
                share, lift = t * t * (3.0 - 2.0 * t), far - h
                across = 6.0 * t * (1.0 - t) * lift / self.track_spacing
                bend = (6.0 - 12.0 * t) * lift / self.track_spacing**2
                h = h + share * lift
                slope = slope + share * (far_slope - slope)
                curvature = curvature + share * (far_curvature - curvature)
        if self.crown > 0.0:
            root = sqrt(e * e + _ROUNDED * _ROUNDED)
            h = h - self.crown * (root - _ROUNDED)
            across = across - self.crown * e / root
            bend = bend - self.crown * _ROUNDED * _ROUNDED / (root * root * root)
        return h, slope, across, curvature, bend

    def nearest(
        self, px: Scalar, py: Scalar, pz: Scalar, ax: Scalar, ay: Scalar, az: Scalar
    ) -> tuple[Scalar, Scalar, Scalar, Scalar]:
        """Distance of a wheel's center from the ground in the wheel's plane.

        Args:
            px, py, pz: m, center of the wheel, W.
            ax, ay, az: unit vector along the axle, W.

        Returns:
            The distance (m) and the surface normal (unit vector, W) where it is
            least.

        Raises:
            ValueError: the wheel lies on its side.
        """
        if self.flat:
            return pz / _upright(1.0 - az * az), 0.0, 0.0, 1.0
        ux, uy = self.direction
        d_center, e_center = self._along_and_across(px, py)
        d, e = d_center, e_center
        for _ in range(30):
            h, slope, across, curvature, bend = self._shape(d, e)
            nz = 1.0 / sqrt(1.0 + slope * slope + across * across)
            nx = -(slope * ux + across * uy) * nz
            ny = -(slope * uy - across * ux) * nz
            tilt = nx * ax + ny * ay + nz * az
            cosine = _upright(1.0 - tilt * tilt)
            # The tangent plane at (d, e), seen from the center.
            rise = slope * (d_center - d) + across * (e_center - e)
            distance = (pz - h - rise) * nz / cosine
            gx = distance / cosine * (nx - tilt * ax)
            gy = distance / cosine * (ny - tilt * ay)
            # Newton's method: the foot moves with the normal, r h'' per unit of d.
            step = (d_center - gx * ux - gy * uy - d) / _stretch(distance * curvature)
            aside = (e_center - gx * uy + gy * ux - e) / _stretch(distance * bend)
            d, e = d + step, e + aside
            if abs(step) < 1e-10 and abs(aside) < 1e-10:
                break
        return distance, nx, ny, nz


def _stretch(bent: Scalar) -> Scalar:
    return 1.0 - bent if bent < 0.9 else 0.1


def _upright(square: Scalar) -> Scalar:
    """Cosine of the angle between wheel plane and surface normal, from its square."""
    if square < _LEAST_COSINE * _LEAST_COSINE:
        raise ValueError(
            "tire: the wheel lies on its side; expected an axle at least "
            f"{math.degrees(math.asin(_LEAST_COSINE)):.0f} degrees off the normal of "
            "the runway"
        )
    return sqrt(square)

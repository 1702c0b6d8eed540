"""Outer shape of the reference aircraft: points on wing, tails and fuselage.

Frame: x aft from the nose tip, y to starboard, z up; metres. Lifting surfaces are given
by span coordinate and chord fraction, for the starboard half; `side` -1 mirrors.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt

from drake_landing.reference.d150.facts import facts, table

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

MIRROR = np.array([1.0, -1.0, 1.0])


def polyline(points: Float64, parameter: npt.ArrayLike, column: int) -> Float64:
    """Points of a polyline where its coordinate `column` takes the given values.

    Args:
        points: (n, 3) ascending in `column`; ends are extended by their segment.
        parameter: (m,) values of the coordinate.

    Returns:
        (m, 3) positions.
    """
    t = np.atleast_1d(np.asarray(parameter, float))
    knots = points[:, column]
    i = np.clip(np.searchsorted(knots, t, side="right") - 1, 0, len(knots) - 2)
    share = (t - knots[i]) / (knots[i + 1] - knots[i])
    return points[i] + share[:, None] * (points[i + 1] - points[i])


@dataclass(frozen=True, kw_only=True)
class LiftingSurface:
    """Straight-lined planform of a half wing, half tailplane or fin.

    Attributes:
        name: of its facts.
        leading: (n, 3) leading edge from root to tip, m.
        chord: (n,) m.
        scale: (n,) factor on the section's ordinates.
        span_axis: 1 (wing, tailplane) or 2 (fin): the coordinate along the span.
        incidence: nose up, about the axis y through `pivot`, rad.
        pivot: (3,) m.
        airfoil: name in `airfoils.csv`.
        axis: (k, 3) structural reference axis, m.
        spars: (front, rear): (n, 2) share of the span against chord fraction.
    """

    name: str
    leading: Float64
    chord: Float64
    scale: Float64
    span_axis: int
    incidence: float
    pivot: Float64
    airfoil: str
    axis: Float64
    spars: tuple[Float64, Float64]

    @property
    def root(self) -> float:
        """Span coordinate of the root, m."""
        return float(self.leading[0, self.span_axis])

    @property
    def span(self) -> float:
        """Length from root to tip along the span coordinate, m."""
        return float(self.leading[-1, self.span_axis]) - self.root

    def station(self, eta: npt.ArrayLike) -> Float64:
        """Span coordinate of a share of the span."""
        return self.root + np.asarray(eta, float) * self.span

    def chord_at(self, station: npt.ArrayLike) -> Float64:
        """Chord at span coordinates, m."""
        return np.interp(station, self.leading[:, self.span_axis], self.chord)

    def spar_fraction(self, spar: int, station: npt.ArrayLike) -> Float64:
        """Chord fraction of the front (0) or rear (1) spar at span coordinates."""
        eta = (np.asarray(station, float) - self.root) / self.span
        return np.interp(eta, self.spars[spar][:, 0], self.spars[spar][:, 1])

    def point(
        self, station: npt.ArrayLike, fraction: npt.ArrayLike, surface: str = "chord"
    ) -> Float64:
        """Points at span coordinates and chord fractions.

        Args:
            station: (m,) span coordinate, m.
            fraction: (m,) or scalar chord fraction.
            surface: `chord` for the chord line, `upper` (fin: starboard) or `lower`.

        Returns:
            (m, 3) positions in B, starboard half, m.
        """
        s = np.atleast_1d(np.asarray(station, float))
        xi = np.broadcast_to(np.asarray(fraction, float), s.shape)
        chord = self.chord_at(s)
        p = polyline(self.leading, s, self.span_axis)
        p[:, 0] += xi * chord
        if surface != "chord":
            scale = np.interp(s, self.leading[:, self.span_axis], self.scale)
            p[:, 3 - self.span_axis] += (
                airfoil_ordinate(self.airfoil, surface, xi) * scale * chord
            )
        return self._turn(p)

    def on_axis(self, station: npt.ArrayLike) -> Float64:
        """Points of the reference axis at span coordinates, (m, 3)."""
        return polyline(self.axis, station, self.span_axis)

    def _turn(self, p: Float64) -> Float64:
        c, s = np.cos(self.incidence), np.sin(self.incidence)
        arm = p - self.pivot
        turned = np.stack(
            [c * arm[:, 0] + s * arm[:, 2], arm[:, 1], c * arm[:, 2] - s * arm[:, 0]],
            axis=1,
        )
        return turned + self.pivot


def airfoil_ordinate(airfoil: str, surface: str, fraction: npt.ArrayLike) -> Float64:
    """Ordinate of a section of unit chord on its `upper` or `lower` surface."""
    rows = table("airfoils")
    rows = rows[(rows.airfoil == airfoil) & (rows.surface == surface)]
    return np.interp(fraction, rows.x_over_c, rows.z_over_c)


@cache
def wing() -> LiftingSurface:
    """The starboard half wing."""
    data = facts("wing")
    plan = np.array(data["planform"])
    return LiftingSurface(
        name="wing",
        leading=plan[:, [1, 0, 2]],
        chord=plan[:, 3],
        scale=plan[:, 4],
        span_axis=1,
        incidence=np.deg2rad(data["incidence"]),
        pivot=np.array(data["incidence_pivot"]),
        airfoil=data["airfoil"],
        axis=np.array(data["reference_axis"]),
        spars=(np.array(data["front_spar"]), np.array(data["rear_spar"])),
    )


@cache
def tail(name: str) -> LiftingSurface:
    """The starboard half `tailplane` or the `fin`."""
    data = facts("tails")[name]
    return LiftingSurface(
        name=name,
        leading=np.array([data["root_leading_edge"], data["tip_leading_edge"]]),
        chord=np.array([data["root_chord"], data["tip_chord"]]),
        scale=np.full(2, data["thickness_scale"]),
        span_axis=2 if name == "fin" else 1,
        incidence=0.0,
        pivot=np.zeros(3),
        airfoil=data["airfoil"],
        axis=np.array(data["reference_axis"]),
        spars=(np.array(data["front_spar"]), np.array(data["rear_spar"])),
    )


def surface(name: str) -> LiftingSurface:
    """The lifting surface of that name: `wing`, `tailplane` or `fin`."""
    return wing() if name == "wing" else tail(name)


def fuselage_section(x: npt.ArrayLike) -> Float64:
    """Half width, bottom z and top z of the fuselage at stations x, (m, 3), m."""
    rows = table("fuselage_sections")
    x = np.atleast_1d(np.asarray(x, float))
    half = np.interp(x, rows.x, rows.width) / 2
    return np.stack(
        [half, np.interp(x, rows.x, rows.z_bottom), np.interp(x, rows.x, rows.z_top)],
        axis=1,
    )


def fuselage_point(x: npt.ArrayLike, angle: npt.ArrayLike) -> Float64:
    """Points of the skin; angle from the crown toward starboard, rad. (m, 3), m."""
    x, angle = np.broadcast_arrays(np.asarray(x, float), np.asarray(angle, float))
    half, bottom, top = fuselage_section(x).T
    return np.stack(
        [
            x,
            half * np.sin(angle),
            (bottom + top) / 2 + (top - bottom) / 2 * np.cos(angle),
        ],
        axis=1,
    )

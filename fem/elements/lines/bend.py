"""CBEND: a beam along a circular arc in a plane, by its flexibility.

Forces at end B go through the section at each angle by equilibrium; the flexibilities
of the sections, integrated along the arc, give that of the element, exact for the loads
at its ends (Gauss points; the integrands are products of sines and cosines). Axes of a
section: r away from the center, s along the arc from A to B, z = r x s. Plane 1 is that
of the arc (I1), plane 2 is across it (I2).

The neutral axis lies nearer the center than the centroid by DELTAN, by default
I1 / (A R), so that bending and stretching are coupled (Winkler; Timoshenko, Strength of
Materials II). The strain energy of a quarter circle is so MSC's to seven digits:

    C_MM = 1 / (E A DELTAN R),    C_NM = 1 / (E A R),    C_NN = 1 / (E A)

A pipe (FSI) of radii a, b has the neutral axis of the annulus, and bends in both planes
k >= 1 times as much, as its section flattens (ASME code III, NB-3687.2; r mean radius,
t wall, p pressure; formula from memory, MSC's figures are met where k = 1):

    DELTAN = R - (a² - b²) / (2 √(R² - b²) - 2 √(R² - a²))
    k = 1.65 r² / (t R) / (1 + 6 p r / (t E) (r / t)^(4/3) (R / r)^(1/3))
"""

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Bool, Float64, Int64
from fem.deck.records.lines import BEND_FORCE
from fem.deck.references import column, refer, table, where
from fem.elements.block import CENTER, Detail, Kind, Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.lines.line_geometry import congruence, skew
from fem.elements.lines.orientation import orientation_vectors
from fem.errors import InputError
from fem.geometry.points import Points, grid_freedoms
from fem.properties.materials import isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_GAUSS, _WEIGHT = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True, kw_only=True)
class Arc:
    """Arcs of circles, basic axes.

    Attributes:
        center: (e, 3).
        radius, angle: (e,) of the line of centroids; rad.
        r, z: (e, 3) unit vectors from the center to end A, and normal to the plane.
    """

    center: Float64
    radius: Float64
    angle: Float64
    r: Float64
    z: Float64

    def axes(self, share: Float64) -> Float64:
        """(e, q, 3, 3) rows r, s, z at shares (q,) of the arc from A to B."""
        turned = self.angle[:, None, None] * share[:, None]
        s = np.cross(self.z, self.r)
        r = np.cos(turned) * self.r[:, None] + np.sin(turned) * s[:, None]
        z = np.broadcast_to(self.z[:, None], r.shape)
        return np.stack([r, np.cross(z, r), z], axis=2)

    def places(self, axes: Float64) -> Float64:
        """(e, q, 3) centroids of sections with these axes."""
        return self.center[:, None] + self.radius[:, None, None] * axes[:, :, 0]


@dataclass(frozen=True, kw_only=True)
class Bends(DenseBlock):
    """All CBEND elements; 12 freedoms, basic axes.

    Attributes:
        arc: the lines of centroids.
        ends: (e, 2, 3) the grids.
        compliance: (e, 6, 6) of a section: V1 N V2 along r, s, z, M2 T M1 about them.
        line_mass: (e,) mass per length.
        ge: (e,) structural damping.
    """

    arc: Arc
    ends: Float64
    compliance: Float64
    line_mass: Float64
    ge: Float64

    def stiffness(self) -> Float64:
        axes = self.arc.axes(0.5 * (1.0 + _GAUSS))
        through = section_forces(axes, self.arc.places(axes), self.ends[:, 1])
        flexible = np.einsum(
            "q,eqai,eab,eqbj->eij", _WEIGHT, through, self.compliance, through
        )
        length = self.arc.radius * self.arc.angle
        at_b = np.linalg.inv(0.5 * length[:, None, None] * flexible)
        return congruence(self._strain_motion(), at_b)

    def _strain_motion(self) -> Float64:
        """(e, 6, 12) motion of grid B less that of the rigid body that follows A."""
        motion = np.zeros((len(self.id), 6, 12))
        motion[:, :, 6:] = np.eye(6)
        motion[:, :, :6] = -np.eye(6)
        motion[:, :3, 3:6] = skew(self.ends[:, 1] - self.ends[:, 0])
        return motion

    def structural_damping(self) -> Float64 | None:
        return some(self.ge)

    def mass(self, *, coupled: bool) -> Float64 | None:
        """Half to each grid (the coupled matrix is not made, either)."""
        if not np.any(self.line_mass):
            return None
        half = 0.5 * self.line_mass * self.arc.radius * self.arc.angle
        translations = np.tile(np.repeat([1.0, 0.0], 3), 2)
        return half[:, None, None] * np.diag(translations)

    def forces(self) -> Recovery:
        """Moments and shears of planes 1 and 2, axial force, torque at both ends."""
        at_b = self.stiffness()[:, 6:]
        axes = self.arc.axes(np.array([0.0, 1.0]))
        through = section_forces(axes, self.arc.places(axes), self.ends[:, 1])
        section = np.einsum("eqai,eij->eqaj", through, at_b)
        return Recovery(
            table=self.card,
            columns=BEND_FORCE,
            matrix=_printed(section),
            id=self.id,
        )

    def of_nodal_forces(self, kind: Kind, detail: Detail = CENTER) -> Float64 | None:
        """(e, 12, 12) as `forces` from forces at the grids; nothing else is printed."""
        if kind != "force":
            return None
        axes = self.arc.axes(np.array([0.0, 1.0]))
        section = np.zeros((len(self.id), 2, 6, 12))
        for half in (slice(0, 3), slice(3, 6)):
            section[:, 0, half, half] = -axes[:, 0]
            section[:, 1, half, slice(half.start + 6, half.stop + 6)] = axes[:, 1]
        return _printed(section)

    def take(self, which: Int64) -> "Bends":
        """Some of the elements."""
        arc = Arc(**{f.name: getattr(self.arc, f.name)[which] for f in fields(Arc)})
        names = ("id", "dof", "ends", "compliance", "line_mass", "ge")
        own = {name: getattr(self, name)[which] for name in names}
        return replace(self, arc=arc, **own)


def _printed(section: Float64) -> Float64:
    """(e, 12, n) printed forces from those of both sections (e, 2, 6, n)."""
    # V1 N V2 M2 T M1 to M1 M2 V1 V2 N T; M1 straightens the arc (MSC).
    ordered = section[:, :, [5, 3, 0, 2, 1, 4]]
    ordered[:, :, 0] *= -1.0
    return ordered.reshape(len(section), 12, -1)


def section_forces(axes: Float64, places: Float64, at: Float64) -> Float64:
    """(e, q, 6, 6) forces and moments at sections, their axes, from those at B."""
    lever = at[:, None] - places
    map_ = np.zeros((*axes.shape[:2], 6, 6))
    map_[..., :3, :3] = map_[..., 3:, 3:] = axes
    map_[..., 3:, :3] = axes @ skew(lever)
    return map_


def read_cbend(deck: "Deck", points: Points) -> list[Bends]:
    """The CBEND block of a deck, or none.

    Raises:
        InputError: undefined references, arcs that are not defined.
    """
    rows = table(deck, "CBEND").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    values = refer(rows, "CBEND", "pid", table(deck, "PBEND"), "PBEND")
    material = isotropic(deck, values, "PBEND")
    at = points.rows(rows[["ga", "gb"]].to_numpy(np.int64))
    arc = _arcs(rows, values, points, points.xyz[at])
    return [
        Bends(
            card="CBEND",
            id=rows["eid"].to_numpy(np.int64),
            dof=grid_freedoms(at),
            arc=arc,
            ends=points.xyz[at],
            compliance=_compliance(values, material.e, material.g, arc.radius),
            line_mass=material.rho * column(values, "a") + column(values, "nsm"),
            ge=material.ge,
        )
    ]


def _compliance(
    values: pd.DataFrame, young: Float64, shear: Float64, radius: Float64
) -> Float64:
    """(e, 6, 6), see `Bends`."""
    a, i1, i2, j = (column(values, name) for name in ("a", "i1", "i2", "j"))
    matrix = np.zeros((len(a), 6, 6))
    for index, name in ((0, "k1"), (2, "k2")):
        factor = column(values, name)
        stiff = np.where(factor > 0.0, factor * shear * a, np.inf)
        matrix[:, index, index] = 1.0 / stiff
    given = values["deltan"].to_numpy(float)
    offset = np.where(np.isnan(given), i1 / (a * radius), given)
    is_pipe = column(values, "fsi") > 0
    r, t = column(values, "rm"), column(values, "wall")
    softer = np.ones(len(a))
    if is_pipe.any():
        with np.errstate(invalid="ignore", divide="ignore"):
            neutral = _neutral_of_pipe(radius, r + 0.5 * t, r - 0.5 * t)
            ratio = 1.65 * r**2 / (t * radius)
            stiffening = 6.0 * column(values, "pressure") * r / (t * young)
            stiffening *= (r / t) ** (4.0 / 3.0) * (radius / r) ** (1.0 / 3.0)
            k = np.maximum(1.0, ratio / (1.0 + stiffening))
        offset = np.where(is_pipe, radius - neutral, offset)
        softer = np.where(is_pipe, k, softer)
    matrix[:, 1, 1] = 1.0 / (young * a)
    matrix[:, 3, 3] = softer / (young * i2)
    matrix[:, 4, 4] = 1.0 / (shear * j)
    curved = offset != 0.0
    offset = np.where(curved, offset, i1 / (a * radius))
    matrix[:, 5, 5] = softer / (young * a * offset * radius)
    coupled = np.where(curved, 1.0 / (young * a * radius), 0.0)
    matrix[:, 1, 5] = matrix[:, 5, 1] = coupled
    return matrix


def _neutral_of_pipe(radius: Float64, outer: Float64, inner: Float64) -> Float64:
    """(e,) radius of the neutral axis of bent annuli, A over the integral of dA/r."""
    roots = np.sqrt(radius**2 - inner**2) - np.sqrt(radius**2 - outer**2)
    return 0.5 * (outer**2 - inner**2) / roots


def _arcs(
    rows: pd.DataFrame, values: pd.DataFrame, points: Points, ends: Float64
) -> Arc:
    """Arcs of the grids by GEOM, moved to the line of centroids (RC, ZC)."""
    a, b = ends[:, 0], ends[:, 1]
    v = orientation_vectors(rows, points, np.zeros(len(rows), bool))
    geom = rows["geom"].to_numpy(np.int64)
    rc, zc = column(values, "rc"), column(values, "zc")
    radius = np.where(geom == 3, column(values, "rb") - rc, np.nan)
    angle = np.where(geom == 4, np.radians(column(values, "thetab")), np.nan)
    chord = b - a
    length = np.linalg.norm(chord, axis=1)
    with np.errstate(all="ignore"):
        across = v - chord * (_dot(v, chord) / length**2)[:, None]
        aside = np.linalg.norm(across, axis=1)
        across = across / aside[:, None]
        inward = chord - v * (_dot(v, chord) / _dot(v, v))[:, None]
        radius = np.where(geom == 4, 0.5 * length / np.sin(0.5 * angle), radius)
        height = np.sqrt(radius**2 - 0.25 * length**2)
        center = 0.5 * (a + b) - height[:, None] * across
        for number, along in ((1, v), (2, inward)):
            reach = (0.5 * length**2 / _dot(chord, along))[:, None]
            center = np.where((geom == number)[:, None], a + reach * along, center)
        to_a, to_b = a - center, b - center
        r = to_a / np.linalg.norm(to_a, axis=1)[:, None]
        normal = np.cross(to_a, to_b)
        z = normal / np.linalg.norm(normal, axis=1)[:, None]
        opening = np.arctan2(np.linalg.norm(normal, axis=1), _dot(to_a, to_b))
    parallel = aside <= 1e-9 * np.linalg.norm(v, axis=1)
    _refuse(rows, parallel | ~np.isfinite(np.c_[r, z, opening]).all(axis=1))
    return Arc(
        center=center + zc[:, None] * z,
        radius=np.linalg.norm(to_a, axis=1) + rc,
        angle=opening,
        r=r,
        z=z,
    )


def _dot(a: Float64, b: Float64) -> Float64:
    """(e,) scalar products."""
    return np.einsum("ei,ei->e", a, b)


def _refuse(rows: pd.DataFrame, bad: Bool) -> None:
    if bad.any():
        raise InputError(
            f"{where('CBEND', rows.iloc[i])}: GEOM {rows['geom'].iloc[i]} with its "
            "vector or G0 and PBEND gives no arc of less than 180 degrees through GA "
            "and GB"
            for i in np.flatnonzero(bad)
        )

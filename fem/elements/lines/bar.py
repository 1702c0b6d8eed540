"""CBAR: prismatic beam with shear flexibility, product of inertia, offsets, pins.

Forces and stresses follow Nastran's signs: with the forces F_A of the element at end A
in element axes, axial P = -F_x, shears V1 = -F_y and V2 = -F_z, torque T = -M_x,
bending moments M1a = -M_z and M2a = M_y; at end B M1b = M_z and M2b = -M_y. Shears,
axial force and torque are those of end A (they change along a bar under PLOAD1).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.records.lines import BAR_ENDS, BAR_FORCE, BAR_STRESS
from fem.deck.references import column, refer, table
from fem.elements.block import CENTER, Detail, Kind, Recovery
from fem.elements.lines.beam_mass import LineMass, coupled_mass, lumped_mass
from fem.elements.lines.beam_stiffness import SectionCompliance, beam_stiffness
from fem.elements.lines.line_block import LineBlock
from fem.elements.lines.line_geometry import congruence
from fem.elements.lines.line_preload import over, shear_ratio
from fem.elements.lines.orientation import place_lines
from fem.elements.lines.pins import pin_flags
from fem.elements.nonstructural_mass import MassInSection
from fem.geometry.points import Points, grid_freedoms
from fem.properties.materials import Isotropic, isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_ENDS = (0, 1, 4, 5, 6, 7, 2, 3, 8, 9, 10, 11)
# Two points integrate the flexibility of a prismatic beam (quadratic), four its mass.
_GAUSS_2, _GAUSS_4 = (np.polynomial.legendre.leggauss(n) for n in (2, 4))


@dataclass(frozen=True, kw_only=True)
class BarSection:
    """PBAR values per element, units of the deck.

    Attributes:
        a, i1, i2, i12, j: (e,) area, moments of inertia, torsion constant.
        k1, k2: (e,) shear factors, 0 for no shear flexibility.
        nsm: (e,) non-structural mass per length.
        recovery: (e, 4, 2) y and z of the stress points C, D, E, F.
    """

    a: Float64
    i1: Float64
    i2: Float64
    i12: Float64
    j: Float64
    k1: Float64
    k2: Float64
    nsm: Float64
    recovery: Float64


@dataclass(frozen=True, kw_only=True)
class Bar(MassInSection, LineBlock):
    """All CBAR elements; 12 freedoms, basic axes.

    Attributes:
        section: of PBAR.
        mass_of_beam: system cell BARMASS, see `beam_mass`.
    """

    section: BarSection
    mass_of_beam: bool = False

    property_card = "PBAR"

    def _stiffness_at_ends(self) -> Float64:
        return bar_stiffness(self.geometry.length, self.section, self.material)

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 12, 12) lumped or coupled, see `beam_mass`."""
        length, s, rho = self.geometry.length, self.section, self.material.rho
        torsion = rho * (s.i1 + s.i2) * self.mass_of_beam
        line = _line_mass(rho * s.a + s.nsm, torsion)
        if not coupled:
            return congruence(self._map, lumped_mass(length, line))
        at_ends = coupled_mass(length, line, axial_mean=not self.mass_of_beam)
        return congruence(self._condensed[1] @ self._map, at_ends)

    def preload_section(self) -> tuple[Float64, Float64]:
        """See `LineBlock`."""
        s, length = self.section, self.geometry.length
        plain = s.i12 == 0.0
        bent = self.material.e[:, None] * np.stack([s.i1, s.i2], axis=1)
        shear = (
            np.stack([s.k1, s.k2], axis=1) * (self.material.g * s.a * plain)[:, None]
        )
        return shear_ratio(bent, shear, length), over(s.i1 + s.i2, s.a)

    @cached_property
    def _force_matrix(self) -> Float64:
        return bar_forces(self._at_ends @ self._map)[:, :8]

    def recovery(self, kind: Kind, detail: Detail = CENTER) -> Recovery | None:
        """Nastran's eight forces, or all six of both ends as table CBAR_ENDS."""
        if kind != "force" or not detail.ends:
            return super().recovery(kind, detail)
        return Recovery(
            table="CBAR_ENDS",
            columns=BAR_ENDS,
            matrix=bar_forces(self._at_ends @ self._map)[:, _ENDS],
            id=self.id,
        )

    def forces(self) -> Recovery:
        """Moments at both ends, shear, axial force and torque."""
        return Recovery(
            table=self.card,
            columns=BAR_FORCE,
            matrix=self._force_matrix,
            id=self.id,
        )

    def stresses(self) -> Recovery:
        """Direct stresses at C, D, E, F of both ends, axial stress, extremes."""
        return BarStress(
            table=self.card,
            columns=BAR_STRESS,
            matrix=bar_stress_matrix(self.section) @ self._force_matrix,
            id=self.id,
        )

    def of_nodal_forces(self, kind: Kind, detail: Detail = CENTER) -> Float64:
        """(e, c, 12) as `forces`, `stresses`, `strains` from forces at the grids."""
        both = bar_forces(self.geometry.end_forces())
        if kind == "force" and detail.ends:
            return both[:, _ENDS]
        forces = both[:, :8]
        if kind == "force":
            return forces
        stress = bar_stress_matrix(self.section) @ forces
        return stress if kind == "stress" else stress * self._per_modulus


@dataclass(frozen=True, kw_only=True)
class BarStress(Recovery):
    """Extreme stresses at both ends from those at the stress points."""

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 13) from (..., e, 9): bending at A (4), axial, bending at B (4)."""
        axial = linear[..., 4:5]
        parts = [linear[..., :5]]
        for k in (0, 5):
            bending = linear[..., k : k + 4]
            parts.append(axial + bending.max(axis=-1, keepdims=True))
            parts.append(axial + bending.min(axis=-1, keepdims=True))
            if k == 0:
                parts.append(linear[..., 5:])
        return np.concatenate(parts, axis=-1)


def bar_stiffness(length: Float64, section: BarSection, material: Isotropic) -> Float64:
    """(e, 12, 12) stiffness of prismatic bars in element axes.

    Nastran ignores the shear factors of a section with a product of inertia.
    """
    x, weight = _on_unit(_GAUSS_2, len(length))
    plain = section.i12 == 0.0

    def along(value: Float64) -> Float64:
        return np.repeat(value[:, None], x.shape[1], axis=1)

    def shear(factor: Float64) -> Float64:
        area = factor * section.a * material.g
        return along(np.where((area != 0.0) & plain, area, np.inf))

    zero = np.zeros(len(length))
    compliance = SectionCompliance(
        x=x,
        weight=weight,
        ea=along(material.e * section.a),
        gj=along(material.g * section.j),
        ei1=along(material.e * section.i1),
        ei2=along(material.e * section.i2),
        ei12=along(material.e * section.i12),
        gay=shear(section.k1),
        gaz=shear(section.k2),
        y=along(zero),
        z=along(zero),
        y_b=zero,
        z_b=zero,
    )
    return beam_stiffness(length, compliance)


def bar_forces(at_ends: Float64) -> Float64:
    """Nastran's bar forces from the forces upon the ends, element axes.

    Args:
        at_ends: (e, 12, n).

    Returns:
        (e, 12, n): M1a M2a M1b M2b, then V1 V2 N T at end A and the same at end B.
        Without loads between the ends these four are equal.
    """
    rows = [(5, -1), (4, 1), (11, 1), (10, -1)]
    rows += [(1, -1), (2, -1), (0, -1), (3, -1), (7, 1), (8, 1), (6, 1), (9, 1)]
    index, sign = np.array(rows).T
    return sign[:, None] * at_ends[:, index]


def bending_stress(
    i1: Float64, i2: Float64, i12: Float64, at: Float64
) -> tuple[Float64, Float64]:
    """Stress at points (e, 4, 2) per unit of M1 and of M2, both (e, 4).

    Planes without inertia carry no bending and get no stress.
    """
    determinant = i1 * i2 - i12**2
    coupled = i12 != 0.0
    safe = np.where(coupled, determinant, 1.0)
    y, z = at[:, :, 0], at[:, :, 1]

    def inverse(i: Float64) -> Float64:
        return np.divide(1.0, i, out=np.zeros_like(i), where=i != 0.0)

    c11 = np.where(coupled, i2 / safe, inverse(i1))[:, None]
    c22 = np.where(coupled, i1 / safe, inverse(i2))[:, None]
    c12 = np.where(coupled, -i12 / safe, 0.0)[:, None]
    return -(c11 * y + c12 * z), -(c22 * z + c12 * y)


def bar_stress_matrix(section: BarSection) -> Float64:
    """(e, 9, 8) stresses from the eight bar forces."""
    per_m1, per_m2 = bending_stress(
        section.i1, section.i2, section.i12, section.recovery
    )
    matrix = np.zeros((len(section.a), 9, 8))
    matrix[:, 0:4, 0], matrix[:, 0:4, 1] = per_m1, per_m2
    matrix[:, 5:9, 2], matrix[:, 5:9, 3] = per_m1, per_m2
    area = section.a
    matrix[:, 4, 6] = np.divide(1.0, area, out=np.zeros_like(area), where=area != 0.0)
    return matrix


def read_cbar(deck: "Deck", points: Points) -> list[Bar]:
    """The CBAR block of a deck, or none.

    Raises:
        InputError: undefined properties, materials or grids, impossible geometry.
    """
    rows = table(deck, "CBAR").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    pbar = refer(rows, "CBAR", "pid", table(deck, "PBAR"), "PBAR")
    ends = points.rows(rows[["ga", "gb"]].to_numpy(np.int64))
    dof = grid_freedoms(ends)
    released = np.hstack([pin_flags([str(p) for p in rows[c]]) for c in ("pa", "pb")])
    return [
        Bar(
            card="CBAR",
            id=rows["eid"].to_numpy(np.int64),
            dof=dof,
            pid=rows["pid"].to_numpy(np.int64),
            geometry=place_lines(rows, "CBAR", points),
            section=_sections(pbar),
            mass_of_beam=deck.number("BARMASS") > 0,
            material=isotropic(deck, pbar, "PBAR"),
            released=released,
        )
    ]


def _sections(pbar: pd.DataFrame) -> BarSection:
    names = ("a", "i1", "i2", "i12", "j", "k1", "k2", "nsm")
    recovery = np.stack(
        [column(pbar, f"{p}{i}") for p in "cdef" for i in (1, 2)], axis=1
    )
    return BarSection(
        **{name: column(pbar, name) for name in names},
        recovery=recovery.reshape(-1, 4, 2),
    )


def _line_mass(per_length: Float64, torsion: Float64) -> LineMass:
    x, weight = _on_unit(_GAUSS_4, len(per_length))
    everywhere = np.ones_like(x)
    return LineMass(
        x=x,
        weight=weight,
        mass=per_length[:, None] * everywhere,
        y=np.zeros((len(x), 2)),
        z=np.zeros((len(x), 2)),
        torsion=torsion[:, None] * everywhere,
    )


def _on_unit(
    rule: tuple[np.ndarray, np.ndarray], count: int
) -> tuple[Float64, Float64]:
    """Gauss points and weights on [0, 1], repeated for each element."""
    x, weight = 0.5 * (rule[0] + 1.0), 0.5 * rule[1]
    return np.tile(x, (count, 1)), np.tile(weight, (count, 1))

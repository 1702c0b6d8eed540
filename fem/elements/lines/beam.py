"""CBEAM: tapered beam with offset neutral axis and offset non-structural mass.

The element x axis joins the shear centers. Section values vary linearly between the
stations of PBEAM; the stiffness integrates the flexibility exactly along the taper
(`beam_stiffness`), so that one element gives the answer of arbitrarily many. Restrained
warping (CW with SA, SB) is in `beam_warping`; the shear relief of taper (S1, S2) is not
modelled, `beam_notices` says so.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fem.arrays import Float64
from fem.deck.records.lines import BEAM_FORCE, BEAM_STRESS, at_ends, at_stations
from fem.elements.block import CENTER, Detail, Kind, Recovery
from fem.elements.lines.bar import bar_forces
from fem.elements.lines.beam_mass import LineMass, coupled_mass, lumped_mass
from fem.elements.lines.beam_sections import BeamSection
from fem.elements.lines.beam_stations import (
    TABLE,
    StationRecovery,
    Stations,
    stress_rows,
)
from fem.elements.lines.beam_stiffness import SectionCompliance, beam_stiffness
from fem.elements.lines.line_block import LineBlock
from fem.elements.lines.line_geometry import congruence
from fem.elements.lines.line_preload import over, shear_ratio
from fem.properties.materials import Isotropic

# M1 M2 V1 V2 N T of both ends among the rows of `bar_forces`.
_OF_ENDS = ([0, 1, 4, 5, 6, 7], [2, 3, 8, 9, 10, 11])


@dataclass(frozen=True, kw_only=True)
class Beam(LineBlock):
    """CBEAM elements, prismatic or tapered; 12 freedoms, basic axes."""

    section: BeamSection
    stations: Stations | None = None

    property_card = "PBEAM"

    def with_nonstructural_mass(self, per_length: Float64) -> "Beam":
        """Copy with additional mass per length (e,)."""
        nsm = self.section.values["nsm"] + per_length[:, None]
        section = replace(self.section, values={**self.section.values, "nsm": nsm})
        return replace(self, section=section)

    def _stiffness_at_ends(self) -> Float64:
        compliance = section_compliance(self.section, self.material)
        return beam_stiffness(self.geometry.length, compliance)

    def mass(self, *, coupled: bool) -> Float64:
        length = self.geometry.length
        form = coupled_mass if coupled else lumped_mass
        at_ends = self._widened(
            sum(form(length, line) for line in line_masses(self.section, self.material))
        )
        if coupled:
            at_ends = congruence(self._condensed[1], at_ends)
        return congruence(self._map, at_ends)

    def preload_section(self) -> tuple[Float64, Float64]:
        """See `LineBlock`; means along tapered beams."""
        s = self.section
        mean = {name: np.sum(v * s.weight, axis=1) for name, v in s.values.items()}
        bent = self.material.e[:, None] * np.stack([mean["i1"], mean["i2"]], axis=1)
        shear = np.stack([s.k1, s.k2], axis=1) * (self.material.g * mean["a"])[:, None]
        polar = (
            over(mean["i1"] + mean["i2"], mean["a"]) + mean["y"] ** 2 + mean["z"] ** 2
        )
        return shear_ratio(bent, shear, self.geometry.length), polar

    @cached_property
    def _force_matrix(self) -> Float64:
        """(e, 12, 12), see `bar_forces`."""
        return bar_forces(self._at_ends @ self._map)

    def forces(self) -> Recovery:
        return Recovery(
            table=self.card,
            columns=at_ends(BEAM_FORCE),
            matrix=_printed(self._force_matrix, self._warping_torque),
            id=self.id,
        )

    @property
    def _warping_torque(self) -> Float64:
        """(e, 1, n) the part of the torque that restrained warping carries."""
        return np.zeros_like(self._force_matrix[:, :1])

    def stresses(self) -> Recovery:
        return BeamStress(
            table=self.card,
            columns=at_ends(BEAM_STRESS),
            matrix=beam_stress_matrix(self.section) @ self._force_matrix,
            id=self.id,
        )

    def recovery(self, kind: Kind, detail: Detail = CENTER) -> Recovery | None:
        """Results at both ends, or at the stations between, table CBEAM_STATIONS."""
        if not detail.stations:
            return super().recovery(kind, detail)
        return None if kind == "failure" else self._at_stations(kind)

    def _at_stations(self, kind: Kind) -> StationRecovery | None:
        """Forces, stresses or strains of the stations; None where there are none."""
        stations = self.stations
        if stations is None:
            return None
        ends = np.stack([self._force_matrix[:, end] for end in _OF_ENDS], axis=1)
        if kind == "force":
            matrix = stations.forces(ends)
            warping = np.repeat(self._warping_torque[:, None], matrix.shape[1], axis=1)
            matrix = np.concatenate([matrix, warping], axis=2)
        else:
            matrix = stations.stresses(ends)
            if kind == "strain":
                matrix = matrix * self._per_modulus[:, None]
        names = BEAM_FORCE if kind == "force" else BEAM_STRESS
        e, s, q, n = matrix.shape
        return StationRecovery(
            table=TABLE,
            columns=at_stations(names, s),
            matrix=matrix.reshape(e, s * q, n),
            id=self.id,
            x=stations.x,
            extremes=kind != "force",
        )

    def of_nodal_forces(self, kind: Kind, detail: Detail = CENTER) -> Float64:
        """(e, c, 12) as `forces`, `stresses`, `strains` from forces at the grids."""
        forces = bar_forces(self.geometry.end_forces())
        if kind == "force":
            return _printed(forces, np.zeros_like(forces[:, :1]))
        stress = beam_stress_matrix(self.section) @ forces
        return stress if kind == "stress" else stress * self._per_modulus


@dataclass(frozen=True, kw_only=True)
class BeamStress(Recovery):
    """Extreme stresses at both ends from those at the stress points."""

    def derive(self, linear: Float64) -> Float64:
        """(..., e, 12) from (..., e, 8)."""
        parts = []
        for k in (0, 4):
            at = linear[..., k : k + 4]
            parts += [
                at,
                at.max(axis=-1, keepdims=True),
                at.min(axis=-1, keepdims=True),
            ]
        return np.concatenate(parts, axis=-1)


def section_compliance(section: BeamSection, material: Isotropic) -> SectionCompliance:
    """Stiffness values of the sections for the integration of the flexibility."""
    v = section.values
    e, g = material.e[:, None], material.g[:, None]

    def shear(factor: Float64) -> Float64:
        stiffness = factor[:, None] * g * v["a"]
        return np.where(stiffness != 0.0, stiffness, np.inf)

    return SectionCompliance(
        x=section.x,
        weight=section.weight,
        ea=e * v["a"],
        gj=g * v["j"],
        ei1=e * v["i1"],
        ei2=e * v["i2"],
        ei12=e * v["i12"],
        gay=shear(section.k1),
        gaz=shear(section.k2),
        y=v["y"],
        z=v["z"],
        y_b=section.ends["y"][:, 1],
        z_b=section.ends["z"][:, 1],
    )


def line_masses(section: BeamSection, material: Isotropic) -> tuple[LineMass, LineMass]:
    """Structural mass on the neutral axis and non-structural mass on its own line."""
    v = section.values
    rho = material.rho[:, None]
    structural = LineMass(
        x=section.x,
        weight=section.weight,
        mass=rho * v["a"],
        y=section.ends["y"],
        z=section.ends["z"],
        torsion=rho * (v["i1"] + v["i2"]),
    )
    other = LineMass(
        x=section.x,
        weight=section.weight,
        mass=v["nsm"],
        y=section.ends["my"],
        z=section.ends["mz"],
        torsion=v["nsi"],
    )
    return structural, other


def beam_stress_matrix(section: BeamSection) -> Float64:
    """(e, 8, 12) axial plus bending stress at four points of both ends.

    The columns are those of `bar_forces`.
    """
    matrix = np.zeros((len(section.k1), 8, 12))
    for end, columns in enumerate(_OF_ENDS):
        values = {name: value[:, end] for name, value in section.ends.items()}
        rows = np.arange(4 * end, 4 * end + 4)
        matrix[:, rows[:, None], columns] = stress_rows(
            values, section.recovery[:, end]
        )
    return matrix


def _printed(forces: Float64, warping_torque: Float64) -> Float64:
    """(e, 14, n) the columns of CBEAM from `bar_forces` and the warping torque."""
    return np.concatenate(
        [x for end in _OF_ENDS for x in (forces[:, end], warping_torque)], axis=1
    )

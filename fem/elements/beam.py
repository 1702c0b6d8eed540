"""CBEAM: tapered beam with offset neutral axis and offset non-structural mass.

The element x axis joins the shear centres. Section values vary linearly between the
stations of PBEAM; the stiffness integrates the flexibility exactly along the taper
(`beam_stiffness`), so that one element gives the answer of arbitrarily many. Warping
(CW) and the shear relief of taper (S1, S2) are not modelled; `beam_notices` says so.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.elements.bar import bar_forces, bending_stress
from fem.elements.beam_mass import LineMass, coupled_mass, lumped_mass
from fem.elements.beam_stiffness import SectionCompliance, beam_stiffness
from fem.elements.block import CENTRE, Detail, Float64, Kind, Recovery
from fem.elements.line_block import LineBlock
from fem.elements.line_geometry import congruence
from fem.elements.orientation import place_lines
from fem.elements.pins import condense, pin_flags
from fem.materials import Isotropic, isotropic
from fem.points import Points
from fem.tables import column, refer, table, where

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_ENDS = ("a", "b")
_FORCES = (
    "bending_moment1",
    "bending_moment2",
    "shear1",
    "shear2",
    "axial_force",
    "total_torque",
    "warping_torque",
)
_STRESSES = ("sxc", "sxd", "sxe", "sxf", "smax", "smin")
FORCE_COLUMNS = tuple(f"{name}_{end}" for end in _ENDS for name in _FORCES)
STRESS_COLUMNS = tuple(f"{name}_{end}" for end in _ENDS for name in _STRESSES)
# Prismatic: the flexibility is quadratic, the mass of degree six. With taper the
# integrand is rational; ten points per segment integrate 1:10 in depth to 1e-9.
_GAUSS_UNIFORM, _GAUSS_TAPERED = 4, 10
_VARYING = ("a", "i1", "i2", "i12", "j", "nsm")


@dataclass(frozen=True, kw_only=True)
class BeamSection:
    """Sections of e beams at q integration points and at both ends.

    Attributes:
        x, weight: (e, q) integration points as fraction of the length, weights.
        values: a i1 i2 i12 j nsm, y z (neutral axis), my mz (non-structural mass), nsi
            (its moment of inertia per length), each (e, q).
        ends: a i1 i2 i12 y z, each (e, 2).
        recovery: (e, 2, 4, 2) y and z of points C, D, E, F at both ends.
        k1, k2: (e,) shear factors, 0 for no shear flexibility.
    """

    x: Float64
    weight: Float64
    values: dict[str, Float64]
    ends: dict[str, Float64]
    recovery: Float64
    k1: Float64
    k2: Float64


@dataclass(frozen=True, kw_only=True)
class Beam(LineBlock):
    """CBEAM elements, prismatic or tapered; 12 freedoms, basic axes."""

    section: BeamSection

    property_card = "PBEAM"

    def with_nonstructural_mass(self, per_length: Float64) -> "Beam":
        """The same beams with additional mass per length (e,)."""
        nsm = self.section.values["nsm"] + per_length[:, None]
        section = replace(self.section, values={**self.section.values, "nsm": nsm})
        return replace(self, section=section)

    def _stiffness_at_ends(self) -> Float64:
        compliance = section_compliance(self.section, self.material)
        return beam_stiffness(self.geometry.length, compliance)

    def mass(self, *, coupled: bool) -> Float64:
        length = self.geometry.length
        form = coupled_mass if coupled else lumped_mass
        at_ends = sum(
            form(length, line) for line in line_masses(self.section, self.material)
        )
        if coupled:
            at_ends = condense(self.end_stiffness, self.released, at_ends)[1]
        return congruence(self._map, at_ends)

    @cached_property
    def _force_matrix(self) -> Float64:
        """(e, 12, 12), see `bar_forces`."""
        return bar_forces(self._at_ends @ self._map)

    def forces(self) -> Recovery:
        return Recovery(
            table=self.card,
            columns=FORCE_COLUMNS,
            matrix=_printed(self._force_matrix),
            id=self.id,
        )

    def stresses(self) -> Recovery:
        return BeamStress(
            table=self.card,
            columns=STRESS_COLUMNS,
            matrix=beam_stress_matrix(self.section) @ self._force_matrix,
            id=self.id,
        )

    def of_nodal_forces(self, kind: Kind, detail: Detail = CENTRE) -> Float64:
        """(e, c, 12) as `forces`, `stresses`, `strains` from forces at the grids."""
        forces = bar_forces(self.geometry.end_forces())
        if kind == "force":
            return _printed(forces)
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
        y=v["y"],
        z=v["z"],
        torsion=rho * (v["i1"] + v["i2"]),
    )
    other = LineMass(
        x=section.x,
        weight=section.weight,
        mass=v["nsm"],
        y=v["my"],
        z=v["mz"],
        torsion=v["nsi"],
    )
    return structural, other


def beam_stress_matrix(section: BeamSection) -> Float64:
    """(e, 8, 12) axial plus bending stress at four points of both ends.

    The columns are those of `bar_forces`.
    The moments of the shear centre are moved to the neutral axis first.
    """
    ends = section.ends
    matrix = np.zeros((len(section.k1), 8, 12))
    for end in (0, 1):
        a, y, z = (ends[name][:, end] for name in ("a", "y", "z"))
        at = section.recovery[:, end] - np.stack([y, z], axis=-1)[:, None, :]
        per_m1, per_m2 = bending_stress(
            *(ends[name][:, end] for name in ("i1", "i2", "i12")), at
        )
        area = np.divide(1.0, a, out=np.zeros_like(a), where=a != 0.0)
        rows = slice(4 * end, 4 * end + 4)
        matrix[:, rows, 2 * end] = per_m1
        matrix[:, rows, 2 * end + 1] = per_m2
        # M1 at the neutral axis is M1 + y N, M2 is M2 + z N.
        matrix[:, rows, 6 + 4 * end] = (
            area[:, None] + per_m1 * y[:, None] + per_m2 * z[:, None]
        )
    return matrix


def _printed(forces: Float64) -> Float64:
    """(e, 14, n) the columns of CBEAM from `bar_forces`; no warping torque."""
    none = np.zeros_like(forces[:, :1])
    ends = ([0, 1, 4, 5, 6, 7], [2, 3, 8, 9, 10, 11])
    return np.concatenate([x for end in ends for x in (forces[:, end], none)], axis=1)


def read_cbeam(deck: "Deck", points: Points) -> list[Beam]:
    """The prismatic and the tapered CBEAM block of a deck.

    Raises:
        InputError: undefined properties, materials or grids, impossible geometry.
    """
    rows = table(deck, "CBEAM").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    pbeam = refer(rows, "CBEAM", "pid", table(deck, "PBEAM"), "PBEAM")
    properties = table(deck, "PBEAM")
    prismatic = [int(p["pid"]) for _, p in properties.iterrows() if _is_uniform(p)]
    uniform = rows["pid"].isin(prismatic).to_numpy()
    return [
        _block(deck, points, rows[part], pbeam[part])
        for part in (uniform, ~uniform)
        if part.any()
    ]


def beam_notices(deck: "Deck") -> list[str]:
    """What PBEAM cards ask for and is not modelled."""
    notices = []
    for _, row in table(deck, "PBEAM").iterrows():
        if np.nan_to_num(row["cwa"]) or np.nan_to_num(row["cwb"]):
            notices.append(f"{where('PBEAM', row)}: warping (CW) is ignored")
        if np.nan_to_num(row["s1"]) or np.nan_to_num(row["s2"]):
            notices.append(f"{where('PBEAM', row)}: shear relief S1, S2 is ignored")
        if "YES" in [str(so).upper() for so in row["sos"][1:-1]]:
            notices.append(
                f"{where('PBEAM', row)}: results of CBEAM are given at both ends, not "
                "at the stations between that ask for them (SO)"
            )
    return notices


def _block(
    deck: "Deck", points: Points, rows: pd.DataFrame, pbeam: pd.DataFrame
) -> Beam:
    rows, pbeam = rows.reset_index(drop=True), pbeam.reset_index(drop=True)
    ends = points.rows(rows[["ga", "gb"]].to_numpy(np.int64))
    return Beam(
        card="CBEAM",
        id=rows["eid"].to_numpy(np.int64),
        dof=(6 * ends[:, :, None] + np.arange(6)).reshape(-1, 12),
        pid=rows["pid"].to_numpy(np.int64),
        geometry=place_lines(rows, "CBEAM", points),
        section=_sections(pbeam),
        material=isotropic(deck, pbeam, "PBEAM"),
        released=np.hstack(
            [pin_flags([str(p) for p in rows[c]]) for c in ("pa", "pb")]
        ),
    )


def _is_uniform(row: pd.Series) -> bool:
    sequences = [np.asarray(row[f"{name}s"], float) for name in _VARYING]
    offsets = [f"{p}{i}" for p in "mn" for i in (1, 2)]
    ends = [(row[f"{o}a"], row[f"{o}b"]) for o in offsets]
    ends.append((row["nsia"], row["nsib"]))
    return all(np.all(s == s[0]) for s in sequences) and all(
        np.nan_to_num(a) == np.nan_to_num(b) for a, b in ends
    )


def _sections(pbeam: pd.DataFrame) -> BeamSection:
    """Sections per element; each property is evaluated once."""
    _, first, index = np.unique(
        pbeam["pid"].to_numpy(np.int64), return_index=True, return_inverse=True
    )
    properties = [pbeam.iloc[k] for k in first]
    segments = max(len(p["xxbs"]) - 1 for p in properties)
    uniform = all(_is_uniform(p) for p in properties)
    count = _GAUSS_UNIFORM if uniform else _GAUSS_TAPERED
    points = [_integration(p, 1 if uniform else segments, count) for p in properties]
    x, weight = (np.stack([p[k] for p in points])[index] for k in (0, 1))
    values = [_values_at(p, q[0]) for p, q in zip(properties, points)]
    ends = [_values_at(p, np.array([0.0, 1.0])) for p in properties]
    return BeamSection(
        x=x,
        weight=weight,
        values={k: np.stack([v[k] for v in values])[index] for k in values[0]},
        ends={k: np.stack([v[k] for v in ends])[index] for k in ends[0]},
        recovery=np.stack([_recovery(p) for p in properties])[index],
        k1=column(pbeam, "k1"),
        k2=column(pbeam, "k2"),
    )


def _integration(row: pd.Series, segments: int, count: int) -> tuple[Float64, Float64]:
    """Gauss points and weights per segment between stations; missing ones are empty."""
    stations = np.sort(np.asarray(row["xxbs"], float))
    if segments == 1:
        stations = np.array([0.0, 1.0])
    stations = np.concatenate([stations, np.ones(segments + 1 - len(stations))])
    xi, weight = np.polynomial.legendre.leggauss(count)
    start, size = stations[:-1, None], np.diff(stations)[:, None]
    return (
        (start + size * 0.5 * (xi + 1.0)).reshape(-1),
        (size * 0.5 * weight).reshape(-1),
    )


def _values_at(row: pd.Series, x: Float64) -> dict[str, Float64]:
    """Section values by linear interpolation between the stations."""
    order = np.argsort(row["xxbs"])
    stations = np.asarray(row["xxbs"], float)[order]

    def between_stations(values: Sequence[float]) -> Float64:
        return np.interp(x, stations, np.nan_to_num(np.asarray(values, float)[order]))

    def between_ends(a: float, b: float) -> Float64:
        return np.interp(x, [0.0, 1.0], np.nan_to_num([a, b]))

    values = {name: between_stations(row[f"{name}s"]) for name in _VARYING}
    pairs = {"y": "n1", "z": "n2", "my": "m1", "mz": "m2", "nsi": "nsi"}
    for name, field in pairs.items():
        values[name] = between_ends(row[f"{field}a"], row[f"{field}b"])
    return values


def _recovery(row: pd.Series) -> Float64:
    """(2, 4, 2) stress points of both ends."""
    order = np.argsort(row["xxbs"])
    table_ = [
        [np.asarray(row[f"{p}{i}s"], float)[order] for i in (1, 2)] for p in "cdef"
    ]
    points = np.nan_to_num(np.asarray(table_))
    return points[:, :, [0, -1]].transpose(2, 0, 1)

"""CROD, CONROD and CTUBE: axial and torsional springs along a line."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.records.lines import ROD
from fem.deck.references import column, refer, table, where
from fem.elements.block import Recovery
from fem.elements.dense import DenseBlock, some
from fem.elements.nonstructural_mass import MassInSection
from fem.elements.preload import tension_across
from fem.errors import InputError
from fem.geometry.points import Points, grid_freedoms
from fem.properties.materials import Isotropic, isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class RodSection:
    """Section values per element, units of the deck.

    Attributes:
        a, j: (e,) area and torsion constant.
        c: (e,) lever of the torsional stress, stress = T c / J.
        nsm: (e,) non-structural mass per length.
    """

    a: Float64
    j: Float64
    c: Float64
    nsm: Float64


@dataclass(frozen=True, kw_only=True)
class Rod(MassInSection, DenseBlock):
    """All CROD, CONROD or CTUBE elements; 12 freedoms, basic axes.

    Attributes:
        axis: (e, 3) unit vectors from the first to the second grid.
        length: (e,).
    """

    pid: Int64
    property_card: str
    axis: Float64
    length: Float64
    section: RodSection
    material: Isotropic

    @property
    def extent(self) -> Float64:
        """(e,) length."""
        return self.length

    def stiffness(self) -> Float64:
        """(e, 12, 12) of an axial and a torsional spring."""
        axial = self.material.e * self.section.a / self.length
        torsional = self.material.g * self.section.j / self.length
        return line_springs(self.axis, axial, torsional)

    def differential_stiffness(
        self, motion: Float64, load: Float64 | None = None
    ) -> Float64:
        """(e, 12, 12) of the axial force, across the axis."""
        stretch = np.einsum("ei,ei->e", self.axis, motion[:, 6:9] - motion[:, :3])
        force = self.material.e * self.section.a * stretch / self.length
        matrix = np.zeros((len(force), 12, 12))
        moves = np.array([0, 1, 2, 6, 7, 8])
        matrix[:, moves[:, None], moves] = tension_across(
            self.axis, force / self.length
        )
        return matrix

    def structural_damping(self) -> Float64 | None:
        """(e,) GE of the material."""
        return some(self.material.ge)

    def mass(self, *, coupled: bool) -> Float64:
        """Translations only; coupled: 5/12 and 1/12 along the axis, see `beam_mass`."""
        per_length = self.material.rho * self.section.a + self.section.nsm
        total = per_length * self.length
        matrix = np.zeros((len(total), 12, 12))
        for i in (0, 1, 2, 6, 7, 8):
            matrix[:, i, i] = 0.5 * total
        if coupled:
            along = self.axis[:, :, None] * self.axis[:, None, :]
            part = (total / 12.0)[:, None, None] * along
            matrix[:, :3, :3] -= part
            matrix[:, 6:9, 6:9] -= part
            matrix[:, :3, 6:9] += part
            matrix[:, 6:9, :3] += part
        return matrix

    @property
    def tref(self) -> Float64:
        """(e,) temperature without strain."""
        return self.material.tref

    def expansion(self) -> Float64:
        """(e, 12), see `DenseBlock`."""
        return stretched(self.axis, self.material.alpha * self.length)

    def forces(self) -> Recovery:
        """Axial force and torque."""
        return Recovery(
            table=self.card,
            columns=ROD,
            matrix=self._resultants(
                self.material.e * self.section.a, self.material.g * self.section.j
            ),
            id=self.id,
        )

    def stresses(self) -> Recovery:
        """Axial stress, and shear stress at the lever C."""
        return Recovery(
            table=self.card,
            columns=ROD,
            matrix=self._resultants(
                np.where(self.section.a != 0.0, self.material.e, 0.0),
                np.where(self.section.j != 0.0, self.material.g, 0.0) * self.section.c,
            ),
            id=self.id,
        )

    def strains(self) -> Recovery:
        """Stretch, and shear strain at the lever of the torsional stress."""
        return Recovery(
            table=self.card,
            columns=ROD,
            matrix=self._resultants(np.ones_like(self.length), self.section.c),
            id=self.id,
        )

    def _resultants(self, per_strain: Float64, per_twist: Float64) -> Float64:
        """(e, 2, 12) multiples of the axial strain and of the rate of twist."""
        matrix = np.zeros((len(self.length), 2, 12))
        for row, factor in enumerate((per_strain, per_twist)):
            gradient = (factor / self.length)[:, None] * self.axis
            matrix[:, row, 3 * row : 3 * row + 3] = -gradient
            matrix[:, row, 6 + 3 * row : 9 + 3 * row] = gradient
        return matrix


def stretched(axis: Float64, by: Float64) -> Float64:
    """(e, 12) displacements of the ends of lines that are longer by (e,)."""
    found = np.zeros((len(by), 12))
    found[:, 6:9] = 0.5 * by[:, None] * axis
    found[:, 0:3] = -found[:, 6:9]
    return found


def line_springs(axis: Float64, axial: Float64, torsional: Float64) -> Float64:
    """(e, 12, 12) matrix of an axial and a torsional spring along unit axes (e, 3)."""
    along = axis[:, :, None] * axis[:, None, :]
    matrix = np.zeros((len(axis), 12, 12))
    for k, value in ((0, axial), (3, torsional)):
        part = value[:, None, None] * along
        matrix[:, k : k + 3, k : k + 3] = part
        matrix[:, k + 6 : k + 9, k + 6 : k + 9] = part
        matrix[:, k : k + 3, k + 6 : k + 9] = -part
        matrix[:, k + 6 : k + 9, k : k + 3] = -part
    return matrix


def read_crod(deck: "Deck", points: Points) -> list[Rod]:
    """The CROD and the CONROD block of a deck, as far as it has such elements.

    Raises:
        InputError: undefined references, elements without length.
    """
    rows = table(deck, "CROD").sort_values("eid", ignore_index=True)
    own = (rows["pid"].to_numpy() == 0) if len(rows) else np.zeros(0, bool)
    blocks = []
    for card, part in (("CROD", rows[~own]), ("CONROD", rows[own])):
        if part.empty:
            continue
        part = part.reset_index(drop=True)
        values = part
        if card == "CROD":
            values = refer(part, card, "pid", table(deck, "PROD"), "PROD")
        section = RodSection(**{k: column(values, k) for k in ("a", "j", "c", "nsm")})
        source = "PROD" if card == "CROD" else card
        blocks.append(
            _rods(card, source, part, section, isotropic(deck, values, source), points)
        )
    return blocks


def read_ctube(deck: "Deck", points: Points) -> list[Rod]:
    """The CTUBE block of a deck, or none.

    A blank thickness or one of half the diameter is a solid rod; a second outer
    diameter makes a tapered tube, taken with its mean section as Nastran does.

    Raises:
        InputError: undefined references, impossible wall, elements without length.
    """
    rows = table(deck, "CTUBE").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    tube = refer(rows, "CTUBE", "pid", table(deck, "PTUBE"), "PTUBE")
    outer, wall = column(tube, "od1"), column(tube, "t")
    second = column(tube, "od2")
    outer = np.where(second > 0.0, 0.5 * (outer + second), outer)
    thick = np.flatnonzero((2.0 * wall > outer * (1 + 1e-9)) | (outer <= 0.0))
    if thick.size:
        raise InputError(
            f"{where('PTUBE', tube.iloc[i])}: OD {outer[i]:g} and T {wall[i]:g} "
            "do not make a tube, expected 0 <= T <= OD/2"
            for i in thick
        )
    section = tube_section(outer, wall, column(tube, "nsm"))
    material = isotropic(deck, tube, "PTUBE")
    return [_rods("CTUBE", "PTUBE", rows, section, material, points)]


def tube_section(outer: Float64, wall: Float64, nsm: Float64) -> RodSection:
    """Section of circular tubes from outer diameter and wall (0: solid)."""
    inner = np.where(wall > 0.0, np.maximum(outer - 2.0 * wall, 0.0), 0.0)
    return RodSection(
        a=0.25 * np.pi * (outer**2 - inner**2),
        j=np.pi / 32.0 * (outer**4 - inner**4),
        c=0.5 * outer,
        nsm=nsm,
    )


def _rods(
    card: str,
    property_card: str,
    rows: pd.DataFrame,
    section: RodSection,
    material: Isotropic,
    points: Points,
) -> Rod:
    ends = points.rows(rows[["g1", "g2"]].to_numpy(np.int64))
    axis, length = unit_axes(
        rows, card, points.xyz[ends[:, 1]] - points.xyz[ends[:, 0]]
    )
    return Rod(
        card=card,
        id=rows["eid"].to_numpy(np.int64),
        dof=grid_freedoms(ends),
        pid=rows["pid"].to_numpy(np.int64),
        property_card=property_card,
        axis=axis,
        length=length,
        section=section,
        material=material,
    )


def unit_axes(
    rows: pd.DataFrame, card: str, between: Float64
) -> tuple[Float64, Float64]:
    """Unit vectors (e, 3) and lengths (e,) of lines.

    Raises:
        InputError: elements of zero length, all.
    """
    length = np.linalg.norm(between, axis=1)
    short = np.flatnonzero(length == 0.0)
    if short.size:
        raise InputError(
            f"{where(card, rows.iloc[i])}: its ends coincide, the element has no length"
            for i in short
        )
    return between / length[:, None], length

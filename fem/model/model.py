"""`Model`: what a deck describes on the g-set, before anything holds it.

Subcases may choose non-structural mass, matrices of direct input and combinations of
masses; those that choose alike share one model, those that differ in MASSSET alone all
but the mass.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.arrays import Int64
from fem.constraints.sets import freedoms_of
from fem.elements.quality import quality_table
from fem.elements.registry import read_elements
from fem.geometry.points import Points
from fem.model.assembly import Matrices, assemble
from fem.model.damping import damping_in_transients, inactive_damping
from fem.model.direct_input import DirectMatrices, read_direct
from fem.model.mass_sets import combined_mass
from fem.model.points import read_points
from fem.model.weight import Weight, weigh

if TYPE_CHECKING:
    from fem.deck.control.subcase import Subcase
    from fem.deck.deck import Deck
    from fem.elements.block import ElementBlock


@dataclass(frozen=True)
class ModelChoice:
    """What a subcase chooses of the model; names as in `Subcase`."""

    nsm: int
    k2gg: str
    m2gg: str
    b2gg: str
    massset: int

    @classmethod
    def from_subcase(cls, subcase: Subcase) -> ModelChoice:
        """The choice of a subcase."""
        return cls(*(getattr(subcase, item.name) for item in fields(cls)))


class Model:
    """Points, elements and matrices of the g-set; computed when first asked for.

    Args:
        deck: the deck.
        choice: what the subcases choose.
        points: of the same deck, where they are known.
        base: the same model without MASSSET, where it is known.

    Attributes:
        deck, choice: as given.
        points: grids and scalar points, numbering of the g-set.
        base: the model without MASSSET; itself, where none is chosen.
    """

    def __init__(
        self,
        deck: Deck,
        choice: ModelChoice,
        points: Points | None = None,
        base: Model | None = None,
    ) -> None:
        self.deck, self.choice = deck, choice
        self.points = read_points(deck) if points is None else points
        self.base = self
        if choice.massset:
            self.base = base or Model(deck, replace(choice, massset=0), self.points)

    def under(self, subcase: Subcase) -> Model:
        """The model under another subcase: itself, where that chooses alike."""
        choice = ModelChoice.from_subcase(subcase)
        if choice == self.choice:
            return self
        if replace(choice, massset=0) != self.base.choice:
            return Model(self.deck, choice, self.points)
        if not choice.massset:
            return self.base
        return Model(self.deck, choice, self.points, self.base)

    @cached_property
    def blocks(self) -> list[ElementBlock]:
        """All elements.

        Raises:
            InputError: whatever is wrong with any of them.
        """
        if self.base is not self:
            return self.base.blocks
        return read_elements(self.deck, self.points, nsm=self.choice.nsm)

    @cached_property
    def direct(self) -> DirectMatrices:
        """Matrices of direct input."""
        if self.base is not self:
            return self.base.direct
        c = self.choice
        return read_direct(
            self.deck, self.points, k2gg=c.k2gg, m2gg=c.m2gg, b2gg=c.b2gg
        )

    @cached_property
    def matrices(self) -> Matrices:
        """K, M, B and K4 of the g-set."""
        if self.base is not self:
            own = self.base.matrices
            mass = combined_mass(self.deck, self.points, own.mass, self.choice.massset)
            return replace(own, mass=mass)
        number = self.deck.number
        return assemble(
            self.points,
            self.blocks,
            coupled=number("COUPMASS") > 0,
            wtmass=number("WTMASS"),
            direct=self.direct,
            factors=(number("CK1"), number("CM1"), number("CB1")),
        )

    @cached_property
    def loaded_mass(self) -> sp.csr_matrix:
        """(g, g) mass on which GRAV, ACCEL and RFORCE act: not external ones."""
        external = self.direct.external_mass
        mass = self.matrices.mass
        return mass if external is None else sp.csr_matrix(mass - external)

    @cached_property
    def damping(self) -> Damping:
        """B = B1 + (G/W3 + ALPHA2) K + ALPHA1 M + K4/W4 of the g-set, in transients."""
        return damping_in_transients(self.deck, self.matrices)

    @cached_property
    def damping_notices(self) -> list[str]:
        """Damping that the deck gives and that a transient does not use."""
        return inactive_damping(self.deck, self.matrices)

    @cached_property
    def weight(self) -> Weight:
        """Nastran's weight table (PARAM GRDPNT: reference grid), without PARAM WTMASS.

        In the units that the deck gives masses or weights in; see `rigid_mass`.
        """
        grid = int(self.deck.number("GRDPNT"))
        reference = self.points.xyz[self.points.rows(grid)] if grid > 0 else np.zeros(3)
        return weigh(
            self.points,
            self.matrices.mass,
            reference=reference,
            wtmass=self.deck.number("WTMASS") or 1.0,  # 0 leaves no mass to divide
        )

    @cached_property
    def rigid_mass(self) -> Weight:
        """Mass, center of gravity and inertia that the dynamics have.

        As `weight`, but about the origin and with PARAM WTMASS in it: what a deck that
        gives weights moves like.
        """
        return weigh(self.points, self.matrices.mass)

    @cached_property
    def quality(self) -> pd.DataFrame:
        """Worst shapes of surface and solid elements, see `quality_table`."""
        return quality_table(self.blocks)

    @cached_property
    def generalised_dof(self) -> Int64:
        """(q,) rows of the g-set that QSET reserves for generalised coordinates."""
        return freedoms_of(self.deck, self.points, "QSET")

    @cached_property
    def omitted_dof(self) -> Int64:
        """(o,) rows of the g-set that OMIT takes out of a reduction; none with ASET."""
        if not self.deck.cards["ASET"].empty:
            return np.zeros(0, np.int64)
        return freedoms_of(self.deck, self.points, "OMIT")

    @cached_property
    def kept_dof(self) -> Int64:
        """(a,) rows of the g-set that ASET keeps in a reduction, without the q-set."""
        rows = freedoms_of(self.deck, self.points, "ASET")
        return np.setdiff1d(rows, self.generalised_dof)

    @cached_property
    def support_dof(self) -> Int64:
        """(r,) rows of the g-set that SUPORT names."""
        return freedoms_of(self.deck, self.points, "SUPORT")

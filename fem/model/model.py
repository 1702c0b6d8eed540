"""`Model`: what a deck describes on the g-set, before anything holds it.

Subcases may choose non-structural mass and matrices of direct input; those that choose
alike share one model.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.algebra.damping import Damping
from fem.arrays import Int64
from fem.constraints.sets import freedoms_of
from fem.elements.quality import quality_table
from fem.elements.registry import read_elements
from fem.geometry.points import Points
from fem.model.assembly import Matrices, assemble
from fem.model.damping import damping_in_transients, inactive_damping
from fem.model.direct_input import DirectMatrices, read_direct
from fem.model.points import read_points
from fem.model.weight import Weight, weigh

if TYPE_CHECKING:
    from fem.deck.case_control import Subcase
    from fem.deck.deck import Deck
    from fem.elements.block import ElementBlock


@dataclass(frozen=True)
class ModelChoice:
    """What a subcase chooses of the model; names as in `Subcase`."""

    nsm: int
    k2gg: str
    m2gg: str
    b2gg: str

    @classmethod
    def of(cls, subcase: Subcase) -> ModelChoice:
        """Of a subcase."""
        return cls(*(getattr(subcase, item.name) for item in fields(cls)))


class Model:
    """Points, elements and matrices of the g-set; computed when first asked for.

    Args:
        deck: the deck.
        choice: what the subcases choose.
        points: of the same deck, where they are known.

    Attributes:
        deck, choice: as given.
        points: grids and scalar points, numbering of the g-set.
    """

    def __init__(
        self, deck: Deck, choice: ModelChoice, points: Points | None = None
    ) -> None:
        self.deck, self.choice = deck, choice
        self.points = read_points(deck) if points is None else points

    def under(self, subcase: Subcase) -> Model:
        """The model under another subcase: itself, where that chooses alike."""
        choice = ModelChoice.of(subcase)
        return self if choice == self.choice else Model(self.deck, choice, self.points)

    @cached_property
    def blocks(self) -> list[ElementBlock]:
        """All elements.

        Raises:
            InputError: whatever is wrong with any of them.
        """
        return read_elements(self.deck, self.points, nsm=self.choice.nsm)

    @cached_property
    def direct(self) -> DirectMatrices:
        """Matrices of direct input."""
        c = self.choice
        return read_direct(
            self.deck, self.points, k2gg=c.k2gg, m2gg=c.m2gg, b2gg=c.b2gg
        )

    @cached_property
    def matrices(self) -> Matrices:
        """K, M, B and K4 of the g-set."""
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
        """Mass, centre of gravity and inertia that the dynamics have.

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

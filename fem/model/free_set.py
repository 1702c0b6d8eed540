"""`FreeSet`: what is left of a model when its constraints are eliminated.

Subcases with the same SPC and MPC sets share one.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.algebra.extension import CondensedProduct
from fem.arrays import Float64, Int64
from fem.constraints.autospc import grouped
from fem.constraints.support import Support, support
from fem.elements.quality import quality_notices
from fem.elements.registry import element_notices
from fem.model.connected_pieces import describe_pieces, unconnected_pieces
from fem.model.mass_sets import combination_story
from fem.model.model import Model
from fem.model.points import axis_notices
from fem.model.weight import rigid_modes

if TYPE_CHECKING:
    from fem.deck.control.subcase import Subcase


_WITHOUT_MOTION = (101, 105)


@dataclass(frozen=True)
class ConstraintChoice:
    """Sets of constraints that a subcase chooses; names as in `Subcase`."""

    spc: int
    mpc: int

    @classmethod
    def from_subcase(cls, subcase: Subcase) -> ConstraintChoice:
        """The choice of a subcase."""
        return cls(*(getattr(subcase, item.name) for item in fields(cls)))


class FreeSet:
    """A model held by constraints: matrices of the f-set, computed when asked for.

    Args:
        model: the model.
        choice: the constraints.
        like: of the same constraints and stiffness, where it is known.
    """

    def __init__(
        self, model: Model, choice: ConstraintChoice, like: FreeSet | None = None
    ) -> None:
        self.model, self.choice = model, choice
        self._like = like

    def under(self, subcase: Subcase) -> FreeSet:
        """The free set under another subcase: itself, where that chooses alike."""
        model, choice = (
            self.model.under(subcase),
            ConstraintChoice.from_subcase(subcase),
        )
        if choice != self.choice:
            return FreeSet(model, choice)
        if model is self.model:
            return self
        return FreeSet(model, choice, self if model.base is self.model.base else None)

    def holding(self, rows: Int64, motions: Float64) -> FreeSet:
        """Copy with some freedoms at zero, which stops motions of no consequence.

        Args:
            rows: (r,) positions in the f-set.
            motions: (f, r) without stiffness and mass, independent on these rows.
        """
        own = self.support
        keep = np.setdiff1d(np.arange(len(own.elimination.f)), rows)
        held = FreeSet(self.model, self.choice)
        held.support = replace(
            own,
            elimination=own.elimination.with_fixed(own.elimination.f[rows]),
            stiffness=sp.csr_matrix(own.stiffness[keep][:, keep]),
        )
        along = np.linalg.solve(motions[rows], self.rigid_body[rows])
        held.rigid_body = (self.rigid_body - motions @ along)[keep]
        return held

    @cached_property
    def support(self) -> Support:
        """Constraints, AUTOSPC included, and (f, f) K."""
        if self._like is not None:
            return self._like.support
        return support(
            self.model.deck,
            self.model.points,
            self.model.matrices.stiffness,
            spc=self.choice.spc,
            mpc=self.choice.mpc,
            generalised=self.model.generalised_dof,
            moving=self._moving(),
        )

    def _moving(self) -> list[sp.csr_matrix]:
        """Mass and damping, where the deck's solution has them."""
        if self.model.deck.sol in _WITHOUT_MOTION:
            return []
        found, damping = self.model.matrices, self.model.damping
        other = [] if damping.other is None else [sp.csr_matrix(damping.other)]
        return [found.mass, *other]

    @cached_property
    def mass(self) -> sp.csr_matrix:
        """(f, f) M."""
        return self.support.elimination.reduce(self.model.matrices.mass)

    @cached_property
    def mass_product(self) -> CondensedProduct:
        """Products with M, by its factors."""
        T = self.support.elimination.T
        return CondensedProduct.from_matrix(self.model.matrices.mass, T)

    @cached_property
    def damping(self) -> Damping:
        """(f, f) B with its proportional part apart, see `Model.damping`."""
        whole = self.model.damping
        if whole.other is None:
            return whole
        return replace(whole, other=self.support.elimination.reduce(whole.other))

    @cached_property
    def rigid_body(self) -> Float64:
        """(f, 6) motions of the free set as a rigid body about the center of gravity.

        Motions that constraints prevent cost energy; `normal_modes` sorts them out.
        """
        motions = rigid_modes(self.model.points, self.model.rigid_mass.center)
        return motions[self.support.elimination.f]

    @cached_property
    def pieces(self) -> list[Int64]:
        """Points of each piece of the model that nothing connects to the others."""
        model, e, direct = self.model, self.support.elimination, self.model.direct
        couplings = [direct.stiffness]
        if model.deck.sol not in _WITHOUT_MOTION:
            couplings += [direct.mass, direct.damping]
        return unconnected_pieces(
            model.points, model.blocks, e.dependence, e.m, couplings
        )

    @cached_property
    def notices(self) -> list[str]:
        """Remarks on this model that the user should read."""
        deck, autospc = self.model.deck, self.support.autospc
        lines = [
            *deck.notices,
            *axis_notices(deck, self.model.points),
            *element_notices(deck, self.model.points),
            *quality_notices(self.model.blocks),
            *describe_pieces(self.pieces),
        ]
        if self.model.choice.massset:
            lines.append(combination_story(deck, self.model.choice.massset))
        inert = self.support.inert
        if len(inert):
            names = grouped([self.model.points.label(int(d)) for d in inert], 8)
            lines.append(
                f"{len(inert)} freedoms without any stiffness or mass are held "
                f"(AUTOSPC is off): {names}"
            )
        if autospc is not None and len(autospc.dof):
            lines.append(f"AUTOSPC constrained {autospc.summary(self.model.points)}")
        return lines

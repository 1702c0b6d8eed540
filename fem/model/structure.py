"""`Structure`: a deck and one of its subcases, put together for the solutions.

The deck's part is a `Model`, that of the constraints a `FreeSet`; subcases that agree
share them. Everything is computed when it is first asked for, and kept. The matrices on
the free set (f) are plain scipy.sparse matrices, so that any function of `fem` that
works on matrices works on a structure, on parts of it, or on somebody else's matrices.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeVar

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp
from scipy.linalg import qr

from fem.algebra.damping import Damping
from fem.algebra.extension import CondensedProduct
from fem.algebra.linear_solver import SingularMatrixError
from fem.arrays import Float64, Int64
from fem.constraints.autospc import Singularities, grouped
from fem.constraints.elimination import Elimination
from fem.constraints.sets import freedoms_of
from fem.errors import InputError
from fem.geometry.points import Points
from fem.model.assembly import Matrices
from fem.model.dynamic_input import DynamicInput, read_dynamic_input
from fem.model.free_set import ConstraintChoice, FreeSet
from fem.model.mechanisms import Mechanism, describe, find_mechanisms
from fem.model.model import Model, ModelChoice
from fem.model.weight import Weight

if TYPE_CHECKING:
    from fem.algebra.linear_solver import SolverName
    from fem.deck.control.subcase import Subcase
    from fem.deck.deck import Deck
    from fem.elements.block import ElementBlock

Answer = TypeVar("Answer")


class Structure:
    """A finite-element model with the constraints of one subcase.

    Args:
        deck: the deck.
        subcase: its subcase; None: the first.
        free: its free set, where it is known.

    Attributes:
        subcase: as given.
    """

    def __init__(
        self, deck: Deck, subcase: Subcase | None = None, *, free: FreeSet | None = None
    ) -> None:
        self.subcase = subcase if subcase is not None else deck.case_control[0]
        if free is None:
            model = Model(deck, ModelChoice.from_subcase(self.subcase))
            free = FreeSet(model, ConstraintChoice.from_subcase(self.subcase))
        self._free = free

    @classmethod
    def from_deck(cls, deck: Deck, subcase: int | None = None) -> Structure:
        """Structure of a deck with the constraints of a subcase.

        Args:
            deck: from `fem.read_deck`.
            subcase: its id; None: the first.

        Raises:
            InputError: no such subcase, or coordinate systems that cannot be placed.
        """
        return cls(deck, None if subcase is None else deck.subcase(subcase))

    def with_subcase(self, subcase: Subcase) -> Structure:
        """Copy under another subcase; what does not change is shared."""
        return Structure(self.deck, subcase, free=self._free.under(subcase))

    def without_massless_motions(self) -> tuple[Structure, list[str]]:
        """The structure with motions that have neither stiffness nor mass held.

        They take no part in any vibration, whatever PARAM,AUTOSPC says.

        Returns:
            The structure, and a notice that names the freedoms; itself and none, where
            there are no such motions.
        """
        found = self.mechanisms(dynamic=True)
        if not found:
            return self, []
        motions = np.concatenate([m.motions for m in found], axis=1)
        count = motions.shape[1]
        pivots = qr(motions.T, mode="r", pivoting=True)[-1]
        rows = np.sort(np.asarray(pivots, np.int64)[:count])
        free = self._free.holding(rows, motions)
        names = grouped([self.label(int(row)) for row in rows], 8)
        text = f"{count} motion{'s' if count > 1 else ''} without stiffness and mass"
        return (
            Structure(self.deck, self.subcase, free=free),
            [f"{text} held at {names}"],
        )

    # -- the model ------------------------------------------------------------------

    @property
    def model(self) -> Model:
        """The part that subcases of the same mass and matrices share."""
        return self._free.model

    @property
    def deck(self) -> Deck:
        """The deck."""
        return self.model.deck

    @property
    def points(self) -> Points:
        """Grids and scalar points, numbering of the g-set."""
        return self.model.points

    @property
    def blocks(self) -> list[ElementBlock]:
        """All elements, see `Model`."""
        return self.model.blocks

    @property
    def matrices(self) -> Matrices:
        """K, M, B and K4 of the g-set."""
        return self.model.matrices

    @cached_property
    def dynamic_input(self) -> DynamicInput | None:
        """Matrices of K2PP, M2PP, B2PP and TFL of the subcase; None: none."""
        return read_dynamic_input(self.deck, self.points, self.subcase)

    @property
    def loaded_mass(self) -> sp.csr_matrix:
        """Mass on which inertial loads act, see `Model`."""
        return self.model.loaded_mass

    @property
    def weight(self) -> Weight:
        """Nastran's weight table, see `Model`."""
        return self.model.weight

    @property
    def rigid_mass(self) -> Weight:
        """Mass, center of gravity and inertia that the dynamics have, see `Model`."""
        return self.model.rigid_mass

    @property
    def analysis_dof(self) -> Int64:
        """(a,) rows of the g-set that a reduction keeps, without the q-set.

        Those of ASET; with OMIT alone, all free ones that it does not name.
        """
        omitted = self.model.omitted_dof
        if not len(omitted):
            return self.model.kept_dof
        self.free_rows(omitted, "OMIT")
        rest = np.setdiff1d(self.elimination.f, omitted)
        return np.setdiff1d(rest, self.generalised_dof)

    @property
    def generalised_dof(self) -> Int64:
        """(q,) rows of the g-set that QSET reserves for generalised coordinates."""
        return self.model.generalised_dof

    @property
    def support_dof(self) -> Int64:
        """(r,) rows of the g-set that SUPORT names, and SUPORT1 of the subcase."""
        chosen = self.subcase.suport1
        if not chosen:
            return self.model.support_dof
        own = freedoms_of(self.deck, self.points, "SUPORT1", chosen)
        return np.union1d(self.model.support_dof, own)

    @property
    def damping_g(self) -> Damping:
        """B of the g-set in transients, see `Model`."""
        return self.model.damping

    # -- constraints ----------------------------------------------------------------

    @property
    def elimination(self) -> Elimination:
        """Constraints of the subcase, AUTOSPC included: u_g = T u_f + u_0."""
        return self._free.support.elimination

    @property
    def autospc(self) -> Singularities | None:
        """Freedoms that AUTOSPC constrained; None where it is switched off."""
        return self._free.support.autospc

    def free_rows(self, dof: npt.ArrayLike, card: str) -> Int64:
        """Positions of rows of the g-set in the f-set.

        Raises:
            InputError: rows that are constrained or dependent; `card` names their set.
        """
        dof = np.asarray(dof, dtype=np.int64)
        f = self.elimination.f
        at = np.searchsorted(f, dof)
        at_safe = np.minimum(at, max(len(f) - 1, 0))
        bad = (
            (at >= len(f)) | (f[at_safe] != dof) if len(f) else np.ones(len(dof), bool)
        )
        if bad.any():
            raise InputError(
                f"{card} names {self.points.label(int(d))}, which is constrained or "
                "dependent; expected a free one"
                for d in dof[bad][:20]
            )
        return at

    # -- matrices of the free set -----------------------------------------------------

    @property
    def stiffness(self) -> sp.csr_matrix:
        """(f, f) K."""
        return self._free.support.stiffness

    @property
    def mass(self) -> sp.csr_matrix:
        """(f, f) M."""
        return self._free.mass

    @property
    def mass_product(self) -> CondensedProduct:
        """Products with M that do not suffer from what constraints fill."""
        return self._free.mass_product

    @property
    def damping(self) -> Damping:
        """(f, f) B with its proportional part apart, see `damping_g`."""
        return self._free.damping

    @property
    def rigid_body(self) -> Float64:
        """(f, 6) motions as a rigid body about the center of gravity, see `FreeSet`."""
        return self._free.rigid_body

    # -- between the sets -------------------------------------------------------------

    @property
    def size(self) -> int:
        """Number f of free freedoms."""
        return len(self.elimination.f)

    def displacement(self, u_f: Float64) -> Float64:
        """(g,) or (g, k) displacements in displacement frames from those of the f-set.

        Enforced displacements of the subcase are included.
        """
        u_g = self.elimination.T @ u_f
        u_0 = self.elimination.u_0
        return u_g + (u_0 if u_g.ndim == 1 else u_0[:, None])

    def shape(self, u_f: Float64) -> Float64:
        """Displacements as `displacement`, without enforced ones: modes, velocities."""
        return self.elimination.T @ u_f

    def load(self, p_g: Float64 | sp.spmatrix | sp.sparray) -> sp.csr_matrix | Float64:
        """Loads on the f-set from loads on the g-set, Tᵀ P; sparse stays sparse."""
        return self.elimination.T.T @ p_g

    def operator(
        self,
        grid_ids: npt.ArrayLike,
        components: Sequence[int] = (1, 2, 3, 4, 5, 6),
        *,
        frame: Literal["displacement", "basic"] = "displacement",
    ) -> sp.csr_matrix:
        """Rows that give displacements of grids from u_f.

        Args:
            grid_ids: (k,) grids.
            components: (c,) of 1 to 6, the same for all.
            frame: axes of the displacements: each grid's CD, or the basic frame.

        Returns:
            (k c, f), grid by grid; its transpose turns forces at the grids into loads.
        """
        ids = np.atleast_1d(np.asarray(grid_ids, dtype=np.int64))
        dof = self.points.dof(ids[:, None], np.asarray(components)[None, :]).reshape(-1)
        if frame == "displacement":
            return sp.csr_matrix(self.elimination.T[dof])
        rows = sp.csr_matrix(self.points.basic_rotation()[dof])
        return sp.csr_matrix(rows @ self.elimination.T)

    # -- messages ---------------------------------------------------------------------

    @property
    def notices(self) -> list[str]:
        """Remarks on this model that the user should read."""
        return self._free.notices

    @property
    def quality(self) -> pd.DataFrame:
        """Worst shapes of surface and solid elements, see `quality_table`."""
        return self.model.quality

    @property
    def pieces(self) -> list[Int64]:
        """Points of each piece of the model that nothing connects to the others."""
        return self._free.pieces

    @property
    def damping_notices(self) -> list[str]:
        """Damping that the deck gives and that a transient does not use."""
        return self.model.damping_notices

    def label(self, row: int) -> str:
        """Name of a row of the f-set: "grid 12 T3"."""
        return self.points.label(int(self.elimination.f[row]))

    def singular_message(
        self, *, dynamic: bool = False, solver: SolverName | None = None
    ) -> list[str]:
        """Lines that name what moves without stiffness; empty where nothing does.

        Args:
            dynamic: leave out motions that move mass.
            solver: as in `fem.algebra.linear_solver.factorize`.
        """
        found = self.mechanisms(dynamic=dynamic, solver=solver)
        return describe(found, self.label, dynamic=dynamic)

    def mechanisms(
        self, *, dynamic: bool = False, solver: SolverName | None = None
    ) -> list[Mechanism]:
        """Motions of the free set without stiffness, rigid-body motions included.

        Args:
            dynamic: leave out motions that move mass.
            solver: as in `fem.algebra.linear_solver.factorize`.
        """
        f, grids = self.elimination.f, 6 * len(self.points.grid_id)
        return find_mechanisms(
            self.stiffness,
            solver=solver,
            mass=self.mass if dynamic else None,
            point=np.where(f < grids, f // 6, f),
        )

    def guarded(
        self,
        function: Callable[[], Answer],
        *,
        dynamic: bool,
        error: type[Exception] | tuple[type[Exception], ...],
    ) -> Answer:
        """Call a solution; its numerical failure becomes an error that names grids.

        Raises:
            InputError: `function` raised `error`; the message names what moves freely.
        """
        try:
            return function()
        except error as caught:
            lines = self.singular_message(dynamic=dynamic)
            if not lines:
                if not isinstance(caught, SingularMatrixError):
                    raise InputError(f"{self.deck.path}: {caught}") from None
                row = getattr(caught, "row", None)
                at = "" if row is None else f" at {self.label(row)}"
                lines = [f"the stiffness is not positive definite{at}: {caught}"]
            raise InputError(
                [f"{self.deck.path}: the structure is singular", *lines]
            ) from None


def system_of(subcase: Subcase) -> tuple[ModelChoice, ConstraintChoice]:
    """Choices that decide the matrices of a subcase; subcases with equal ones share."""
    return ModelChoice.from_subcase(subcase), ConstraintChoice.from_subcase(subcase)

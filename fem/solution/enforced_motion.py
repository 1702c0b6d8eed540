"""Harmonic motion of constrained freedoms as a load on the free ones.

With u = T u_f + Ψ s(f), where Ψ moves the constrained freedoms and whatever goes along,

    Tᵀ Z T u_f = Tᵀ (P - Z Ψ s),  Z = -ω² M + iω B + (1 + iG) K + i K4.

Directly, Ψ leaves the free freedoms at rest. In modes, Ψ is the static response to the
motion: what modes with held constraints are slow to represent is in it, and u_f is the
motion relative to it.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.linear_solver import SolverName
from fem.algebra.modes import Modes
from fem.errors import InputError
from fem.loads.harmonic import HarmonicExcitation
from fem.model.structure import Structure
from fem.response.modal import static_response
from fem.solution.analysis_model import AnalysisModel

Complex128 = npt.NDArray[np.complex128]


@dataclass(frozen=True, kw_only=True)
class BaseMotion:
    """Motions Ψ s(f) of a model.

    Attributes:
        shape: (g, m) sparse, Ψ.
        factor: (m, f) s, displacements.
    """

    shape: sp.csr_matrix
    factor: Complex128

    @property
    def displacement(self) -> Complex128:
        """(f, g)."""
        return (self.shape @ self.factor).T

    def carried(
        self,
        model: Structure,
        reduced: AnalysisModel,
        modes: Modes,
        *,
        solver: SolverName | None = None,
    ) -> "BaseMotion":
        """Copy with the static response of the free freedoms in Ψ."""
        shape = carried_shape(self.shape, model, reduced, modes, solver=solver)
        return BaseMotion(shape=shape, factor=self.factor)

    def inertia(self, model: Structure, reduced: AnalysisModel) -> sp.csr_matrix:
        """(n, m) patterns of the loads that inertia of the motion is."""
        return reduced.load(sp.csr_matrix(model.matrices.mass @ self.shape))


def base_motion(model: Structure, excitation: HarmonicExcitation) -> BaseMotion | None:
    """Motion of the constrained freedoms, the free ones at rest; None: there is none.

    Raises:
        InputError: freedoms are moved that no SPC holds.
    """
    shape = moved_shape(model, excitation.motion)
    if shape is None:
        return None
    return BaseMotion(shape=shape, factor=excitation.motion_factor)


def carried_shape(
    shape: sp.csr_matrix,
    model: Structure,
    reduced: AnalysisModel,
    modes: Modes,
    *,
    solver: SolverName | None = None,
) -> sp.csr_matrix:
    """(g, m) a motion with the static response of the free freedoms to it."""
    force = reduced.load(sp.csr_matrix(model.matrices.stiffness @ shape))
    along = static_response(
        reduced.stiffness, reduced.mass, modes, -force.toarray(), solver=solver
    )
    return sp.csr_matrix(shape + reduced.expand @ sp.csr_matrix(along))


def unseen_motion(model: Structure, motion: sp.csr_matrix) -> str:
    """Notice that K2PP, TFL and the like do not see motions (g, m) of the s-set.

    Nastran takes the rows and columns of what SPC holds out of them, moved or not
    (workshop 21 of its course NAS102: the nonlinear loads that it prints).
    """
    given = model.dynamic_input
    if given is None:
        return ""
    columns = abs(given.stiffness) + abs(given.damping) + abs(given.mass)
    seen = np.asarray(columns.sum(axis=0)).ravel() > 0.0
    rows = [int(row) for row in np.unique(motion.nonzero()[0]) if seen[row]]
    if not rows:
        return ""
    names = ", ".join(model.points.label(row) for row in rows[:6])
    return (
        f"subcase {model.subcase.id}: TFL, K2PP, B2PP or M2PP refer to {names}, which "
        "SPC holds and SPCD moves: as in Nastran they see freedoms that SPC holds at "
        "rest; a large mass or a stiff spring may move the freedom instead"
    )


def moved_shape(model: Structure, motion: sp.csr_matrix) -> sp.csr_matrix | None:
    """(g, m) the g-set from motions of constrained freedoms (g, m); None: none moves.

    Raises:
        InputError: freedoms are moved that no SPC holds.
    """
    elimination = model.elimination
    moved = np.unique(motion.nonzero()[0])
    if not len(moved):
        return None
    loose = np.setdiff1d(moved, elimination.s)
    if len(loose):
        raise InputError(
            f"{model.deck.path}: subcase {model.subcase.id}: SPCD moves "
            f"{model.points.label(int(dof))}, which no SPC holds; expected it in the "
            f"SPC set {model.subcase.spc or '(none is selected)'}"
            for dof in loose[:20]
        )
    return sp.csr_matrix(elimination.S @ motion[elimination.s])

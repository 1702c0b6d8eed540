"""Matrices that a solution works on: the free set, or its reduction (ASET, QSET).

Direct dynamics add extra points and what K2PP, TFL and their like select (the d-set);
modal ones with such input are solved as a system of modes and extra points (the h-set).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.components import Component, condense
from fem.algebra.damping import Damping
from fem.algebra.linear_solver import Kind, SolverName
from fem.algebra.modes import Modes
from fem.algebra.reduction import reduce_craig_bampton
from fem.arrays import Float64, Int64
from fem.model.dynamic_input import DynamicInput
from fem.model.structure import Structure
from fem.response.modal import modal_damping
from fem.solution.components import components_of


@dataclass(frozen=True, kw_only=True)
class AnalysisModel:
    """Matrices of n freedoms and how the g-set follows them.

    Attributes:
        stiffness, mass: (n, n).
        damping: B.
        expand: (g, n) sparse, u_g = expand u, without enforced displacements.
        rigid_body: (n, r) motions that may be free of energy.
        reduced: whether this is a reduction of the free set.
        rows: (k,) rows of the g-set that the first k freedoms are.
        direct: what dynamic solutions add, on the same freedoms; None: nothing.
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    damping: Damping
    expand: sp.csr_matrix
    rigid_body: Float64 | None
    reduced: bool
    rows: Int64
    direct: DynamicInput | None = None

    @property
    def system(self) -> tuple[sp.csr_matrix, sp.csr_matrix, Damping, Kind]:
        """K, M and B with what is added, and of which kind they are."""
        k, m, b, more = self.stiffness, self.mass, self.damping, self.direct
        if more is None:
            return k, m, b, "spd"
        whole = Damping(other=sp.csr_matrix(b.matrix(k, m) + more.damping))
        k, m = sp.csr_matrix(k + more.stiffness), sp.csr_matrix(m + more.mass)
        return k, m, whole, "general"

    def load(self, p_g: sp.csr_matrix) -> sp.csr_matrix:
        """(n, k) loads from loads (g, k) of the g-set."""
        return sp.csr_matrix(self.expand.T @ p_g)


def moving_extra_points(structure: Structure) -> Int64:
    """Rows of the extra points that TF or direct input has an equation for."""
    given, extra = structure.dynamic_input, structure.points.extra_dof
    if given is None:
        return extra[:0]
    used = np.zeros(structure.points.size, bool)
    for matrix in (given.stiffness, given.damping, given.mass, given.structural):
        used |= np.diff(matrix.indptr) > 0
    return extra[used[extra]]


def with_dynamic_input(
    structure: Structure, reduced: AnalysisModel, say: Callable[[str], None]
) -> AnalysisModel:
    """Extra points before the freedoms, with what the subcase adds; or nothing new.

    Args:
        structure: with its subcase.
        reduced: its freedoms.
        say: told of extra points without an equation, which rest, as Nastran has it
            (its results of such decks hold zeros there).
    """
    given, extra = structure.dynamic_input, moving_extra_points(structure)
    if (idle := np.setdiff1d(structure.points.extra_dof, extra)).size:
        names = ", ".join(structure.points.label(int(dof)) for dof in idle[:10])
        more = ", ..." if len(idle) > 10 else ""
        say(
            f"notice: subcase {structure.subcase.id}: {names}{more}: no row of TF (TFL)"
            " or DMIG (K2PP, B2PP, M2PP); rests, loads on it do nothing"
        )
    if given is None:
        return reduced
    e = len(extra)
    unit = sp.csr_matrix(
        (np.ones(e), (extra, np.arange(e))), shape=(structure.points.size, e)
    )
    expand = sp.csr_matrix(sp.hstack([unit, reduced.expand]))

    def padded(matrix: sp.csr_matrix) -> sp.csr_matrix:
        return sp.csr_matrix(sp.block_diag([sp.csr_matrix((e, e)), matrix]))

    damping = reduced.damping.matrix(reduced.stiffness, reduced.mass)
    return AnalysisModel(
        stiffness=padded(reduced.stiffness),
        mass=padded(reduced.mass),
        damping=Damping(other=padded(damping)),
        expand=expand,
        rigid_body=None,
        reduced=reduced.reduced,
        rows=np.concatenate([extra, reduced.rows]),
        direct=given.on(expand),
    )


def in_modes(
    reduced: AnalysisModel, modes: Modes, ratio: Float64 | float = 0.0
) -> AnalysisModel:
    """The model in mass-normalised modes, with damping ratios added to B."""
    own = 2.0 * np.broadcast_to(ratio, modes.count) * np.sqrt(np.abs(modes.eigenvalue))
    damping = modal_damping(modes, reduced.damping) + np.diag(own)
    return AnalysisModel(
        stiffness=sp.csr_matrix(sp.diags(modes.eigenvalue)),
        mass=sp.csr_matrix(sp.identity(modes.count)),
        damping=Damping(other=sp.csr_matrix(damping)),
        expand=sp.csr_matrix(reduced.expand @ modes.shape),
        rigid_body=None,
        reduced=True,
        rows=np.zeros(0, np.int64),
    )


def analysis_model(
    structure: Structure, *, solver: SolverName | None = None
) -> AnalysisModel:
    """The free set of a structure, or what ASET and QSET reduce it to.

    Raises:
        InputError: ASET names freedoms that are not free.
        SingularMatrixError: the interior moves freely while the a-set is held.
    """
    components = components_of(structure)
    if components:
        return _of_components(structure, components, solver)
    if not len(structure.analysis_dof):
        return AnalysisModel(
            stiffness=structure.stiffness,
            mass=structure.mass,
            damping=structure.damping,
            expand=structure.elimination.T,
            rigid_body=structure.rigid_body,
            reduced=False,
            rows=structure.elimination.f,
        )
    reduction = reduce_craig_bampton(
        structure.stiffness,
        structure.mass,
        structure.damping,
        structure.free_rows(structure.analysis_dof, "ASET"),
        count=len(structure.generalised_dof),
        solver=solver,
    )
    expand = structure.elimination.T @ reduction.transform
    q = len(reduction.interior_hz)
    first = reduction.size - q
    expand[structure.generalised_dof[:q], first + np.arange(q)] = 1.0
    return AnalysisModel(
        stiffness=sp.csr_matrix(reduction.stiffness),
        mass=sp.csr_matrix(reduction.mass),
        damping=Damping(other=sp.csr_matrix(reduction.damping)),
        expand=sp.csr_matrix(expand),
        rigid_body=None,
        reduced=True,
        rows=structure.analysis_dof,
    )


def _of_components(
    structure: Structure, components: list[Component], solver: SolverName | None
) -> AnalysisModel:
    """Superelements reduced, then what ASET keeps of the rest."""
    k, m = structure.stiffness, structure.mass
    whole = condense(k, m, structure.damping.matrix(k, m), components, solver=solver)
    physical = np.flatnonzero(whole.rows >= 0)
    modal = np.flatnonzero(whole.rows < 0)
    f = structure.elimination.f
    named = whole.generalised[modal] >= 0
    shown = sp.coo_matrix(
        (np.ones(named.sum()), (whole.generalised[modal][named], modal[named])),
        shape=(len(structure.points.basic_rotation().indptr) - 1, len(whole.rows)),
    )
    expand = sp.csr_matrix(structure.elimination.T @ whole.transform + shown)
    order = np.concatenate([physical, modal])
    stiffness, mass, damping = (
        sp.csr_matrix(matrix[order][:, order])
        for matrix in (whole.stiffness, whole.mass, whole.damping)
    )
    expand, rows = sp.csr_matrix(expand[:, order]), f[whole.rows[physical]]
    kept = structure.analysis_dof
    if not len(kept):
        return AnalysisModel(
            stiffness=stiffness,
            mass=mass,
            damping=Damping(other=damping),
            expand=expand,
            rigid_body=None,
            reduced=True,
            rows=rows,
        )
    at = np.flatnonzero(np.isin(rows, kept))
    at = np.concatenate([at, np.arange(len(rows), len(order))])
    reduction = reduce_craig_bampton(stiffness, mass, damping, at, count=0)
    return AnalysisModel(
        stiffness=sp.csr_matrix(reduction.stiffness),
        mass=sp.csr_matrix(reduction.mass),
        damping=Damping(other=sp.csr_matrix(reduction.damping)),
        expand=sp.csr_matrix(expand @ reduction.transform),
        rigid_body=None,
        reduced=True,
        rows=rows[np.isin(rows, kept)],
    )

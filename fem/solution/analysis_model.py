"""Matrices that a solution works on: the free set, or its reduction (ASET, QSET)."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.components import Component, condense
from fem.algebra.damping import Damping
from fem.algebra.linear_solver import SolverName
from fem.algebra.reduction import reduce_craig_bampton
from fem.arrays import Float64, Int64
from fem.model.structure import Structure
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
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    damping: Damping
    expand: sp.csr_matrix
    rigid_body: Float64 | None
    reduced: bool
    rows: Int64

    def load(self, p_g: sp.csr_matrix) -> sp.csr_matrix:
        """(n, k) loads from loads (g, k) of the g-set."""
        return sp.csr_matrix(self.expand.T @ p_g)


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

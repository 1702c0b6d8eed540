"""Matrices that a solution works on: the free set, or its reduction (ASET, QSET)."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.algebra.linear_solver import SolverName
from fem.algebra.reduction import reduce_craig_bampton
from fem.arrays import Float64
from fem.model.structure import Structure


@dataclass(frozen=True, kw_only=True)
class AnalysisModel:
    """Matrices of n freedoms and how the g-set follows them.

    Attributes:
        stiffness, mass: (n, n).
        damping: B.
        expand: (g, n) sparse, u_g = expand u, without enforced displacements.
        rigid_body: (n, r) motions that may be free of energy.
        reduced: whether this is a reduction of the free set.
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    damping: Damping
    expand: sp.csr_matrix
    rigid_body: Float64 | None
    reduced: bool

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
    if not len(structure.analysis_dof):
        return AnalysisModel(
            stiffness=structure.stiffness,
            mass=structure.mass,
            damping=structure.damping,
            expand=structure.elimination.T,
            rigid_body=structure.rigid_body,
            reduced=False,
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
    )

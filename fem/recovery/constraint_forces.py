"""Forces of constraint in a transient.

They are the residual K u + B v + M a - P of the constrained rows of the g-set, with
what rigid elements and MPC carry to them.
"""

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Float64
from fem.constraints.elimination import Elimination
from fem.model.structure import Structure
from fem.response.observation import Chunk
from fem.response.system import TransientLoad


class ResidualResponse:
    """Linear combinations of the residual at the times of a chunk.

    Args:
        structure: the model.
        expand: (g, n) g-set from the freedoms of the transient.
        load: on the g-set, patterns (g, k).
        case: load case.
        gather: (r, g) combinations, `spc_gather` or `mpc_gather`.
    """

    def __init__(
        self,
        structure: Structure,
        expand: sp.csr_matrix,
        load: TransientLoad,
        case: int,
        gather: sp.csr_matrix,
    ) -> None:
        b, m = structure.damping_g, structure.matrices
        damping = b.matrix(m.stiffness, m.mass)
        self._stiffness = sp.csr_matrix(gather @ m.stiffness @ expand)
        self._damping = sp.csr_matrix(gather @ damping @ expand)
        self._mass = sp.csr_matrix(gather @ m.mass @ expand)
        self._pattern = sp.csr_matrix(gather @ load.pattern)
        self._load, self._case = load, case

    def values(self, chunk: Chunk) -> Float64:
        """(m, r) forces of a chunk."""
        force = chunk.get("displacement", self._stiffness)[:, self._case]
        force = force + chunk.get("velocity", self._damping)[:, self._case]
        force += chunk.get("acceleration", self._mass)[:, self._case]
        if self._pattern.nnz:
            factors = self._load.factors(chunk.time)
            case = self._case if len(factors) > 1 else 0
            force -= (self._pattern @ factors[case]).T
        return force


def spc_gather(elimination: Elimination) -> sp.csr_matrix:
    """(g, g) SPC forces from residuals, see `Elimination.spc_force`."""
    own = _take(elimination.s, elimination.size)
    all_of = sp.identity(elimination.size, format="csr")
    return sp.csr_matrix(own.T @ (own @ (all_of - mpc_gather(elimination))))


def mpc_gather(elimination: Elimination) -> sp.csr_matrix:
    """(g, g) forces of rigid elements and MPC from residuals."""
    take = _take(elimination.m, elimination.size)
    return sp.csr_matrix(take.T @ take - elimination.dependence.T @ take)


def _take(rows: npt.NDArray[np.int64], size: int) -> sp.csr_matrix:
    """(r, g) the rows of a vector."""
    k = len(rows)
    return sp.csr_matrix((np.ones(k), (np.arange(k), rows)), shape=(k, size))

"""Forces of single-point constraints in a transient, as an observer.

Forces of constraint are the residual K u + B v + M a - P of the constrained rows of the
g-set, with what rigid elements and MPC carry to them.
"""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.constraints.elimination import Elimination
from fem.observation import Chunk
from fem.structure import Structure
from fem.transient_system import TransientLoad

Float64 = npt.NDArray[np.float64]
Sink = Callable[[int, Float64], None]


class SpcForceObserver:
    """Computes SPC forces at every output time.

    Args:
        structure: the model.
        expand: (g, n) g-set from the freedoms of the transient.
        load: on the g-set, patterns (g, k).
        case: load case.
        sink: receives (index of the first time, forces (m, s)); rows as in
            `structure.elimination.s`.
    """

    def __init__(
        self,
        structure: Structure,
        expand: sp.csr_matrix,
        load: TransientLoad,
        case: int,
        sink: Sink,
    ) -> None:
        gather = _gather(structure.elimination)
        b, m = structure.damping_g, structure.matrices
        damping = b.matrix(m.stiffness, m.mass)
        self._stiffness = sp.csr_matrix(gather @ m.stiffness @ expand)
        self._damping = sp.csr_matrix(gather @ damping @ expand)
        self._mass = sp.csr_matrix(gather @ m.mass @ expand)
        self._pattern = sp.csr_matrix(gather @ load.pattern)
        self._load, self._case, self._sink = load, case, sink

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Nothing to prepare; see `Observer`."""

    def observe(self, chunk: Chunk) -> None:
        """Forces of a chunk; see `Observer`."""
        force = chunk.get("displacement", self._stiffness)[:, self._case]
        force = force + chunk.get("velocity", self._damping)[:, self._case]
        force += chunk.get("acceleration", self._mass)[:, self._case]
        if self._pattern.nnz:
            factors = self._load.factors(chunk.time)
            case = self._case if len(factors) > 1 else 0
            force -= (self._pattern @ factors[case]).T
        self._sink(chunk.first, force)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Nothing stays in memory here."""
        return 0


def _gather(elimination: Elimination) -> sp.csr_matrix:
    """(s, g) SPC forces from residuals of the g-set, see `Elimination.spc_force`."""
    rows = np.arange(len(elimination.s))
    shape = (len(rows), elimination.size)
    own = sp.csr_matrix((np.ones(len(rows)), (rows, elimination.s)), shape=shape)
    if not len(elimination.m):
        return own
    carried = sp.csr_matrix(elimination.dependence.T.tocsr()[elimination.s])
    columns = np.arange(len(elimination.m))
    spread = sp.csr_matrix(
        (np.ones(len(columns)), (columns, elimination.m)),
        shape=(len(columns), elimination.size),
    )
    return sp.csr_matrix(own + carried @ spread)

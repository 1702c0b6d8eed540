"""Counting eigenvalues by the inertia of K - s M (Sylvester, "Sturm check").

The number of negative pivots of K - s M is the number of eigenvalues of K x = λ M x
below s, where M is positive semi-definite and K positive on the null space of M.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.linear_solver import SingularMatrixError, SolverName, factorize
from fem.arrays import Float64

# Relative steps away from a shift that lies on an eigenvalue.
_NUDGES = (0.0, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4, -1e-4)


@dataclass(frozen=True)
class SturmCount:
    """One count.

    Attributes:
        frequency_hz: limit of the count.
        counted: eigenvalues below it by inertia.
        found: modes below it that the iteration found.
    """

    frequency_hz: float
    counted: int
    found: int

    @property
    def complete(self) -> bool:
        """Whether no mode was missed."""
        return self.counted == self.found

    def __str__(self) -> str:
        verdict = "none missed" if self.complete else "modes are MISSING"
        return (
            f"{self.counted} modes counted below {self.frequency_hz:.6g} Hz, "
            f"{self.found} found: {verdict}"
        )


def count_below(
    stiffness: sp.csr_matrix,
    mass: sp.csr_matrix,
    eigenvalue: float,
    *,
    constraint: Float64 | None = None,
    solver: SolverName | None = None,
) -> int:
    """Number of eigenvalues λ of K x = λ M x below a limit.

    With constraints C'x = 0: the bordered matrix [A C; C' 0] has as many more negative
    eigenvalues as there are constraints, and they are those of A and of -C' A⁻¹ C.

    Args:
        stiffness, mass: (n, n) K and M.
        eigenvalue: the limit s, rad²/s².
        constraint: (n, r) C of full rank, None: all x.
        solver: as in `factorize`.

    Raises:
        SingularMatrixError: every shift that was tried lies on an eigenvalue.
    """
    error: SingularMatrixError | None = None
    for nudge in _NUDGES:
        shift = eigenvalue * (1.0 + nudge)
        try:
            with factorize(
                sp.csr_matrix(stiffness - shift * mass), kind="symmetric", solver=solver
            ) as factor:
                if factor.inertia is None or factor.perturbed_pivots:
                    continue
                if constraint is None or not constraint.shape[1]:
                    return factor.inertia
                schur = -constraint.T @ factor.solve(np.asfortranarray(constraint))
                values = np.linalg.eigvalsh(0.5 * (schur + schur.T))
                return factor.inertia + int(np.sum(values < 0.0)) - len(values)
        except SingularMatrixError as singular:
            error = singular
    raise error or SingularMatrixError(None)


def hertz(eigenvalue: float) -> float:
    """Frequency (Hz) of an eigenvalue (rad²/s²), negative for a negative one."""
    return float(np.sign(eigenvalue) * np.sqrt(abs(eigenvalue)) / (2.0 * np.pi))

"""Block Lanczos iteration for an operator that is self-adjoint in an inner product M.

For K x = λ M x around a shift σ it is (K - σ M)⁻¹ M with the eigenvalues
θ = 1 / (λ - σ): modes near the shift converge first. For buckling it is -K⁻¹ K_d in the
inner product of K. The basis is kept
M-orthonormal by orthogonalising every new block twice against all of it, so that no
spurious copies appear; blocks find multiple eigenvalues and make the solves cheap.
M may be singular: iterates stay in the range of the operator, and the Ritz vectors
are purified by one more application of it.

Reference: R. G. Grimes, J. G. Lewis, H. D. Simon, "A shifted block Lanczos algorithm
for solving sparse symmetric generalized eigenproblems", SIAM J. Matrix Anal. 15, 1994.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.orthonormal import orthonormal_block
from fem.arrays import Float64

Operator = Callable[[Float64], Float64]

_RANK_TOLERANCE = 1e-10
# Share of a block's norm below which what the basis leaves of it is cleaned twice.
_CANCELLATION = 1e-3


@dataclass(frozen=True)
class RitzPairs:
    """Approximations from a Lanczos basis.

    Attributes:
        theta: (k,) Ritz values of the operator.
        coefficients: (k, k) their vectors in the basis, as columns.
        residual: (k,) norms of the residuals relative to |theta|.
    """

    theta: Float64
    coefficients: Float64
    residual: Float64


class BlockLanczos:
    """A growing Lanczos basis.

    Args:
        operator: applied to blocks (n, k).
        mass: (n, n) sparse M of the inner product, positive semi-definite.
        block: columns that are iterated together.
        reserve: vectors that the basis will probably need; their memory is taken only
            when it is used.
        seed: of the random starting blocks.
    """

    def __init__(
        self,
        operator: Operator,
        mass: sp.csr_matrix,
        *,
        block: int = 8,
        reserve: int = 64,
        seed: int = 0,
    ) -> None:
        self._operator = operator
        self._mass = mass
        self._n = len(mass.indptr) - 1
        self._block = min(block, self._n)
        self._reserved = reserve
        self._random = np.random.default_rng(seed)
        self._basis = np.empty((self._n, 0), order="F")
        self._projected = np.zeros((0, 0))
        self._used = 0
        # The block behind the basis, and its norm matrix: the residual of the process.
        self._next = self._random_block(self._block)
        self._coupling = np.zeros((self._next.shape[1], 0))
        self.solved_columns = 0

    @property
    def size(self) -> int:
        """Vectors in the basis."""
        return self._used

    @property
    def exhausted(self) -> bool:
        """Whether the basis spans all that the operator can reach."""
        return self._next.shape[1] == 0

    def _basis_view(self) -> Float64:
        return self._basis[:, : self._used]

    def _apply(self, block: Float64) -> Float64:
        self.solved_columns += block.shape[1]
        return self._operator(block)

    def _orthonormalise(self, block: Float64) -> tuple[Float64, Float64, Float64]:
        """Split a block: coefficients in the basis, orthonormal rest, its norms.

        The three-term recurrence comes first, so that the pass over all of the basis
        has round-off alone to remove and needs no repetition, as a rule.
        """
        scale = np.sqrt(np.max(_columns_dot(block, self._mass @ block), initial=0.0))
        coefficients = np.zeros((self._used, block.shape[1]))
        near = slice(max(self._used - 2 * block.shape[1], 0), self._used)
        coefficients[near], rest = self._without(near, block)
        part, rest = self._without(slice(0, self._used), rest)
        coefficients += part
        rest, norms = orthonormal_block(rest, self._mass, _RANK_TOLERANCE * scale)
        smallest = np.min(np.linalg.norm(norms, axis=1), initial=scale)
        if smallest < _CANCELLATION * scale or np.abs(part).max(initial=0) > smallest:
            # What shrinks once more was round-off.
            part, rest = self._without(slice(0, self._used), rest)
            coefficients += part @ norms
            rest, again = orthonormal_block(rest, self._mass, 0.1)
            norms = again @ norms
        return coefficients, rest, norms

    def _without(self, columns: slice, block: Float64) -> tuple[Float64, Float64]:
        """Coefficients of a block in columns of the basis, and the rest of it."""
        basis = self._basis[:, columns]
        part = basis.T @ (self._mass @ block)
        return part, block - basis @ part

    def _random_block(self, columns: int) -> Float64:
        columns = min(columns, self._n - self._used)
        block = self._random.standard_normal((self._n, columns))
        # One application leaves the null space of M behind.
        return self._orthonormalise(self._operator(block))[1]

    def _reserve(self, columns: int) -> None:
        if self._used + columns <= self._basis.shape[1]:
            return
        capacity = max(self._used + columns, 2 * self._basis.shape[1], self._reserved)
        grown = np.empty((self._n, min(capacity, self._n)), order="F")
        grown[:, : self._used] = self._basis_view()
        self._basis = grown

    def extend(self) -> None:
        """Add one block to the basis."""
        block = self._next
        columns = block.shape[1]
        if columns == 0:
            return
        self._reserve(columns)
        self._basis[:, self._used : self._used + columns] = block
        self._used += columns
        coefficients, rest, norms = self._orthonormalise(self._apply(block))
        grown = np.zeros((self._used, self._used))
        old = self._used - columns
        grown[:old, :old] = self._projected
        grown[:, old:] = coefficients
        grown[old:, :old] = coefficients[:old].T
        grown[old:, old:] = 0.5 * (coefficients[old:] + coefficients[old:].T)
        self._projected = grown
        self._next = rest
        self._coupling = np.zeros((rest.shape[1], self._used))
        self._coupling[:, old:] = norms

    def restart_randomly(self, columns: int) -> None:
        """Leave the Krylov sequence: look for what it cannot see, e.g. multiple modes.

        Call `keep` before, with converged pairs only.

        Args:
            columns: random directions to look in, at least a block of them.
        """
        self._next = self._random_block(max(columns, self._block))
        self._coupling = np.zeros((self._next.shape[1], self._used))

    def keep(self, pairs: RitzPairs, chosen: npt.NDArray[np.intp]) -> None:
        """Compress the basis to some Ritz vectors (thick restart).

        Args:
            pairs: the current Ritz pairs.
            chosen: positions of those to keep, with those that are nearly converged.
        """
        vectors = self._basis_view() @ np.ascontiguousarray(
            pairs.coefficients[:, chosen]
        )
        self._used = len(chosen)
        self._basis[:, : self._used] = vectors
        self._projected = np.diag(pairs.theta[chosen])
        self._coupling = self._coupling @ pairs.coefficients[:, chosen]

    def ritz(self) -> RitzPairs:
        """Ritz pairs of the present basis, largest |theta| first."""
        theta, coefficients = np.linalg.eigh(self._projected)
        order = np.argsort(-np.abs(theta), kind="stable")
        theta, coefficients = theta[order], coefficients[:, order]
        residual = np.linalg.norm(self._coupling @ coefficients, axis=0)
        return RitzPairs(
            theta,
            coefficients,
            residual / np.maximum(np.abs(theta), np.finfo(float).tiny),
        )

    def vectors(
        self, pairs: RitzPairs, chosen: npt.NDArray[np.intp], *, chunk: int = 64
    ) -> Float64:
        """Purified Ritz vectors (n, k) of chosen pairs."""
        result = np.empty((self._n, len(chosen)), order="F")
        for start in range(0, len(chosen), chunk):
            part = chosen[start : start + chunk]
            vectors = self._basis_view() @ np.ascontiguousarray(
                pairs.coefficients[:, part]
            )
            result[:, start : start + len(part)] = (
                self._apply(vectors) / pairs.theta[part]
            )
        return result


def shift_inverted(solve: Operator, mass: sp.csr_matrix) -> Operator:
    """(K - σ M)⁻¹ M from a solution x = (K - σ M)⁻¹ b."""
    return lambda block: solve(np.asfortranarray(mass @ block))


def _columns_dot(a: Float64, b: Float64) -> Float64:
    return np.einsum("ij,ij->j", a, b)

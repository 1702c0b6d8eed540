"""Linear buckling (K + λ K_d) x = 0: factors λ of the load that gave K_d.

K is positive definite, K_d is not: as -K_d x = μ K x with μ = 1 / λ the largest |μ| are
the smallest |λ|, of both signs (a negative factor buckles under the reversed load).
They come by block Lanczos in the inner product of K, or densely. K + a K_d has as many
negative eigenvalues as there are factors between 0 and a: that count shows that none
was missed (Sylvester's law of inertia).

A structure that moves freely under loads that balance buckles in mean axes: modes have
no share of the rigid motions R, Rᵀ M x = 0. (Turned as a whole under loads that keep
their directions it would gain or lose energy at once.)
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.linalg
import scipy.sparse as sp

from fem.algebra.eigenproblem import DENSE_LIMIT, Progress, look_again
from fem.algebra.lanczos import BlockLanczos, RitzPairs
from fem.algebra.linear_solver import (
    Factorization,
    SingularMatrixError,
    SolverName,
    factorize,
)
from fem.algebra.statics import determinate_rows
from fem.algebra.sturm import count_below
from fem.arrays import Float64

_CONVERGED = 1e-8
# Share of the largest 1 / |λ| below which an eigenvalue is rounding.
_NONE = 1e-12
_ATTEMPTS = 6


@dataclass(frozen=True)
class FactorCount:
    """One count.

    Attributes:
        limit: of the factors, counted from zero.
        counted: by inertia.
        found: by the iteration.
    """

    limit: float
    counted: int
    found: int

    @property
    def complete(self) -> bool:
        """Whether none was missed."""
        return self.counted == self.found

    def __str__(self) -> str:
        verdict = "none missed" if self.complete else "some are MISSING"
        return (
            f"{self.counted} load factors counted between 0 and {self.limit:.6g}, "
            f"{self.found} found: {verdict}"
        )


@dataclass(frozen=True)
class FreeMotions:
    """Motions of a structure that nothing holds.

    Attributes:
        motions: (n, r) R, without energy.
        heavy: (n, r) M R.
    """

    motions: Float64
    heavy: Float64

    def balanced(self, load: Float64) -> Float64:
        """Loads (n, k) with the inertia that balances them."""
        return load - self.heavy @ self._solve(self.motions.T @ load)

    def in_mean_axes(self, displacement: Float64) -> Float64:
        """(n, k) without their share of the motions."""
        return displacement - self.motions @ self._solve(self.heavy.T @ displacement)

    def _solve(self, right: Float64) -> Float64:
        return np.linalg.solve(self.motions.T @ self.heavy, right)


@dataclass(frozen=True, kw_only=True)
class Buckling:
    """Buckling factors, smallest magnitude first.

    Attributes:
        factor: (m,) λ.
        shape: (n, m), X' K X = 1; the largest entry of each is positive.
        counts: how completeness was shown, for each sign.
    """

    factor: Float64
    shape: Float64
    counts: tuple[FactorCount, ...]


class BucklingSolver:
    """Load factors of one structure under several loads: K is factorised once.

    Args:
        stiffness: (n, n) K, positive definite, but for free motions.
        free: motions without energy, that modes have no share of.
        solver: as in `factorize`.

    Example:
        >>> k = sp.csr_matrix([[2.0, 0.0], [0.0, 3.0]])
        >>> loads = [sp.csr_matrix(-np.eye(2)), sp.csr_matrix(-0.5 * np.eye(2))]
        >>> with BucklingSolver(k) as solver:
        ...     lowest = [solver.factors(kd, count=1).factor[0] for kd in loads]
        >>> [round(float(factor), 9) for factor in lowest]
        [2.0, 4.0]
    """

    def __init__(
        self,
        stiffness: sp.csr_matrix,
        free: FreeMotions | None = None,
        solver: SolverName | None = None,
    ) -> None:
        if free is not None and not free.motions.shape[1]:
            free = None
        self._stiffness, self._free, self._solver = stiffness, free, solver
        self._inverse: _Inverse | None = None

    def __enter__(self) -> "BucklingSolver":
        return self

    def __exit__(self, *_: object) -> None:
        if self._inverse is not None:
            self._inverse.factor.close()
            self._inverse = None

    def factors(
        self,
        differential: sp.csr_matrix,
        *,
        count: int | None = None,
        band: tuple[float | None, float | None] = (None, None),
        progress: Progress | None = None,
    ) -> Buckling:
        """Load factors λ with (K + λ K_d) x = 0.

        Args:
            differential: (n, n) K_d of the load.
            count: at most this many, the smallest in magnitude.
            band: (lowest, highest) λ; None stands for no limit. A count, or both
                limits, or one limit with the sign of the wanted factors is needed.
            progress: called with (converged, wanted).

        Raises:
            SingularMatrixError: K is not positive definite.
            ValueError: neither count nor limits.
        """
        low = -np.inf if band[0] is None else band[0]
        high = np.inf if band[1] is None else band[1]
        if count is None and not np.isfinite(_reach(low, high)):
            raise ValueError("give a count of factors or limits")
        if not len(self._stiffness.indptr) - 1:
            return Buckling(factor=np.zeros(0), shape=np.zeros((0, 0)), counts=())
        problem = _Problem(
            self._stiffness, differential, low, high, count, self._free, self._solver
        )
        if problem.n <= DENSE_LIMIT:
            factors, shapes = problem.dense()
            counts = problem.counts(factors, np.inf)
        else:
            if self._inverse is None:
                self._inverse = _Inverse.of(self._stiffness, self._free, self._solver)
            factors, shapes, counts = problem.iterate(self._inverse, progress)
        chosen = problem.chosen(factors)
        if shapes.size:
            largest = np.argmax(np.abs(shapes), axis=0)
            shapes = shapes * np.sign(shapes[largest, np.arange(shapes.shape[1])])
        return Buckling(
            factor=factors[chosen],
            shape=np.asfortranarray(shapes[:, chosen]),
            counts=tuple(counts),
        )


def buckling_factors(
    stiffness: sp.csr_matrix,
    differential: sp.csr_matrix,
    *,
    count: int | None = None,
    band: tuple[float | None, float | None] = (None, None),
    free: FreeMotions | None = None,
    solver: SolverName | None = None,
    progress: Progress | None = None,
) -> Buckling:
    """Load factors under one load; arguments as in `BucklingSolver`."""
    with BucklingSolver(stiffness, free, solver) as own:
        return own.factors(differential, count=count, band=band, progress=progress)


@dataclass(frozen=True)
class _Inverse:
    """Displacements under loads, of free structures upon a determinate support."""

    factor: Factorization
    keep: npt.NDArray[np.intp]
    free: FreeMotions | None

    @classmethod
    def of(
        cls,
        stiffness: sp.csr_matrix,
        free: FreeMotions | None,
        solver: SolverName | None,
    ) -> "_Inverse":
        size = len(stiffness.indptr) - 1
        if free is None:
            return cls(factorize(stiffness, solver=solver), np.arange(size), None)
        keep = np.setdiff1d(np.arange(size), determinate_rows(free.motions))
        inner = sp.csr_matrix(stiffness[keep][:, keep])
        return cls(factorize(inner, solver=solver), keep, free)

    def __call__(self, load: Float64) -> Float64:
        """(n, k), of free structures in mean axes."""
        if self.free is None:
            return self.factor.solve(np.asfortranarray(load))
        moved = np.zeros_like(load)
        balanced = self.free.balanced(load)[self.keep]
        moved[self.keep] = self.factor.solve(np.asfortranarray(balanced))
        return self.free.in_mean_axes(moved)


def _reach(low: float, high: float) -> float:
    """How far from zero factors of a band lie at most."""
    return max(abs(low), abs(high))


@dataclass(frozen=True)
class _Problem:
    stiffness: sp.csr_matrix
    differential: sp.csr_matrix
    low: float
    high: float
    count: int | None
    free: FreeMotions | None
    solver: SolverName | None

    @property
    def n(self) -> int:
        return len(self.stiffness.indptr) - 1

    def chosen(self, factors: Float64) -> npt.NDArray[np.intp]:
        """Positions of the wanted among factors that ascend in magnitude."""
        inside = (factors >= self.low) & (factors <= self.high)
        return np.flatnonzero(inside)[: self.count]

    def dense(self) -> tuple[Float64, Float64]:
        """All factors and shapes."""
        k, kd = self.stiffness.toarray(), self.differential.toarray()
        basis = None
        if self.free is not None:
            basis = scipy.linalg.null_space(self.free.heavy.T)
            k, kd = (basis.T @ matrix @ basis for matrix in (k, kd))
        try:
            theta, shapes = scipy.linalg.eigh(-0.5 * (kd + kd.T), 0.5 * (k + k.T))
        except np.linalg.LinAlgError:
            raise SingularMatrixError(self._failing_row()) from None
        if basis is not None:
            shapes = basis @ shapes
        order = np.argsort(-np.abs(theta), kind="stable")
        theta = theta[order]
        there = np.abs(theta) > _NONE * np.abs(theta).max(initial=0.0)
        return 1.0 / theta[there], shapes[:, order][:, there]

    def _failing_row(self) -> int | None:
        try:
            factorize(self.stiffness, solver=self.solver).close()
        except SingularMatrixError as error:
            return error.row
        return None

    def iterate(
        self, inverse: _Inverse, progress: Progress | None
    ) -> tuple[Float64, Float64, list[FactorCount]]:
        """Factors and shapes up to the last wanted one, and how they were counted."""
        tell = progress or (lambda done, wanted: None)
        wanted = self.count or 8
        lanczos = BlockLanczos(
            lambda block: inverse(-(self.differential @ block)),
            self.stiffness,
            block=int(np.clip(wanted // 4, 4, 8)),
            reserve=4 * wanted + 64,
        )
        for attempt in range(_ATTEMPTS):
            pairs, leading, known = self._grow(lanczos, tell)
            factors = 1.0 / pairs.theta[:leading]
            counts = self.counts(factors, known)
            missing = sum(c.counted - c.found for c in counts)
            if missing <= 0 or lanczos.exhausted or attempt == _ATTEMPTS - 1:
                break
            look_again(lanczos, pairs, missing)
        return factors, lanczos.vectors(pairs, np.arange(leading)), counts

    def _grow(
        self, lanczos: BlockLanczos, tell: Callable[[int, int], None]
    ) -> tuple[RitzPairs, int, float]:
        """Extend the basis until the wanted factors have converged.

        Returns the pairs, how many of the first have converged, and the magnitude of
        the first that has not.
        """
        look = lanczos.size + 2 * (self.count or 16) + 16
        while True:
            while lanczos.size < look and not lanczos.exhausted:
                lanczos.extend()
            pairs = lanczos.ritz()
            there = np.abs(pairs.theta) > _NONE * np.abs(pairs.theta).max(initial=0.0)
            bad = np.flatnonzero(there & (pairs.residual > _CONVERGED))
            leading = int(bad[0]) if len(bad) else int(there.sum())
            known = 1.0 / abs(pairs.theta[leading]) if len(bad) else np.inf
            found = len(self.chosen(1.0 / pairs.theta[:leading]))
            tell(found, self.count or found + 1)
            enough = self.count is not None and found >= self.count
            # Ritz values approach from inside: what has not converged lies nearer.
            over = 0.9 * known > _reach(self.low, self.high)
            if enough or over or lanczos.exhausted:
                return pairs, leading, known
            look = lanczos.size + max(16, lanczos.size // 8)

    def counts(self, factors: Float64, known: float) -> list[FactorCount]:
        """Counts beyond the last chosen factors, on each side that is wanted.

        Args:
            factors: that were found, ascending in magnitude.
            known: magnitude below which none is missing, by the iteration.
        """
        chosen = self.chosen(factors)
        last = -1.0 if not len(chosen) else abs(float(factors[chosen[-1]]))
        found = []
        for sign, limit in ((1.0, self.high), (-1.0, -self.low)):
            if limit <= 0.0:
                continue
            own = sign * factors[sign * factors > 0.0]
            if self.count is not None and len(chosen) == self.count:
                limit = _gap(own, last, known)
            elif np.isfinite(limit):
                limit = _gap(own, min(limit, known), known)
            elif len(own):
                limit = 1.001 * float(own.max())
            else:
                continue
            counted = count_below(
                self.stiffness,
                sp.csr_matrix(-sign * self.differential),
                limit,
                constraint=None if self.free is None else self.free.heavy,
                solver=self.solver,
            )
            found.append(FactorCount(sign * limit, counted, int(np.sum(own < limit))))
        return found


def _gap(own: Float64, last: float, known: float) -> float:
    """A limit beyond `last` in a gap of magnitudes, below what is not known."""
    beyond = np.sort(own[own > last * (1.0 + 1e-6)])
    following = min([*beyond[:1], known])
    return 0.5 * (last + following) if np.isfinite(following) else 1.001 * last

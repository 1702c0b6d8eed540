"""The eigenvalue problem K x = λ M x: a dense way, one from below zero, and slices.

Which way is taken depends on size and band. Every way returns eigenvalues (rad²/s²),
mass-normalised shapes and the Sturm counts at the limits of what it looked at.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt
import scipy.linalg
import scipy.sparse as sp

from fem.algebra.lanczos import BlockLanczos, RitzPairs, shift_inverted
from fem.algebra.linear_solver import SingularMatrixError, SolverName, factorize
from fem.algebra.sturm import SturmCount, count_below, hertz
from fem.arrays import Float64

Progress = Callable[[int, int], None]

DENSE_LIMIT = 400
SLICE_MODES = 400

# Relative residual of a converged pair; purification gains several digits more.
_CONVERGED = 1e-8
# Share of the largest operator value below which a dense pair is a massless freedom.
_MASSLESS = 1e-13
# Share of the shift below which eigenvalues are rounding of one value (rigid bodies).
_NOISE = 1e-3
_RANDOM_RESTARTS = 8
_LAST_ATTEMPT = _RANDOM_RESTARTS - 1


class ModesError(ArithmeticError):
    """The eigenvalue problem has no modes of the wanted kind."""


@dataclass(frozen=True)
class EigenProblem:
    """K x = λ M x and how it is solved.

    Attributes:
        stiffness, mass: (n, n) K and M.
        solver: as in `factorize`.
        progress: called with (converged, wanted) modes.
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    solver: SolverName | None
    progress: Progress

    @property
    def n(self) -> int:
        """Order of the matrices."""
        return len(self.mass.indptr) - 1

    def solve(
        self, count: int | None, limits: tuple[float, float]
    ) -> tuple[Float64, Float64, list[SturmCount]]:
        """Eigenvalues (m,), (rad/s)², shapes (n, m) and counts in a band of them."""
        if self.n <= DENSE_LIMIT or (count or 0) > self.n // 4:
            return self._dense(count, limits)
        low, high = limits
        below = 0 if low == -np.inf else self.count(low)
        if high == np.inf and below + (count or 0) <= SLICE_MODES:
            return self._lowest(below + (count or 0), None, below)
        total = self.count(high) if high < np.inf else None
        if total is None or (count is not None and total - below > 1.2 * count + 10):
            wanted = below + (count or 0)
            high, total = self._upper_limit(wanted, high)
        if total <= SLICE_MODES:
            wanted = total if count is None else min(total, below + count)
            return self._lowest(wanted, (high, total), below)
        return self._slices(low, high, below, total, count)

    def count(self, eigenvalue: float) -> int:
        """Number of eigenvalues below one, by Sylvester's law."""
        return count_below(self.stiffness, self.mass, eigenvalue, solver=self.solver)

    # -- small problems ---------------------------------------------------------------

    def _dense(
        self, count: int | None, limits: tuple[float, float]
    ) -> tuple[Float64, Float64, list[SturmCount]]:
        k, m = self.stiffness.toarray(), self.mass.toarray()
        shift = 100.0 * self._probe_shift()
        try:
            theta, shapes = scipy.linalg.eigh(
                0.5 * (m + m.T), 0.5 * (k + k.T) - shift * m
            )
        except np.linalg.LinAlgError:
            raise _not_definite(self._failing_row(shift)) from None
        if theta[0] < -1e-9 * theta[-1]:
            raise ModesError("the mass matrix has negative eigenvalues")
        finite = theta > _MASSLESS * theta[-1]
        theta, shapes = theta[finite][::-1], shapes[:, finite][:, ::-1]
        values = 1.0 / theta + shift
        # eigh normalises by K - σ M.
        shapes = shapes / np.sqrt(theta)
        inside = (values >= limits[0]) & (values <= limits[1])
        chosen = np.flatnonzero(inside)[:count]
        noise = _NOISE * abs(shift)
        sturm = self._check(values, chosen, low=limits[0], noise=noise)
        return values[chosen], shapes[:, chosen], sturm

    def _failing_row(self, shift: float) -> int | None:
        try:
            factorize(self._shifted(shift), solver=self.solver).close()
        except SingularMatrixError as error:
            return error.row
        return None

    def _check(
        self,
        values: Float64,
        chosen: npt.NDArray[np.intp],
        *,
        low: float,
        noise: float,
    ) -> list[SturmCount]:
        """Counts at the ends of the chosen modes of an ascending spectrum.

        Values that differ by less than `noise` are not told apart: the rigid-body
        modes are one cluster.
        """
        counts = []
        limits = [low] if low > -np.inf else []
        if len(chosen):
            limits.append(_gap_above(values, int(chosen[-1]), noise))
        for limit in limits:
            found = int(np.sum(values < limit))
            counts.append(SturmCount(hertz(limit), self.count(limit), found))
        return counts

    # -- from below zero --------------------------------------------------------------

    def _shifted(self, shift: float) -> sp.csr_matrix:
        return sp.csr_matrix(self.stiffness - shift * self.mass)

    def _probe_shift(self) -> float:
        """A shift below zero from the diagonals alone, far below most of the band."""
        k, m = self.stiffness.diagonal(), self.mass.diagonal()
        at = (m > 0.0) & (k > 0.0)
        ratio = float(np.median(k[at] / m[at])) if at.any() else 1.0
        return -1e-8 * ratio

    def _base_shift(self, high: float | None) -> float:
        """A shift below zero of the size of the lowest elastic eigenvalue."""
        if high is not None:
            return -0.01 * high
        probe = self._probe_shift()
        with self._factorize(probe) as factor:
            lanczos = BlockLanczos(shift_inverted(factor.solve, self.mass), self.mass)
            while lanczos.size < 32 and not lanczos.exhausted:
                lanczos.extend()
            theta = lanczos.ritz().theta
        values = 1.0 / theta[theta > 0.0] + probe
        elastic = values[values > 1e-3 * abs(probe)]
        return -float(elastic[0]) if len(elastic) else probe

    def _factorize(self, shift: float):
        try:
            return factorize(self._shifted(shift), kind="spd", solver=self.solver)
        except SingularMatrixError as error:
            raise _not_definite(error.row) from None

    def _lowest(
        self, wanted: int, limit: tuple[float, int] | None, below: int
    ) -> tuple[Float64, Float64, list[SturmCount]]:
        """The lowest modes, without the first `below`; limit: known (λ, count)."""
        shift = self._base_shift(None if limit is None else limit[0])
        with self._factorize(shift) as factor:
            lanczos = _lanczos(factor.solve, self.mass, wanted)
            target = wanted if limit is not None else wanted + 1
            for attempt in range(_RANDOM_RESTARTS):
                pairs = _grow(lanczos, target, self.progress)
                values = 1.0 / pairs.theta + shift
                converged = np.argsort(values)[:wanted]
                if limit is not None and wanted == limit[1]:
                    found = int(np.sum(values < limit[0]))
                    sturm = [SturmCount(hertz(limit[0]), limit[1], found)]
                else:
                    last = np.arange(len(converged))
                    sturm = self._check(
                        np.sort(values), last, low=-np.inf, noise=_NOISE * abs(shift)
                    )
                missing = sum(c.counted - c.found for c in sturm)
                if missing == 0 or lanczos.exhausted or attempt == _LAST_ATTEMPT:
                    break
                target = max(target, *(c.counted for c in sturm))
                look_again(lanczos, pairs, missing)
            chosen = converged[below:]
            shapes = lanczos.vectors(pairs, chosen)
        return values[chosen], shapes, sturm

    # -- slices -----------------------------------------------------------------------

    def _upper_limit(self, wanted: int, cap: float) -> tuple[float, int]:
        """An eigenvalue limit with at least `wanted` and not many more modes below."""
        high = 4.0 * abs(self._base_shift(None))
        low, total = 0.0, self.count(high)
        while total < min(wanted, self.n) and high < cap:
            low, (high, total) = high, (4.0 * high, self.count(4.0 * high))
        for _ in range(12):
            if total <= 1.15 * wanted + 5:
                break
            middle = (0.5 * (np.sqrt(low) + np.sqrt(high))) ** 2
            inside = self.count(middle)
            if inside >= wanted:
                high, total = middle, inside
            else:
                low = middle
        return high, total

    def _slices(
        self, low: float, high: float, below: int, total: int, count: int | None
    ) -> tuple[Float64, Float64, list[SturmCount]]:
        """Modes of a wide band, slice by slice."""
        edges = self._edges(low, high, below, total)
        values: list[Float64] = []
        shapes: list[Float64] = []
        sturm: list[SturmCount] = []
        found = below
        for (a, at_a), (b, at_b) in pairwise(edges):
            if a == -np.inf:
                part, vectors, _ = self._lowest(at_b, (b, at_b), 0)
            else:
                part, vectors = self._inside(a, b, at_b - at_a)
            order = np.argsort(part)
            values.append(part[order])
            shapes.append(vectors[:, order])
            found += len(part)
            sturm.append(SturmCount(hertz(b), at_b, found))
            self.progress(found - below, total - below)
        chosen = slice(0, count)
        return (
            np.concatenate(values)[chosen],
            np.hstack(shapes)[:, chosen],
            sturm,
        )

    def _edges(
        self, low: float, high: float, below: int, total: int
    ) -> list[tuple[float, int]]:
        """Limits of slices with at most SLICE_MODES modes each, with their counts."""
        if total - below <= SLICE_MODES:
            return [(low, below), (high, total)]
        root = 0.0 if low == -np.inf else np.sqrt(low)
        middle = (0.5 * (root + np.sqrt(high))) ** 2
        inside = self.count(middle)
        left = self._edges(low, middle, below, inside)
        right = self._edges(middle, high, inside, total)
        return left[:-1] + right

    def _inside(self, low: float, high: float, wanted: int) -> tuple[Float64, Float64]:
        """All modes between two limits, by an indefinite shift in the middle."""
        if wanted == 0:
            return np.zeros(0), np.zeros((self.n, 0))
        shift = 0.5 * (low + high)
        with factorize(
            self._shifted(shift), kind="symmetric", solver=self.solver
        ) as factor:
            lanczos = _lanczos(factor.solve, self.mass, wanted)
            chosen = np.zeros(0, dtype=np.intp)
            for attempt in range(_RANDOM_RESTARTS):
                pairs = _grow_between(lanczos, shift, (low, high), wanted)
                values = 1.0 / pairs.theta + shift
                chosen = np.flatnonzero(
                    (values > low) & (values < high) & (pairs.residual < _CONVERGED)
                )
                missing = wanted - len(chosen)
                if missing <= 0 or lanczos.exhausted or attempt == _LAST_ATTEMPT:
                    break
                look_again(lanczos, pairs, missing)
            return values[chosen], lanczos.vectors(pairs, chosen)


def _not_definite(row: int | None) -> ModesError:
    where = "" if row is None else f" (row {row})"
    return ModesError(
        "stiffness with a little mass added is not positive definite: a massless "
        f"mechanism, or negative stiffness or mass{where}"
    )


def _lanczos(
    solve: Callable[[Float64], Float64], mass: sp.csr_matrix, wanted: int
) -> BlockLanczos:
    """An iteration for `wanted` modes: small problems need few columns per block."""
    block = int(np.clip(wanted // 4, 4, 8))
    operator = shift_inverted(solve, mass)
    return BlockLanczos(operator, mass, block=block, reserve=4 * wanted + 64)


def _grow(lanczos: BlockLanczos, wanted: int, progress: Progress) -> RitzPairs:
    """Extend the basis until the `wanted` largest Ritz values have converged."""
    look = min(lanczos.size + wanted, int(1.3 * wanted) + 16)
    while True:
        while lanczos.size < look and not lanczos.exhausted:
            lanczos.extend()
        pairs = _positive(lanczos.ritz())
        bad = np.flatnonzero(pairs.residual > _CONVERGED)
        leading = int(bad[0]) if len(bad) else len(pairs.theta)
        progress(min(leading, wanted), wanted)
        if leading >= wanted or lanczos.exhausted:
            return _first(pairs, leading)
        look = lanczos.size + max(16, lanczos.size // 12)


def _grow_between(
    lanczos: BlockLanczos, shift: float, limits: tuple[float, float], wanted: int
) -> RitzPairs:
    """Extend the basis until `wanted` Ritz values between the limits have converged."""
    look = lanczos.size + int(1.5 * wanted) + 16
    most = lanczos.size + 6 * wanted + 200
    while True:
        while lanczos.size < look and not lanczos.exhausted:
            lanczos.extend()
        pairs = lanczos.ritz()
        with np.errstate(divide="ignore"):
            values = 1.0 / pairs.theta + shift
        inside = (values > limits[0]) & (values < limits[1])
        if (
            np.sum(inside & (pairs.residual < _CONVERGED)) >= wanted
            or lanczos.exhausted
            or lanczos.size > most
        ):
            return pairs
        look = lanczos.size + max(16, lanczos.size // 12)


def look_again(lanczos: BlockLanczos, pairs: RitzPairs, missing: int) -> None:
    """Keep what has converged and search in as many random directions as modes miss."""
    lanczos.keep(pairs, np.flatnonzero(pairs.residual < _CONVERGED))
    lanczos.restart_randomly(missing)
    for _ in range(4):
        lanczos.extend()


def _positive(pairs: RitzPairs) -> RitzPairs:
    """Pairs of a positive operator: round-off below zero belongs to infinite λ."""
    at = pairs.theta > _MASSLESS * max(float(np.max(pairs.theta, initial=0.0)), 0.0)
    return RitzPairs(pairs.theta[at], pairs.coefficients[:, at], pairs.residual[at])


def _first(pairs: RitzPairs, count: int) -> RitzPairs:
    return RitzPairs(
        pairs.theta[:count], pairs.coefficients[:, :count], pairs.residual[:count]
    )


def _gap_above(values: Float64, last: int, noise: float) -> float:
    """A limit above values[last] in a gap (wider than noise) of ascending values."""
    while last + 1 < len(values):
        a, b = values[last], values[last + 1]
        if b - a > max(1e-6 * max(abs(a), abs(b)), noise):
            return float(0.5 * (a + b))
        last += 1
    top = float(values[-1])
    return top + max(1e-3 * abs(top), noise, float(np.finfo(float).tiny))

"""What a direct time integration works on: matrices, load, initial state."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.algebra.extension import CondensedProduct
from fem.algebra.linear_solver import Factorization, Kind, SolverName, factorize
from fem.algebra.sparse_products import SplitMatrix, shape_of
from fem.arrays import Float64


@dataclass(frozen=True)
class TransientLoad:
    """Load patterns times functions of time, for one load case or for several.

    Attributes:
        pattern: (n, k) sparse, spatial distributions on the free set.
        evaluate: times (t,) s -> factors (k, t), or (c, k, t) for c load cases that
            are solved together.
    """

    pattern: sp.csr_matrix
    evaluate: Callable[[Float64], Float64]

    def factors(self, time: Float64) -> Float64:
        """Factors (c, k, t) at times (t,).

        Raises:
            ValueError: their shape does not fit the patterns, or they are not finite.
        """
        values = np.asarray(self.evaluate(time), dtype=float)
        values = values[None] if values.ndim == 2 else values
        _, patterns = shape_of(self.pattern)
        expected = (patterns, len(time))
        if values.ndim != 3 or values.shape[1:] != expected:
            raise ValueError(
                f"load factors have shape {values.shape}, expected (c, *{expected})"
            )
        if not np.isfinite(values).all():
            raise ValueError("load factors hold NaN or infinite values")
        return values


def sampled_load(
    pattern: sp.spmatrix | sp.sparray, time: Float64, factors: Float64
) -> TransientLoad:
    """A load given at instants, linear in between, zero outside.

    Args:
        pattern: (n, k) sparse.
        time: (t,) s, ascending; equal neighbours are a jump.
        factors: (k, t) or (c, k, t).
    """
    time = np.asarray(time, dtype=float)
    factors = np.asarray(factors, dtype=float)
    if time.ndim != 1 or factors.shape[-1:] != time.shape:
        raise ValueError(f"factors {factors.shape} do not fit times {time.shape}")
    if np.any(np.diff(time) < 0.0):
        raise ValueError("times of the load must ascend")

    def evaluate(at: Float64) -> Float64:
        flat = factors.reshape(-1, len(time))
        values = np.stack(
            [np.interp(at, time, row, left=0.0, right=0.0) for row in flat]
        )
        return values.reshape(*factors.shape[:-1], len(at))

    return TransientLoad(sp.csr_matrix(pattern), evaluate)


@dataclass(frozen=True)
class TransientSystem:
    """Matrices of M u'' + B u' + K u = P with their fast products.

    Attributes:
        stiffness, mass: (n, n) K and M.
        damping: B.
        mass_product: M by its diagonal and the rest, or by its factors.
        other_product: B' as diagonal and rest.
        pattern_rows: (r,) rows that the load patterns touch.
        pattern: (r, k) those rows of the patterns.
        kind: of the matrices: "spd", or "general" where they are not symmetric.
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    damping: Damping
    mass_product: SplitMatrix | CondensedProduct
    other_product: SplitMatrix | None
    pattern_rows: npt.NDArray[np.intp]
    pattern: sp.csr_matrix
    solver: SolverName | None
    threads: int | None
    kind: Kind = "spd"

    @classmethod
    def assemble(
        cls,
        stiffness: sp.spmatrix | sp.sparray,
        mass: sp.spmatrix | sp.sparray,
        damping: Damping | sp.spmatrix | sp.sparray | None,
        load: TransientLoad | None,
        *,
        solver: SolverName | None,
        threads: int | None,
        mass_product: CondensedProduct | None = None,
        kind: Kind = "spd",
    ) -> "TransientSystem":
        """Prepare the products."""
        k, m = sp.csr_matrix(stiffness, dtype=float), sp.csr_matrix(mass, dtype=float)
        b = Damping.from_matrix(damping, k)
        n = len(k.indptr) - 1
        pattern = sp.csr_matrix((n, 0)) if load is None else sp.csr_matrix(load.pattern)
        for name, matrix in (("mass", m), ("damping", b.other), ("load", pattern)):
            if matrix is not None and len(matrix.indptr) - 1 != n:
                found = len(matrix.indptr) - 1
                raise ValueError(f"{name} has {found} rows, expected {n}")
        rows = np.flatnonzero(np.diff(pattern.indptr))
        return cls(
            stiffness=k,
            mass=m,
            damping=b,
            mass_product=mass_product or SplitMatrix.from_matrix(m),
            other_product=None if b.other is None else SplitMatrix.from_matrix(b.other),
            pattern_rows=rows,
            pattern=pattern[rows],
            solver=solver,
            threads=threads,
            kind=kind,
        )

    @property
    def size(self) -> int:
        """Number of freedoms."""
        return len(self.stiffness.indptr) - 1

    def combine(self, k: float, m: float, other: float) -> sp.csr_matrix:
        """The matrix k K + m M + other B'."""
        total = k * self.stiffness + m * self.mass
        if self.damping.other is not None:
            total = total + other * self.damping.other
        return sp.csr_matrix(total)

    def factorize(
        self, k: float, m: float, other: float, cases: int | None = None
    ) -> Factorization:
        """Factor of k K + m M + other B', for the steps of so many load cases."""
        return factorize(
            self.combine(k, m, other),
            kind=self.kind,
            solver=self.solver,
            threads=self.threads,
            columns=cases,
        )

    def add_load(self, right: Float64, factors: Float64) -> None:
        """Add patterns times factors (c, k) to right-hand sides (c, n)."""
        if len(self.pattern_rows):
            right[:, self.pattern_rows] += (self.pattern @ factors.T).T

    def add_other(self, right: Float64, scale: float, vectors: Float64) -> None:
        """Add scale B' vectors (c, n) to right-hand sides (c, n)."""
        if self.other_product is not None and scale != 0.0:
            right += scale * self.other_product.dot(vectors)

    def stiffness_times(self, vectors: Float64) -> Float64:
        """K times vectors (c, n); used at starts only."""
        return (self.stiffness @ vectors.T).T

    def damping_times(self, vectors: Float64) -> Float64:
        """B times vectors (c, n); used at starts only."""
        b = self.damping
        result = b.mass_factor * self.mass_product.dot(vectors)
        if b.stiffness_factor != 0.0:
            result += b.stiffness_factor * self.stiffness_times(vectors)
        self.add_other(result, 1.0, vectors)
        return result

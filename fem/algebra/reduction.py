"""Reduction to interface freedoms: Guyan, Craig-Bampton, dynamic reduction.

The free set is split into the a-set, which is kept, and the o-set, which follows:

    u = [u_o; u_a] = [G_oa  Φ; I  0] [u_a; q],   G_oa = -K_oo⁻¹ K_oa

Φ are fixed-interface modes of the o-set, none of them for Guyan. Nastran's generalised
dynamic reduction (ASET with QSET) is the same transformation.

Reference: R. R. Craig, M. C. C. Bampton, "Coupling of substructures for dynamic
analyses", AIAA J. 6, 1968.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.algebra.dynamic_reduction import ritz_modes
from fem.algebra.linear_solver import SingularMatrixError, SolverName, factorize
from fem.algebra.modes import Modes, normal_modes
from fem.arrays import Float64

Rows = npt.NDArray[np.intp]

# Columns solved and multiplied at once.
_CHUNK = 64


@dataclass(frozen=True, kw_only=True)
class Reduction:
    """A reduced structure with a + q freedoms.

    Attributes:
        kept: (a,) rows of the f-set that are kept, in the order of the reduced ones.
        transform: (f, a + q) displacements of the f-set by the reduced freedoms.
        stiffness, mass, damping: (a + q, a + q) reduced matrices, dense, symmetric.
        interior_hz: (q,) frequencies of the fixed-interface modes.
    """

    kept: Rows
    transform: Float64
    stiffness: Float64
    mass: Float64
    damping: Float64
    interior_hz: Float64

    @property
    def size(self) -> int:
        """Number of reduced freedoms."""
        return len(self.stiffness)

    def expand(self, reduced: Float64) -> Float64:
        """(f,) or (f, k) displacements from reduced ones."""
        return self.transform @ reduced

    def load(self, p_f: Float64) -> Float64:
        """Loads on the reduced freedoms from loads on the f-set."""
        return self.transform.T @ p_f


def reduce_guyan(
    stiffness: sp.spmatrix | sp.sparray,
    mass: sp.spmatrix | sp.sparray,
    damping: Damping | sp.spmatrix | sp.sparray | None,
    kept: npt.ArrayLike,
    *,
    solver: SolverName | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Reduction:
    """Static condensation onto kept rows.

    Args:
        stiffness, mass: (f, f) K and M.
        damping: B in any form; None: zero.
        kept: (a,) rows of the f-set, each once.
        solver, threads: as in `fem.algebra.linear_solver.factorize`.
        progress: called with (done, all) columns.

    Raises:
        SingularMatrixError: the o-set moves freely while the a-set is held; `row` is
            of the f-set.
        ValueError: rows that are not in the f-set or given twice.
    """
    return reduce_craig_bampton(
        stiffness,
        mass,
        damping,
        kept,
        count=0,
        solver=solver,
        threads=threads,
        progress=progress,
    )


def reduce_craig_bampton(
    stiffness: sp.spmatrix | sp.sparray,
    mass: sp.spmatrix | sp.sparray,
    damping: Damping | sp.spmatrix | sp.sparray | None,
    kept: npt.ArrayLike,
    *,
    count: int | None = None,
    highest_hz: float | None = None,
    motions: Float64 | None = None,
    solver: SolverName | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Reduction:
    """Condensation onto kept rows and fixed-interface modes.

    Args:
        stiffness, mass, damping, kept, solver, threads, progress: see `reduce_guyan`.
        count: at most this many fixed-interface modes, the lowest.
        highest_hz: only those below this frequency.
        motions: (f, r); given, the modes are approximate ones (generalised dynamic
            reduction), from the inertia forces of these motions; `count` is needed.

    Raises:
        SingularMatrixError, ValueError: see `reduce_guyan`.
    """
    k, m = sp.csr_matrix(stiffness, dtype=float), sp.csr_matrix(mass, dtype=float)
    b = Damping.from_matrix(damping, k)
    n = len(k.indptr) - 1
    a = np.asarray(kept, dtype=np.intp)
    if len(np.unique(a)) != len(a) or np.any((a < 0) | (a >= n)):
        raise ValueError(f"kept rows must be different and within 0 ... {n - 1}")
    o = np.setdiff1d(np.arange(n), a)
    k_oo = sp.csr_matrix(k[o][:, o])
    if motions is None or len(o) == 0:
        modes = _interior_modes(k_oo, m, o, count, highest_hz, solver)
    else:
        m_oo, load = sp.csr_matrix(m[o][:, o]), (m @ motions)[o]
        modes = ritz_modes(k_oo, m_oo, load, count or 0, solver=solver)
    q = 0 if modes is None else modes.count
    transform = np.zeros((n, len(a) + q), order="F")
    transform[a, np.arange(len(a))] = 1.0
    _condense(k_oo, k, a, o, transform, solver, threads, progress)
    if modes is not None:
        transform[o, len(a) :] = modes.shape
    reduced_k = _reduced_stiffness(k, a, transform, modes)
    reduced_m = _product(m, transform)
    reduced_b = b.stiffness_factor * reduced_k + b.mass_factor * reduced_m
    if b.other is not None:
        reduced_b += _product(b.other, transform)
    return Reduction(
        kept=a,
        transform=transform,
        stiffness=reduced_k,
        mass=reduced_m,
        damping=reduced_b,
        interior_hz=np.zeros(0) if modes is None else modes.frequency_hz,
    )


def _interior_modes(
    k_oo: sp.csr_matrix,
    m: sp.csr_matrix,
    o: Rows,
    count: int | None,
    highest_hz: float | None,
    solver: SolverName | None,
) -> Modes | None:
    """Modes of the o-set with the a-set held; None where none are wanted."""
    m_oo = sp.csr_matrix(m[o][:, o])
    no_limit = count is None and highest_hz is None
    if count == 0 or no_limit or len(o) == 0 or not m_oo.diagonal().any():
        return None
    band = None if highest_hz is None else (0.0, highest_hz)
    return normal_modes(k_oo, m_oo, count=count, band=band, solver=solver)


def _condense(
    k_oo: sp.csr_matrix,
    k: sp.csr_matrix,
    a: Rows,
    o: Rows,
    transform: Float64,
    solver: SolverName | None,
    threads: int | None,
    progress: Callable[[int, int], None] | None,
) -> None:
    """Fill G_oa = -K_oo⁻¹ K_oa into the transformation, block by block of columns."""
    if len(o) == 0:
        return
    k_oa = sp.csc_matrix(k[o][:, a])
    try:
        factor = factorize(k_oo, solver=solver, threads=threads)
    except SingularMatrixError as error:
        row = None if error.row is None else int(o[error.row])
        raise SingularMatrixError(row) from None
    with factor:
        for start in range(0, len(a), _CHUNK):
            columns = slice(start, min(start + _CHUNK, len(a)))
            right = np.asfortranarray(k_oa[:, columns].toarray())
            transform[o, columns] = -factor.solve(right) if right.any() else 0.0
            if progress is not None:
                progress(columns.stop, len(a))


def _reduced_stiffness(
    k: sp.csr_matrix, a: Rows, transform: Float64, modes: Modes | None
) -> Float64:
    """K_aa + K_ao G_oa and the eigenvalues of the interior; both uncoupled."""
    size = transform.shape[1]
    reduced = np.zeros((size, size))
    statics = transform[:, : len(a)]
    reduced[: len(a), : len(a)] = k[a] @ statics
    if modes is not None:
        rest = np.arange(len(a), size)
        reduced[rest, rest] = modes.eigenvalue
    return 0.5 * (reduced + reduced.T)


def _product(matrix: sp.csr_matrix, transform: Float64) -> Float64:
    """Tᵀ A T without a copy of the size of T."""
    size = transform.shape[1]
    result = np.empty((size, size))
    for start in range(0, size, _CHUNK):
        columns = slice(start, min(start + _CHUNK, size))
        part = matrix @ np.ascontiguousarray(transform[:, columns])
        result[:, columns] = transform.T @ part
    return 0.5 * (result + result.T)

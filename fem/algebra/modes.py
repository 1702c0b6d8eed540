"""Normal modes K x = λ M x: shift-invert block Lanczos, checked by Sturm counts.

Small problems are solved densely. Larger ones start from a shift below zero, so that
free structures need no support; wide bands are cut into slices with a shift in the
middle of each. Every result carries the counts that show that no mode was missed.

Massless freedoms (M singular) are allowed: only finite eigenvalues are modes.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.eigenproblem import EigenProblem, ModesError, Progress
from fem.algebra.linear_solver import SolverName
from fem.algebra.orthonormal import gram_schmidt, nearest_orthonormal, rank
from fem.algebra.sturm import SturmCount
from fem.arrays import Float64

__all__ = ["Modes", "ModesError", "normal_modes", "rigid_energy"]


# Energy of a motion relative to that of its parts at which it is round-off alone.
_RIGID_ENERGY = 1e-14


@dataclass(frozen=True, kw_only=True)
class Modes:
    """Normal modes, ascending.

    Attributes:
        frequency_hz: (m,) Hz; exactly 0 for motions without strain energy.
        shape: (n, m) mode shapes, X' M X = 1 (mass-normalised); the largest entry of
            each is positive.
        rigid: number of modes without strain energy.
        sturm: the counts that were made, at the limits of the band.
    """

    frequency_hz: Float64
    shape: Float64
    rigid: int
    sturm: tuple[SturmCount, ...]

    @property
    def count(self) -> int:
        """Number of modes."""
        return len(self.frequency_hz)

    @property
    def eigenvalue(self) -> Float64:
        """(m,) ω², rad²/s²."""
        return (2.0 * np.pi * self.frequency_hz) * np.abs(
            2.0 * np.pi * self.frequency_hz
        )


def normal_modes(
    stiffness: sp.spmatrix | sp.sparray,
    mass: sp.spmatrix | sp.sparray,
    *,
    count: int | None = None,
    band: tuple[float | None, float | None] | None = None,
    rigid_body: Float64 | None = None,
    solver: SolverName | None = None,
    progress: Progress | None = None,
) -> Modes:
    """Modes of K x = ω² M x.

    Args:
        stiffness, mass: (n, n) K and M, symmetric, both triangles; K positive
            semi-definite, M too (massless freedoms are allowed).
        count: at most this many modes, the lowest (of the band).
        band: (f1, f2) Hz; None stands for no limit. f1 <= 0 includes the rigid-body
            modes. One of count and f2 is needed.
        rigid_body: (n, r) motions without strain energy that are known, e.g. from the
            geometry. Where they span all such modes they take their place, so that
            these shapes are exact.
        solver: as in `fem.algebra.linear_solver.factorize`.
        progress: called with (converged, wanted) modes.

    Raises:
        ModesError: no mass, or a stiffness or mass with negative energy.
        ValueError: neither count nor an upper limit is given.
    """
    low, high = band if band is not None else (None, None)
    if count is None and high is None:
        raise ValueError("give a count of modes or an upper limit of the band")
    if count is not None and count < 1:
        raise ValueError(f"count of modes is {count}, expected at least 1")
    k, m = sp.csr_matrix(stiffness, dtype=float), sp.csr_matrix(mass, dtype=float)
    if not np.any(m.diagonal() > 0.0):
        raise ModesError(
            "the structure has no mass and therefore no modes; expected densities "
            "(RHO), NSM, CONM2 or CMASS"
        )
    problem = EigenProblem(k, m, solver, progress or (lambda done, wanted: None))
    limits = (
        -np.inf if low is None or low <= 0.0 else (2.0 * np.pi * low) ** 2,
        np.inf if high is None else (2.0 * np.pi * high) ** 2,
    )
    values, shapes, sturm = problem.solve(count, limits)
    return _finish(k, m, values, shapes, sturm, rigid_body)


def _finish(
    k: sp.csr_matrix,
    m: sp.csr_matrix,
    values: Float64,
    shapes: Float64,
    sturm: list[SturmCount],
    rigid_body: Float64 | None,
) -> Modes:
    """Orthonormal shapes, exact zeros for rigid-body motions, fixed signs."""
    shapes = nearest_orthonormal(shapes, m)
    rigid = rigid_energy(k, shapes) <= _RIGID_ENERGY
    values = np.where(rigid, 0.0, values)
    order = np.argsort(values, kind="stable")
    values, shapes = values[order], shapes[:, order]
    count = int(np.sum(rigid))
    if rigid_body is not None and count:
        known = rigid_body[:, rigid_energy(k, rigid_body) <= _RIGID_ENERGY]
        if known.shape[1] >= count and rank(known, m) == count:
            shapes = nearest_orthonormal(
                np.hstack([gram_schmidt(known, m), shapes[:, count:]]), m
            )
    if shapes.size:
        largest = np.argmax(np.abs(shapes), axis=0)
        shapes = shapes * np.sign(shapes[largest, np.arange(shapes.shape[1])])
    return Modes(
        frequency_hz=np.sign(values) * np.sqrt(np.abs(values)) / (2.0 * np.pi),
        shape=np.asfortranarray(shapes),
        rigid=count,
        sturm=tuple(sturm),
    )


def rigid_energy(stiffness: sp.csr_matrix, motion: Float64) -> Float64:
    """Energy x'Kx of motions (n, k) relative to that of their parts |x|'|K||x|, (k,).

    Values near the round-off of double precision mean: no strain energy.
    """
    absolute = abs(stiffness)
    parts = np.einsum("ij,ij->j", np.abs(motion), absolute @ np.abs(motion))
    energy = np.abs(np.einsum("ij,ij->j", motion, stiffness @ motion))
    return energy / np.where(parts > 0.0, parts, 1.0)

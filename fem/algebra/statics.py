"""Static solutions K u = P on the free set: blocks of load cases, inertia relief.

A stiffness matrix whose factorisation succeeds may still be singular up to round-off.
Inverse iteration finds such a motion, and `SingularMatrixError` is raised, instead of
enormous displacements.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.linalg
import scipy.sparse as sp

from fem.algebra.linear_solver import (
    Factorization,
    SingularMatrixError,
    SolverName,
    factorize,
)
from fem.algebra.modes import rigid_energy
from fem.arrays import Float64

# Energy of a motion, relative to that of its parts, that is round-off alone.
_NO_ENERGY = 1e-14
# The same for motions that are known beforehand.
_FREE = 1e-12


def solve_static(
    stiffness: sp.csr_matrix,
    load: Float64,
    *,
    solver: SolverName | None = None,
    threads: int | None = None,
) -> Float64:
    """Displacements (f, c) under loads (f, c), or (f,) under (f,).

    Raises:
        SingularMatrixError: the structure can move without strain energy.
    """
    if not len(load):  # every freedom is constrained
        return np.zeros_like(load)
    with factorize(stiffness, solver=solver, threads=threads) as factor:
        check_regular(stiffness, factor)
        return factor.solve(load)


def check_regular(stiffness: sp.csr_matrix, factor: Factorization) -> None:
    """Refuse a matrix with a motion whose energy is round-off.

    Raises:
        SingularMatrixError: with the row that moves most.
    """
    n = len(stiffness.indptr) - 1
    if n == 0:
        return
    scale = np.maximum(stiffness.diagonal(), np.finfo(float).tiny)
    motion = np.random.default_rng(2).normal(size=(n, 1)) / np.sqrt(scale)[:, None]
    for _ in range(2):
        motion = factor.solve(scale[:, None] * motion)
        largest = np.abs(motion).max()
        if not 0.0 < largest < np.inf:
            raise SingularMatrixError(None)
        motion /= largest
    if rigid_energy(stiffness, motion)[0] < _NO_ENERGY:
        raise SingularMatrixError(int(np.argmax(np.abs(motion[:, 0]))))


@dataclass(frozen=True, kw_only=True)
class InertiaRelief:
    """A free structure under loads that its own inertia balances.

    Attributes:
        displacement: (f, c) relative to the support, or in mean axes.
        acceleration: (r, c) accelerations of the support freedoms.
        balanced: (f, c) loads plus inertia forces.
        motions: (f, r) rigid-body motions that belong to `acceleration`.
    """

    displacement: Float64
    acceleration: Float64
    balanced: Float64
    motions: Float64


def inertia_relief(
    stiffness: sp.csr_matrix,
    mass: sp.csr_matrix,
    load: Float64,
    *,
    support: npt.NDArray[np.intp] | None = None,
    rigid_body: Float64 | None = None,
    solver: SolverName | None = None,
) -> InertiaRelief:
    """Statics of a free structure (PARAM INREL -1 with SUPORT, -2 without).

    The accelerations a of the rigid-body motions R follow from Rᵀ(P - M R a) = 0; under
    loads and inertia forces together the structure is solved on a determinate support.

    Args:
        stiffness, mass: (f, f) K and M.
        load: (f, c).
        support: (r,) rows of the f-set that carry the structure determinately; the
            displacements are relative to them.
        rigid_body: (f, r) motions without energy; used where no support is given.
            Displacements are then in mean axes: mass-orthogonal to these motions.

    Raises:
        SingularMatrixError: the structure moves freely on its support.
        ValueError: the support resists some of its own motions (it is not
            determinate), or neither support nor free motions are given.
    """
    n = len(stiffness.indptr) - 1
    given = support is not None
    if support is None:
        if rigid_body is None:
            raise ValueError("give a support or the rigid-body motions")
        motions = free_motions(stiffness, rigid_body)
        if motions.shape[1] == 0:
            raise ValueError("no rigid-body motion is free: the structure is held")
        support = determinate_rows(motions)
    keep = np.setdiff1d(np.arange(n), support)
    inner = sp.csr_matrix(stiffness[keep][:, keep])
    coupling = stiffness[keep][:, support].toarray()
    with factorize(inner, solver=solver) as factor:
        check_regular(inner, factor)
        motions = np.zeros((n, len(support)))
        motions[support, np.arange(len(support))] = 1.0
        motions[keep] = -factor.solve(coupling)
        if rigid_energy(stiffness, motions).max(initial=0.0) > 1e-8:
            raise ValueError(
                "the support resists rigid-body motions of the structure; it must hold "
                "it determinately, and no other constraint may hold it"
            )
        heavy = mass @ motions
        acceleration = _acceleration(motions.T @ heavy, motions.T @ load)
        balanced = load - heavy @ acceleration
        u = np.zeros_like(balanced)
        u[keep] = factor.solve(balanced[keep])
    if not given:
        u -= motions @ _acceleration(motions.T @ heavy, heavy.T @ u)
    return InertiaRelief(
        displacement=u, acceleration=acceleration, balanced=balanced, motions=motions
    )


def _acceleration(rigid_mass: Float64, load: Float64) -> Float64:
    """(r, c) of rigid masses (r, r) under loads (r, c).

    A motion without inertia, as the roll of masses on a line, has no acceleration where
    no load acts along it.

    Raises:
        ValueError: a load acts along such a motion.
    """
    size = np.sqrt(np.diag(rigid_mass))
    scale = 1.0 / np.where(size > 0.0, size, 1.0)
    weighted = scale[:, None] * load
    values, vectors = np.linalg.eigh(scale[:, None] * rigid_mass * scale)
    massless = values < _NO_INERTIA * values.max(initial=0.0)
    along = np.abs(vectors[:, massless].T @ weighted)
    if (along > _UNLOADED * np.abs(weighted).max(axis=0, initial=0.0)).any():
        raise ValueError(
            "a load turns or moves the structure along a rigid-body motion that has no "
            "inertia; expected masses off that line (CONM2 with inertia, offsets)"
        )
    kept = vectors[:, ~massless]
    return scale[:, None] * (kept @ ((kept.T @ weighted).T / values[~massless]).T)


# Inertia over the largest that is none, with masses scaled to one; load that is none.
_NO_INERTIA, _UNLOADED = 1e-12, 1e-9


def free_motions(stiffness: sp.csr_matrix, rigid_body: Float64) -> Float64:
    """Combinations of rigid-body motions (f, r) that cost no energy, (f, k)."""
    if rigid_body.shape[1] == 0:
        return rigid_body
    size = np.linalg.norm(rigid_body, axis=0)
    scaled = rigid_body / np.where(size > 0.0, size, 1.0)
    energy = scaled.T @ (stiffness @ scaled)
    values, vectors = np.linalg.eigh(0.5 * (energy + energy.T))
    parts = np.einsum("ij,ij->j", np.abs(scaled), abs(stiffness) @ np.abs(scaled))
    return scaled @ vectors[:, values <= _FREE * parts.max()]


def determinate_rows(motions: Float64) -> npt.NDArray[np.intp]:
    """(r,) rows that hold motions (f, r) determinately, well conditioned."""
    scaled = motions / np.linalg.norm(motions, axis=0)
    pivots = scipy.linalg.qr(scaled.T, mode="economic", pivoting=True)[-1]
    return np.sort(np.asarray(pivots)[: motions.shape[1]])

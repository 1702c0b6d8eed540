"""Naming what moves when a stiffness matrix is singular.

Motions without strain energy are found by inverse iteration on a slightly stiffened
matrix, piece by piece of what hangs together. A motion counts where its energy is
round-off compared to that of its parts, so that soft but sound structures pass.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from fem.algebra.linear_solver import SingularMatrixError, SolverName, factorize
from fem.arrays import Float64, Int64
from fem.constraints.autospc import grouped

# Stiffening relative to the diagonal, energy that counts as none, share that moves.
_STIFFENING = 1e-9
_NO_ENERGY = 1e-13
_MOVES = 1e-3
_SWEEPS = 4
_FIRST_BLOCK = 12


@dataclass(frozen=True)
class Mechanism:
    """Motions without strain energy of one connected piece.

    Attributes:
        rows: (k,) rows that move, ascending.
        motions: (n, r) independent motions, largest entry 1.
        whole: whether every row of the piece moves.
        everything: whether the piece is the whole structure.
    """

    rows: Int64
    motions: Float64
    whole: bool
    everything: bool = False


def find_mechanisms(
    stiffness: sp.csr_matrix,
    *,
    solver: SolverName | None = None,
    mass: sp.csr_matrix | None = None,
    point: npt.NDArray[np.int64] | None = None,
) -> list[Mechanism]:
    """Motions of the free set that cost no energy, one entry per connected piece.

    Args:
        stiffness: (n, n) K, positive semi-definite.
        solver: as in `factorize`.
        mass: (n, n) M; given, motions that move mass are not counted (they are no
            mechanism in a dynamic solution).
        point: (n,) number of the grid of each row; a grid hangs together, but for its
            freedoms without any stiffness.
    """
    matrix = stiffness if mass is None else _dynamic(stiffness, mass)
    count, piece = connected_components(_graph(matrix, point), directed=False)
    motions = _null_motions(matrix, solver)
    if motions.shape[1] == 0:
        return []
    found = []
    moving = np.abs(motions) > _MOVES * np.abs(motions).max(axis=0)
    for number in np.unique(piece[moving.any(axis=1)]) if count > 1 else [0]:
        inside = piece == number
        part = motions * inside[:, None]
        part = _independent(part[:, np.abs(part).max(axis=0) > _MOVES])
        rows = np.flatnonzero((np.abs(part) > _MOVES).any(axis=1))
        if len(rows):
            whole = len(rows) == int(inside.sum())
            found.append(Mechanism(rows, part, whole, len(rows) == len(motions)))
    return found


def _graph(matrix: sp.csr_matrix, point: npt.NDArray[np.int64] | None) -> sp.csr_matrix:
    """Which rows hang together."""
    if point is None:
        return matrix
    held = np.flatnonzero(matrix.diagonal() != 0.0)
    order = held[np.argsort(point[held], kind="stable")]
    same = point[order[1:]] == point[order[:-1]]
    a, b = order[:-1][same], order[1:][same]
    links = sp.csr_matrix((np.ones(len(a)), (a, b)), shape=matrix.shape)
    return sp.csr_matrix(abs(matrix) + links)


def _independent(motions: Float64) -> Float64:
    """Independent motions of the same span, largest entry 1."""
    basis, size, _ = np.linalg.svd(motions, full_matrices=False)
    basis = basis[:, size > _MOVES * size.max(initial=0.0)]
    return basis / np.abs(basis).max(axis=0)


def _dynamic(stiffness: sp.csr_matrix, mass: sp.csr_matrix) -> sp.csr_matrix:
    """K with so much M that moving mass is not free of energy."""
    k, m = stiffness.diagonal().max(initial=0.0), mass.diagonal().max(initial=0.0)
    return sp.csr_matrix(stiffness + (k / m if m > 0.0 else 0.0) * mass)


def _null_motions(matrix: sp.csr_matrix, solver: SolverName | None) -> Float64:
    """(n, r) independent motions without energy, largest entry 1."""
    n = len(matrix.indptr) - 1
    diagonal = matrix.diagonal()
    largest = diagonal.max(initial=0.0)
    scale = np.where(diagonal > 0.0, diagonal, largest if largest > 0.0 else 1.0)
    # Of unit diagonal: freedoms of very different stiffness are stiffened alike.
    weight = 1.0 / np.sqrt(scale)
    even = sp.diags(weight)
    stiffened = sp.csr_matrix(even @ matrix @ even + _STIFFENING * sp.eye(n))
    try:
        factor = factorize(stiffened, kind="symmetric", solver=solver)
    except SingularMatrixError:
        return np.zeros((n, 0))

    def solve(load: Float64) -> Float64:
        return weight[:, None] * factor.solve(weight[:, None] * load)

    with factor:
        block = min(_FIRST_BLOCK, n)
        while True:
            motions = _smallest(solve, matrix, scale, block)
            if motions.shape[1] < block or block == n:
                return motions
            block = min(4 * block, n)


def _smallest(
    solve: Callable[[Float64], Float64],
    matrix: sp.csr_matrix,
    scale: Float64,
    block: int,
) -> Float64:
    """Motions without energy in the span of inverse iterates."""
    vectors = np.random.default_rng(1).normal(size=(len(scale), block))
    for _ in range(_SWEEPS):
        vectors = solve(scale[:, None] * vectors)
        vectors, _ = np.linalg.qr(np.sqrt(scale)[:, None] * vectors)
        vectors /= np.sqrt(scale)[:, None]
    reduced = vectors.T @ (matrix @ vectors)
    _, rotation = np.linalg.eigh(0.5 * (reduced + reduced.T))
    vectors = vectors @ rotation
    # Rows without any stiffness have no parts to compare with: the scale serves.
    parts = np.einsum("ij,ij->j", np.abs(vectors), abs(matrix) @ np.abs(vectors))
    size = np.maximum(parts, scale @ vectors**2)
    energy = np.abs(np.einsum("ij,ij->j", vectors, matrix @ vectors))
    vectors = vectors[:, energy < _NO_ENERGY * size]
    return vectors / np.abs(vectors).max(axis=0, initial=1e-300)


def describe(
    mechanisms: list[Mechanism],
    label: Callable[[int], str],
    *,
    most: int = 12,
    dynamic: bool = False,
) -> list[str]:
    """Lines that say how many motions there are, and what moves.

    Args:
        mechanisms: from `find_mechanisms`.
        label: name of a row, "grid 12 T3".
        most: grids or scalar points per line.
        dynamic: the motions have no mass either.
    """
    lacking = "stiffness and mass" if dynamic else "stiffness"
    loose = [int(m.rows[0]) for m in mechanisms if m.whole and len(m.rows) == 1]
    lines = []
    if loose:
        names = grouped([label(row) for row in loose], most)
        lines.append(f"{len(loose)} freedoms without any {lacking}: {names}")
    for mechanism in mechanisms:
        if mechanism.whole and len(mechanism.rows) == 1:
            continue
        count = mechanism.motions.shape[1]
        what = "motion" if count == 1 else "motions"
        where = f"{len(mechanism.rows)} freedoms"
        if mechanism.everything:
            where = "the whole structure"
        elif mechanism.whole:
            where = "a piece that nothing connects or holds"
        names = grouped([label(int(row)) for row in mechanism.rows], most)
        lines.append(f"{count} {what} without {lacking} of {where}: {names}")
    if not dynamic and any(m.everything for m in mechanisms):
        lines.append(
            "hold the structure by SPC; a free one may be balanced by its inertia with "
            "PARAM,INREL,-2"
        )
    return lines

"""The solve for the loads between fittings and nodes; the law is in `attachment`."""

import math

import numpy as np
import numpy.typing as npt

from systems.tools.compiled import compiled
from systems.tools.vectors import rotation_matrix, rotation_vector

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@compiled
def fitting_gaps(
    state: Float64,
    positions: Int64,
    velocities: Int64,
    pose: Float64,
    velocity: Float64,
) -> tuple[Float64, Float64, Float64, Float64]:
    """Fittings relative to nodes.

    Args:
        state: positions and velocities of the plant.
        positions: (k,) first of the fitting's quaternion and place.
        velocities: (k,) first of the fitting's velocity.
        pose, velocity: (12 k,), (6 k,) of the nodes.

    Returns:
        (k, 2, 6) rotation and translation, and their rates; (6 k,) and (6 k,) the same,
        apart; (k, 3, 3) R_WF.
    """
    k = len(positions)
    gap, rate, turns = np.empty((k, 6)), np.empty((k, 6)), np.empty((k, 3, 3))
    both = np.empty((k, 2, 6))
    relative = np.empty((3, 3))
    for i in range(k):
        q, v = positions[i], velocities[i]
        R = rotation_matrix(state[q], state[q + 1], state[q + 2], state[q + 3])
        turns[i] = R
        for c in range(3):
            for d in range(3):
                total = 0.0
                for f in range(3):
                    total += R[c, f] * pose[12 * i + 3 * d + f]
                relative[c, d] = total
        turn = rotation_vector(relative)
        for c in range(3):
            gap[i, c] = turn[c]
            gap[i, 3 + c] = state[q + 4 + c] - pose[12 * i + 9 + c]
        for c in range(6):
            rate[i, c] = state[v + c] - velocity[6 * i + c]
        both[i, 0], both[i, 1] = gap[i], rate[i]
    return both, gap.ravel(), rate.ravel(), turns


@compiled
def plain_load(
    mass: Float64,
    force: Float64,
    rows: Int64,
    starts: Int64,
    compliance: Float64,
    acceleration: Float64,
    gap: Float64,
    rate: Float64,
    alpha: float,
    beta: float,
) -> Float64:
    """(m,) loads on fittings, each held rigidly at one node; see `attachment`.

    Args:
        mass, force, rows, starts: see `fitting_response`.
        compliance: (m²,) of the nodes.
        acceleration: (m,) of the nodes without the loads.
        gap, rate: (m,).
        alpha, beta: Baumgarte's rates, 1/s.
    """
    A, wanted = fitting_response(mass, force, rows, starts)
    m = len(wanted)
    for i in range(m):
        for j in range(m):
            A[i, j] += compliance[m * i + j]
        stabilised = 2.0 * alpha * rate[i] + beta * beta * gap[i]
        wanted[i] = acceleration[i] - wanted[i] - stabilised
    return solve_positive(A, wanted)


@compiled
def fitting_response(
    mass: Float64, force: Float64, rows: Int64, starts: Int64
) -> tuple[Float64, Float64]:
    """What the fittings do under wrenches on them, and without.

    Args:
        mass: (nv, nv) of the plant: one diagonal block for each fitting and what it
            carries.
        force: (nv,) of everything but the attachments.
        rows: (m,) velocities of the fittings.
        starts: (f + 1,) first row of each block, and nv.

    Returns:
        (m, m) accelerations per wrench and (m,) free accelerations, W.
    """
    nv, m = len(force), len(rows)
    A, out = mass.copy(), np.zeros((m, m))
    free, b = force.copy(), np.empty(nv)
    for g in range(len(starts) - 1):
        start, end = starts[g], starts[g + 1]
        _factorise(A, start, end)
        _solve(A, free, start, end)
        for j in range(m):
            if start <= rows[j] < end:
                for i in range(start, end):
                    b[i] = 0.0
                b[rows[j]] = 1.0
                _solve(A, b, start, end)
                for i in range(m):
                    if start <= rows[i] < end:
                        out[i, j] = b[rows[i]]
    return out, free[rows]


@compiled
def solve_positive(A: Float64, b: Float64) -> Float64:
    """Solution of A x = b for a symmetric positive definite A; NaN if it is not."""
    L, x = A.copy(), b.copy()
    _factorise(L, 0, len(b))
    _solve(L, x, 0, len(b))
    return x


@compiled
def _factorise(A: Float64, start: int, end: int) -> None:
    """Cholesky factor of a diagonal block of A, in place of its lower triangle."""
    for j in range(start, end):
        total = A[j, j]
        for f in range(start, j):
            total -= A[j, f] * A[j, f]
        # NaN where there is no root, compiled and in plain Python alike.
        pivot = math.sqrt(total) if total > 0.0 else math.nan
        A[j, j] = pivot
        for i in range(j + 1, end):
            total = A[i, j]
            for f in range(start, j):
                total -= A[i, f] * A[j, f]
            A[i, j] = total / pivot


@compiled
def _solve(L: Float64, b: Float64, start: int, end: int) -> None:
    """Rows start to end of b, in place, with the factor of `_factorise`."""
    for i in range(start, end):
        for f in range(start, i):
            b[i] -= L[i, f] * b[f]
        b[i] /= L[i, i]
    for i in range(end - 1, start - 1, -1):
        for f in range(i + 1, end):
            b[i] -= L[f, i] * b[f]
        b[i] /= L[i, i]

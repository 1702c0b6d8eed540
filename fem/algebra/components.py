"""Reduction of parts of a structure one after the other, on its own matrices.

The interior of a part is coupled to its boundary alone, so that the blocks K_oo, K_oa
of the whole are those of the part: each part is condensed as `reduction` does it, and
its boundary and modal coordinates take the place of its interior.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.linear_solver import SolverName
from fem.algebra.reduction import reduce_craig_bampton
from fem.arrays import Int64


@dataclass(frozen=True, kw_only=True)
class Component:
    """Reduced matrices of a part.

    Attributes:
        interior: (o,) rows of the f-set.
        count: modes with the boundary held, 0: none.
        highest_hz: their limit.
        generalised: (q,) rows of the g-set that the modes stand for, at most `count`.
    """

    interior: Int64
    count: int = 0
    highest_hz: float | None = None
    generalised: Int64


@dataclass(frozen=True, kw_only=True)
class Condensed:
    """A structure whose parts are reduced.

    Attributes:
        stiffness, mass, damping: (n, n).
        transform: (f, n) displacements of the f-set.
        rows: (n,) row of the f-set of each freedom, -1 for those of modes.
        generalised: (n,) row of the g-set of each modal freedom, -1 for others.
        modes: number of modes of each part.
    """

    stiffness: sp.csr_matrix
    mass: sp.csr_matrix
    damping: sp.csr_matrix
    transform: sp.csr_matrix
    rows: Int64
    generalised: Int64
    modes: tuple[int, ...] = ()


def condense(
    stiffness: sp.csr_matrix,
    mass: sp.csr_matrix,
    damping: sp.csr_matrix,
    components: Sequence[Component],
    *,
    solver: SolverName | None = None,
) -> Condensed:
    """Reduce parts in turn; the boundary of one may be interior of the next.

    Raises:
        SingularMatrixError: an interior moves freely while its boundary is held.
    """
    n = len(stiffness.indptr) - 1
    found = Condensed(
        stiffness=stiffness,
        mass=mass,
        damping=damping,
        transform=sp.csr_matrix(sp.identity(n)),
        rows=np.arange(n),
        generalised=np.full(n, -1),
    )
    for component in components:
        found = _step(found, component, solver)
    return found


def _step(
    whole: Condensed, component: Component, solver: SolverName | None
) -> Condensed:
    inside = np.isin(whole.rows, component.interior)
    o, rest = np.flatnonzero(inside), np.flatnonzero(~inside)
    if not len(o):
        return whole
    matrices = (whole.stiffness, whole.mass, whole.damping)
    coupled = np.zeros(len(inside), bool)
    for matrix in matrices:
        coupled[np.unique(sp.csr_matrix(matrix[o]).indices)] = True
    a = np.flatnonzero(coupled & ~inside)
    own = np.concatenate([o, a])
    k, m, b = (sp.csr_matrix(matrix[own][:, own]) for matrix in matrices)
    reduced = reduce_craig_bampton(
        k,
        m,
        b,
        np.arange(len(o), len(own)),
        count=component.count,
        highest_hz=component.highest_hz,
        solver=solver,
    )
    q = len(reduced.interior_hz)
    at = np.concatenate([np.searchsorted(rest, a), len(rest) + np.arange(q)])

    def joined(matrix: sp.csr_matrix, small: np.ndarray) -> sp.csr_matrix:
        """What is left of a matrix, with the part's reduced one in place of its own."""
        kept = sp.coo_matrix(matrix[rest][:, rest])
        boundary = np.isin(rest, a)
        other = ~(boundary[kept.row] & boundary[kept.col])
        i, j = np.meshgrid(at, at, indexing="ij")
        value = np.concatenate([kept.data[other], small.ravel()])
        row = np.concatenate([kept.row[other], i.ravel()])
        column = np.concatenate([kept.col[other], j.ravel()])
        size = len(rest) + q
        return sp.csr_matrix((value, (row, column)), shape=(size, size))

    follow = sp.coo_matrix(reduced.transform[: len(o)])
    step = sp.csr_matrix(
        (
            np.concatenate([np.ones(len(rest)), follow.data]),
            (
                np.concatenate([rest, o[follow.row]]),
                np.concatenate([np.arange(len(rest)), at[follow.col]]),
            ),
        ),
        shape=(len(inside), len(rest) + q),
    )
    names = component.generalised[:q]
    names = np.concatenate([names, np.full(q - len(names), -1)])
    return Condensed(
        stiffness=joined(whole.stiffness, reduced.stiffness),
        mass=joined(whole.mass, reduced.mass),
        damping=joined(whole.damping, reduced.damping),
        transform=sp.csr_matrix(whole.transform @ step),
        rows=np.concatenate([whole.rows[rest], np.full(q, -1)]),
        generalised=np.concatenate([whole.generalised[rest], names]),
        modes=(*whole.modes, q),
    )

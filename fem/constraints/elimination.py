"""Elimination of all constraints: u_g = T u_f + S u_s.

Dependent freedoms (m-set) may depend on other dependent ones; they are substituted
until only independent ones are left. What is then fixed or enforced is the s-set, the
rest is free (f-set). Forces of constraint follow from the residual of the g-set.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from fem.arrays import Float64, Int64
from fem.constraints.equations import Equations, concatenate
from fem.constraints.feet import read_feet
from fem.constraints.mpc import read_mpc
from fem.constraints.rbe3 import read_rbe3
from fem.constraints.rigid import read_rbe2
from fem.constraints.rigid_bodies import read_bodies
from fem.constraints.shell_to_solid import read_shell_to_solid
from fem.constraints.spc import SinglePointConstraints, read_spc
from fem.constraints.spline import read_splines
from fem.errors import InputError, Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class Elimination:
    """Sets of freedoms and the map from the free ones to all.

    Attributes:
        size: number g of rows of the g-set.
        m: (m,) dependent rows, ascending.
        s: (s,) fixed or enforced rows, ascending.
        enforced: (s,) their displacements, displacement frames.
        dependence: (m, g) csr, u_m = dependence u_g, columns without m.
        extra: (e,) rows of extra points, which are in no other set.
    """

    size: int
    m: Int64
    s: Int64
    enforced: Float64
    dependence: sp.csr_matrix
    extra: Int64 = field(default_factory=lambda: np.zeros(0, np.int64))

    @cached_property
    def f(self) -> Int64:
        """(f,) free rows, ascending."""
        free = np.ones(self.size, bool)
        free[self.m] = False
        free[self.s] = False
        free[self.extra] = False
        return np.flatnonzero(free)

    @cached_property
    def T(self) -> sp.csr_matrix:
        """(g, f) displacements of all by those of the free rows."""
        return self._columns(self.f)

    @cached_property
    def S(self) -> sp.csr_matrix:
        """(g, s) displacements of all by those of the s-set."""
        return self._columns(self.s)

    @property
    def u_0(self) -> Float64:
        """(g,) displacements with all free rows at rest."""
        return self.S @ self.enforced

    def reduce(self, matrix: sp.csr_matrix) -> sp.csr_matrix:
        """(f, f) Tᵀ matrix T, exactly symmetric where the matrix is symmetric."""
        if not len(self.m):
            return matrix[self.f][:, self.f]
        reduced = sp.csr_matrix(self.T.T @ (matrix @ self.T))
        upper = sp.triu(reduced, format="csr")
        return sp.csr_matrix(upper + sp.triu(upper, 1).T)

    def with_enforced(self, dof: Int64, value: Float64) -> "Elimination":
        """Copy with other displacements of rows of the s-set (SPCD).

        Raises:
            InputError: rows that are not in the s-set.
        """
        loose = ~np.isin(dof, self.s)
        if loose.any():
            raise InputError(
                f"SPCD enforces {int(loose.sum())} freedoms that no SPC constrains"
            )
        enforced = self.enforced.copy()
        enforced[np.searchsorted(self.s, dof)] = value
        return replace(self, enforced=enforced)

    def with_fixed(self, dof: Int64) -> "Elimination":
        """Copy with further rows fixed at zero (AUTOSPC)."""
        s = np.union1d(self.s, dof)
        enforced = np.zeros(len(s))
        enforced[np.searchsorted(s, self.s)] = self.enforced
        return replace(self, s=s, enforced=enforced)

    def mpc_force(self, residual: Float64) -> Float64:
        """Forces of rigid elements and MPC, (g,) or (g, k), from residuals.

        Args:
            residual: forces that the constraints exert, K u + B v + M a - P, of the
                g-set.
        """
        force = np.zeros_like(residual)
        force[self.m] = residual[self.m]
        return force - self.dependence.T @ residual[self.m]

    def spc_force(self, residual: Float64) -> Float64:
        """Forces of SPC, PS and AUTOSPC, (g,) or (g, k), zero off the s-set."""
        force = np.zeros_like(residual)
        force[self.s] = (residual - self.mpc_force(residual))[self.s]
        return force

    def _columns(self, keep: Int64) -> sp.csr_matrix:
        """(g, k) identity on `keep`, dependence on the m-set."""
        k = len(keep)
        unit = sp.csr_matrix((np.ones(k), (keep, np.arange(k))), shape=(self.size, k))
        if not len(self.m):
            return unit
        return sp.csr_matrix(unit + self._spread @ (self.dependence @ unit))

    @cached_property
    def _spread(self) -> sp.csr_matrix:
        """(g, m) places of the dependent rows."""
        m = len(self.m)
        return sp.csr_matrix((np.ones(m), (self.m, np.arange(m))), (self.size, m))


def eliminate(
    deck: "Deck", points: Points, *, spc: int = 0, mpc: int = 0
) -> Elimination:
    """Elimination of all constraints of a subcase.

    Args:
        deck: the deck.
        points: its points.
        spc, mpc: sets that case control selects, 0 for none.

    Raises:
        InputError: bad references, freedoms that depend twice, on each other without a
            solution, or that are dependent and constrained; all with grid and card.
    """
    problems = Problems()
    equations: list[Equations] = []
    fixed = None
    with problems.gathered():
        equations = constraint_equations(deck, points, mpc)
    with problems.gathered():
        fixed = read_spc(deck, points, spc)
    problems.report()
    assert fixed is not None
    return eliminate_equations(points, concatenate(equations), fixed)


def constraint_equations(deck: "Deck", points: Points, mpc: int) -> list[Equations]:
    """Equations of rigid elements, feet of connectors and MPC set `mpc`, as given.

    Raises:
        InputError: bad references, all of them.
    """
    problems = Problems()
    equations: list[Equations] = []
    for read in (
        lambda: read_rbe2(deck, points),
        lambda: read_bodies(deck, points),
        lambda: read_splines(deck, points),
        lambda: read_rbe3(deck, points),
        lambda: read_shell_to_solid(deck, points),
        lambda: read_mpc(deck, points, mpc),
        lambda: read_feet(deck, points),
    ):
        with problems.gathered():
            equations += read()
    problems.report()
    return equations


def eliminate_equations(
    points: Points, equations: Equations, fixed: SinglePointConstraints
) -> Elimination:
    """Elimination of given equations and single-point constraints.

    Raises:
        InputError: see `eliminate`.
    """
    _refuse_conflicts(points, equations, fixed)
    order = np.argsort(equations.dependent, kind="stable")
    m = equations.dependent[order]
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    given = sp.csr_matrix(
        (equations.value, (place[equations.row], equations.column)),
        shape=(len(m), points.size),
    )
    sources = [equations.source[i] for i in order]
    return Elimination(
        size=points.size,
        m=m,
        s=fixed.dof,
        enforced=fixed.value,
        dependence=_substitute(points, m, given, sources),
        extra=points.extra_dof,
    )


def _refuse_conflicts(
    points: Points, equations: Equations, fixed: SinglePointConstraints
) -> None:
    named = {*equations.dependent, *equations.column, *fixed.dof}
    problems = [
        f"{points.label(dof)}: an extra point cannot be constrained; TF relates it to "
        "others"
        for dof in points.extra_dof.tolist()
        if dof in named
    ]
    users: dict[int, list[str]] = {}
    for dof, source in zip(equations.dependent.tolist(), equations.source):
        users.setdefault(dof, []).append(source)
    problems += [
        f"{points.label(dof)} is dependent in {' and in '.join(sources)}; a freedom "
        "can depend once only"
        for dof, sources in users.items()
        if len(sources) > 1
    ]
    for dof, source in zip(fixed.dof.tolist(), fixed.source):
        if dof in users:
            problems.append(
                f"{points.label(dof)} is dependent in {users[dof][0]} and constrained "
                f"by {source}; constrain the independent grid instead"
            )
    if problems:
        raise InputError(problems)


def _substitute(
    points: Points, m: Int64, given: sp.csr_matrix, sources: Sequence[str]
) -> sp.csr_matrix:
    """Dependence on independent freedoms alone: (I - G_mm) u_m = G_mn u_n solved.

    Chains are followed as long as they are; freedoms that depend on each other are
    solved together in small dense blocks.
    """
    if not len(m):
        return given
    among = sp.csr_matrix(given.tocsc()[:, m])
    keep = np.ones(points.size)
    keep[m] = 0.0
    result = sp.csr_matrix(given @ sp.diags(keep))
    if among.nnz:
        solve, among = _solve_loops(points, m, among, sources)
        result = term = sp.csr_matrix(solve @ result)
        while term.nnz:
            term = sp.csr_matrix(among @ term)
            term.eliminate_zeros()
            result = sp.csr_matrix(result + term)
    result.eliminate_zeros()
    return result


def _solve_loops(
    points: Points, m: Int64, among: sp.csr_matrix, sources: Sequence[str]
) -> tuple[sp.csr_matrix, sp.csr_matrix]:
    """Inverse D⁻¹ of the loops' blocks of I - G_mm, and what is left, D⁻¹ (D - I + G).

    What is left has no loops, so that its powers end.
    """
    count, group = connected_components(among, directed=True, connection="strong")
    size = np.bincount(group, minlength=count)
    looped = np.flatnonzero((size[group] > 1) | (among.diagonal() != 0.0))
    if not len(looped):
        return sp.csr_matrix(sp.identity(len(m))), among
    identity = sp.lil_matrix(sp.identity(len(m)))
    inside = among.tocoo()
    same = group[inside.row] == group[inside.col]
    block = sp.csr_matrix(
        (inside.data[same], (inside.row[same], inside.col[same])), shape=among.shape
    )
    problems = Problems()
    for g in np.unique(group[looped]):
        rows = np.flatnonzero(group == g)
        local = np.eye(len(rows)) - _dense(block, rows)
        if np.linalg.cond(local) > 1e10:
            names = ", ".join(points.label(int(m[r])) for r in rows[:6])
            cards = ", ".join(dict.fromkeys(sources[r] for r in rows))
            problems.append(
                f"{names} depend on each other in a cycle without a solution ({cards})"
            )
            continue
        identity[np.ix_(rows, rows)] = np.linalg.inv(local)
    problems.report()
    solve = sp.csr_matrix(identity)
    return solve, sp.csr_matrix(solve @ (among - block))


def _dense(matrix: sp.csr_matrix, rows: Int64) -> Float64:
    """(k, k) part of a sparse matrix."""
    part = sp.csr_matrix(matrix[rows])
    return part[:, rows].toarray()

"""Rigid bodies of a few grids: six freedoms move all others; rigid rods.

RBAR, RBAR1, RJOINT (a joint lets go of the components that CB leaves out), RTRPLT,
RTRPLT1, RBE1; RROD keeps the distance of two grids, one translation depends.
"""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.constraints.equations import (
    Equations,
    components,
    dense_equations,
    equations_of_rows,
)
from fem.errors import InputError
from fem.geometry.points import Points, grid_freedoms
from fem.geometry.rigid_motion import rigid_motion

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_bodies(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all rigid bodies of a few grids, and of rigid rods.

    Raises:
        InputError: undefined grids, independent components that are not six or do not
            determine a rigid motion, rods without length or across their freedom; all.
    """
    makers = {"RBAR": _rbar, "RBE1": _rbe1, "RROD": _rrod}
    return equations_of_rows(deck, points, makers)


def _rbar(row: pd.Series, points: Points, source: str) -> Equations:
    at = points.rows([row["ga"], row["gb"]])
    independent = _of(at, (row["cna"], row["cnb"]))
    dependent = _of(at, (row["cma"], row["cmb"]))
    return _body(points, at, independent, dependent, source)


def _rbe1(row: pd.Series, points: Points, source: str) -> Equations:
    at = points.rows(np.asarray(row["grids"], np.int64))
    independent = _of(points.rows(row["ns"]), row["cns"])
    dependent = _of(points.rows(row["ms"]), row["cms"])
    return _body(points, at, independent, dependent, source)


def _of(at: Int64, digits: tuple[object, ...]) -> Int64:
    """Rows of the g-set."""
    parts = [6 * a + components(c) for a, c in zip(at, digits)]
    return np.concatenate([np.zeros(0, np.int64), *parts])


def _body(
    points: Points, at: Int64, independent: Int64, dependent: Int64, source: str
) -> Equations:
    """Six independent rows of the g-set move the dependent ones, by default all."""
    every = grid_freedoms(at)
    if not len(dependent):
        dependent = np.setdiff1d(every, independent)
    if len(independent) != 6:
        raise InputError(
            f"{len(independent)} independent components, expected 6 in all"
        )
    if len(np.intersect1d(independent, dependent)):
        raise InputError("a component is both independent and dependent")
    arm = points.xyz[at] - points.xyz[at[0]]
    motion = rigid_motion(arm, points.rotation[at]).reshape(-1, 6)
    place = {int(dof): k for k, dof in enumerate(every)}
    lever = np.linalg.norm(arm, axis=1).max() or 1.0
    motion = motion * np.repeat([1.0, 1.0 / lever], 3)
    chosen = motion[[place[int(dof)] for dof in independent]]
    if np.linalg.cond(chosen / np.linalg.norm(chosen, axis=1, keepdims=True)) > 1e10:
        raise InputError("the independent components do not determine a rigid motion")
    moved = motion[[place[int(dof)] for dof in dependent]]
    matrix = np.linalg.solve(chosen.T, moved.T).T
    # Rounding of the solve; such entries would make chains of constraints fill.
    matrix[np.abs(matrix) < 1e-14 * np.abs(matrix).max()] = 0.0
    return dense_equations(dependent, independent, matrix, source)


def _rrod(row: pd.Series, points: Points, source: str) -> Equations:
    at = points.rows([row["ga"], row["gb"]])
    line = points.xyz[at[1]] - points.xyz[at[0]]
    length = np.linalg.norm(line)
    if not length:
        raise InputError("its grids coincide, expected a line between them")
    chosen = _of(at, (row["cma"], row["cmb"]))
    if len(chosen) != 1 or chosen[0] % 6 > 2:
        raise InputError(
            f"CMA '{row['cma']}' and CMB '{row['cmb']}', expected one of 1, 2, 3 in "
            "one of them"
        )
    along = np.einsum("kij,i->kj", points.rotation[at], line / length)
    dof = grid_freedoms(at, 3)
    equation = np.concatenate([-along[0], along[1]])
    own = dof == chosen[0]
    if np.abs(equation[own]) < 1e-6:
        raise InputError("the dependent component lies across the rod")
    matrix = -equation[None, ~own] / equation[own]
    matrix[np.abs(matrix) < 1e-14] = 0.0
    return dense_equations(chosen, dof[~own], matrix, source)

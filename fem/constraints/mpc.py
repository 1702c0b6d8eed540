"""MPC and MPCADD: given linear equations, Σ A u = 0; the first freedom depends."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.constraints.equations import Equations, dense_equations
from fem.constraints.sets import member_sets
from fem.deck.references import table, where
from fem.errors import InputError, Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_mpc(deck: "Deck", points: Points, sid: int) -> list[Equations]:
    """Equations of MPC set `sid` (0: none).

    Raises:
        InputError: unknown set, undefined freedoms, a first coefficient of zero.
    """
    if sid == 0:
        return []
    sets = member_sets(deck, "MPC", sid)
    rows = table(deck, "MPC")
    equations, problems = [], Problems()
    for _, row in rows[rows["sid"].isin(sets)].iterrows():
        place = where("MPC", row)
        with problems.gathered(place):
            equations.append(_equation(points, row, place))
    problems.report()
    return equations


def _equation(points: Points, row: pd.Series, place: str) -> Equations:
    dof = points.dof(row["grids"], row["comps"])
    # A freedom named twice counts with the sum of its coefficients.
    unique, inverse = np.unique(dof, return_inverse=True)
    total = np.bincount(inverse, weights=np.asarray(row["coefficients"], float))
    first = inverse[0]
    if total[first] == 0.0:
        raise InputError(
            f"the first coefficient is zero, {points.label(int(dof[0]))} cannot depend "
            "on the others"
        )
    others = np.arange(len(unique)) != first
    matrix = -total[None, others] / total[first]
    return dense_equations(dof[:1], unique[others], matrix, place)

"""MPC and MPCADD: given linear equations, Σ A u = 0; the first freedom depends."""

from typing import TYPE_CHECKING

import numpy as np

from fem.constraints.equations import Equations, dense_equations
from fem.constraints.sets import member_sets
from fem.deck.references import table, where
from fem.errors import InputError
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
    equations, problems = [], []
    for _, row in rows[rows["sid"].isin(sets)].iterrows():
        try:
            dof = points.dof(row["grids"], row["comps"])
        except InputError as error:
            problems += [f"{where('MPC', row)}: {p}" for p in error.problems]
            continue
        coefficient = np.asarray(row["coefficients"], float)
        # A freedom named twice counts with the sum of its coefficients.
        unique, inverse = np.unique(dof, return_inverse=True)
        total = np.bincount(inverse, weights=coefficient)
        first = inverse[0]
        if total[first] == 0.0:
            problems.append(
                f"{where('MPC', row)}: the first coefficient is zero, "
                f"{points.label(int(dof[0]))} cannot depend on the others"
            )
            continue
        others = np.arange(len(unique)) != first
        matrix = -total[None, others] / total[first]
        equations.append(
            dense_equations(dof[:1], unique[others], matrix, where("MPC", row))
        )
    if problems:
        raise InputError(problems)
    return equations

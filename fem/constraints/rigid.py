"""RBE2 and RBAR: rigid bodies."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.constraints.equations import (
    Equations,
    components,
    dense_equations,
    rigid_motion,
)
from fem.deck.references import table, where
from fem.errors import InputError
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_rbe2(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all RBE2: the components CM of each GM follow GN.

    Raises:
        InputError: undefined grids, a grid that follows itself.
    """
    rows = table(deck, "RBE2")
    if rows.empty:
        return []
    pairs = rows.explode("gms", ignore_index=True)
    own = pairs["gn"] == pairs["gms"]
    if own.any():
        raise InputError(
            f"{where('RBE2', row)}: grid {row['gn']} is both GN and GM"
            for _, row in pairs[own].iterrows()
        )
    master = points.rows(pairs["gn"].to_numpy(np.int64))
    slave = points.rows(pairs["gms"].to_numpy(np.int64))
    motion = rigid_motion(
        points.xyz[slave] - points.xyz[master], points.rotation[slave]
    )
    from_basic = np.zeros_like(motion)
    from_basic[:, :3, :3] = from_basic[:, 3:, 3:] = points.rotation[master]
    motion = motion @ from_basic
    follows = np.array([[d in str(cm) for d in "123456"] for cm in pairs["cm"]])
    pair, component = np.nonzero(follows)
    coefficients = motion[pair, component]
    row, at = np.nonzero(coefficients)
    names = [f"RBE2 {eid}" for eid in pairs["eid"]]
    return [
        Equations(
            dependent=6 * slave[pair] + component,
            row=row.astype(np.int64),
            column=6 * master[pair[row]] + at,
            value=coefficients[row, at],
            source=tuple(names[p] for p in pair),
        )
    ]


def read_rbar(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all RBAR: six components at both ends move all others.

    Raises:
        InputError: undefined grids, independent components that are not six or do not
            determine a rigid motion.
    """
    rows = table(deck, "RBAR")
    equations, problems = [], []
    for _, row in rows.iterrows():
        try:
            equations.append(_rbar(row, points))
        except InputError as error:
            problems += [f"{where('RBAR', row)}: {p}" for p in error.problems]
    if problems:
        raise InputError(problems)
    return equations


def _rbar(row: pd.Series, points: Points) -> Equations:
    at = points.rows([row["ga"], row["gb"]])
    motion = rigid_motion(points.xyz[at] - points.xyz[at[0]], points.rotation[at])
    motion = motion.reshape(12, 6)
    independent = np.concatenate([components(row["cna"]), 6 + components(row["cnb"])])
    dependent = np.concatenate([components(row["cma"]), 6 + components(row["cmb"])])
    if not len(dependent):
        dependent = np.setdiff1d(np.arange(12), independent)
    if len(independent) != 6:
        raise InputError(
            f"{len(independent)} independent components, expected 6 in CNA and CNB"
        )
    if len(np.intersect1d(independent, dependent)):
        raise InputError("a component is both independent and dependent")
    lever = np.linalg.norm(points.xyz[at[1]] - points.xyz[at[0]]) or 1.0
    scale = np.repeat([1.0, 1.0 / lever], 3)
    chosen = motion[independent] * scale
    if np.linalg.cond(chosen / np.linalg.norm(chosen, axis=1, keepdims=True)) > 1e10:
        raise InputError("the independent components do not determine a rigid motion")
    matrix = np.linalg.solve(chosen.T, (motion[dependent] * scale).T).T
    # Rounding of the solve; such entries would make chains of constraints fill.
    matrix[np.abs(matrix) < 1e-14 * np.abs(matrix).max()] = 0.0
    dof = (6 * at[:, None] + np.arange(6)).reshape(-1)
    return dense_equations(
        dof[dependent], dof[independent], matrix, f"RBAR {row['eid']}"
    )

"""RBE3: the motion of a reference grid as weighted mean of others.

The six motions of the reference (as of a rigid body) fit the chosen freedoms of the
independent grids by least squares, u_ref = (Σ Rᵀ W R)⁻¹ Σ Rᵀ W u, with the weights of
rotations multiplied by the square of the mean distance of the grids from the reference,
so that translations and rotations weigh alike in any unit of length. With UM other
freedoms of the element become the dependent ones; the equations are the same.
"""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
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


def read_rbe3(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all RBE3.

    Raises:
        InputError: undefined grids, grids that do not determine the reference's motion,
            a UM set of the wrong size or outside of the element.
    """
    return equations_of_rows(deck, points, {"RBE3": _equations})


def interpolation(lever: Float64, R_BD: Float64, weight: Float64) -> Float64:
    """(6, 6 n) motion of the reference, basic axes, from all freedoms of n grids.

    Args:
        lever: (n, 3) grids from the reference, basic axes.
        R_BD: (n, 3, 3) their displacement axes.
        weight: (n, 6) weights of their freedoms, 0 for those not used.

    Returns:
        The matrix; rows of motions that the grids do not determine are NaN.
    """
    distance = np.linalg.norm(lever, axis=1).mean()
    # The same measure as Nastran's for the weights; a single coincident grid has none.
    unit = distance if distance > 1e-12 else 1.0
    scaled = weight * np.repeat([1.0, unit**2], 3)
    motion = rigid_motion(lever, R_BD).reshape(-1, 6) * np.repeat([1.0, 1 / unit], 3)
    weighted = motion * scaled.reshape(-1, 1)
    normal = motion.T @ weighted
    values, vectors = np.linalg.eigh(normal)
    firm = np.abs(values) > 1e-10 * np.abs(values).max()
    inverse = (vectors[:, firm] / values[firm]) @ vectors[:, firm].T
    result = inverse @ weighted.T
    loose = vectors[:, ~firm]
    result[np.any(np.abs(loose) > 1e-6, axis=1)] = np.nan
    return result * np.repeat([1.0, 1 / unit], 3)[:, None]


def _equations(row: pd.Series, points: Points, source: str) -> Equations:
    grids, weight = _weights(row)
    reference = int(points.rows(int(row["refgrid"])))
    at = points.rows(grids)
    if reference in at:
        raise InputError(f"grid {row['refgrid']} is reference and independent at once")
    matrix = interpolation(
        points.xyz[at] - points.xyz[reference], points.rotation[at], weight
    )
    refc = components(row["refc"])
    turn = np.kron(np.eye(2), points.rotation[reference].T)
    chosen = turn[refc]
    # NaN rows matter only where they are asked for.
    used = np.any(np.abs(chosen) > 1e-9, axis=0)
    if np.isnan(matrix[used]).any():
        raise InputError(
            "the independent grids do not determine the motion of the reference grid "
            f"in all of REFC {row['refc']}; give more grids or components"
        )
    used_weight = weight.reshape(-1) != 0.0
    matrix = chosen[:, used] @ matrix[used][:, used_weight]
    columns = grid_freedoms(at)[used_weight]
    dependent = 6 * reference + refc
    if len(row["umgrids"]):
        m_set = _um(row, points)
        return _exchange(dependent, columns, matrix, m_set, source)
    return dense_equations(dependent, columns, matrix, source)


def _weights(row: pd.Series) -> tuple[Int64, Float64]:
    """Independent grids, each once and ascending, and the weights (n, 6)."""
    grids = np.unique(np.asarray(row["grids"], np.int64))
    weight = np.zeros((len(grids), 6))
    for w, digits, grid in zip(row["weights"], row["comps"], row["grids"]):
        weight[np.searchsorted(grids, grid), components(digits)] += w
    return grids, weight


def _um(row: pd.Series, points: Points) -> Int64:
    at = points.rows(np.asarray(row["umgrids"], np.int64))
    parts = [6 * a + components(c) for a, c in zip(at, row["umcomps"])]
    return np.concatenate(parts)


def _exchange(
    dependent: Int64, columns: Int64, matrix: Float64, m_set: Int64, source: str
) -> Equations:
    """The same equations solved for the freedoms of the UM set."""
    everything = np.concatenate([dependent, columns])
    if len(m_set) != len(dependent):
        raise InputError(
            f"UM names {len(m_set)} freedoms, expected {len(dependent)} as REFC has"
        )
    if not np.isin(m_set, everything).all():
        raise InputError("UM names freedoms that are not part of the element")
    both = np.hstack([np.eye(len(dependent)), -matrix])
    is_m = np.isin(everything, m_set)
    square = both[:, is_m]
    # Columns of one element differ by lengths, rows by components: judge scaled.
    size = np.abs(square).max(axis=0)
    if (size == 0.0).any() or np.linalg.cond(square / size) > 1e12:
        raise InputError("the equations cannot be solved for the freedoms of UM")
    solved = -np.linalg.solve(square, both[:, ~is_m])
    return dense_equations(everything[is_m], everything[~is_m], solved, source)

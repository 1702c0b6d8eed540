"""SPC, SPC1, SPCADD and GRID PS: freedoms that are fixed or given."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.constraints.equations import components
from fem.constraints.sets import member_sets
from fem.deck.references import table, where
from fem.errors import Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class SinglePointConstraints:
    """Constrained freedoms.

    Attributes:
        dof: (n,) rows of the g-set, ascending.
        value: (n,) enforced displacements.
        source: (n,) "SPC 1" or "GRID PS".
    """

    dof: npt.NDArray[np.int64]
    value: npt.NDArray[np.float64]
    source: tuple[str, ...]


def read_spc(deck: "Deck", points: Points, sid: int) -> SinglePointConstraints:
    """Freedoms fixed by GRID PS and by SPC set `sid` (0: PS alone).

    Raises:
        InputError: unknown set, undefined grids or components.
    """
    fixed = np.flatnonzero(points.ps.reshape(-1))
    given = {int(d): (0.0, "GRID PS") for d in fixed}
    if sid:
        sets = member_sets(deck, "SPC", sid)
        rows = table(deck, "SPC")
        rows = rows[rows["sid"].isin(sets)]
        dof, value = freedoms(rows, "SPC", points)
        for d, v in zip(dof.tolist(), value.tolist()):
            given[d] = (v, f"SPC {sid}")
    dofs = sorted(given)
    return SinglePointConstraints(
        dof=np.array(dofs, np.int64),
        value=np.array([given[d][0] for d in dofs], float),
        source=tuple(given[d][1] for d in dofs),
    )


def freedoms(
    rows: pd.DataFrame, card: str, points: Points
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]]:
    """Rows of the g-set and values of cards with columns g, c (digits), d.

    Serves SPC and SPCD.

    Raises:
        InputError: undefined points or components, all of them.
    """
    grids: list[int] = []
    comps: list[int] = []
    values: list[float] = []
    problems = Problems()
    scalar = set(points.spoint_id.tolist())
    for g, c, d in zip(rows["g"], rows["c"], rows["d"]):
        numbers = [0] if int(g) in scalar else (components(c) + 1).tolist()
        grids += [int(g)] * len(numbers)
        comps += numbers
        values += [float(d)] * len(numbers)
    known = np.isin(grids, np.concatenate([points.grid_id, points.spoint_id]))
    for g in sorted({g for g, k in zip(grids, known) if not k}):
        first = rows[rows["g"] == g].iloc[0]
        problems.append(f"{where(card, first)}: grid {g} is not defined")
    problems.report()
    dof = points.dof(np.array(grids, np.int64), np.array(comps, np.int64))
    return dof, np.array(values, float)

"""Which panels buckle first: factors of the static cases of a landing's instants.

The loads of an instant act at rest, balanced by rigid inertia, upon steady flight where
that is known; (K + λ K_d) x = 0 gives the factors of all of it, in mean axes where the
airframe is free. A mode belongs to the
element on whose internal forces it does most work: the panel is that element with those
around it that do a good share. Of modes at the same place the lowest factor counts.
Modes of one panel come in great number: where they fill what is sought of a case, other
panels may buckle at the factors that follow, and the table ends there.

A mode can show only what the mesh can: a panel that is one element wide has no half
wave of its own, and its local buckling is not seen. `elements` says how many do half of
the work; where they are few, the factor is too high.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.cache import Arrays, Cache, content_key
from drake_landing.parts.inventory import Inventory
from fem.algebra.buckling import BucklingSolver, FreeMotions
from fem.algebra.statics import free_motions
from fem.model.differential import (
    differential_stiffness,
    differential_work,
    half_of_the_work,
)
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_SHARE = 0.3  # of the largest work: an element belongs to the panel
_MODES = 2  # sought in a case for each panel that is wanted


@dataclass(frozen=True, kw_only=True)
class BuckledPanels:
    """Panels with the lowest load factors.

    Attributes:
        table: one row each, lowest first: `factor`, `time` (s), `reason`, `component`,
            `id` of the element with most work, `x`, `y`, `z` (B, m), `elements` that do
            half of the work.
        instants: number of static cases.
        shape: (f,) mode of the first row, largest entry 1.
        work: element id -> share of the work in that mode.
        known_below: factor up to which all panels are known.
        complete: a count shows that no lower factor was missed.
    """

    table: pd.DataFrame
    instants: int
    shape: Float64 = field(repr=False)
    work: pd.Series = field(repr=False)
    known_below: float
    complete: bool


def buckled_panels(
    structure: Structure,
    elements: Inventory,
    state: Float64,
    instants: dict[float, str],
    count: int,
    cache: Cache,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> BuckledPanels:
    """The lowest panels of static cases.

    Args:
        structure: the full model, free or held.
        elements: what is told of them.
        state: (f, s) displacements of the cases.
        instants: time (s) of each case -> what is extreme.
        count: of the panels.
        cache: where an earlier answer may be found.
        progress: told how many cases are done.
    """

    ids = elements.elements.id.to_numpy(np.int64)

    def build() -> Arrays:
        return _solve(structure, ids, state, count, progress)

    key = content_key(structure.stiffness, state, count, ids)
    return _panels(cache.arrays("buckling", key, build), elements, instants, count)


def _solve(
    structure: Structure,
    known: Int64,
    state: Float64,
    count: int,
    progress: Callable[[int, int], None],
) -> Arrays:
    """Factors and work of the modes of all cases, and the shape of the lowest.

    What lies above the panels of the cases before, or above what is known of them, is
    not looked for.
    """
    motions = free_motions(structure.stiffness, structure.rigid_body)
    free = FreeMotions(motions, structure.mass @ motions)
    factor, case = np.zeros(0), np.zeros(0, np.int64)
    work, shape = np.zeros((0, 0)), np.zeros(structure.size)
    ids, complete, highest, known_below = np.zeros(0, np.int64), True, np.inf, np.inf
    with BucklingSolver(structure.stiffness, free) as solver:
        for k, u in enumerate(state.T):
            u_g = structure.displacement(u)
            matrix = differential_stiffness(structure.points, structure.blocks, u_g)
            limit = min(highest, known_below)
            found = solver.factors(
                structure.elimination.reduce(matrix),
                count=_MODES * count,
                band=(0.0, limit if np.isfinite(limit) else None),
            )
            complete &= all(c.complete for c in found.counts)
            all_ids, all_work = differential_work(
                structure.points, structure.blocks, u_g, structure.shape(found.shape)
            )
            here = np.isin(all_ids, known)
            ids, own = all_ids[here], np.maximum(all_work[:, here], 0.0)
            if len(found.factor) and found.factor[0] < factor.min(initial=np.inf):
                shape = found.shape[:, 0]
            if len(found.factor) == _MODES * count:
                known_below = min(known_below, float(found.factor[-1]))
            work = np.vstack([work, own]) if work.size else own
            factor = np.concatenate([factor, found.factor])
            case = np.concatenate([case, np.full(len(found.factor), k)])
            rows = _distinct(factor, work, count)
            if len(rows) == count:
                highest = float(factor[rows[-1]])
            progress(k + 1, state.shape[1])
    return {
        "factor": factor,
        "case": case,
        "work": work,
        "id": ids,
        "shape": shape / max(float(np.abs(shape).max()), 1e-300),
        "known_below": np.array(known_below),
        "complete": np.array(complete),
    }


def _distinct(factor: Float64, work: Float64, count: int) -> list[int]:
    """Rows of modes whose panels do not overlap, the lowest first, `count` at most.

    Args:
        factor: (m,) of the modes.
        work: (m, e) of elements in each.
        count: of the rows.
    """
    taken, rows = np.zeros(work.shape[1], bool), []
    for k in np.argsort(factor, kind="stable"):
        near = work[k] >= _SHARE * work[k].max(initial=0.0)
        if not work[k].any() or (near & taken).any():
            continue
        taken |= near
        rows.append(int(k))
        if len(rows) == count:
            break
    return rows


def _panels(
    found: Arrays, elements: Inventory, instants: dict[float, str], count: int
) -> BuckledPanels:
    factor, case, work, ids = (found[k] for k in ("factor", "case", "work", "id"))
    times, reasons = list(instants), list(instants.values())
    known_below = float(found["known_below"])
    table = pd.DataFrame(
        [
            {
                "factor": float(factor[k]),
                "time": times[int(case[k])],
                "reason": reasons[int(case[k])],
                "id": int(ids[work[k].argmax()]),
                "elements": int(half_of_the_work(work[k][None])[0]),
            }
            for k in _distinct(factor, work, count)
            if factor[k] <= known_below
        ],
        columns=["factor", "time", "reason", "id", "elements"],
    )
    told = elements.of(table.id.to_numpy(np.int64))
    for column in ("component", "x", "y", "z"):
        table[column] = told[column].to_numpy()
    first = work[factor.argmin()] if len(factor) else np.zeros(len(ids))
    return BuckledPanels(
        table=table,
        instants=len(instants),
        shape=found["shape"],
        work=pd.Series(first / max(float(first.max(initial=0.0)), 1e-300), index=ids),
        known_below=known_below,
        complete=bool(found["complete"]),
    )


def with_margin(buckled: BuckledPanels, ultimate: float) -> pd.DataFrame:
    """The table with `margin`, factor over the ultimate factor less 1."""
    table = buckled.table
    return table.assign(margin=table.factor / ultimate - 1.0)

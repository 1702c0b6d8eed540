"""Which panels buckle first: factors of the static cases of a landing's instants.

The loads of an instant act at rest, balanced by rigid inertia, upon steady flight where
that is known; (K + λ K_d) x = 0 gives the factors of all of it, in mean axes where the
airframe is free. A mode belongs to the
element on whose internal forces it does most work: the panel is that element with those
around it that do a good share. Of modes at the same place the lowest factor counts.

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
from fem.algebra.buckling import Buckling, FreeMotions, buckling_factors
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
        complete: a count shows that no lower factor was missed.
    """

    table: pd.DataFrame
    instants: int
    shape: Float64 = field(repr=False)
    work: pd.Series = field(repr=False)
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
        count: factors per case, and panels in the end.
        cache: where an earlier answer may be found.
        progress: told how many cases are done.
    """

    def build() -> Arrays:
        return _solve(structure, state, count, progress)

    key = content_key(structure.stiffness, state, count)
    found = cache.arrays("buckling", key, build)
    return _panels(found, elements, instants, count)


def _solve(
    structure: Structure,
    state: Float64,
    count: int,
    progress: Callable[[int, int], None],
) -> Arrays:
    """Factors and work of all modes of all cases, and the shape of the lowest."""
    motions = free_motions(structure.stiffness, structure.rigid_body)
    free = FreeMotions(motions, structure.mass @ motions)
    factors, cases, works, complete = [], [], [], True
    lowest, shape, ids = np.inf, np.zeros(structure.size), np.zeros(0, np.int64)
    for k, u in enumerate(state.T):
        u_g = structure.displacement(u)
        matrix = differential_stiffness(structure.points, structure.blocks, u_g)
        found: Buckling = buckling_factors(
            structure.stiffness,
            structure.elimination.reduce(matrix),
            count=count,
            band=(0.0, None),
            free=free,
        )
        complete &= all(c.complete for c in found.counts)
        shapes = found.shape
        ids, work = differential_work(
            structure.points, structure.blocks, u_g, structure.shape(shapes)
        )
        factors.append(found.factor)
        cases.append(np.full(len(found.factor), k))
        works.append(work)
        if len(found.factor) and found.factor[0] < lowest:
            lowest, shape = float(found.factor[0]), shapes[:, 0]
        progress(k + 1, state.shape[1])
    return {
        "factor": np.concatenate(factors),
        "case": np.concatenate(cases),
        "work": np.concatenate(works),
        "id": ids,
        "shape": shape / max(float(np.abs(shape).max()), 1e-300),
        "complete": np.array(complete),
    }


def _panels(
    found: Arrays, elements: Inventory, instants: dict[float, str], count: int
) -> BuckledPanels:
    factor, case, work, ids = (found[k] for k in ("factor", "case", "work", "id"))
    known = np.isin(ids, elements.elements.id.to_numpy())
    work, ids = np.where(work > 0.0, work, 0.0)[:, known], ids[known]
    times, reasons = list(instants), list(instants.values())
    taken: set[int] = set()
    rows = []
    for k in np.argsort(factor, kind="stable"):
        own = work[k]
        if not own.any():
            continue
        near = set(ids[own >= _SHARE * own.max()].tolist())
        if near & taken:
            continue
        taken |= near
        rows.append(
            {
                "factor": float(factor[k]),
                "time": times[int(case[k])],
                "reason": reasons[int(case[k])],
                "id": int(ids[own.argmax()]),
                "elements": int(half_of_the_work(own[None])[0]),
            }
        )
        if len(rows) == count:
            break
    heads = ["factor", "time", "reason", "id", "elements"]
    table = pd.DataFrame(rows, columns=heads)
    told = elements.of(table.id.to_numpy(np.int64))
    for column in ("component", "x", "y", "z"):
        table[column] = told[column].to_numpy()
    first = work[factor.argmin()] if len(factor) else np.zeros(len(ids))
    return BuckledPanels(
        table=table,
        instants=len(instants),
        shape=found["shape"],
        work=pd.Series(first / max(float(first.max(initial=0.0)), 1e-300), index=ids),
        complete=bool(found["complete"]),
    )


def with_margin(buckled: BuckledPanels, ultimate: float) -> pd.DataFrame:
    """The table with `margin`, factor over the ultimate factor less 1."""
    table = buckled.table
    return table.assign(margin=table.factor / ultimate - 1.0)

"""Linear constraint equations: a dependent freedom as combination of others."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class Equations:
    """u[dependent[i]] = Σ value u[column] over the entries with row i.

    Attributes:
        dependent: (n,) rows of the g-set.
        row, column, value: (k,) entries; row counts equations, column is of the g-set.
        source: (n,) name of the card of each equation, "RBE2 12".
    """

    dependent: Int64
    row: Int64
    column: Int64
    value: Float64
    source: tuple[str, ...]


def dense_equations(
    dependent: Int64, columns: Int64, matrix: Float64, source: str
) -> Equations:
    """Equations of one element from its dense matrix (dependent, columns)."""
    row, at = np.nonzero(matrix)
    return Equations(
        dependent=np.asarray(dependent, np.int64),
        row=row.astype(np.int64),
        column=np.asarray(columns, np.int64)[at],
        value=matrix[row, at],
        source=(source,) * len(dependent),
    )


def concatenate(parts: Iterable[Equations]) -> Equations:
    """All equations of several sets, in their order."""
    parts = list(parts)
    starts = np.cumsum([0, *(len(p.dependent) for p in parts)])
    empty = np.zeros(0, np.int64)
    return Equations(
        dependent=np.concatenate([empty, *(p.dependent for p in parts)]),
        row=np.concatenate([empty, *(p.row + s for p, s in zip(parts, starts))]),
        column=np.concatenate([empty, *(p.column for p in parts)]),
        value=np.concatenate([np.zeros(0), *(p.value for p in parts)]),
        source=tuple(s for p in parts for s in p.source),
    )


def components(digits: object) -> Int64:
    """Component numbers of a text of digits, ascending: "135" gives 0, 2, 4."""
    return np.array(sorted({int(d) - 1 for d in str(digits) if d in "123456"}), int)

"""Linear constraint equations: a dependent freedom as combination of others."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.references import table, where
from fem.errors import Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


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


def equations_of_rows(
    deck: "Deck",
    points: Points,
    makers: Mapping[str, Callable[[pd.Series, Points, str], Equations]],
) -> list[Equations]:
    """Equations of all elements of some card tables, each by the maker of its table.

    A maker takes a row, the points and the name of the element, "RBE3 12".

    Raises:
        InputError: what makers say, each with its place; all of it.
    """
    equations, problems = [], Problems()
    for name, make in makers.items():
        for _, row in table(deck, name).iterrows():
            card = str(row.get("card") or name)
            with problems.gathered(where(name, row).replace(name, card)):
                equations.append(make(row, points, f"{card} {row['eid']}"))
    problems.report()
    return equations


def components(digits: object) -> Int64:
    """Component numbers of a text of digits, ascending: "135" gives 0, 2, 4."""
    return np.array(sorted({int(d) - 1 for d in str(digits) if d in "123456"}), int)

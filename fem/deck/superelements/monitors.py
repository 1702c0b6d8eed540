"""Monitor points of a superelement in the model that the parts make up together.

MONPNT1, MONPNT3 and AECOMP name their grids and elements by SET1, whose ids no other
card tells the kind of. Each list that they use gets a number and ids of the whole, each
component a name of its own: parts may use the same ones.
"""

from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd

from fem.deck.superelements.ids import Tables

_MONITORS = ("MONPNT1", "MONPNT3")


def with_monitors(
    part: Tables,
    offsets: Mapping[str, int],
    basic: int,
    number: int,
    taken: Iterable[int],
) -> tuple[Tables, set[int]]:
    """The tables of a part whose monitor points speak of the whole.

    Args:
        part: tables with the ids of the whole, but for those of monitor points.
        offsets: added to ids, by kind.
        basic: coordinate system of the part's basic frame in the whole, 0 the main one.
        number: of the superelement.
        taken: numbers of SET1 in use.

    Returns:
        The tables; numbers of those of its SET1 that hold grids.
    """
    if not any(len(part[name]) for name in _MONITORS):
        return part, set()
    lists = _Lists(part["SET1"], offsets, 1 + max(taken, default=0))
    tables = dict(part)
    for name in _MONITORS:
        table = part[name].copy()
        for column in ("cp", "cd"):
            ids = table[column].to_numpy(np.int64)
            table[column] = np.where(ids > 0, ids + offsets["frame"], basic)
        tables[name] = table
    three, one = tables["MONPNT3"], tables["MONPNT1"]
    three["gridset"] = [lists.renamed(i, "point") for i in three["gridset"]]
    three["elemset"] = [lists.renamed(i, "element") for i in three["elemset"]]
    one["comp"] = [f"{number}:{name}" for name in one["comp"]]
    components = part["AECOMP"].copy()
    components["name"] = [f"{number}:{name}" for name in components["name"]]
    components["lists"] = [
        _component(kind, members, lists, number)
        for kind, members in zip(components["type"], components["lists"])
    ]
    tables["AECOMP"] = components
    tables["SET1"] = pd.concat([part["SET1"], lists.table()], ignore_index=True)
    return tables, {new for (_, kind), new in lists.numbers.items() if kind == "point"}


def _component(
    kind: str, members: tuple[str, ...], lists: "_Lists", number: int
) -> tuple[str, ...]:
    if kind == "AECOMPL":
        return tuple(f"{number}:{name}" for name in members)
    if kind == "SET1":
        return tuple(str(lists.renamed(int(text), "point")) for text in members)
    return members


class _Lists:
    """SET1 by the kind of what they hold.

    Attributes:
        numbers: (number in the part, kind) -> number in the whole.
    """

    def __init__(self, table: pd.DataFrame, offsets: Mapping[str, int], first: int):
        self._table, self._offsets, self._next = table, offsets, first
        self.numbers: dict[tuple[int, str], int] = {}

    def renamed(self, number: int, kind: str) -> int:
        """The number of a list in the whole; 0 stays, as what is not there."""
        if number and (self._table["sid"] == number).any():
            new = self.numbers.setdefault((number, kind), self._next)
            self._next += new == self._next
            return new
        return number

    def table(self) -> pd.DataFrame:
        """Rows of the lists that were renamed."""
        found = []
        for (number, kind), new in self.numbers.items():
            rows = self._table[self._table["sid"] == number].copy()
            rows["sid"] = new
            shift = self._offsets[kind]
            rows["ids"] = [tuple(i + shift for i in ids) for ids in rows["ids"]]
            found.append(rows)
        return pd.concat(found) if found else self._table.iloc[:0]

"""Ids of superelements in the model that they make up together.

Ids of a part that are in use get an offset, by kind: points, coordinate systems,
elements, properties, materials. Those of sets and tables are shared by all parts.
"""

from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.records import TABLES, targets_of

Tables = dict[str, pd.DataFrame]

# Kinds of ids, by the name of the column that has them; others are shared by all parts.
_KINDS = {"id": "point", "cid": "frame", "eid": "element", "pid": "property"}
_KINDS |= {"mid": "material"}


def key_of_kind(name: str) -> tuple[str, str]:
    """Column with the ids of a table and their kind; "" where they are shared."""
    column = next(iter(TABLES[name].columns))
    return column, _KINDS.get(column, "") if TABLES[
        name
    ].ids or name == "PLOTEL" else ""


def ids_of_kind(tables: Mapping[str, pd.DataFrame], kind: str) -> set[int]:
    """Ids of a kind (point, element, frame, ...) that the tables have."""
    found: set[int] = set()
    for name, table in tables.items():
        column, own = key_of_kind(name)
        if own == kind:
            found.update(table[column].tolist())
    return found


def offsets(whole: list[Tables], part: Tables, number: int) -> dict[str, int]:
    """Numbers added to the ids of a part, by kind; 0 where its ids are free."""
    found = {}
    for kind in sorted(set(_KINDS.values())):
        taken: set[int] = set().union(*(ids_of_kind(tables, kind) for tables in whole))
        own = ids_of_kind(part, kind)
        # Digits of ids as written: those of other parts have an offset already.
        step = 10 ** len(str(max(ids_of_kind(whole[0], kind) | own, default=1)))
        shift = 0 if taken.isdisjoint(own) else number * step
        while not taken.isdisjoint({i + shift for i in own}):
            shift += step
        found[kind] = shift
    return found


def shift_notices(number: int, offsets: Mapping[str, int]) -> list[str]:
    """A line that says what is added to the ids of a part, if anything is."""
    shifted = [f"{kind} + {shift}" for kind, shift in offsets.items() if shift]
    if not shifted:
        return []
    return [f"superelement {number}: ids in the results are {', '.join(shifted)}"]


def renamed(
    part: Tables,
    offsets: Mapping[str, int],
    frame: tuple[Float64, Float64] | None,
    basic: int,
) -> Tables:
    """The tables of a part with the ids that they have in the whole.

    Args:
        part: its tables.
        offsets: added to its ids, by kind.
        frame: axes and origin of its basic frame, None where that is the main one.
        basic: the id that its basic frame gets.
    """
    basic = 0 if frame is None else basic
    tables = {}
    for name, table in part.items():
        table = table.copy()
        for column, kind in columns_with_ids(name):
            if column in table:
                ground = basic if kind == "frame" else 0
                table[column] = _shifted(table[column], offsets[kind], ground)
        tables[name] = table
    if frame is not None:
        tables["CORD"] = _with_basic(tables["CORD"], basic, *frame)
    return tables


def columns_with_ids(name: str) -> Iterator[tuple[str, str]]:
    """Columns of a table that hold ids, with their kinds."""
    key, own = key_of_kind(name)
    if own:
        yield key, own
    if name == "CORD":
        yield from (("rid", "frame"), ("g1", "point"), ("g2", "point"), ("g3", "point"))
    for column, item in TABLES[name].columns.items():
        if item.targets and (column != key or not own):
            target = targets_of(item.targets[0])[0]
            kind = "frame" if target == "CORD" else key_of_kind(target)[1]
            if kind:
                yield column, kind


def _shifted(values: pd.Series, shift: int, ground: int) -> pd.Series:
    """Ids moved; 0 becomes `ground`, what is below is no id."""

    def moved(ids: Int64) -> Int64:
        return np.where(ids > 0, ids + shift, np.where(ids == 0, ground, ids))

    if values.dtype != object:
        return pd.Series(moved(values.to_numpy(np.int64)), values.index)
    column = np.empty(len(values), dtype=object)
    for row, value in enumerate(values):
        column[row] = moved(np.asarray(value, dtype=np.int64))
    return pd.Series(column, values.index)


def _with_basic(
    table: pd.DataFrame, cid: int, axes: Float64, origin: Float64
) -> pd.DataFrame:
    """Coordinate systems of a part with the part's own basic frame."""
    row = dict.fromkeys(table.columns, 0)
    points = {"a": origin, "b": origin + axes[:, 2], "c": origin + axes[:, 0]}
    row |= {f"{p}{k + 1}": float(x[k]) for p, x in points.items() for k in range(3)}
    row |= {"cid": cid, "type": "R", "form": 2, "file": "", "rid": 0}
    return pd.concat([table, pd.DataFrame([row])], ignore_index=True)

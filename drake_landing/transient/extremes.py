"""Extremes of element results during a landing: what the parts see at worst."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.model.structure import Structure
from fem.recovery.elements import element_tables
from fem.recovery.envelope import Envelope
from fem.response.observation import Chunk, Observer, StateChunk

Float64 = npt.NDArray[np.float64]

KINDS = ("force", "stress")
_NO_LOAD = ("fibre", "angle")  # columns


def element_envelopes(structure: Structure) -> list[Envelope]:
    """One observer per table of element forces and of stresses, all elements.

    They are named `envelope/element_<kind>` for the result file.
    """
    return [
        Envelope(table, structure.elimination.T, f"envelope/element_{kind}")
        for kind in KINDS
        for table in element_tables(structure.points, structure.blocks, kind)
    ]


class OfFirstCase:
    """Observers that are shown the first load case alone.

    The products of their operators are then taken for that one only. They see
    displacements at rest: dampers show no results.
    """

    def __init__(self, observers: Sequence[Observer]) -> None:
        self._observers = observers

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """See `Observer`."""
        for observer in self._observers:
            observer.begin(time, 1, size)

    def observe(self, chunk: Chunk) -> None:
        """See `Observer`."""
        first = chunk.get("displacement")[:, :1]
        alone = StateChunk(chunk.first, chunk.time, {"displacement": first})
        for observer in self._observers:
            observer.observe(alone)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """See `Observer`."""
        return sum(o.memory_bytes(times, 1, size) for o in self._observers)


def worst_elements(envelopes: Sequence[Envelope], count: int = 5) -> pd.DataFrame:
    """The elements with the largest value of each column.

    Returns:
        Rows `result` (force or stress), `type`, `column`, `element`, `value` (the
        extreme of larger magnitude, units of the deck), `time` (s); at most `count` per
        type and column, columns that stay zero left out, and those that are no force
        or stress: where fibres lie, angles of principal axes.
    """
    rows = []
    for envelope in envelopes:
        low, high = envelope.smallest, envelope.largest
        value = np.where(np.abs(low) > np.abs(high), low, high)
        time = np.where(
            np.abs(low) > np.abs(high),
            envelope.time_of_smallest,
            envelope.time_of_largest,
        )
        for c, column in enumerate(envelope.table.columns):
            if str(column).startswith(_NO_LOAD):
                continue
            order = np.argsort(-np.abs(value[:, c]), kind="stable")[:count]
            rows += [
                {
                    "result": envelope.name.rsplit("_", 1)[-1],
                    "type": envelope.table.table,
                    "column": column,
                    "element": int(envelope.table.id[e]),
                    "value": value[e, c],
                    "time": time[e, c],
                }
                for e in order
                if value[e, c]
            ]
    columns = ["result", "type", "column", "element", "value", "time"]
    return pd.DataFrame(rows, columns=columns)

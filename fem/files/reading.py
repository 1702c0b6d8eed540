"""Reading result files: solutions, states and datasets, for other file formats."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import h5py
import numpy as np

from fem.arrays import Float64, Int64

Analysis = Literal["static", "modes", "buckling", "frequency", "transient"]


@dataclass(frozen=True, kw_only=True)
class ElementResult:
    """A table of element results.

    Attributes:
        id: (e,) element ids.
        columns: names of the columns.
        dataset: (e, c), or (t, e, c) of several states.
    """

    id: Int64
    columns: tuple[str, ...]
    dataset: h5py.Dataset


@dataclass(frozen=True, kw_only=True)
class PointResult:
    """A quantity of points.

    Attributes:
        grid_id, scalar_id: (k,), (s,) ids.
        grids, scalars: datasets ([t,] k, 6) and ([t,] s), the latter None if there are
            none.
    """

    grid_id: Int64
    scalar_id: Int64
    grids: h5py.Dataset
    scalars: h5py.Dataset | None


@dataclass(frozen=True)
class Solution:
    """Results of one subcase.

    Attributes:
        source: the file.
        group: the results.
        analysis: what was solved.
        subcase: its id; 0: the first of the deck.
        values: (t,) times (s), frequencies (Hz) or load factors of the states; (1,)
            zero of statics.
    """

    source: h5py.File
    group: h5py.Group
    analysis: Analysis
    subcase: int
    values: Float64

    def point(self, name: str) -> PointResult | None:
        """A quantity of points, None where the file does not have it."""
        grids = self.group.get(name)
        if not isinstance(grids, h5py.Dataset):
            return None
        scalars = self.group.get(f"{name}_scalar_point")
        own = _ids(self.group, f"{name}_grid_id")
        points = _ids(self.group, f"{name}_scalar_point_id")
        if scalars is not None and points is None:
            points = _ids(self.source, "scalar_point_id")
        everything = _ids(self.source, "grid_id")
        chosen = own if own is not None else everything
        return PointResult(
            grid_id=np.zeros(0, np.int64) if chosen is None else chosen,
            scalar_id=np.zeros(0, np.int64) if points is None else points,
            grids=grids,
            scalars=scalars if isinstance(scalars, h5py.Dataset) else None,
        )

    def elements(self, kind: str) -> dict[str, ElementResult]:
        """Tables of "element_force", "element_stress" ... by card."""
        group = self.group.get(kind)
        found: dict[str, ElementResult] = {}
        if not isinstance(group, h5py.Group):
            return found
        for card, table in group.items():
            ids, values = _ids(table, "id"), table.get("value")
            if ids is not None and isinstance(values, h5py.Dataset):
                names = tuple(str(c) for c in np.asarray(table.attrs["columns"]))
                found[card] = ElementResult(id=ids, columns=names, dataset=values)
        return found

    def state(self, dataset: h5py.Dataset, k: int) -> Float64:
        """Values of one state; statics have no axis of states.

        Those of frequency responses are complex.
        """
        chosen = np.asarray(dataset[()] if self.analysis == "static" else dataset[k])
        return chosen if np.iscomplexobj(chosen) else chosen.astype(float)


# Solutions by subcase, and what their states are numbered by.
_STATES: dict[str, str] = {
    "static": "",
    "buckling": "factor",
    "frequency": "frequency_hz",
    "transient": "time",
}


def _ids(group: h5py.Group | h5py.File, name: str) -> Int64 | None:
    found = group.get(name)
    if not isinstance(found, h5py.Dataset):
        return None
    return np.asarray(found[()], dtype=np.int64)


def solutions(source: h5py.File) -> Iterator[Solution]:
    """All solutions of a result file."""
    for key in source:
        name, group = str(key), source[key]
        if not isinstance(group, h5py.Group):
            continue
        if name == "modes" or name.startswith("modes_"):
            case = int(name.removeprefix("modes").lstrip("_") or 0)
            hertz = np.asarray(group["frequency_hz"], dtype=float)
            yield Solution(source, group, "modes", case, hertz)
        elif name in _STATES:
            for case, own in group.items():
                values = np.zeros(1)
                if _STATES[name]:
                    values = np.asarray(own[_STATES[name]], dtype=float)
                yield Solution(source, own, name, int(case), values)

"""The HDF5 result file of a deck; its layout is section 6 of docs/design.md.

The file is written under a temporary name and takes its own when it is complete.
Histories of transients are written while they are computed.
"""

import errno
import shutil
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Protocol, Self

import h5py
import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Float64, Int64
from fem.deck.control.case_sets import Selection
from fem.files.atomic_hdf5 import written_hdf5
from fem.files.finite_check import require_finite
from fem.geometry.points import Points, grid_freedoms
from fem.model.structure import Structure
from fem.recovery.elements import ElementTable
from fem.recovery.grid_forces import GridBalance
from fem.recovery.table_response import TableResponse
from fem.response.observation import Chunk, Quantity


class ResultFile:
    """A result file that is being written; a context manager.

    Args:
        path: final name; it appears only when the context ends without an error.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._open = ExitStack()

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            self.file = stack.enter_context(written_hdf5(self.path))
            self._open = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._open.__exit__(kind, error, trace)

    def write_model(self, structure: Structure) -> None:
        """Grids, mass properties and what the deck had to say."""
        points, weight = structure.points, structure.weight
        self.file["grid_id"] = points.grid_id
        self.file["position"] = points.xyz
        if len(points.spoint_id):
            self.file["scalar_point_id"] = points.spoint_id
        self.file["mass/total"] = weight.total
        self.file["mass/cg"] = weight.center
        self.file["mass/inertia"] = weight.inertia
        self.file.attrs["deck"] = str(structure.deck.path.name)
        self.file.attrs["notices"] = list(structure.notices)
        self.file.attrs["ignored_cards"] = list(structure.deck.ignored)
        found = structure.autospc
        if found is not None and len(found.dof):
            labels = [points.label(int(dof)) for dof in found.dof]
            self.file["autospc/freedom"] = np.array(labels, h5py.string_dtype())
            self.file["autospc/stiffness_ratio"] = found.ratio
        for name, column in structure.quality.items():
            values = column.to_numpy()
            if values.dtype == object:
                values = values.astype(h5py.string_dtype())
            self.file[f"quality/{name}"] = values

    def size_bytes(self) -> int:
        """Size of all datasets, those that are still to be filled included."""
        sizes: list[int] = []

        def count(_: str, item: object) -> None:
            if isinstance(item, h5py.Dataset):
                sizes.append(item.size * item.dtype.itemsize)

        self.file.visititems(count)
        return sum(sizes)

    def require_room(self) -> None:
        """Refuses where the disk has no room for what the datasets will hold.

        Raises:
            OSError: it has not; with both figures.
        """
        size, free = self.size_bytes(), shutil.disk_usage(self.path.parent).free
        if size > free:
            words = f"results of {size / 1e6:,.0f} MB, {free / 1e6:,.0f} MB are free"
            raise OSError(errno.ENOSPC, words, str(self.path))

    def discard(self, *names: str) -> None:
        """Forget groups of an attempt that failed, where they are there."""
        for name in names:
            if name in self.file:
                del self.file[name]

    def write(self, name: str, values: npt.ArrayLike) -> None:
        """A dataset of numbers; groups on the way are made.

        Raises:
            InputError: it is not finite.
        """
        values = np.asarray(values)
        require_finite(name, values)
        self.file[name] = values

    def write_points(
        self, name: str, points: Points, values: Float64, selection: Selection
    ) -> None:
        """A quantity (g,) or (k, g) of the g-set as (k', 6) or (k, k', 6)."""
        layout = PointLayout(points, selection)
        require_finite(name, values, _Labels(points))
        layout.describe(self.file, name)
        self.file[name] = layout.grids(values[..., layout.grid_dof])
        if len(layout.scalar_dof):
            self.file[f"{name}_scalar_point"] = values[..., layout.scalar_dof]

    def write_table(self, name: str, table: ElementTable, values: Float64) -> None:
        """Element results ([k,] e, c)."""
        group = self._table_group(name, table)
        _require_finite_table(group, table, values)
        group["value"] = values

    def _table_group(self, name: str, table: ElementTable) -> h5py.Group:
        group = self.file.create_group(f"{name}/{table.table}")
        group["id"] = table.id
        group.attrs["columns"] = list(table.columns)
        return group

    def grid_force_group(self, name: str, balance: GridBalance) -> h5py.Group:
        """Group of a grid point force balance with the description of its rows."""
        group = self.file.create_group(name)
        group["grid_id"], group["element_id"] = balance.grid_id, balance.element_id
        group["source"] = balance.source.astype(h5py.string_dtype())
        return group

    def write_energies(
        self,
        name: str,
        energies: dict[str, tuple[Int64, Float64]],
        wanted: Int64 | None,
    ) -> None:
        """Strain energies (e,) or (k, e) by card."""
        for card, (ids, values) in energies.items():
            keep = np.full(len(ids), True) if wanted is None else np.isin(ids, wanted)
            if keep.any():
                group = self.file.create_group(f"{name}/{card}")
                group["id"], group["value"] = ids[keep], values[..., keep]

    def point_history(
        self,
        name: str,
        points: Points,
        selection: Selection,
        quantity: Quantity,
        expand: sp.csr_matrix,
        case: int,
    ) -> "PointHistory":
        """Observer that writes a quantity of points while a transient runs."""
        layout = PointLayout(points, selection)
        rows = sp.csr_matrix(expand[layout.dof])
        response = MotionResponse(quantity=quantity, operator=rows, case=case)
        return PointHistory(self.file, name, layout, response)

    def table_history(self, name: str, response: TableResponse) -> "TableHistory":
        """Observer that writes element results while a transient runs."""
        return TableHistory(self._table_group(name, response.table), response)


class PointLayout:
    """Which rows of the g-set a dataset of points holds.

    Attributes:
        grid_dof: (6 k,) rows of the chosen grids.
        scalar_dof: (s,) rows of the chosen scalar points.
    """

    def __init__(self, points: Points, selection: Selection) -> None:
        self.all = selection == "ALL"
        wanted = np.fromiter(selection, np.int64) if _is_set(selection) else None
        grid = _chosen(points.grid_id, wanted)
        scalar = _chosen(points.spoint_id, wanted)
        self.grid_id = points.grid_id[grid]
        self.scalar_id = points.spoint_id[scalar]
        self.grid_dof = grid_freedoms(grid)
        self.scalar_dof = 6 * len(points.grid_id) + scalar
        self.labels = _Labels(points, self.dof)

    @property
    def dof(self) -> Int64:
        """(6 k + s,) all rows, those of the grids first."""
        return np.concatenate([self.grid_dof, self.scalar_dof])

    def grids(self, values: Float64) -> Float64:
        """(..., 6 k) as (..., k, 6)."""
        return values.reshape(*values.shape[:-1], len(self.grid_id), 6)

    def describe(self, file: h5py.File, name: str) -> None:
        """Say which points a dataset holds, where these are not all."""
        if not self.all:
            file[f"{name}_grid_id"] = self.grid_id
        if len(self.scalar_dof) and not self.all:
            file[f"{name}_scalar_point_id"] = self.scalar_id


def _is_set(selection: Selection) -> bool:
    return not isinstance(selection, str)


def _chosen(ids: Int64, wanted: Int64 | None) -> npt.NDArray[np.intp]:
    if wanted is None:
        return np.arange(len(ids))
    return np.flatnonzero(np.isin(ids, wanted))


class _Labels(Sequence[str]):
    """Names of the rows of the g-set, made when they are asked for."""

    def __init__(self, points: Points, rows: Int64 | None = None) -> None:
        self._points, self._rows = points, rows

    def __len__(self) -> int:
        return self._points.size if self._rows is None else len(self._rows)

    def __getitem__(self, row: int) -> str:  # pyright: ignore[reportIncompatibleMethodOverride]
        return self._points.label(int(row if self._rows is None else self._rows[row]))


def _require_finite_table(
    group: h5py.Group,
    table: ElementTable,
    values: Float64,
    time: Float64 | None = None,
) -> None:
    """Refuse element results ([t,] e, c) that are infinite; NaN: no such ply."""
    if np.isinf(values).any():
        columns = [f"element {i}, {c}" for i in table.id for c in table.columns]
        flat = values.reshape(*values.shape[:-2], -1)
        name = (group.name or "").lstrip("/")
        require_finite(name, flat, columns, time, blanks=True)


class PointResponse(Protocol):
    """Something that points have at each output time."""

    def values(self, chunk: Chunk) -> Float64:
        """(m, r) at the rows of a `PointLayout`, grids first."""
        ...


@dataclass(frozen=True, kw_only=True)
class MotionResponse:
    """A quantity of motion of one load case through an operator (r, n)."""

    quantity: Quantity
    operator: sp.csr_matrix
    case: int

    def values(self, chunk: Chunk) -> Float64:
        """(m, r); see `PointResponse`."""
        return chunk.get(self.quantity, self.operator)[:, self.case]


class PointHistory:
    """Writes what points have at every output time; see `Observer`.

    Args:
        file, name: where to write.
        layout: at which points.
        response: what.
    """

    def __init__(
        self, file: h5py.File, name: str, layout: PointLayout, response: PointResponse
    ) -> None:
        layout.describe(file, name)
        self._file, self._name = file, name
        self._layout, self._response = layout, response
        self._datasets: list[h5py.Dataset] = []

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Make the datasets."""
        layout, t = self._layout, len(time)
        shapes = {self._name: (t, len(layout.grid_id), 6)}
        if len(layout.scalar_dof):
            shapes[f"{self._name}_scalar_point"] = (t, len(layout.scalar_dof))
        self._datasets = [
            self._file.create_dataset(name, shape, dtype="f8")
            for name, shape in shapes.items()
        ]

    def observe(self, chunk: Chunk) -> None:
        """Write a chunk."""
        values = self._response.values(chunk)
        require_finite(self._name, values, self._layout.labels, chunk.time)
        at = slice(chunk.first, chunk.first + len(chunk.time))
        grids = 6 * len(self._layout.grid_id)
        self._datasets[0][at] = self._layout.grids(values[:, :grids])
        for dataset in self._datasets[1:]:
            dataset[at] = values[:, grids:]

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Nothing stays in memory."""
        return 0


class TableHistory:
    """Writes element results at every output time; see `Observer`."""

    def __init__(self, group: h5py.Group, response: TableResponse) -> None:
        self._group, self._response = group, response
        self._value: h5py.Dataset | None = None

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Make the dataset."""
        table = self._response.table
        shape = (len(time), len(table.id), len(table.columns))
        self._value = self._group.create_dataset("value", shape, dtype="f8")

    def observe(self, chunk: Chunk) -> None:
        """Write a chunk."""
        at = slice(chunk.first, chunk.first + len(chunk.time))
        if self._value is not None:
            values = self._response.values(chunk)
            table = self._response.table
            _require_finite_table(self._group, table, values, chunk.time)
            self._value[at] = values

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Nothing stays in memory."""
        return 0

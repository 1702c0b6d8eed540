"""ParaView files (VTKHDF): the mesh once, and its results at all times or modes.

Points: displacements, velocities, accelerations, in the basic frame. Cells: element and
property ids, and the largest von Mises stress of each element (of all its fibres,
corners and plies; of bars and rods the largest normal stress), where stresses were
asked for; envelopes where they were made. Values that are not there are NaN.

Reference: VTK file formats, "VTKHDF File Format", version 2.0.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import numpy.typing as npt

from fem.arrays import Float64, Int64
from fem.deck.records import CARDS
from fem.elements.connectivity import element_grids
from fem.elements.stress_measures import plane_von_mises
from fem.files.atomic_hdf5 import written_hdf5
from fem.files.reading import ElementResult, PointResult, Solution, solutions
from fem.model.structure import Structure

_QUANTITIES = ("displacement", "shape", "velocity", "acceleration")


@dataclass(frozen=True)
class Cells:
    """Cells of a mesh.

    Attributes:
        conn: concatenated positions of their grids.
        size: (e,) grids per cell.
        type: (e,) VTK's cell type.
        id, pid: (e,) element and property ids.
    """

    conn: Int64
    size: Int64
    type: Int64
    id: Int64
    pid: Int64


def write_paraview(results: Path, structure: Structure, folder: Path) -> list[Path]:
    """Write a file for each solution of a result file.

    Args:
        results: HDF5 file of a run.
        structure: the model of the run.
        folder: for the files `<results>_<solution>.vtkhdf`.

    Returns:
        The files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    cells = _cells(structure)
    written = []
    with h5py.File(results) as source:
        for solution in solutions(source):
            if solution.analysis == "frequency":  # complex: the HDF5 file has it
                continue
            name = solution.analysis
            name += f"_{solution.subcase}" if solution.subcase else ""
            path = folder / f"{results.stem}_{name}.vtkhdf"
            with written_hdf5(path) as file:
                _write(file, structure, cells, solution)
            written.append(path)
    return written


def _cells(structure: Structure) -> Cells:
    """All elements between grids, one kind after the other."""
    conn, size, kind, ids, pids = [], [], [], [], []
    for block in structure.blocks:
        grids = element_grids(structure.points, block)
        if grids is None or not len(grids):
            continue
        n, topology = grids.shape[1], CARDS[block.card].topology
        vtk = topology.cell(n) if topology else None
        if topology and vtk is None:  # with some of its mid-sides: as its corners
            n = topology.corners
            grids, vtk = grids[:, :n], topology.cell(n)
        if topology is None or vtk is None:
            continue
        conn.append(grids[:, topology.order.get(n, range(n))].ravel())
        size.append(np.full(len(grids), n))
        kind.append(np.full(len(grids), vtk))
        ids.append(block.id)
        pids.append(np.asarray(getattr(block, "pid", np.zeros(len(grids), int))))
    empty = [np.zeros(0, np.int64)]
    return Cells(
        *(np.concatenate(x or empty).astype(np.int64) for x in (conn, size, kind)),
        *(np.concatenate(x or empty).astype(np.int64) for x in (ids, pids)),
    )


def _write(
    file: h5py.File, structure: Structure, cells: Cells, solution: Solution
) -> None:
    """A mesh that stays, and data that change from step to step."""
    root = file.create_group("VTKHDF")
    root.attrs["Version"] = np.array([2, 0], np.int64)
    root.attrs.create("Type", np.bytes_("UnstructuredGrid"))
    points = structure.points
    count, steps = len(points.grid_id), len(solution.values)
    root["Points"] = points.xyz
    root["Connectivity"] = cells.conn
    root["Offsets"] = np.concatenate([[0], np.cumsum(cells.size)])
    root["Types"] = cells.type.astype(np.uint8)
    for name, value in (
        ("NumberOfPoints", count),
        ("NumberOfCells", len(cells.id)),
        ("NumberOfConnectivityIds", len(cells.conn)),
    ):
        root[name] = np.array([value], np.int64)
    times = root.create_group("Steps")
    times.attrs["NSteps"] = steps
    times["Values"] = solution.values
    times["NumberOfParts"] = np.ones(steps, np.int64)
    for name in ("PartOffsets", "PointOffsets"):
        times[name] = np.zeros(steps, np.int64)
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        times[name] = np.zeros((steps, 1), np.int64)
    writer = _Fields(root, times, steps)
    writer.fixed("PointData", "grid_id", points.grid_id)
    writer.fixed("CellData", "element_id", cells.id)
    writer.fixed("CellData", "property_id", cells.pid)
    for name in _QUANTITIES:
        found = solution.point(name)
        if found is not None:
            label = "displacement" if name == "shape" else name
            values = _in_basic_frame(structure, solution, found)
            writer.varying("PointData", label, (count, 3), values)
    stresses = solution.elements("element_stress")
    if stresses:
        at = _places(cells, stresses)

        def von_mises(k: int) -> Float64:
            return _von_mises(cells, at, stresses, solution, k)

        writer.varying("CellData", "von_mises", (len(cells.id),), von_mises)
    _write_envelopes(writer, cells, solution)


class _Fields:
    """Data of points and cells with their offsets per step."""

    def __init__(self, root: h5py.Group, steps: h5py.Group, count: int) -> None:
        self._root, self._steps, self._count = root, steps, count

    def fixed(self, where: str, name: str, values: npt.NDArray) -> None:
        """A field that is the same at all steps."""
        self._group(where)[name] = values
        self._offsets(where)[name] = np.zeros(self._count, np.int64)

    def varying(
        self,
        where: str,
        name: str,
        shape: tuple[int, ...],
        values: Callable[[int], Float64],
    ) -> None:
        """A field of a shape at each step, computed step by step."""
        rows = shape[0]
        data = self._group(where).create_dataset(
            name, (self._count * rows, *shape[1:]), dtype="f4"
        )
        for k in range(self._count):
            data[k * rows : (k + 1) * rows] = values(k)
        self._offsets(where)[name] = rows * np.arange(self._count)

    def _group(self, where: str) -> h5py.Group:
        return self._root.require_group(where)

    def _offsets(self, where: str) -> h5py.Group:
        return self._steps.require_group(f"{where}Offsets")


def _in_basic_frame(
    structure: Structure, solution: Solution, result: PointResult
) -> Callable[[int], Float64]:
    """(g, 3) translations of a step."""
    points = structure.points
    rows = points.rows(result.grid_id)

    def values(k: int) -> Float64:
        own = solution.state(result.grids, k)[:, :3]
        out = np.full((len(points.grid_id), 3), np.nan)
        out[rows] = np.einsum("gij,gj->gi", points.rotation[rows], own)
        return out

    return values


def _places(
    cells: Cells, tables: Mapping[str, ElementResult]
) -> dict[str, npt.NDArray[np.intp]]:
    """Positions of the elements of tables among the cells."""
    order = np.argsort(cells.id, kind="stable")
    found = {}
    for card, table in tables.items():
        at = np.searchsorted(cells.id[order], table.id)
        at = np.minimum(at, max(len(order) - 1, 0))
        position = order[at] if len(order) else np.zeros(len(table.id), np.intp)
        known = cells.id[position] == table.id if len(order) else np.zeros(0, bool)
        found[card] = np.where(known, position, -1)
    return found


def _von_mises(
    cells: Cells,
    places: Mapping[str, npt.NDArray[np.intp]],
    tables: Mapping[str, ElementResult],
    solution: Solution,
    k: int,
) -> Float64:
    """(e,) largest von Mises stress of each cell, NaN where none is known."""
    out = np.full(len(cells.id), np.nan)
    for card, table in tables.items():
        values = largest_von_mises(table.columns, solution.state(table.dataset, k))
        if values is not None:
            at = places[card]
            out[at[at >= 0]] = values[at >= 0]
    return out


def largest_von_mises(columns: tuple[str, ...], values: Float64) -> Float64 | None:
    """(e,) largest von Mises stress of elements from their printed columns (e, c).

    None where the columns hold no stress of this kind.
    """
    at = [k for k, name in enumerate(columns) if "von_mises" in name]
    if at:
        return values[:, at].max(axis=1)
    plies = [k for k, name in enumerate(columns) if name.startswith("o11_")]
    if plies:
        triple = [
            [columns.index(columns[k].replace("o11", name)) for k in plies]
            for name in ("o11", "o22", "t12")
        ]
        xx, yy, xy = (values[:, own] for own in triple)
        return np.nan_to_num(plane_von_mises(xx, yy, xy), nan=0.0).max(axis=1)
    at = [k for k, name in enumerate(columns) if name.startswith(("smax", "smin"))]
    if not at and columns[:1] == ("axial",):
        at = [0]
    return np.abs(values[:, at]).max(axis=1) if at else None


def _write_envelopes(writer: _Fields, cells: Cells, solution: Solution) -> None:
    """Largest von Mises stress over time, where envelopes were made."""
    group = solution.group.get("envelope/stress")
    if not isinstance(group, h5py.Group):
        return
    out = np.full(len(cells.id), np.nan)
    for card, table in group.items():
        columns = tuple(str(c) for c in np.asarray(table.attrs["columns"]))
        most = np.maximum(np.abs(table["max"][:]), np.abs(table["min"][:]))
        values = largest_von_mises(columns, most)
        if values is not None and not card.endswith("COMPOSITE"):
            ids = np.asarray(table["id"], dtype=np.int64)
            result = ElementResult(id=ids, columns=columns, dataset=table["max"])
            at = _places(cells, {card: result})[card]
            out[at[at >= 0]] = values[at >= 0]
    writer.fixed("CellData", "von_mises_envelope", out.astype(np.float32))

"""Words of element results in OP2 files.

Each layout turns results (e, c) in our columns into rows of 32-bit words; ids and grid
numbers are integers among the reals. What Nastran fills with margins of safety is its
"no margin"; direction cosines of principal stresses of solids are left zero.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64, Int64
from fem.files.op2_records import DEVICE

Float32 = npt.NDArray[np.float32]
Cell = str | float | Int64

NO_MARGIN = float(np.array([1], "<i4").view("<f4")[0])


@dataclass(frozen=True, kw_only=True)
class Elements:
    """Results of one table.

    Attributes:
        id: (e,) element ids.
        grids: (e, n) grid ids of the elements, zero where they are not known.
        columns: names of our columns.
    """

    id: Int64
    grids: Int64
    columns: tuple[str, ...]

    @property
    def points(self) -> int:
        """Points with results in an element: the centre, or with corners."""
        return 1 + len({c.split("_")[0] for c in self.columns if _is_corner(c)})


def _is_corner(column: str) -> bool:
    head = column.split("_")[0]
    return head[:1] == "c" and head[1:].isdigit()


@dataclass(frozen=True, kw_only=True)
class Layout:
    """How the words of an element type lie.

    Attributes:
        type: Nastran's element type.
        cells: for each word of a row: a column, a constant, or integers (r,).
        rows: (r,) elements of the rows where there are several for each; None: one.
        places: per row the columns that change from row to row.
    """

    type: int
    cells: Sequence[Cell]

    @property
    def width(self) -> int:
        """Words per element."""
        return len(self.cells)


Maker = Callable[[Elements], Layout]


def words(layout: Layout, columns: Sequence[str], values: Float64) -> Float32:
    """(e, w) words of results (e, c)."""
    at = {name: k for k, name in enumerate(columns)}
    out = np.zeros((len(values), layout.width), "<f4")
    integers = out.view("<i4")
    for k, cell in enumerate(layout.cells):
        if isinstance(cell, str):
            out[:, k] = values[:, at[cell]]
        elif isinstance(cell, float):
            out[:, k] = cell
        else:
            integers[:, k] = cell
    return out


def _device(elements: Elements) -> Int64:
    return 10 * elements.id + DEVICE


def simple(number: int) -> Maker:
    """The id, then all columns as they come."""
    return lambda e: Layout(type=number, cells=[_device(e), *e.columns])


def _rod_stress(number: int) -> Maker:
    def make(e: Elements) -> Layout:
        first, second = e.columns
        cells = [_device(e), first, NO_MARGIN, second, NO_MARGIN]
        return Layout(type=number, cells=cells)

    return make


def _shear_stress(e: Elements) -> Layout:
    return Layout(type=4, cells=[_device(e), *e.columns, NO_MARGIN])


def _bar_stress(e: Elements) -> Layout:
    c = e.columns  # four points, axial, extremes at A; four points, extremes at B
    cells = [_device(e), *c[:7], NO_MARGIN, *c[7:], NO_MARGIN]
    return Layout(type=34, cells=cells)


def _beam(per_end: int, margins: int) -> Maker:
    """Eleven stations, of which the ends have results."""

    def make(e: Elements) -> Layout:
        half = len(e.columns) // 2
        empty: list[Cell] = [np.zeros(1, np.int64), *[0.0] * (1 + per_end + margins)]
        ends: list[list[Cell]] = []
        for k, place in enumerate((0.0, 1.0)):
            own = e.columns[k * half : (k + 1) * half]
            ends.append([e.grids[:, k], place, *own, *[NO_MARGIN] * margins])
        cells = [_device(e), *ends[0], *empty * 9, *ends[1]]
        return Layout(type=2, cells=cells)

    return make


def _plate(flat: int, bilinear: int) -> Maker:
    """The centre, or the centre and the corners with their grids."""

    def make(e: Elements) -> Layout:
        points, cells = e.points, [_device(e)]
        if points == 1:
            return Layout(type=flat, cells=[*cells, *e.columns])
        per_point = len(e.columns) // points
        cells.append(np.full(1, int.from_bytes(b"CEN/", "little")))
        corners = points - 1
        for k in range(points):
            grid = np.full(1, corners) if k == 0 else e.grids[:, k - 1]
            own = e.columns[k * per_point : (k + 1) * per_point]
            cells += [grid, *own]
        return Layout(type=bilinear, cells=cells)

    return make


def _solid(number: int) -> Maker:
    """Centre and corners: stresses, principal ones, mean pressure, von Mises."""

    def make(e: Elements) -> Layout:
        points = e.points
        grid_word = np.full(1, int.from_bytes(b"GRID", "little"))
        cells: list[Cell] = [_device(e), np.zeros(1, np.int64), grid_word]
        cells.append(np.full(1, points - 1))
        none = [0.0, 0.0, 0.0]
        for k in range(points):
            xx, yy, zz, xy, yz, zx, major, mid, minor, mises = e.columns[
                10 * k : 10 * k + 10
            ]
            grid = np.zeros(1, np.int64) if k == 0 else e.grids[:, k - 1]
            cells += [grid, xx, xy, major, *none, 0.0, mises]
            cells += [yy, yz, mid, *none, zz, zx, minor, *none]
        return Layout(type=number, cells=cells)

    return make


FORCES: dict[str, Maker] = {
    "CROD": simple(1),
    "CTUBE": simple(3),
    "CONROD": simple(10),
    "CBAR": simple(34),
    "CBEAM": _beam(7, 0),
    "CSHEAR": simple(4),
    "CELAS1": simple(11),
    "CELAS2": simple(12),
    "CELAS3": simple(13),
    "CELAS4": simple(14),
    "CDAMP1": simple(20),
    "CDAMP2": simple(21),
    "CDAMP3": simple(22),
    "CDAMP4": simple(23),
    "CVISC": simple(24),
    "CBUSH": simple(102),
    "CTRIA3": _plate(74, 74),
    "CQUAD4": _plate(33, 144),
}
STRESSES: dict[str, Maker] = {
    "CROD": _rod_stress(1),
    "CTUBE": _rod_stress(3),
    "CONROD": _rod_stress(10),
    "CBAR": _bar_stress,
    "CBEAM": _beam(6, 2),
    "CSHEAR": _shear_stress,
    "CELAS1": simple(11),
    "CELAS2": simple(12),
    "CELAS3": simple(13),
    "CELAS4": simple(14),
    "CBUSH": simple(102),
    "CTRIA3": _plate(74, 74),
    "CQUAD4": _plate(33, 144),
    "CTETRA": _solid(39),
    "CHEXA": _solid(67),
    "CPENTA": _solid(68),
    "CPYRAM": _solid(255),
}
# Plies: one row per element and ply.
PLIES = {"CQUAD4_COMPOSITE": 95, "CTRIA3_COMPOSITE": 97}


def ply_words(id: Int64, values: Float64) -> Float32:
    """(r, 11) words of ply results (e, 9 p); plies that an element lacks are NaN."""
    plies = values.reshape(len(id), -1, 9)
    element, ply = np.nonzero(np.isfinite(plies[:, :, 0]))
    out = np.zeros((len(element), 11), "<f4")
    integers = out.view("<i4")
    integers[:, 0], integers[:, 1] = 10 * id[element] + DEVICE, ply + 1
    out[:, 2:] = plies[element, ply]
    return out

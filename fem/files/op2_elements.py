"""Words of element results in OP2 files.

Which columns an element has, and its layout, stand in its record (`Op2`).
Each layout turns results (e, c) in our columns into rows of 32-bit words; ids and grid
numbers are integers among the reals. What Nastran fills with margins of safety is its
"no margin"; direction cosines of principal stresses of solids are left zero.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64, Int64
from fem.deck.records import CARDS, Op2
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
        """Points with results in an element: the center, or with corners."""
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


def words(layout: Layout, columns: Sequence[str], values: Float64) -> Float32:
    """(e, w) words of results (e, c), real, or real and imaginary parts one by one."""
    at = {name: k for k, name in enumerate(columns)}
    if np.iscomplexobj(values):
        at |= {imaginary(name): len(at) + k for name, k in at.items()}
        values = np.concatenate([values.real, values.imag], axis=1)
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


def imaginary(column: str) -> str:
    """Name of the imaginary part of a complex column."""
    return f"{column} imaginary"


def device(elements: Elements) -> Int64:
    """(e,) words of their ids."""
    return 10 * elements.id + DEVICE


def _simple(op2: Op2, e: Elements) -> Layout:
    """The id, then all columns as they come."""
    return Layout(type=op2.type, cells=[device(e), *e.columns])


def _rod_stress(op2: Op2, e: Elements) -> Layout:
    first, second = e.columns
    cells = [device(e), first, NO_MARGIN, second, NO_MARGIN]
    return Layout(type=op2.type, cells=cells)


def _panel_stress(op2: Op2, e: Elements) -> Layout:
    return Layout(type=op2.type, cells=[device(e), *e.columns, NO_MARGIN])


def _bar_stress(op2: Op2, e: Elements) -> Layout:
    c = e.columns  # four points, axial, extremes at A; four points, extremes at B
    cells = [device(e), *c[:7], NO_MARGIN, *c[7:], NO_MARGIN]
    return Layout(type=op2.type, cells=cells)


def _beam(op2: Op2, e: Elements) -> Layout:
    """Eleven stations, of which the ends have results; stresses with two margins."""
    half = len(e.columns) // 2
    margins = 2 if "smax_a" in e.columns else 0
    empty: list[Cell] = [np.zeros(1, np.int64), *[0.0] * (1 + half + margins)]
    ends: list[list[Cell]] = []
    for k, place in enumerate((0.0, 1.0)):
        own = e.columns[k * half : (k + 1) * half]
        ends.append([e.grids[:, k], place, *own, *[NO_MARGIN] * margins])
    cells = [device(e), *ends[0], *empty * 9, *ends[1]]
    return Layout(type=op2.type, cells=cells)


def _plate(op2: Op2, e: Elements) -> Layout:
    """The center, or the center and the corners with their grids."""
    points, cells = e.points, [device(e)]
    if points == 1:
        return Layout(type=op2.type, cells=[*cells, *e.columns])
    per_point = len(e.columns) // points
    cells.append(np.full(1, int.from_bytes(b"CEN/", "little")))
    corners = points - 1
    for k in range(points):
        grid = np.full(1, corners) if k == 0 else e.grids[:, k - 1]
        own = e.columns[k * per_point : (k + 1) * per_point]
        cells += [grid, *own]
    return Layout(type=op2.corners or op2.type, cells=cells)


def _solid(op2: Op2, e: Elements) -> Layout:
    """Center and corners: stresses, principal ones, mean pressure, von Mises."""
    points = e.points
    grid_word = np.full(1, int.from_bytes(b"GRID", "little"))
    cells: list[Cell] = [device(e), np.zeros(1, np.int64), grid_word]
    cells.append(np.full(1, points - 1))
    none = [0.0, 0.0, 0.0]
    for k in range(points):
        xx, yy, zz, xy, yz, zx, major, mid, minor, mises = e.columns[
            10 * k : 10 * k + 10
        ]
        grid = np.zeros(1, np.int64) if k == 0 else e.grids[:, k - 1]
        cells += [grid, xx, xy, major, *none, 0.0, mises]
        cells += [yy, yz, mid, *none, zz, zx, minor, *none]
    return Layout(type=op2.type, cells=cells)


def _ring(op2: Op2, e: Elements) -> Layout:
    """Center and corners with their grids."""
    cells: list[Cell] = [device(e)]
    for k in range(e.points):
        grid = np.zeros(1, np.int64) if k == 0 else e.grids[:, k - 1]
        cells += [grid, *e.columns[7 * k : 7 * k + 7]]
    return Layout(type=op2.type, cells=cells)


_ARRANGEMENTS: dict[str, Callable[[Op2, Elements], Layout]] = {
    "simple": _simple,
    "rod": _rod_stress,
    "bar": _bar_stress,
    "beam": _beam,
    "panel": _panel_stress,
    "plate": _plate,
    "solid": _solid,
    "ring": _ring,
}


def layout_of(card: str, kind: str, elements: Elements) -> Layout | None:
    """Words of the results of a card; None: there is no place for them.

    Args:
        card: table of the results, "CBAR".
        kind: "force", "stress" or "strain".
        elements: its elements and columns.
    """
    element = CARDS[card].element if card in CARDS else None
    if element is None or element.op2 is None:
        return None
    name = element.op2.force if kind == "force" else element.op2.stress
    return _ARRANGEMENTS[name](element.op2, elements) if name else None


def plies_of(table: str) -> int:
    """Element type of a table of plies, 0 for all others."""
    card = CARDS.get(table.removesuffix("_COMPOSITE"))
    if card is None or card.name == table or not card.element or not card.element.op2:
        return 0
    return card.element.op2.plies


def ply_words(id: Int64, values: Float64, columns: int) -> Float32:
    """(r, 11) words of ply results (e, c p); plies that an element lacks are NaN.

    With the seven columns of solids the place in the ply, its middle, and a grid, none,
    stand before them.
    """
    plies = values.reshape(len(id), -1, columns)
    element, ply = np.nonzero(np.isfinite(plies[:, :, 0]))
    out = np.zeros((len(element), 11), "<f4")
    integers = out.view("<i4")
    integers[:, 0], integers[:, 1] = 10 * id[element] + DEVICE, ply + 1
    if columns < 9:
        integers[:, 2] = int.from_bytes(b"MID ", "little")
    out[:, 11 - columns :] = plies[element, ply]
    return out

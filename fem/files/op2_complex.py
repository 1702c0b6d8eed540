"""Words of complex element results in OP2 files: real and imaginary parts, or polar.

Only the linear columns exist (`fem.recovery.harmonic`): stresses have no principal
values, no margins. Forces have all first parts of a point, then all second ones.
"""

from collections.abc import Callable, Sequence

import numpy as np

from fem.deck.records import CARDS, Op2
from fem.files.op2_elements import Cell, Elements, Layout, device, imaginary

_CENTER = int.from_bytes(b"CEN/", "little")
_GRID = int.from_bytes(b"GRID", "little")
_STATIONS = 9  # of a beam, between its ends
_PLANE = (("oxx", "oyy", "txy"), ("exx", "eyy", "exy"))
_SOLID = (
    ("oxx", "oyy", "ozz", "txy", "tyz", "txz"),
    ("exx", "eyy", "ezz", "exy", "eyz", "exz"),
)


def _both(columns: Sequence[str]) -> list[Cell]:
    """All first parts, then all second ones."""
    return [*columns, *map(imaginary, columns)]


def _pairs(columns: Sequence[str]) -> list[Cell]:
    """Each first part with its second one."""
    return [part for c in columns for part in (c, imaginary(c))]


def _simple(op2: Op2, e: Elements) -> Layout:
    return Layout(type=op2.type, cells=[device(e), *_both(e.columns)])


def _rod_stress(op2: Op2, e: Elements) -> Layout:
    return Layout(type=op2.type, cells=[device(e), *_pairs(e.columns)])


def _bar_stress(op2: Op2, e: Elements) -> Layout:
    a, b = e.columns[:5], e.columns[5:]  # four points and axial at A; four points at B
    return Layout(type=op2.type, cells=[device(e), *_both(a), *_both(b)])


def _beam(op2: Op2, e: Elements) -> Layout:
    """Eleven stations, of which the ends have results."""
    half = len(e.columns) // 2
    empty: list[Cell] = [np.zeros(1, np.int64), *[0.0] * (1 + 2 * half)]
    ends: list[list[Cell]] = [
        [e.grids[:, k], place, *_both(e.columns[k * half : (k + 1) * half])]
        for k, place in enumerate((0.0, 1.0))
    ]
    return Layout(
        type=op2.type, cells=[device(e), *ends[0], *empty * _STATIONS, *ends[1]]
    )


def _at_points(
    op2: Op2, e: Elements, of_point: Callable[[Sequence[str]], list[Cell]]
) -> Layout:
    """The center of a plate, or the center and the corners with their grids."""
    points, cells = e.points, [device(e)]
    if points == 1:
        return Layout(type=op2.type, cells=[*cells, *of_point(e.columns)])
    per_point = len(e.columns) // points
    cells.append(np.full(1, _CENTER))
    for k in range(points):
        own = e.columns[k * per_point : (k + 1) * per_point]
        grid = np.full(1, points - 1) if k == 0 else e.grids[:, k - 1]
        cells += [grid, *of_point(own)]
    return Layout(type=op2.corners or op2.type, cells=cells)


def _plate_force(op2: Op2, e: Elements) -> Layout:
    return _at_points(op2, e, _both)


def _plate_stress(op2: Op2, e: Elements) -> Layout:
    def of_point(columns: Sequence[str]) -> list[Cell]:
        found: list[Cell] = []
        for fibre in columns:
            if "fibre" in fibre:
                found.append(fibre)
                suffix = fibre[-2:]
                own = [c for c in columns if c.endswith(suffix)]
                found += _pairs([c for c in own if _plain(c) in sum(_PLANE, ())])
        return found

    return _at_points(op2, e, of_point)


def _plain(column: str) -> str:
    """Name of a column without its corner and its fibre."""
    name = column.rsplit("_", 1)[0] if column[-2:] in ("_1", "_2") else column
    return name.split("_", 1)[1] if name[:1] == "c" and name[1:2].isdigit() else name


def _solid(op2: Op2, e: Elements) -> Layout:
    points = e.points
    cells: list[Cell] = [device(e), np.zeros(1, np.int64), np.full(1, _GRID)]
    cells.append(np.full(1, points - 1))
    per_point = len(e.columns) // points
    for k in range(points):
        own = e.columns[k * per_point : (k + 1) * per_point]
        stress = [c for c in own if _plain(c) in sum(_SOLID, ())]
        grid = np.zeros(1, np.int64) if k == 0 else e.grids[:, k - 1]
        cells += [grid, *_both(stress)]
    return Layout(type=op2.type, cells=cells)


_ARRANGEMENTS: dict[tuple[str, str], Callable[[Op2, Elements], Layout]] = {
    ("simple", "force"): _simple,
    ("simple", "stress"): _simple,
    ("rod", "stress"): _rod_stress,
    ("bar", "stress"): _bar_stress,
    ("beam", "force"): _beam,
    ("beam", "stress"): _beam,
    ("plate", "force"): _plate_force,
    ("plate", "stress"): _plate_stress,
    ("solid", "stress"): _solid,
}


def complex_layout_of(card: str, kind: str, elements: Elements) -> Layout | None:
    """Layout as `layout_of` for complex results, whose columns have both parts."""
    element = CARDS[card].element if card in CARDS else None
    if element is None or element.op2 is None:
        return None
    force = kind == "force"
    name = element.op2.force if force else element.op2.stress
    arrange = _ARRANGEMENTS.get((name, "force" if force else "stress"))
    return arrange(element.op2, elements) if arrange else None

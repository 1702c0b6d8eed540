"""The hull's grids: rows × lines, less the openings."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.halves import Halves
from drake_landing.reference.d150.fuselage.lines import Lines
from drake_landing.reference.d150.fuselage.rows import Rows
from drake_landing.reference.d150.geometry import Float64, Int64

SKIN = "fuselage skin"
Bool = npt.NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class Hull:
    """Grids of the skin.

    Attributes:
        halves: the bench.
        rows: along the fuselage.
        lines: from crown to keel.
        present: (r - 1, n) whether there is skin.
        ids: (r, n + 1, 2) twins; 0 where an opening leaves no grid.
    """

    halves: Halves
    rows: Rows
    lines: Lines
    present: Bool
    ids: Int64

    def line(self, name: str) -> int:
        """Number of a named line."""
        return self.lines.index[name]

    def at(self, row: int, line: int) -> Int64:
        """Twin of a grid."""
        return self.ids[row, line]

    def p(self, row: int, line: int) -> Float64:
        """(3,) position of a starboard grid."""
        return self.lines.p[row, line]

    def ring(self, row: int) -> list[Int64]:
        """Twins of a row that exist, from crown to keel."""
        return [t for t in self.ids[row] if t[0]]

    @property
    def bay_edge(self) -> int:
        """Line at the outer edge of the opening of the main gear bay."""
        data = facts("fuselage_shell")["main_bay"]
        row = self.rows.at(data["frames"][0])
        angle = np.rad2deg(self.lines.angle[row])
        return int(np.argmin(np.abs(angle - data["edge_angle"])))

    @property
    def nose_bay_edge(self) -> int:
        """Line of the side walls of the nose gear bay."""
        return nose_bay_line(self.rows, self.lines)


def make_hull(halves: Halves, rows: Rows, lines: Lines) -> Hull:
    """Writes the grids of the skin."""
    present = _skin_present(rows, lines)
    used = np.zeros(lines.p.shape[:2], bool)
    for corner in (np.s_[:-1, :-1], np.s_[1:, :-1], np.s_[:-1, 1:], np.s_[1:, 1:]):
        used[corner] |= present
    used[rows.at(facts("fuselage_shell")["main_bay"]["frames"][0])] = True
    ids = np.zeros((*used.shape, 2), np.int64)
    ids[used] = halves.grids(SKIN, lines.p[used])
    return Hull(halves=halves, rows=rows, lines=lines, present=present, ids=ids)


def nose_bay_line(rows: Rows, lines: Lines) -> int:
    """The line nearest to the side walls of the nose gear bay."""
    data = facts("fuselage_shell")["nose_bay"]
    row = rows.at(data["frames"][1])
    low = lines.index["cargo"]
    return lines.nearest(row, 1, data["half_width"], low, lines.index["keel"])


def tailplane_lines(rows: Rows, lines: Lines) -> tuple[int, int]:
    """Lines above and below the opening of the tailplane."""
    data = facts("fuselage_shell")["tailplane_opening"]
    low, high = data["z"]
    z = lines.p[list(rows.between(*data["frames"])), :, 2]
    above = np.flatnonzero(np.all(z >= high, axis=0)).max()
    below = np.flatnonzero(np.all(z <= low, axis=0)).min()
    return int(above), int(below)


def _skin_present(rows: Rows, lines: Lines) -> Bool:
    """Everywhere but in the openings."""
    data, index = facts("fuselage_shell"), lines.index
    present = np.ones((len(rows.x) - 1, lines.count), bool)

    def open_up(frames: tuple[str, str], first: int, last: int) -> None:
        present[rows.at(frames[0]) : rows.at(frames[1]), first:last] = False

    main = data["main_bay"]
    row = rows.at(main["frames"][0])
    edge = int(np.argmin(np.abs(np.rad2deg(lines.angle[row]) - main["edge_angle"])))
    open_up(tuple(facts("fuselage")["wing_frames"]), index["wing"], index["keel"])
    open_up(tuple(main["frames"]), edge, index["keel"])
    bay = data["nose_bay"]["frames"]
    open_up(tuple(bay), nose_bay_line(rows, lines), lines.count)
    tail = data["tailplane_opening"]["frames"]
    open_up(tuple(tail), *tailplane_lines(rows, lines))
    windows = np.ix_(
        window_rows(rows), range(index["window_top"], index["window_bottom"])
    )
    present[windows] = False
    return present


def window_rows(rows: Rows) -> list[int]:
    """Rows of elements with a window: amid every bay that has three rows or more."""
    data = facts("fuselage_shell")["windows"]
    found: list[int] = []
    for bay in range(rows.number(data["first"]), rows.number(data["last"])):
        inside = np.flatnonzero(rows.bay == bay)
        if len(inside) >= 3:
            edge = (len(inside) - 1) // 2
            found += inside[edge : len(inside) - edge].tolist()
    return found

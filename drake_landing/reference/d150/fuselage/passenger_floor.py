"""Passenger floor: crossbeams at the frames, sandwich panels and seat rails, struts.

Crossbeams lie below the panels, whose grids follow theirs at the frames; between two
frames the panels have rows of their own. Over the center wing box and the main gear bay
the crossbeams are deep, and stiffen the pressure deck.
"""

from dataclasses import dataclass

import numpy as np

from drake_landing.reference.d150.beams import UP
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.geometry import Int64

FLOOR = "fuselage passenger floor"
DECK = "fuselage pressure deck"


@dataclass(frozen=True, kw_only=True)
class PassengerFloor:
    """Grids of the floor.

    Attributes:
        columns: (c,) y of its lines, m.
        beams: row -> (c + 1, 2) twins of a crossbeam, 0 where the floor is narrower;
            the last is the skin's.
    """

    columns: tuple[float, ...]
    beams: dict[int, Int64]

    def beam(self, row: int) -> list[Int64]:
        """Twins of a crossbeam from the center plane to the skin."""
        return [t for t in self.beams[row] if t[0]]


def add_passenger_floor(hull: Hull) -> PassengerFloor:
    """Writes crossbeams, panels, rails, struts and the pressure deck."""
    data = facts("fuselage_shell")["passenger_floor"]
    columns = tuple(c[0] for c in data["columns"])
    floor = PassengerFloor(columns=columns, beams=_beams(hull))
    _panels(hull, floor)
    _deck(hull, floor)
    _struts(hull, floor)
    return floor


def _active(hull: Hull) -> np.ndarray:
    """(c, r) where each line of the floor exists."""
    rows = hull.rows
    columns = facts("fuselage_shell")["passenger_floor"]["columns"]
    active = np.zeros((len(columns), len(rows.x)), bool)
    for k, (_, first, last, _) in enumerate(columns):
        active[k, rows.at(first) : rows.at(last) + 1] = True
    return active


def _beams(hull: Hull) -> dict[int, Int64]:
    halves, rows, active = hull.halves, hull.rows, _active(hull)
    data = facts("fuselage_shell")["passenger_floor"]
    y = np.array([c[0] for c in data["columns"]])
    heavy = rows.frames(*data["heavy_frames"])
    beams = {}
    for row in rows.frames(*data["columns"][0][1:3]):
        use = active[:, row]
        twins = np.zeros((len(y) + 1, 2), np.int64)
        edge = hull.p(row, hull.line("floor"))
        p = np.stack([0 * y + edge[0], y, 0 * y + edge[2]], axis=1)
        twins[:-1][use] = halves.grids(FLOOR, p[use])
        twins[-1] = hull.at(row, hull.line("floor"))
        profile = "wing_crossbeam" if row in heavy else "passenger_crossbeam"
        pid = halves.profile(profile)
        halves.chain(FLOOR, pid, [t for t in twins if t[0]], UP)
        beams[row] = twins
    return beams


def _panels(hull: Hull, floor: PassengerFloor) -> None:
    halves, active = hull.halves, _active(hull)
    data = facts("fuselage_shell")["passenger_floor"]
    panel = data["panel"]
    pid = halves.sheet("fuselage floor panel", panel["thickness"], panel["bending"])
    grid = np.zeros((*active.T.shape, 2), np.int64)
    y, x = np.meshgrid(floor.columns, hull.rows.x)
    p = np.stack([x, y, np.full_like(x, data["panel_z"])], axis=-1)
    grid[active.T] = halves.grids(FLOOR, p[active.T])
    for row, beam in floor.beams.items():
        for k in np.flatnonzero(active[:, row]):
            halves.follow(FLOOR, beam[k], grid[row, k])
    for row in range(len(grid) - 1):
        for k in range(len(floor.columns) - 1):
            corners = [(row, k), (row + 1, k), (row + 1, k + 1), (row, k + 1)]
            if all(grid[c][0] for c in corners):
                halves.shell(FLOOR, pid, [grid[c] for c in corners])
    for k, (*_, rail) in enumerate(data["columns"]):
        if rail:
            halves.chain(FLOOR, halves.profile(rail), grid[active[k], k], UP)


def _deck(hull: Hull, floor: PassengerFloor) -> None:
    """The pressure deck, in the plane of the crossbeams, from skin to skin."""
    halves, data = hull.halves, facts("fuselage_shell")["pressure_deck"]
    pid = halves.sheet("fuselage pressure deck", data["thickness"], data["bending"])
    grid = []
    for row in hull.rows.between(*data["frames"]):
        if row in floor.beams:
            grid.append(floor.beams[row])
            continue
        edge = hull.p(row, hull.line("floor"))
        p = np.array([[edge[0], y, edge[2]] for y in floor.columns])
        twins = halves.grids(DECK, p)
        grid.append(np.concatenate([twins, hull.at(row, hull.line("floor"))[None]]))
    halves.patch(DECK, pid, np.array(grid))


def _struts(hull: Hull, floor: PassengerFloor) -> None:
    """From the crossbeams to the frames below, but not over wing box and gear bay."""
    halves, data = hull.halves, facts("fuselage_shell")["passenger_floor"]
    without = hull.rows.frames(*data["heavy_frames"])
    foot = strut_line(hull)
    for row in hull.rows.frames(*data["strut_frames"]):
        if row in without:
            continue
        halves.strut(FLOOR, strut_head(floor, row), hull.at(row, foot))


def strut_line(hull: Hull) -> int:
    """The line of the skin below the struts."""
    y = facts("fuselage_shell")["passenger_floor"]["strut_y"]
    row = hull.rows.at(facts("fuselage_shell")["section_frame"])
    return hull.lines.nearest(row, 1, y, hull.line("wing"), hull.line("keel"))


def strut_head(floor: PassengerFloor, row: int) -> Int64:
    """The crossbeam's grid that stands on the strut."""
    y = facts("fuselage_shell")["passenger_floor"]["strut_y"]
    beam = floor.beams[row][:-1]
    usable = [k for k in range(len(beam)) if beam[k, 0]]
    return beam[min(usable, key=lambda k: abs(floor.columns[k] - y))]

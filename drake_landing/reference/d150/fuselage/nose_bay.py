"""Nose gear bay: an open box in the belly, side walls, roof and end walls.

Stiffeners stand on the side walls and lie across the roof at every frame; posts hold
the roof's corners on the passenger floor, struts on the frames beside the bay.
"""

import numpy as np

from drake_landing.reference.d150.beams import UP
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.fuselage.passenger_floor import PassengerFloor
from drake_landing.reference.d150.geometry import Int64

BAY = "fuselage nose gear bay"
_AFT = (1.0, 0.0, 0.0)


def add_nose_bay(hull: Hull, floor: PassengerFloor) -> list[int]:
    """Writes the bay.

    Returns:
        Grids of the side walls that hold the nose gear, both sides.
    """
    halves, data = hull.halves, facts("fuselage_shell")["nose_bay"]
    rows = list(hull.rows.between(*data["frames"]))
    line, across = hull.nose_bay_edge, hull.lines.count - hull.nose_bay_edge
    share = np.linspace(0.0, 1.0, data["high"] + 1)[1:, None]
    walls, roofs = [], []
    for row in rows:
        foot = hull.p(row, line)
        side = foot + share * np.array([0.0, 0.0, data["roof_z"] - foot[2]])
        inward = np.linspace(1.0, 0.0, across + 1)[1:, None]
        roof = side[-1] * (1.0, 0.0, 1.0) + inward * (side[-1] * (0.0, 1.0, 0.0))
        twins = halves.grids(BAY, np.concatenate([side, roof]))
        walls.append(np.concatenate([hull.at(row, line)[None], twins[: len(side)]]))
        roofs.append(twins[len(side) - 1 :])
    wall, roof = np.array(walls), np.array(roofs)
    sheet = data["sheet"]
    pid = halves.sheet("fuselage nose bay", sheet["thickness"], sheet["bending"])
    halves.patch(BAY, pid, wall)
    halves.patch(BAY, pid, roof)
    for end in (0, -1):
        _end_wall(hull, rows[end], pid, wall[end], roof[end])
    _stiffen(hull, rows, wall, roof)
    _brace(hull, floor, rows, wall[:, -1])
    first, last = (hull.rows.at(f) - rows[0] for f in data["gear_frames"])
    return sorted({int(i) for i in wall[first : last + 1].ravel()})


def _end_wall(hull: Hull, row: int, pid: int, side: Int64, roof: Int64) -> None:
    """Between the side walls, from the skin to the roof."""
    halves, line = hull.halves, hull.nose_bay_edge
    skin = hull.ids[row, line:]
    bottom, top = halves.positions(skin), halves.positions(roof)
    share = np.linspace(0.0, 1.0, len(side))[1:-1, None, None]
    inner = bottom[1:] + share * (top - bottom)[1:]
    twins = halves.grids(BAY, inner)
    middle = np.concatenate([side[1:-1, None], twins], axis=1)
    grid = np.concatenate([skin[None], middle, roof[None]])
    halves.patch(BAY, pid, grid)


def _stiffen(hull: Hull, rows: list[int], wall: Int64, roof: Int64) -> None:
    halves = hull.halves
    beam = halves.profile("bay_beam")
    for k, row in enumerate(rows):
        if hull.rows.frame[row] >= 0:
            halves.chain(BAY, beam, wall[k], _AFT)
            halves.chain(BAY, beam, roof[k], _AFT)
    longeron = halves.profile("opening_longeron")
    for height in (0, -1):
        halves.chain(BAY, longeron, wall[:, height], UP)


def _brace(hull: Hull, floor: PassengerFloor, rows: list[int], corner: Int64) -> None:
    """Posts from the roof's corners up to the crossbeams, struts out to the frames."""
    halves = hull.halves
    pid = halves.profile("bay_beam")
    for k, row in enumerate(rows):
        if hull.rows.frame[row] < 0:
            continue
        y, z = halves.position(corner[k])[1:]
        beam = floor.beam(row)[:-1]
        head = min(beam, key=lambda t: abs(halves.position(t)[1] - y))
        halves.bar(BAY, pid, corner[k], head, _AFT)
        line = hull.lines.nearest(row, 2, z, hull.line("floor"), hull.line("keel"))
        halves.bar(BAY, pid, corner[k], hull.at(row, line), _AFT)

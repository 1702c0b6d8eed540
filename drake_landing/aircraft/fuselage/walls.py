"""Walls across the lower fuselage: beside the wing's spars, and behind the main bay.

At the main frames the spar webs of the centre wing box are the wall; sheets close the
gaps above, to the floor, and below, to the skin.
"""

import numpy as np

from drake_landing.aircraft.facts import facts
from drake_landing.aircraft.fuselage.hull import Hull
from drake_landing.aircraft.fuselage.passenger_floor import PassengerFloor
from drake_landing.aircraft.fuselage.wing_fit import Fit
from drake_landing.aircraft.geometry import Int64

WALLS = "fuselage walls"
_AFT = (1.0, 0.0, 0.0)
_CLOSE = 0.04  # m: a skin grid so near to the spar's edge stands on it


def add_spar_wall(
    hull: Hull, floor: PassengerFloor, frame: str, face: str, fit: Fit
) -> None:
    """Sheets from a spar of the centre box up to the floor and down to the skin.

    Args:
        hull: the skin.
        floor: the passenger floor.
        frame: C36 or C42.
        face: `front` or `rear` web of the wing.
        fit: joins grids to the wing.
    """
    halves, row = hull.halves, hull.rows.at(frame)
    data = facts("fuselage_shell")["main_bay"]["wall"]
    pid = halves.sheet("fuselage bay wall", data["thickness"], data["bending"])
    top, bottom = fit.edges(face)
    beam = floor.beam(row)
    p = np.array([halves.position(t) for t in beam[:-1]])
    p[:, 2] = top
    spar = halves.grids(WALLS, p)
    for twin in spar:
        fit.to_face(WALLS, twin, face)
    edge = hull.at(row, hull.line("wing"))
    halves.patch(WALLS, pid, np.array([beam, [*spar, edge]]))
    _below_spar(hull, row, pid, bottom, face, fit)


def _below_spar(
    hull: Hull, row: int, pid: int, bottom: float, face: str, fit: Fit
) -> None:
    """The sheet below the spar: columns above the skin's grids up to the spar."""
    halves, p = hull.halves, hull.lines.p[row]
    lines = range(hull.line("wing") + 1, hull.lines.count + 1)
    beside = [k for k in lines if p[k, 2] >= bottom - _CLOSE]
    below = [k for k in lines if p[k, 2] < bottom - _CLOSE]
    for k in beside:
        fit.to_face(WALLS, hull.at(row, k), face)
    heads = p[below].copy()
    heads[:, 2] = bottom
    middles = (heads + p[below]) / 2
    head, middle = halves.grids(WALLS, heads), halves.grids(WALLS, middles)
    for twin in head:
        fit.to_face(WALLS, twin, face)
    grid = np.array([head, middle, hull.ids[row, below]])
    halves.patch(WALLS, pid, grid)
    last = hull.at(row, beside[-1])
    halves.shell(WALLS, pid, [last, head[0], middle[0]])
    halves.shell(WALLS, pid, [last, middle[0], grid[2, 0]])


def add_bay_wall(hull: Hull, floor: PassengerFloor, frame: str) -> Int64:
    """The wall from the floor to the skin at a frame, with upright stiffeners.

    Returns:
        (rows, columns, 2) twins, from the floor down, from the centre plane out.
    """
    halves, row = hull.halves, hull.rows.at(frame)
    data = facts("fuselage_shell")["main_bay"]["wall"]
    pid = halves.sheet("fuselage bay wall", data["thickness"], data["bending"])
    beam = floor.beam(row)
    share = np.array([halves.position(t)[1] for t in beam])
    share = share / share[-1]
    grid = [np.array(beam)]
    for line in range(hull.line("floor") + 1, hull.lines.count):
        edge = hull.p(row, line)
        p = np.stack([0 * share + edge[0], share * edge[1], 0 * share + edge[2]], 1)
        twins = halves.grids(WALLS, p[:-1])
        grid.append(np.concatenate([twins, hull.at(row, line)[None]]))
    grid.append(np.repeat(hull.at(row, hull.lines.count)[None], len(share), axis=0))
    wall = np.array(grid)
    halves.patch(WALLS, pid, wall)
    stiffener = halves.profile("bulkhead_stiffener")
    for column in range(0, len(share) - 1, 2):
        halves.chain(WALLS, stiffener, wall[:-1, column], _AFT)
    return wall

"""Walls across the lower fuselage: beside the wing's spars, and behind the main bay.

At the main frames the spar webs of the center wing box are the wall; sheets close the
gaps above, to the floor, and below, to the skin.
"""

from itertools import pairwise

import numpy as np

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.halves import Halves
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.fuselage.passenger_floor import PassengerFloor
from drake_landing.reference.d150.fuselage.wing_fit import Fit
from drake_landing.reference.d150.geometry import Int64

WALLS = "fuselage walls"
_AFT = (1.0, 0.0, 0.0)
_CLOSE = 0.04  # m: a skin grid so near to the spar's edge stands on it


def add_spar_wall(
    hull: Hull, floor: PassengerFloor, frame: str, face: str, fit: Fit
) -> None:
    """Sheets from a spar of the center box up to the floor and down to the skin.

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
    head, middle = halves.shared(WALLS, heads), halves.shared(WALLS, middles)
    for twin in head:
        fit.to_face(WALLS, twin, face)
    grid = np.array([head, middle, hull.ids[row, below]])
    halves.patch(WALLS, pid, grid)
    last = hull.at(row, beside[-1])
    halves.shell(WALLS, pid, [last, head[0], middle[0]])
    halves.shell(WALLS, pid, [last, middle[0], grid[2, 0]])


def add_bay_wall(hull: Hull, floor: PassengerFloor, frame: str, keel: Int64) -> None:
    """The wall from the floor to the skin at a frame, with upright stiffeners.

    Toward the keel, where it is narrow, it has half and a quarter of its columns.

    Args:
        hull: the skin.
        floor: the passenger floor.
        frame: where it stands.
        keel: twins of the keel's web there, which pass through the wall.
    """
    halves, row = hull.halves, hull.rows.at(frame)
    data = facts("fuselage_shell")["main_bay"]["wall"]
    pid = halves.sheet("fuselage bay wall", data["thickness"], data["bending"])
    beam = floor.beam(row)
    share = np.array([halves.position(t)[1] for t in beam])
    lines = range(hull.line("floor") + 1, hull.line("keel"))
    wall = [dict(enumerate(beam))]
    for line, stride in zip(lines, _strides(len(lines))):
        edge, columns = hull.p(row, line), np.arange(0, len(share), stride)
        p = np.tile(edge, (len(columns), 1))
        p[:, 1] *= share[columns] / share[-1]
        twins = [*halves.grids(WALLS, p[:-1]), hull.at(row, line)]
        wall.append(dict(zip(columns.tolist(), twins)))
    sheets = [c for upper, lower in pairwise(wall) for c in _strip(upper, lower)]
    inner, middle, outer = wall[-1].values()
    foot, bottom = hull.at(row, hull.line("keel")), hull.at(row, hull.lines.count)
    sheets += [[inner, middle, foot, bottom], [middle, outer, foot]]
    for corners in sheets:
        halves.shell(WALLS, pid, corners)
    stiffener = halves.profile("bulkhead_stiffener")
    for column in range(0, len(share) - 1, 2):
        chain = [upright[column] for upright in wall if column in upright]
        halves.chain(WALLS, stiffener, chain, _AFT)
    for twin in keel[1:]:
        _through(halves, twin, sheets)


def _strides(count: int) -> list[int]:
    """Columns of the floor per column of the wall, from the floor down."""
    return [1] * (count - 5) + [2] * 3 + [4] * 2


def _strip(upper: dict[int, Int64], lower: dict[int, Int64]) -> list[list[Int64]]:
    """Elements between two rows; the lower may have half of the upper's columns."""
    sheets = []
    for a, b in pairwise(lower):
        if a + (b - a) // 2 in upper and b - a > 1 and len(upper) > len(lower):
            amid = upper[(a + b) // 2]
            sheets.append([upper[a], amid, lower[a]])
            sheets.append([amid, lower[b], lower[a]])
            sheets.append([amid, upper[b], lower[b]])
        else:
            sheets.append([upper[a], upper[b], lower[b], lower[a]])
    return sheets


def _through(halves: Halves, twin: Int64, sheets: list[list[Int64]]) -> None:
    """A grid of the keel's web moves with the wall's element where it passes it."""
    middles = [np.mean([halves.position(t) for t in corners], 0) for corners in sheets]
    distance = np.linalg.norm(np.array(middles) - halves.position(twin), axis=1)
    around = np.array(sheets[int(np.argmin(distance))])
    for side in (0, 1):
        grids = [int(i) for i in around[:, side]]
        halves.model.average(WALLS, int(twin[side]), grids)
        halves.hold(int(twin[side]))

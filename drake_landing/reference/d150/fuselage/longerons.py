"""Longerons: along the edges of openings in belly and tail cone, and panel splices."""

import numpy as np

from drake_landing.reference.d150.beams import UP
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull, tailplane_lines

EDGES = "fuselage longerons"


def add_opening_edges(hull: Hull) -> None:
    """Along the main gear bay and above and below the tailplane's opening."""
    halves, data = hull.halves, facts("fuselage_shell")
    pid = halves.profile("opening_longeron")
    tail = data["tailplane_opening"]["edge_frames"]
    edges = [(hull.bay_edge, data["main_bay"]["edge_frames"])]
    edges += [(line, tail) for line in tailplane_lines(hull.rows, hull.lines)]
    for line, frames in edges:
        rows = hull.rows.between(*frames)
        halves.chain(EDGES, pid, [hull.at(row, line) for row in rows], UP)


def add_splices(hull: Hull) -> None:
    """The doubled edges of the skin panels where these are joined lengthwise."""
    strap = hull.halves.profile("stringer")
    for angle, *frames in facts("fuselage_shell")["splices"]:
        rows = hull.rows.between(*frames)
        middle = np.rad2deg(hull.lines.angle[rows[len(rows) // 2]])
        line = int(np.argmin(np.abs(middle - angle)))
        hull.halves.chain(EDGES, strap, [hull.at(row, line) for row in rows], UP)

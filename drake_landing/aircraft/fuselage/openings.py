"""Longerons along the edges of openings in belly and tail cone; the crown's strap."""

from drake_landing.aircraft.beams import UP
from drake_landing.aircraft.facts import facts
from drake_landing.aircraft.fuselage.hull import Hull, tailplane_lines

EDGES = "fuselage opening edges"


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


def add_crown_strap(hull: Hull) -> None:
    """The splice of the skin panels along the crown."""
    rows = hull.rows.between(*facts("fuselage_shell")["crown_strap"])
    strap = hull.halves.profile("stringer")
    hull.halves.chain(EDGES, strap, [hull.at(row, 0) for row in rows], UP)

"""Cargo floor before and behind wing box and gear bay: beams, panels, struts, rail."""

import numpy as np

from drake_landing.reference.d150.beams import UP
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.geometry import Int64

CARGO = "fuselage cargo floor"


def add_cargo_floor(hull: Hull) -> None:
    """Writes both compartments."""
    data = facts("fuselage_shell")["cargo_floor"]
    for compartment in ("forward", "aft"):
        _compartment(hull, *data[compartment])


def _compartment(hull: Hull, first: str, last: str) -> None:
    halves, line = hull.halves, hull.line("cargo")
    shares = np.array(facts("fuselage_shell")["cargo_floor"]["shares"])
    beam = halves.profile("cargo_crossbeam")
    grid = []
    for row in hull.rows.between(first, last):
        edge = hull.p(row, line)
        p = np.stack([0 * shares + edge[0], shares * edge[1], 0 * shares + edge[2]], 1)
        twins: Int64 = halves.grids(CARGO, p)
        grid.append(twins)
        if hull.rows.frame[row] >= 0:
            halves.chain(CARGO, beam, [*twins, hull.at(row, line)], UP)
            halves.strut(CARGO, twins[1], hull.at(row, hull.line("keel")))
    panel = facts("fuselage_shell")["cargo_floor"]["panel"]
    sheet = halves.sheet("fuselage floor panel", panel["thickness"], panel["bending"])
    halves.patch(CARGO, sheet, np.array(grid))
    rail = halves.profile("cargo_rail")
    halves.chain(CARGO, rail, [twins[0] for twins in grid], UP)

"""Fasteners and welds between sheets: how a joint shares its load."""

import numpy as np

from benchmarks.verification.mesh import Bulk
from benchmarks.verification.row import Row, figure
from benchmarks.verification.runner import run

_YOUNG, _THICK, _PITCH, _STIFF = 70.0, 0.5, 2.0, 50.0
_TARGET = 1e-4  # the foot's square reaches D over into both elements


def lap_joint() -> list[Row]:
    """Three in a row between equal strips, F1 = F3 = P (1/s + 1/k) / (2/s + 3/k)."""
    s = _YOUNG * _THICK / _PITCH
    outer = (1.0 / s + 1.0 / _STIFF) / (2.0 / s + 3.0 / _STIFF)
    rows = []
    for card, column in (("CFAST", "fx"), ("CWELD", "shear1")):
        bulk = _joint(card)
        results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nFORCE = ALL"))
        force = np.abs(results.column(f"static/1/element_force/{card}", column))
        if card == "CWELD":  # along the strips by either of its axes
            other = results.column(f"static/1/element_force/{card}", "shear2")
            force = np.hypot(force, other)
        rows += [
            figure(
                f"lap joint, three {card}",
                name,
                float(force[k]),
                exact,
                "compatibility of two strips",
                target=_TARGET,
            )
            for name, k, exact in (
                ("load of the outer one", 0, outer),
                ("load of the middle one", 1, 1.0 - 2.0 * outer),
            )
        ]
    return rows


def shell_in_solid() -> list[Row]:
    """A plate whose edge RSSCON clamps in a block of its height: one cantilever."""
    bulk = Bulk("MAT1,1,7.+10,,0.\nPSOLID,1,1\nPSHELL,2,1,.2,1,,1")
    x = np.array([0.0, 1.0])
    bulk.grids(np.array([(xi, y, z) for z in (-0.1, 0.1) for y in x for xi in x]))
    bulk.elements("CHEXA", 1, np.array([[0, 1, 3, 2, 4, 5, 7, 6]]))
    first = bulk.grid_count
    bulk.grids(np.array([(xi, y, 0.0) for y in x for xi in (1.0, 5.0)]))
    shell = np.array([[first, first + 1, first + 3, first + 2]])
    bulk.elements("CQUAD4", 2, shell)
    bulk.add("RSSCON", 9, "ELEM", 2, 1)
    bulk.add("SPC1", 1, 123, *(1, 3, 5, 7))
    for grid in (first + 2, first + 4):
        bulk.add("FORCE", 7, grid, 0, 500.0, 0.0, 0.0, 1.0)
    results = run(bulk.deck(101, "SPC = 1\nLOAD = 7\nDISP = ALL"))
    tip = results["static/1/displacement"][first + 1, 2]
    exact = 1000.0 * 5.0**3 / (3.0 * 7e10 * 0.2**3 / 12.0)
    return [
        figure(
            "plate clamped in a block (RSSCON)",
            "tip",
            float(tip),
            exact,
            "beam theory, one CHEXA and one CQUAD4",
            target=2e-3,
        )
    ]


def _joint(card: str) -> Bulk:
    """Strips of 1 width from -pitch and from 0, each of three elements, load 1."""
    bulk = Bulk(f"MAT1,1,{_YOUNG},,0.\nPSHELL,1,1,{_THICK}\nPSHELL,2,1,{_THICK}")
    for pid in (1, 2):
        x = _PITCH * (np.arange(4.0) + pid - 2.0)
        first = bulk.grid_count
        bulk.grids(np.array([(xi, y, 0.0) for xi in x for y in (0.0, 1.0)]))
        own = first + 2 * np.arange(3)
        bulk.elements("CQUAD4", pid, np.c_[own, own + 2, own + 3, own + 1])
    diameter = 1e-5
    if card == "CFAST":
        bulk.add("PFAST", 8, diameter, 0, 1, *[_STIFF] * 6)
    else:  # of no length, sheared: k = G A / LDMIN D
        shear = _STIFF * 0.2 * diameter / (0.25 * np.pi * diameter**2)
        bulk.add("MAT1", 2, 2.0 * shear, "", 0.0)
        bulk.add("PWELD", 8, 2, diameter)
    for i in range(3):
        x, eid = _PITCH * i, 90 + i
        if card == "CFAST":
            bulk.add(card, eid, 8, "PROP", 1, 2, "", "", "", x, 0.5, 0.0)
        else:
            blank = [""] * 6
            bulk.add(card, eid, 8, "", "PARTPAT", *[""] * 4, 1, 2, *blank, x, 0.5, 0.0)
    last = bulk.grid_count
    bulk.fix("23456", np.arange(last))
    bulk.fix("1", [last - 2, last - 1])
    bulk.forces(7, [0, 1], (1.0, 0.0, 0.0), [-0.5, -0.5])
    return bulk

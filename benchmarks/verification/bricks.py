"""CHEXA of eight grids: plies, no bubble functions; figures of Simcenter and MSC."""

import numpy as np

from benchmarks.verification.mesh import Bulk
from benchmarks.verification.row import Row, figure
from benchmarks.verification.runner import run

_SIDES = ((0.0, 0.0), (0.08, 0.0), (0.08, 0.1), (0.0, 0.1))


def layered_bricks() -> list[Row]:
    """Twelve CHEXA of two plies each, pulled at one end, clamped at the other."""
    x, y, z = (52.0, 34.66667, 17.33333, 0.0), (31.0, 15.5, 0.0), (15.0, 30.0)
    xyz = np.array([(a, b, c) for c in (*z, 0.0) for b in y for a in x])
    # The upper row first, from the clamp to the loads.
    first = np.array([i + 4 * j for j in (0, 1) for i in (0, 1, 2)])
    face = first[:, None] + np.array([0, 4, 16, 12])
    upper = np.concatenate([face, face + 1], axis=1)
    lower = np.where(upper < 12, upper + 24, upper - 12)
    conn = np.concatenate([upper, lower])
    bulk = Bulk(
        "MAT1,1,1.931+8,,.3\nPCOMPS,2,0,13\n,1,1,5.,,,,YES,ABS\n,2,1,5.,,,,YES,ABS"
    )
    bulk.grids(xyz)
    bulk.elements("CHEXA", 2, conn)
    bulk.fix("123456", xyz[:, 0] == 52.0)
    end = np.flatnonzero(xyz[:, 0] == 0.0)
    bulk.forces(2, end, (-1, 0, 0), np.full(9, 111.111))
    ours = run(bulk.deck(101, "SPC = 1\nLOAD = 2\nSTRESS = ALL"))
    table = "static/1/element_stress/CHEXA_COMPOSITE"
    figures = [
        ("o11, ply 1 beside the clamp", "o11_p1", 0, 1.060943),
        ("o33 beside the clamp", "o33_p1", 0, 0.185317),
        ("t12, ply 1 beside the clamp", "t12_p1", 0, 0.059782),
        ("t13, ply 2 beside the clamp", "t13_p2", 0, 0.083607),
        ("o11, ply 1 beside the loads", "o11_p1", 2, 0.800943),
        ("o11, ply 2 beside the loads", "o11_p2", 2, 1.349593),
        ("t23, ply 1 beside the loads", "t23_p1", 2, -0.028698),
        ("t13, ply 1 beside the loads", "t13_p1", 2, -0.175212),
        ("von Mises, ply 2 beside the loads", "von_mises_p2", 2, 1.437178),
    ]
    source = "Simcenter 2020.2 (pyNastran models, nx/composite_solids)"
    return [
        figure(
            "CHEXA of two plies", f"{what}, mPa", ours.column(table, name)[e], b, source
        )
        for what, name, e, b in figures
    ]


def brick_without_bubbles() -> list[Row]:
    """One CHEXA of PSOLID IN = TWO, 1 x 0.08 x 0.1, bent by a force at its end."""
    xyz = np.array([(x, y, z) for x in (0.0, 1.0) for y, z in _SIDES])
    bulk = Bulk("MAT1,1,1.+7,,.3\nPSOLID,1,1,0,TWO")
    bulk.grids(xyz)
    bulk.elements("CHEXA", 1, np.arange(8)[None])
    bulk.fix("123456", np.arange(4))
    bulk.fix("456", np.arange(4, 8))
    bulk.forces(2, np.arange(4, 8), (0, 0, -1), np.full(4, 0.25))
    u = run(bulk.deck(101, "SPC = 1\nLOAD = 2\nDISP = ALL"))["static/1/displacement"]
    figures = [
        ("u1 at the end", u[4, 0], -3.2308e-4),
        ("u2 at the end", u[4, 1], -8.3077e-6),
        ("u3 at the end", u[4, 2], -3.2633e-3),
    ]
    source = "MSC (pyNastran models, randvar2)"
    return [figure("CHEXA, IN TWO", what, a, b, source) for what, a, b in figures]

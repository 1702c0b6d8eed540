"""CTRIAX6 under pressure: figures of MSC."""

from benchmarks.verification.mesh import Bulk
from benchmarks.verification.row import Row, figure
from benchmarks.verification.runner import run

RINGS = """\
CTRIAX6,5301,1,5301,5302,5303,5304,5305,5306
,30.
CTRIAX6,5311,1,5311,5312,5313,5314,5315
,30.
GRID,5301,,6.,0.,0.
GRID,5302,,6.,0.,2.
GRID,5303,,6.,0.,4.
GRID,5304,,4.238,0.,3.
GRID,5305,,2.536,0.,2.
GRID,5306,,4.238,0.,1.
GRID,5311,,6.,0.,0.
GRID,5312,,6.,0.,2.
GRID,5313,,6.,0.,4.
GRID,5314,,3.402,0.,3.5
GRID,5315,,2.536,0.,2.
SPC1,1,2456,5301,THRU,5315
SPC1,1,3,5302,5312
PLOADX,2,.0222139,.0333209,5301,5302,5303
PLOADX1,2,5311,.0222139,.0333209,5311,5313
MAT1,1,1.,.8,.1"""


def rings_under_pressure() -> list[Row]:
    """Two CTRIAX6, one without a mid-side, material turned, E, G and nu at odds."""
    ours = run(Bulk(RINGS).deck(101, "SPC = 1\nLOAD = 2\nDISP = ALL\nSTRESS = ALL"))
    u, at = ours["static/1/displacement"], ours["grid_id"].tolist()
    table = "static/1/element_stress/CTRIAX6"
    figures = [
        ("u1 at 5301", u[at.index(5301), 0], -0.2956416),
        ("u3 at 5305", u[at.index(5305), 2], -0.3183309),
        ("u1 at 5311", u[at.index(5311), 0], -0.5260662),
        ("u3 at 5315", u[at.index(5315), 2], 0.3062404),
        ("radial at the center of 5301", ours.column(table, "radial")[0], -0.01862618),
        ("shear at a corner of 5301", ours.column(table, "c1_shear")[0], 0.02501979),
        ("axial at a corner of 5311", ours.column(table, "c3_axial")[1], -0.01793208),
        ("von Mises of 5311", ours.column(table, "von_mises")[1], 0.06401755),
    ]
    source = "MSC (pyNastran models, randvar2)"
    return [figure("two CTRIAX6", what, a, b, source) for what, a, b in figures]

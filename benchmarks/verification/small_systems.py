"""Small systems in time with closed solutions: start, delay, change of the step."""

import numpy as np

from benchmarks.verification.mesh import Bulk
from benchmarks.verification.row import Row, convergence, field
from benchmarks.verification.runner import run


def damped_oscillator() -> list[Row]:
    """A sudden force on mass, spring and damper, steps from coarse to fine."""
    m, hz, z = 2.0, 5.0, 0.05
    w = 2 * np.pi * hz
    rows = []
    found = []
    for steps in (200, 800, 3200):
        bulk = Bulk(f"TSTEP,7,{steps},{1.0 / steps:.10g}\nTLOAD1,5,6,,LOAD,8")
        bulk.lines.append("TABLED1,8\n+,0.,1.,10.,1.,ENDT\nSPOINT,1\nDAREA,6,1,0,3.")
        bulk.add("CELAS2", 1, m * w * w, 1)
        bulk.add("CMASS2", 2, m, 1)
        bulk.add("CDAMP2", 3, 2 * z * w * m, 1)
        ours = run(bulk.deck(109, "TSTEP = 7\nDLOAD = 5\nDISP = ALL"))
        u = ours["transient/1/displacement_scalar_point"][:, 0]
        found.append((f"{steps} steps", float(u.max())))
    wd = w * np.sqrt(1 - z * z)
    peak = 3.0 / (m * w * w) * (1 + np.exp(-z * w * np.pi / wd))
    rows += convergence(
        "damped oscillator",
        "peak after a step",
        found,
        peak,
        "closed form",
        target=1e-3,
    )
    return rows


# Tables go on as straight lines beyond their ends: zero is said before the start.
# Four scalar points of NASTRAN's demonstration problem 9-1: an oscillator with an
# initial velocity; a damper with a step and, later, a ramp; an oscillator with a
# delayed step; a damper by direct input that is released and then pushed.
FOUR_POINTS = """\
SOL 109
CEND
B2GG = DAMPER
IC = 3
DLOAD = 5
TSTEP = 7
DISP = ALL
BEGIN BULK
SPOINT,10,11,12,13
CMASS2,1,1.,10
CELAS2,2,100.,10
CELAS2,3,10.,11
CDAMP2,4,1.,11
CMASS2,5,1.,12
CDAMP2,6,6.,12
CELAS2,7,25.,12
CELAS2,8,10.,13
DMIG,DAMPER,0,6,1,0
DMIG,DAMPER,13,0,,13,0,1.
TIC,3,10,0,,10.
TIC,3,13,0,-10.
DLOAD,5,1.,1.,21,1.,22,1.,23
,1.,24
TLOAD1,21,35,,LOAD,41
TLOAD1,22,31,51,LOAD,42
TLOAD1,23,33,52,LOAD,41
TLOAD1,24,34,53,LOAD,41
DAREA,31,11,0,1.
DAREA,35,11,0,.5
DAREA,33,12,0,1.
DAREA,34,13,0,10.
DELAY,51,11,0,1.
DELAY,52,12,0,1.
DELAY,53,13,0,1.
TABLED1,41
,-2.,0.,0.,0.,0.,1.,1000.,1.
,ENDT
TABLED1,42
,-2.,0.,0.,0.,1000.,1000.,ENDT
TSTEP,7,{first},{h1},{stride1}
,,{second},{h2},{stride2}
ENDDATA
"""


def four_points() -> list[Row]:
    """NASTRAN's demonstration problem 9-1: TIC, DELAY, DMIG, a change of the step."""
    series: list[list[tuple[str, float]]] = [[], [], [], []]
    for n in (1, 4, 16):
        h1, h2 = 0.005 / n, 0.01 / n
        text = FOUR_POINTS.format(
            first=200 * n, h1=f"{h1:.9f}", stride1=n,
            second=100 * n, h2=f"{h2:.9f}", stride2=n,
        )  # fmt: skip
        ours = run(text)
        t = ours["transient/1/time"]
        late = np.maximum(t - 1.0, 0.0)
        exact = np.stack(
            [
                np.sin(10 * t),
                0.05 * (1 - np.exp(-10 * t))
                + 0.1 * (late - 0.1 * (1 - np.exp(-10 * late))),
                0.04
                * (
                    1 - np.exp(-3 * late) * (np.cos(4 * late) + 0.75 * np.sin(4 * late))
                ),
                -10 * np.exp(-10 * t) + 1 - np.exp(-10 * late),
            ],
            axis=1,
        )
        u = ours["transient/1/displacement_scalar_point"]
        for k, found in enumerate(series):
            row = field("", "", u[:, k], exact[:, k], "")
            found.append((f"{300 * n} steps", 1.0 + row.difference))
    rows = []
    for point, found in zip((10, 11, 12, 13), series):
        rows += convergence(
            "NASTRAN demonstration 9-1",
            f"point {point}: 1 + largest difference of the history over its peak",
            found,
            1.0,
            "closed form",
            target=3e-3,
        )
    return rows

"""CBEAM whose ends hold the warping of the section: closed forms, MSC's figures."""

import numpy as np

from benchmarks.verification.mesh import Bulk
from benchmarks.verification.row import Row, convergence, figure
from benchmarks.verification.runner import Results, run

_CASE = "I-beam in torsion, warping held"
# IPE 200: Saint-Venant's constant and warping coefficient, m^4 and m^6.
_J, _CW, _LENGTH, _TORQUE = 6.98e-8, 1.299e-8, 3.0, 100.0
_E, _G = 2.1e11, 8.1e10
_THEORY = "Vlasov's torsion: E Cw θ'' and G J θ', closed form"


def _beam(count: int, *, tip_held: bool) -> Results:
    bulk = Bulk("SOL 101\nCEND\nSPC=1\nLOAD=1\nDISP=ALL\nSPCF=ALL\nBEGIN BULK")
    bulk.add("MAT1", 1, _E, _G)
    bulk.add("PBEAM", 1, 1, 2.85e-3, 1.943e-5, 1.42e-6, "", _J, *[""] * 15, _CW)
    bulk.grids(np.linspace([0.0, 0.0, 0.0], [_LENGTH, 0.0, 0.0], count + 1))
    for i in range(1, count + 1):
        ends = [i, i + 1, 0.0, 1.0, 0.0]
        bulk.add("CBEAM", i, 1, *ends, *[""] * 9, 100 + i, 101 + i)
    bulk.add("SPOINT", 101, "THRU", 101 + count)
    bulk.add("SPC1", 1, 123456, 1)
    bulk.add("SPC1", 1, 0, 101, *[101 + count] * tip_held)
    bulk.add("MOMENT", 1, count + 1, 0, _TORQUE, 1.0, 0.0, 0.0)
    return run("\n".join([*bulk.lines, "ENDDATA", ""]))


def restrained_torsion() -> list[Row]:
    """Twist and bimoment of a cantilever, with the warping of one end held, of both."""
    decay = np.sqrt(_G * _J / (_E * _CW))
    whole = decay * _LENGTH
    rows = []
    for tip_held, name, less, root in (
        (False, "tip free to warp", np.tanh(whole), np.tanh(whole)),
        (True, "both ends held", 2.0 * np.tanh(whole / 2), np.tanh(whole / 2)),
    ):
        twist = _TORQUE / (_G * _J) * (_LENGTH - less / decay)
        both = {count: _beam(count, tip_held=tip_held) for count in (4, 16, 64)}
        tips = [
            (str(n), found.grid("static/1/displacement", n + 1)[3])
            for n, found in both.items()
        ]
        roots = [
            (str(n), abs(found["static/1/spc_force_scalar_point"][0]))
            for n, found in both.items()
        ]
        for quantity, values, exact in (
            (f"{name}: twist, rad", tips, twist),
            (f"{name}: bimoment of the root, N m2", roots, _TORQUE / decay * root),
        ):
            rows += convergence(_CASE, quantity, values, exact, _THEORY, target=1e-3)
    return rows


_MSC = "MSC Nastran, file of pyNastran's deck api3"
_TWO = """\
SOL 101
CEND
SPC=1
LOAD=1
DISP=ALL
FORCE=ALL
BEGIN BULK
MAT1,1,1.+7,4.+6
PBEAM,1,1,1.,.0833,.0833,,.05
+
+,,,,,,,1.2
GRID,201
GRID,202,,.4
GRID,203,,1.
SPOINT,204,205,206
CBEAM,201,1,201,202,0.,1.,0.
+
+,204,205
CBEAM,202,1,202,203,0.,1.,0.
+
+,205,206
SPC1,1,123456,201,203
SPC1,1,0,204,206
MOMENT,1,202,,2.,1.,0.,0.
ENDDATA
"""


def warping_of_two_beams() -> list[Row]:
    """Torsion of two unequal beams, held at both ends, as MSC has it."""
    found, case = run(_TWO), "two CBEAM with CW, SA, SB"
    # Undamped: the file's figures are those at 0 Hz with GE = 0.03333.
    alive = 1.0 + 0.03333**2
    force = "static/1/element_force/CBEAM"
    pairs = (
        (
            "twist, rad",
            found.grid("static/1/displacement", 202)[3],
            7.6690232e-10 * alive,
        ),
        (
            "warping freedom, rad/m",
            found["static/1/displacement_scalar_point"][1],
            -9.586280e-10 * alive,
        ),
        (
            "torque of 201",
            found.column(force, "total_torque_a")[0],
            1.2945312 * alive,
        ),
        (
            "warping torque of 201",
            found.column(force, "warping_torque_a")[0],
            1.2941477 * alive,
        ),
        (
            "warping torque of 202",
            found.column(force, "warping_torque_b")[1],
            -0.7029939 * alive,
        ),
    )
    return [figure(case, text, a, b, _MSC, target=1e-6) for text, a, b in pairs]

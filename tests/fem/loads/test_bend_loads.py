"""PLOAD1 on CBEND: a ring under pressure, the straight limit, NX's transient."""

import numpy as np
import pytest

from benchmarks.verification.runner import run
from fem.errors import InputError

ARC = """\
GRID,1,,10.,0.,0.
GRID,2,,0.,10.,0.
CBEND,1,1,1,2,10.,0.,0.,3
PBEND,1,2,.1,.01,.02,.03,10.
MAT1,2,1.+7,,.3
"""


def solve(bulk, load, case="FORCE = ALL\nSPCFORCES = ALL\nDISP = ALL"):
    text = (
        f"SOL 101\nCEND\nSPC = 1\nLOAD = 1\n{case}\nBEGIN BULK\n{bulk}{load}ENDDATA\n"
    )
    return run(text)


def test_ring_under_radial_load_carries_q_r():
    """Symmetry holds both ends of a quarter; the load is along r, axis X of CBEND."""
    held = "SPC1,1,23456,1\nSPC1,1,13456,2\n"
    found = solve(ARC.replace("10.,0.,0.,3", "0.,10.,0.,2") + held,
                  "PLOAD1,1,1,FXE,FR,0.,5.,1.,5.\n")  # fmt: skip
    force = found["static/1/element_force/CBEND/value"][0].reshape(2, 6)
    np.testing.assert_allclose(force[:, 4], 50.0, rtol=1e-9)
    np.testing.assert_allclose(force[:, [1, 2, 3, 5]], 0.0, atol=1e-7)
    assert force[0, 0] == pytest.approx(force[1, 0])
    u = found["static/1/displacement"]
    assert u[0, 0] == pytest.approx(u[1, 1])


@pytest.mark.parametrize("kind", ["FX", "FYE", "MZ", "FZ"])
def test_loads_are_in_balance(kind):
    """Force and moment of the grids are those of the load, linear along the arc."""
    held = "SPC1,1,123456,1,2\n"
    bulk = ARC.replace("10.,0.,0.,3", "0.,10.,0.,2") + held
    load = f"PLOAD1,1,1,{kind},LE,0.,3.,{10 * np.pi / 2:.7f},6.\n"
    found = solve(bulk, load)
    reaction = found["static/1/spc_force"]
    total = reaction[:, :3].sum(axis=0)
    moment = reaction[:, 3:].sum(axis=0)
    moment += np.cross([[10.0, 0, 0], [0, 10.0, 0]], reaction[:, :3]).sum(axis=0)
    s, weight = np.polynomial.legendre.leggauss(20)
    s, weight = 0.5 * (1.0 + s), 0.5 * weight
    angle = s * np.pi / 2
    r = np.stack([np.cos(angle), np.sin(angle), 0 * s], axis=1)
    t = np.stack([-np.sin(angle), np.cos(angle), 0 * s], axis=1)
    size = 3.0 + 3.0 * s
    if kind == "FX":  # r and s components run linearly: 3 and 0, 0 and -6
        vector = 3.0 * (1 - s)[:, None] * r - 6.0 * s[:, None] * t
    elif kind == "FYE":
        vector = size[:, None] * t
    else:
        vector = size[:, None] * np.array([0.0, 0.0, 1.0])
    arc = 10 * np.pi / 2
    if kind == "MZ":
        expected, turning = np.zeros(3), weight @ vector * arc
    else:
        expected = weight @ vector * arc
        turning = weight @ np.cross(10.0 * r, vector) * arc
    np.testing.assert_allclose(total, -expected, atol=2e-6)
    np.testing.assert_allclose(moment, -turning, atol=2e-5)


def test_a_nearly_straight_arc_is_a_bar():
    """Radius 1e6: deflection and end moment of a cantilever, q L^4 / 8 E I."""
    bulk = (
        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBEND,1,1,1,2,.5,1.+6,,1\n"
        "PBEND,1,2,.1,.01,.01,.02\nMAT1,2,1.+7,,.3\nSPC1,1,123456,2\n"
    )
    found = solve(bulk, "PLOAD1,1,1,FY,FR,0.,8.,1.,8.\n")
    u = found["static/1/displacement"][0]
    assert u[1] == pytest.approx(8.0 / (8 * 1e7 * 0.01), rel=1e-6)
    force = found["static/1/element_force/CBEND/value"][0].reshape(2, 6)
    assert abs(force[0, 0]) < 1e-6
    assert abs(force[1, 0]) == pytest.approx(4.0, rel=1e-6)


NX = """\
TSTEP,20,10,.1,5
GRID,6,,0.,0.,4.,,123456
GRID,7,,1.,0.,4.
CBEND,33,14,6,7,5.,5.,0.,1
PBEND,14,21,.5,.0833,.0833,.05
MAT1,21,2.+4,1.+4,,.1
CONM2,123,7,,64.
,1.,,16.,,,16.
CMASS2,133,-63.,7,1
DLOAD,1,1.,1.,10
PLOAD1,10,33,FY,FR,0.,-2.+3,1.,-2.+3
TLOAD1,10,10,,,24
TABLED1,24
,0.,0.,.1,0.,1.1,1.,1.125,0.
,2.1,0.,ENDT
TIC,10,7,1,.001
"""


def test_nx_transient_of_a_quarter_circle():
    """tst1d3 of pyNastran's models, its CBEND, to the four digits of the loads."""
    case = "DLOAD = 1\nIC = 10\nTSTEP = 20\nDISP = ALL"
    found = run(f"SOL 109\nCEND\n{case}\nBEGIN BULK\n{NX}ENDDATA\n")
    u = found["transient/1/displacement"][:, 1][:, [0, 1, 5]]
    theirs = [
        [1.2630841e-04, -4.0937919e-02, -5.5563211e-02],
        [-3.9264485e-03, -1.2484707e-01, -1.8275350e-01],
    ]
    np.testing.assert_allclose(u[1:], theirs, atol=5e-6, rtol=2e-5)


@pytest.mark.parametrize(
    ("load", "message"),
    [
        ("FY,FR,.2,1.,1.,1.", r"X1 0.2, X2 1, expected 0 and 1"),
        ("FY,FR,.5,1.", r"X1 0.5, X2 0.5, expected"),
        ("FY,FRPR,0.,1.,1.,1.", "SCALE FRPR, expected LE or FR"),
        ("FY,LE,0.,1.,9.,1.", r"expected 0 and 15.70796"),
    ],
)
def test_loads_on_parts_are_refused(load, message):
    with pytest.raises(InputError, match=message):
        solve(ARC + "SPC1,1,123456,1\n", f"PLOAD1,1,1,{load}\n")

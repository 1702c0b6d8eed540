"""CBEAM with CW, SA and SB; closed forms and MSC's figures are verification rows."""

import numpy as np
import pytest

import fem
from benchmarks.verification.runner import run
from fem.elements.lines.beam_warping import warping_stiffness
from fem.errors import InputError

HEAD = "CEND\nSPC=1\n{cases}BEGIN BULK\nMAT1,1,7.+10,,.3,2700.,1.-5,0.\n"
GRIDS = "GRID,1\nGRID,2,,1.,.3,.2,{cd}\nGRID,3,,1.9,.4,.1\nSPC1,1,456,3\n"
FRAME = "CORD2R,7,,,,,1.,2.,3.,\n,3.,-1.,.5\n"
ENDS = ",4,,.1,.05,-.07,.02,.11,-.03\n"
# Tapered, with offsets, a pin, and an inner station.
BEAMS = (
    f"CBEAM,1,1,1,2,0.,0.,1.\n,,,.1,.05,-.07,.02,.11,-.03\n{{s1}}"
    f"CBEAM,2,1,2,3,0.,0.,1.\n{ENDS}{{s2}}"
    "PBEAM,1,1,.01,2.-6,3.-6,0.,4.-6\n,.1,.1\n,YES,.4,.013,2.4-6,4.-6,0.,5.-6\n"
    ",.1,.1\n,YES,1.,.02,3.-6,5.-6,0.,6.-6\n,.1,.1\n,1.,1.,,,,,{cw}\n"
    ",,,,,.01,.02,.03,.01\n"
)
LOADS = (
    "SPC1,1,123456,1\nFORCE,1,3,,1.,3.,-200.,500.\nMOMENT,1,3,,1.,40.,70.,-90.\n"
    "PLOAD1,1,1,FY,FR,0.,10.,1.,20.\nTEMP,1,1,20.,2,30.,3,10.\nDEFORM,1,2,1.-4\n"
)
STATIC = "SOL 105\n" + HEAD.format(
    cases="SUBCASE 1\nLOAD=1\nTEMP(LOAD)=1\nDEFORM=1\nDISP=ALL\nFORCE=ALL\n"
    "STRESS=ALL\nGPFO=ALL\nESE=ALL\nSUBCASE 2\nMETHOD=1\n"
)
MODES = "SOL 103\n" + HEAD.format(cases="METHOD=1\nDISP=ALL\nESE=ALL\n")


def beams(*, warping: bool, cd: str = "") -> str:
    """Two beams, with or without a warping too weak to be noticed."""
    held = "SPOINT,51,52,53\nSPC1,1,0,51,52,53\n" if warping else ""
    text = BEAMS.format(
        s1=",51,52\n" if warping else "",
        s2=",52,53\n" if warping else "",
        cw="1.-22" if warping else "",
    )
    return GRIDS.format(cd=cd) + FRAME + text + held + "EIGRL,1,,,6\n"


@pytest.mark.parametrize(("head", "cd"), [(STATIC, "7"), (MODES, "")])
def test_all_results_of_weak_warping_are_those_without(head, cd):
    """Offsets, pins, taper, stations, PLOAD1, temperatures, DEFORM, buckling, mass."""
    loads = LOADS if head is STATIC else "SPC1,1,123456,1\nPARAM,COUPMASS,1\n"
    plain = run(head + beams(warping=False, cd=cd) + loads + "ENDDATA\n")
    warped = run(head + beams(warping=True, cd=cd) + loads + "ENDDATA\n")
    compared = 0
    for name in plain:
        one, other = plain[name], warped[name]
        if one.dtype.kind != "f" or one.shape != other.shape or "epsilon" in name:
            continue
        if "modes" in name and "frequency" not in name:
            one, other = np.abs(one), np.abs(other)
        scale = np.nanmax(np.abs(one), initial=0.0)
        np.testing.assert_allclose(other, one, rtol=0, atol=1e-7 * scale, err_msg=name)
        compared += 1
    assert compared > 8


def test_warping_stiffness_of_a_taper_and_of_a_prism():
    length, x = np.array([2.0]), np.polynomial.legendre.leggauss(10)
    points, weight = 0.5 * (x[0][None] + 1.0), 0.5 * x[1][None]
    prism = warping_stiffness(length, points, weight, np.full_like(points, 3.0))[0]
    a, b = 12.0 * 3.0 / 8.0, 6.0 * 3.0 / 4.0
    c, d = 4.0 * 3.0 / 2.0, 2.0 * 3.0 / 2.0
    expected = [[a, b, -a, b], [b, c, -b, d], [-a, -b, a, -b], [b, d, -b, c]]
    np.testing.assert_allclose(prism, expected, rtol=1e-12)
    # Clamped at A, free to warp at B: θ = T ∫ (L - x)² / (3 - x) dx, from 3 to 1.
    taper = warping_stiffness(length, points, weight, 3.0 - 2.0 * points)[0]
    found = np.linalg.solve(taper[2:, 2:], [1.0, 0.0])[0]
    # u = 3 - x: ∫ (u - 1)² / u du from 1 to 3
    assert found == pytest.approx(4.0 - 4.0 + np.log(3.0), rel=1e-8)


TWISTED = """\
SOL 101
CEND
SPC=1
LOAD=1
DISP=ALL
FORCE=ALL
BEGIN BULK
MAT1,1,2.1+11,,.3
PBEAM,1,1,1.-3,1.-6,1.-6,,1.-9
+
+,,,,,,,1.-9
GRID,1
GRID,2,,1.
CBEAM,1,1,1,2,0.,1.,0.
+
SPC1,1,123456,1
MOMENT,1,2,,1.,1.,0.,0.
"""


def twist(points: str, more: str) -> float:
    text = TWISTED.replace("CBEAM,1,1,1,2,0.,1.,0.\n+\n", "{}")
    card = f"CBEAM,1,1,1,2,0.,1.,0.\n+\n{points}"
    found = run(text.format(card) + more + "ENDDATA\n")
    return float(found.grid("static/1/displacement", 2)[3])


def test_a_grid_serves_as_warping_freedom_in_its_displacement_frame():
    """Component 1 of SA and SB, whatever their frame; blank: free to warp."""
    scalar = twist("+,11,12\n", "SPOINT,11,12\nSPC1,1,0,11\n")
    grids = f"{FRAME}GRID,11,,,,,7\nGRID,12,,,,,7\nSPC1,1,123456,11\nSPC1,1,23456,12\n"
    assert twist("+,11,12\n", grids) == pytest.approx(scalar, rel=1e-9)
    assert twist("+,11\n", "SPOINT,11\nSPC1,1,0,11\n") == pytest.approx(scalar)
    held = twist("+,11,12\n", "SPOINT,11,12\nSPC1,1,0,11,12\n")
    stiffness = 2.1e11 / 2.6 * 1e-9
    assert held == pytest.approx(1.0 / (stiffness + 12.0 * 210.0), rel=1e-6)
    assert scalar == pytest.approx(1.0 / (stiffness + 3.0 * 210.0), rel=1e-6)


def test_free_ends_are_said_and_wrong_coefficients_refused(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text(TWISTED + "ENDDATA\n")
    notices = fem.Structure.from_deck(fem.read_deck(path)).notices
    assert any("CW does nothing" in line for line in notices)
    text = TWISTED.replace("2,0.,1.,0.\n+\n", "2,0.,1.,0.\n+\n+,11,12\n")
    path.write_text(text.replace(",,1.-9\nGRID", ",,1.-9,0.\nGRID") + "SPOINT,11,12\n")
    with pytest.raises(InputError, match="expected both > 0"):
        assert fem.Structure.from_deck(fem.read_deck(path)).blocks

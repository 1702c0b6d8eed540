"""What a run says: AUTOSPC, pieces, mechanisms, ignored cards, shapes, progress."""

import re

import h5py
import pytest

from fem.cli import PlainProgress, _status

BAR = (
    "MAT1,1,7.+10,,.3,2700.,,,.02\nPBAR,1,1,1.-3,1.-6,1.-6,2.-6\nGRID,1\nGRID,2,,1.\n"
    "GRID,3,,2.\nCBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\nSPC1,1,123456,1\n"
    "FORCE,1,3,,10.,0.,0.,1.\n"
)
OTHER = "GRID,14,,3.\nGRID,15,,4.\nCBAR,3,1,14,15,0.,1.,0.\n"
INERTIA = "EIGRL,1,,,3\nCONM2,9,14,,1.,,,,\n,1.,,1.,,,1.\n"
HELD = "SPC1,1,123456,2,3\nEIGRL,1,,,3\n"
STEP = "TSTEP,4,10,.001\nTLOAD1,1,1,,,2\nTABLED1,2\n,0.,0.,1.,1.,ENDT\n"


@pytest.fixture
def say(tmp_path, capsys):
    """Function from solution, case control, bulk and options to status and text."""

    def go(sol, case, bulk, *options):
        path = tmp_path / "model.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}\nBEGIN BULK\n{bulk}ENDDATA\n")
        status = _status([str(path), "--out", str(tmp_path), *options])
        captured = capsys.readouterr()
        assert "Traceback" not in captured.err
        return status, captured.out + captured.err

    return go


@pytest.mark.parametrize(
    ("sol", "case", "bulk", "words"),
    [
        (101, "LOAD=1", BAR, "6 motions without stiffness of the whole structure"),
        (101, "LOAD=1", BAR, "PARAM,INREL,-2"),
        (101, "LOAD=1\nSPC=1", BAR + OTHER, "nothing connects or holds: grid 14 T1"),
        (
            101,
            "LOAD=1\nSPC=1",
            BAR + "GRID,4,,3.\nCBAR,3,1,3,4,0.,1.,0.\n,456\n",
            "2 motions without stiffness of 4 freedoms: grid 4 T2 T3 R2 R3",
        ),
        (109, "SPC=1\nDLOAD=1", BAR + STEP, "needs TSTEP in the case control"),
        (112, "SPC=1\nDLOAD=1\nTSTEP=4", BAR + STEP, "SOL 112 needs METHOD"),
        (103, "SPC=1\nMETHOD=1", BAR.replace("2700.", "") + "EIGRL,1,,,3\n", "no mass"),
        (103, "SPC=1\nMETHOD=1", BAR + HELD, "nothing can move"),
        (109, "SPC=1\nDLOAD=1\nTSTEP=4", BAR + STEP + HELD, "nothing can move"),
        (101, "LOAD=1\nTEMP(LOAD)=3", BAR, "no TEMP, TEMPD, TEMPRB"),
        (101, "TEMP(INIT)=3", BAR + "MATT1,1,7\n", "do not depend on temperature"),
        (101, "TEMP(MATE)=3", BAR + "MATT1,1,7\n", "do not depend on temperature"),
        (101, "LOAD=1", BAR + "CBARR,1,7\n", "did you mean 'CBAR'?"),
        (101, "LOAD=1", BAR + "FORCE,1,0,,1.,1.\n", "FORCE 1: grid 0 is not defined"),
        (101, "LOAD=1", BAR + "CROD,9,1,1,0\n", "CROD 9: grid 0 is not defined"),
    ],
)
def test_what_cannot_be_solved_is_named(say, sol, case, bulk, words):
    status, text = say(sol, case, bulk)
    assert status == 2
    assert words in text


@pytest.mark.parametrize(
    ("sol", "case", "bulk", "words"),
    [
        (103, "METHOD=1\nSPC=1", BAR + OTHER + INERTIA,
         "2 pieces that nothing connects; apart from the largest (3 points): "
         "points 14 15"),
        (101, "LOAD=1\nSPC=1", BAR + "GRID,9\n",
         "AUTOSPC constrained 6 freedoms without stiffness: grid 9 T1 T2 T3 R1 R2 R3"),
        (101, "LOAD=1\nSPC=1\nTEMP(INIT)=3", BAR, "sum of SPC forces 0 0 -10"),
        (109, "DLOAD=1\nSPC=1\nTSTEP=4", "PARAM,G,.04\n" + BAR + STEP,
         "PARAM,G,0.04 is inactive: a transient uses it only with PARAM,W3; give W3"),
        (109, "DLOAD=1\nSPC=1\nTSTEP=4", BAR + STEP,
         "(GE) is inactive: a transient uses it only with PARAM,W4; give W4"),
        (109, "DLOAD=1\nSPC=1\nTSTEP=4", BAR + STEP, "memory: factor"),
    ],
)  # fmt: skip
def test_what_a_user_should_know_is_said(say, sol, case, bulk, words):
    status, text = say(sol, case, bulk)
    assert status == 0, text
    assert words in text


def test_amplitudes_that_mass_alone_couples_are_no_pieces_of_their_own(say):
    """As in a Craig-Bampton reduction: stiffness on the diagonal, coupled masses."""
    matrices = (
        "SPOINT,9\nDMIG,KRED,0,6,1,0\nDMIG,KRED,9,0,,9,0,1.+6\n"
        "DMIG,MRED,0,6,1,0\nDMIG,MRED,9,0,,9,0,1.\n,3,3,.5\n"
        "CONM2,9,3,,9.\nEIGRL,1,,,2\n"
    )
    chosen = "METHOD=1\nSPC=1\nK2GG=KRED"
    status, text = say(103, f"{chosen}\nM2GG=MRED", BAR + matrices)
    assert status == 0, text
    assert "pieces" not in text
    status, text = say(103, chosen, BAR + matrices)
    assert status == 0, text
    assert "2 pieces that nothing connects" in text


@pytest.mark.parametrize(
    ("words", "undone"),
    [("NOINRL,DAMPLOD,BAD", "DAMPLOD, BAD"), ("INRLOD,NODAMP", None)],
)
def test_words_of_resvec_that_are_not_followed_are_said(say, words, undone):
    case = f"SPC=1\nMETHOD=1\nFREQ=3\nDLOAD=4\nRESVEC({words})=YES"
    bulk = "EIGRL,1,,,2\nFREQ,3,5.\nRLOAD1,4,1,,,5\nTABLED1,5\n,0.,1.,9.,1.,ENDT\n"
    status, text = say(111, case, BAR + bulk)
    assert status == 0, text
    assert (f"notice: RESVEC({undone}) is not done" in text) == (undone is not None)
    assert ("RESVEC(" in text) == (undone is not None)


def test_options_without_effect_are_said(say):
    options = ("--envelope", "--ignore", "CBEAM3")
    status, text = say(103, "METHOD=1\nSPC=1", BAR + "EIGRL,1,,,3\n", *options)
    assert status == 0
    assert "notice: --envelope has no effect: no subcase is a transient" in text
    assert "notice: to be ignored, but not in the deck: CBEAM3" in text
    assert not re.search(r"(^|[ ,])-0(\.0*)?([ ,]|$)", text, re.MULTILINE)


def test_ignored_cards_are_recorded(say, tmp_path):
    bulk = BAR + "CBEAM3,33,14,1,2\nPBEAM3,14,1,1.,1.,1.,1.\nGRID,9\n"
    status, text = say(101, "LOAD=1\nSPC=1", bulk)
    assert status == 2
    assert "--ignore CBEAM3,PBEAM3" in text
    status, text = say(101, "LOAD=1\nSPC=1", bulk, "--ignore", "cbeam3,CFOO")
    assert status == 0
    assert "but not in the deck: CFOO" in text
    with h5py.File(tmp_path / "model.h5") as file:
        assert sorted(file.attrs["ignored_cards"]) == ["CBEAM3", "PBEAM3"]
        assert any("CBEAM3" in notice for notice in file.attrs["notices"])
        assert file["autospc/freedom"].asstr()[0] == "grid 9 T1"


def test_shapes_of_elements_are_examined_before_solving(say, tmp_path):
    bulk = (
        "MAT1,1,7.+10,,.3\nPSHELL,1,1,.01,1\nGRID,1\nGRID,2,,1.\nGRID,3,,1.,1.,.4\n"
        "GRID,4,,0.,1.\nCQUAD4,1,1,1,2,3,4\nSPC1,1,123456,1,4\nFORCE,1,3,,1.,0.,0.,1.\n"
    )
    status, text = say(101, "LOAD=1\nSPC=1", bulk, "--quality")
    assert status == 0
    assert "1 of 1 CQUAD4: warp beyond 0.05" in text
    assert "angle_max" in text
    with h5py.File(tmp_path / "model.h5") as file:
        assert "warp" in file["quality/measure"].asstr()[:].tolist()


def test_plain_progress_speaks_after_a_while_and_ever_less_often():
    now, lines = [0.0], []
    progress = PlainProgress("steps", lines.append, clock=lambda: now[0])
    for done in range(1, 1001):
        now[0] = 0.2 * done
        progress(done, 1000)
    assert lines[0].startswith("steps: 51 of 1000, 3 min 1")
    assert 3 <= len(lines) <= 6


def test_all_freedoms_may_be_enforced(say, tmp_path):
    """A bar stretched by 1 mm: E A u / L in its force; nothing is left to solve."""
    bulk = BAR + HELD + "SPCD,1,3,1,1.-3\nSPCD,1,2,1,1.-3\n"
    status, text = say(101, "LOAD=1\nSPC=1\nFORCE=ALL", bulk)
    assert status == 0, text
    with h5py.File(tmp_path / "model.h5") as file:
        axial = file["static/1/element_force/CBAR/value"][:, 6]
    assert axial == pytest.approx([7e10 * 1e-3 * 1e-3, 0.0])


@pytest.mark.parametrize(
    ("params", "words"),
    [
        ("PARAM,LMODES,2\n", "2 of 5 modes are used"),
        ("PARAM,HFREQ,50.\n", "of 5 modes are used"),
        ("PARAM,LFREQ,1.+6\n", "leave none of 5 modes"),
    ],
)
def test_modes_of_a_modal_transient_may_be_limited(say, params, words):
    bulk = BAR + STEP + params + "EIGRL,1,,,5\n"
    _, text = say(112, "SPC=1\nDLOAD=1\nTSTEP=4\nMETHOD=1", bulk)
    assert words in text


@pytest.mark.parametrize("command", ["A2GG=STIF", "BOLTLD=3", "STATSUB=1"])
def test_commands_that_would_change_the_answer_are_refused(say, command):
    status, text = say(101, f"SPC=1\nLOAD=1\n{command}", BAR)
    assert status == 2
    assert "is not supported" in text


def test_statics_without_loads_is_rest_and_said(say):
    status, text = say(101, "SPC=1\nDISP=ALL", BAR)
    assert status == 0
    assert "selects no LOAD and enforces no displacement" in text
    assert "largest displacement 0 " in text


def test_a_motion_that_no_load_moves_is_held_where_bailout_goes_on(say):
    bulk = BAR + OTHER + "PARAM,BAILOUT,-1\n"
    status, text = say(101, "LOAD=1\nSPC=1", bulk)
    assert status == 0
    assert "6 motions without stiffness of a piece that nothing connects" in text
    assert "largest displacement 0.0003809" in text  # F L^3 / 3 E I
    status, text = say(101, "LOAD=1\nSPC=1", bulk + "FORCE,1,14,,1.,1.\n")
    assert status == 2


DIRECT = "DMIG,PP,0,9,1,0,,,2\nDMIG,PP,1,,,3,3,10.\nDMIG,PP,2,,,3,3,20.\n,3,5,0.\n"


@pytest.mark.parametrize(
    ("case", "moved"),
    [
        ("P2G=PP", ("0.0003809", "0.0007619")),
        ("P2G=PP\nLOAD=1", ("0.0007619", "0.00114")),
        ("P2G=0.5*PP", ("0.0001904", "0.0003809")),
    ],
)
def test_direct_loads_are_columns_by_subcase(say, case, moved):
    bulk = BAR + DIRECT
    status, text = say(101, f"SPC=1\n{case}\nSUBCASE 1\nSUBCASE 7", bulk)
    assert status == 0
    for number, value in zip((1, 7), moved):
        assert f"subcase {number}: largest displacement {value}" in text


def test_direct_loads_that_cannot_be_are_named(say):
    case = "SPC=1\nP2G=PP\nSUBCASE 1\nSUBCASE 2\nSUBCASE 3"
    assert "or column 3 for it" in say(101, case, BAR + DIRECT)[1]
    assert "DMIG QQ is not in the deck" in say(101, "P2G=QQ", BAR + DIRECT)[1]
    six = BAR + "DMIG,PP,0,6,1,0\nDMIG,PP,3,3,,3,3,10.\n"
    assert "expected 9 (rectangular)" in say(101, "SPC=1\nP2G=PP", six)[1]
    status, text = say(109, "SPC=1\nDLOAD=1\nTSTEP=4\nP2G=PP", BAR + STEP + DIRECT)
    assert status == 2
    assert "P2G is not supported in SOL 109" in text


def test_spcd_of_the_selected_number_counts_beside_a_load_card(say):
    """As in MSC's demonstration problem ab4."""
    bulk = BAR + "LOAD,300,1.,1.,1\nSPC,2,3,3,0.\nSPCADD,5,1,2\nSPCD,300,3,3,.25\n"
    assert "largest displacement 0.25 " in say(101, "SPC=5\nLOAD=300", bulk)[1]


def test_a_solution_that_is_not_supported_comes_before_all_else(say):
    status, text = say(144, "TRIM = 1", BAR + "CAERO9,1\n")
    first = text.splitlines()[0]
    assert status == 2
    assert (
        "SOL 144 is not supported; expected 101, 103, 105, 108, 109, 111, 112" in first
    )
    assert "CAERO9" in text
    assert "CAERO9" in say(101, "LOAD=1", BAR + "CAERO9,1\n")[1].splitlines()[0]

"""Case control: inheritance, sets, requests, refusals."""

import pytest

from fem.deck.control.case_control import read_case_control
from fem.deck.reader import read_deck
from fem.deck.text.source import Line
from fem.errors import InputError

CASE = """\
TITLE = Landing
SPC = 1
SET 5 = 1 THRU 10 EXCEPT 3, 4, 20,
   22
DISP(PLOT, PRINT) = ALL
$ comment
SUBCASE 1
  LABEL = one
  LOAD = 1
  ACCELERATION = 5
SUBCASE 7
  subtitle = seven
  Load=1
  DISPLACEMENT = NONE
  stress(corner)=all
"""


def test_subcases_inherit_the_global_section(read):
    first, second = read(case=CASE).case_control
    assert (first.id, first.spc, first.load, first.label) == (1, 1, 1, "one")
    assert (second.id, second.title, second.subtitle) == (7, "Landing", "seven")
    assert first.outputs["DISPLACEMENT"] == "ALL"
    assert first.options["DISPLACEMENT"] == ("PLOT", "PRINT")
    assert second.outputs["DISPLACEMENT"] == "NONE"
    assert second.options["STRESS"] == ("CORNER",)
    assert "ACCELERATION" not in second.outputs
    expected = frozenset({1, 2, 5, 6, 7, 8, 9, 10, 20, 22})
    assert first.outputs["ACCELERATION"] == expected


def test_deck_without_subcases_has_one(read):
    (only,) = read(case="SPC=1\nLOAD=1").case_control
    assert (only.id, only.spc, only.load) == (1, 1, 1)
    assert read(alone=True, bulk="GRID,1").case_control[0].id == 1


@pytest.mark.parametrize(
    ("case", "message"),
    [
        ("SPC = X", "expected an integer"),
        ("DISP = 9", "set 9 is not defined"),
        ("LAOD = 1", "LAOD is no case control command; did you mean 'LOAD'"),
        ("A2GG = A", "no coupling to fluids"),
        ("SUBCOM 2", "no subcase before"),
        ("SUBCASE 1\nSUBCOM 2\nSUBSEQ = 1., 2.", "2 factors for the 1 subcases"),
        ("OUTPUT(XYPLOT)\nSPC = 1", "reads no selections"),
        ("SET 1 = 5 THRU 2", "ascending"),
        ("SUBCASE 2\nSUBCASE 2", "must ascend"),
        ("LOAD = 99", "LOAD = 99 is not defined"),
        ("PARAM,COUPMASS", "PARAM,NAME,VALUE"),
        (")=(", "cannot be read"),
    ],
)
def test_faults_are_named(read, case, message):
    with pytest.raises(InputError) as caught:
        read(case=case)
    assert message in str(caught.value)


def test_parameters_of_case_control_override_bulk_data(read):
    deck = read("PARAM,COUPMASS,-1\nPARAM,WTMASS,.00259", case="PARAM,COUPMASS,1")
    assert deck.param("COUPMASS") == 1
    assert deck.param("WTMASS") == 0.00259
    assert deck.param("K6ROT") == 100.0
    assert deck.param("AUTOSPC") == "YES"


def test_parameter_of_the_wrong_type_is_named(read):
    with pytest.raises(InputError, match=r"PARAM WTMASS: found 'YES', expected a real"):
        read("PARAM,WTMASS,YES")


@pytest.mark.parametrize(
    ("statement", "sol"),
    [
        ("SOL 103", 103),
        ("sol semodes", 103),
        ("SOL SEDTRAN", 109),
        ("SOL 'SEMTRAN'", 112),
    ],
)
def test_solution_sequences(tmp_path, statement, sol):
    path = tmp_path / "a.bdf"
    path.write_text(f"{statement}\nCEND\nBEGIN BULK\nGRID,1\nENDDATA\n")
    assert read_deck(path).sol == sol


def test_unknown_solution_proposes_the_nearest(tmp_path):
    path = tmp_path / "a.bdf"
    path.write_text("SOL SEMODE\nCEND\nBEGIN BULK\nGRID,1\nENDDATA\n")
    with pytest.raises(InputError, match="did you mean 'SEMODES'"):
        read_deck(path)


def test_bare_output_line_ends_nothing(read):
    """As Simcenter writes it, before the requests."""
    deck = read(case="OUTPUT\nDISP(PLOT) = ALL\nSUBCASE 1\nSPC = 1\nLOAD = 1")
    (only,) = deck.case_control
    assert (only.spc, only.load) == (1, 1)
    assert only.outputs["DISPLACEMENT"] == "ALL"


@pytest.mark.parametrize("option", ["(PLOT)", " (XYPLOT)", "(XYOUT)"])
def test_plot_section_ends_at_the_next_subcase(read, option):
    case = f"SUBCASE 1\nLOAD = 1\nOUTPUT{option}\nFIND SCALE\nPLOT SET 1\n"
    deck = read(case=case + "SUBCASE 2\nLOAD = 1\nSPC = 1")
    assert [c.spc for c in deck.case_control] == [0, 1]
    assert "plot and curve requests after OUTPUT are passed over: FIND, PLOT" in (
        deck.notices
    )


def test_grid_point_stress_section_holds_other_commands(read):
    deck = read(case="OUTPUT(POST)\nSURFACE 1 SET 2 NORMAL Z\nSPC = 1")
    assert deck.case_control[0].spc == 1
    assert any("without effect here: SURFACE" in text for text in deck.notices)


def test_what_is_passed_over_is_named_in_one_notice(read):
    deck = read(case="ECHO = NONE\nMAXLINES = 9\nTRIM = 1\nAEROF = ALL\nFOO = 1")
    assert [text for text in deck.notices if "case control" in text] == [
        "case control commands without effect here: AEROF, ECHO, MAXLINES, TRIM",
        "case control commands that are not known, passed over: FOO",
    ]


def test_four_letters_are_enough(read):
    case = read(
        case="METH = 0\nTITL = x\nSPCF = ALL\nDISPLACEMENTS = ALL\nELSTRN = ALL"
    )
    (only,) = case.case_control
    assert (only.title, set(only.outputs)) == (
        "x",
        {"SPCFORCES", "DISPLACEMENT", "STRAIN"},
    )


def test_set_without_end_holds_the_ids_of_the_deck(read):
    deck = read(case="SET 1 = 2 THRU 99999999 EXCEPT 3\nDISP = 1")
    assert deck.case_control[0].outputs["DISPLACEMENT"] == frozenset({2})


def test_all_superelements_of_a_deck_without_any(read):
    assert read(case="SUPER = ALL").case_control[0].superelements is None
    (only,) = read(case="SET 9 = 0, 3\nSUPER = 9, 1").case_control
    assert only.superelements == {0, 3}
    assert read(case="SUPER = 3").case_control[0].superelements == {3}


def test_commands_that_only_a_solution_needs_wait_for_it(read):
    (only,) = read(case="BOLTLD = 2\nBGSET = 1").case_control
    assert len(only.not_carried_out) == 2
    (only,) = read(case="BGSET = 1", ignore=["CASE"]).case_control
    assert not only.not_carried_out


def test_subcom_takes_the_last_subcases(read):
    case = "LOAD=1\nSUBCASE 1\nSUBCASE 2\nSUBCOM 3\nSUBSEQ = 0.5\nREPCASE 4\nSYM 5\n"
    cases = read(case=case + "SYMCOM 6").case_control
    assert cases[2].combination == ((2, 0.5),)
    assert cases[3].combination == ((2, 0.5),)
    assert cases[5].combination == ((1, 1.0), (2, 1.0), (5, 1.0))
    assert [c.load for c in cases] == [1, 1, 0, 0, 1, 0]


_BULK = "GRID,1\nSPC1,1,123456,1\nFORCE,1,1,,1.,1.\n"


@pytest.mark.parametrize("text", ["PARAM,POST,0", "param post 0", "PARAM POST = 0"])
def test_parameters_of_the_case_control(read, text):
    assert read(case=text).params["POST"] == 0


@pytest.mark.parametrize(
    ("sol", "number"), [("1,3", 101), ("STATIC", 101), ("24", 101), ("5", 105)]
)
def test_older_names_of_solutions(read, sol, number):
    deck = read(
        f"SOL {sol}\nCEND\nMETHOD = 4\nBEGIN BULK\nEIGRL,4,,,1\n{_BULK}", alone=True
    )
    assert deck.sol == number
    assert any(f"carried out as SOL {number}" in text for text in deck.notices)


def test_a_solution_in_dmap_of_the_deck_is_named(read):
    text = f"SOL MINE\nCOMPILE MINE\nCEND\nBEGIN BULK\n{_BULK}"
    with pytest.raises(InputError, match="SOL MINE: a program of the deck's own"):
        read(text, alone=True)


@pytest.mark.parametrize("on", ["SKIPON", "skip on $ for now", "SKIP = ON"])
def test_commands_after_skipon_are_not_carried_out(on):
    text = f"LOAD=1\n{on}\nLOAD=7\nSUBCASE 4\nSKIPOFF\nSPC=3\n{on}\nSUBCASE 9\nLOAD=5\n"
    lines = [Line(t, "a.bdf", k) for k, t in enumerate(text.splitlines(), start=1)]
    found = read_case_control(lines)
    assert [(case.id, case.load, case.spc) for case in found.subcases] == [(1, 1, 3)]
    assert found.notices[0] == "a.bdf:2: skipped from here to SKIPOFF"

"""Case control: inheritance, sets, requests, refusals."""

import pytest

from fem.deck.reader import read_deck
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
        ("TEMPERATURE(LOAD) = 4", "TEMPERATURE is not supported"),
        ("SET 1 = 5 THRU 2", "ascending"),
        ("SUBCASE 2\nSUBCASE 2", "must ascend"),
        ("SPC = 99", "SPC = 99 is not defined"),
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

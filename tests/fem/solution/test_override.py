"""`--sol`: decks of solutions that are not supported have a way on."""

import re
from pathlib import Path

import pytest

from fem.cli import _status
from fem.deck.reader import read_deck
from fem.solution import solution_problems
from fem.solution.override import as_solution

BULK = """
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,2.,0.,0.
CBAR,1,1,1,2,0.,0.,1.
CBAR,2,1,2,3,0.,0.,1.
PBAR,1,1,1.-3,1.-6,1.-6,1.-6
MAT1,1,7.+10,,.3,2700.
SPC1,1,123456,1
FORCE,5,3,,1000.,0.,0.,1.
{more}
ENDDATA
"""
CASE = """SOL {sol}
CEND
SPC = 1
{subcases}
BEGIN BULK"""


def deck(folder: Path, sol: str, subcases: str, more: str = "") -> Path:
    path = folder / "deck.bdf"
    head = CASE.format(sol=sol, subcases=subcases)
    path.write_text(head + BULK.format(more=more))
    return path


def solved(path: Path, capsys: pytest.CaptureFixture[str], *options: str) -> str:
    assert _status([str(path), "--out", str(path.parent / "o"), *options]) == 0
    return capsys.readouterr().out


TRIM = "SUBCASE 1\nTRIM = 1\nSUBCASE 2\nTRIM = 2\nLOAD = 5"


@pytest.mark.parametrize("sol", ["144", "145", "146", "200"])
def test_the_message_says_what_can_be_done(
    sol: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = deck(tmp_path, sol, TRIM)
    assert _status([str(path)]) == 2
    said = capsys.readouterr().err
    assert f"SOL {sol} is not supported" in said
    assert "--sol 101 solves subcase 2 as statics" in said
    assert "--sol 103 finds the modes" in said


def test_loads_are_solved_as_statics(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = solved(deck(tmp_path, "144", TRIM), capsys, "--sol", "101")
    assert "subcase 2 of SOL 144 solved as SOL 101; subcase 1 left out" in said
    found = float(re.findall(r"largest displacement (\S+) at grid 3 T3", said)[0])
    bending = 1000.0 * 2.0**3 / (3.0 * 7e10 * 1e-6)
    assert found == pytest.approx(bending, rel=1e-6)


def test_modes_are_found_once_and_without_eigrl(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = solved(deck(tmp_path, "144", TRIM), capsys, "--sol", "103")
    assert "subcase 1 of SOL 144 solved as SOL 103; subcase 2 left out" in said
    assert "the 16 lowest modes, as the deck has no EIGRL" in said
    assert said.count("Sturm sequence") == 1
    path = deck(tmp_path, "145", TRIM, "EIGRL,7,,,2")
    said = solved(path, capsys, "--sol", "103")
    assert "METHOD = 7, the deck's first EIGRL" in said
    assert "2 modes, 0 of them" in said


def test_analysis_of_subcases_decides_which_are_solved(tmp_path: Path) -> None:
    subcases = (
        "SUBCASE 1\nANALYSIS = SAERO\nTRIM = 1\n"
        "SUBCASE 2\nANALYSIS = STATICS\nLOAD = 5\n"
        "SUBCASE 3\nANALYSIS = MODES\nMETHOD = 7"
    )
    read = read_deck(deck(tmp_path, "200", subcases, "EIGRL,7,,,2"))
    for number, subcase in ((101, 2), (103, 3)):
        as_another, told = as_solution(read, number)
        assert [case.id for case in as_another.case_control] == [subcase]
        assert as_another.sol == number
        assert "left out" in told[1]


def test_only_solutions_that_are_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _status([str(deck(tmp_path, "144", TRIM)), "--sol", "106"]) == 2
    assert "--sol: found 106, expected 101, 103, 105" in capsys.readouterr().err


@pytest.mark.parametrize("number", [106, 401, 402])
def test_statics_of_a_nonlinear_solution_are_no_linear_ones(tmp_path, number):
    """ANALYSIS names a step there; linear results would pass for those of the step."""
    path = tmp_path / "deck.bdf"
    path.write_text(
        f"SOL {number}\nCEND\nSUBCASE 1\n ANALYSIS = STATICS\n LOAD = 1\nBEGIN BULK\n"
        "GRID,1,,0.,0.,0.,,123456\nENDDATA\n"
    )
    (problem,) = solution_problems(path)
    assert f"SOL {number} is not supported" in problem
    assert "--sol 101 solves subcase 1 as ANALYSIS says" in problem


@pytest.mark.parametrize(
    ("executive", "case", "bulk", "line"),
    [("APP HEAT\n", "", "", 2), ("", "", "PARAM,HEATSTAT,YES\n", 5),
     ("", "PARAM,HEATSTAT,YES\n", "", 3)],
)  # fmt: skip
def test_heat_transfer_is_named_before_what_it_lacks(
    tmp_path, executive, case, bulk, line
):
    path = tmp_path / "deck.bdf"
    path.write_text(
        f"SOL 101\n{executive}CEND\n{case}LOAD = 1\nBEGIN BULK\n{bulk}"
        "GRID,1,,0.,0.,0.\nQVOL,1,5.,,1\nENDDATA\n"
    )
    (problem,) = solution_problems(path)
    assert f"deck.bdf:{line}: " in problem
    assert "heat transfer is not solved" in problem

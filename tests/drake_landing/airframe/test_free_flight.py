"""What keeps an airframe from flying is named by its grids, without solving modes."""

from pathlib import Path

import pytest

from drake_landing.airframe.free_flight import check_free_flight
from drake_landing.case.reading import load_case
from drake_landing.process import explain as explaining
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure

HERE = Path(__file__).parents[1]
DECK = HERE.joinpath("tiny_aircraft.bdf").read_text()
RIGHT = "CBAR,111,2,22,23,0.,0.,1."
LEFT = "CBAR,115,2,32,33,0.,0.,1."
HINGE = ",\n,5,"  # R2 of end A is free
PIECE = """GRID,91,,5.,0.,3.
GRID,92,,6.,0.,3.
CBAR,991,1,91,92,0.,0.,1.
"""


def problems(text: str, folder: Path) -> list[str]:
    path = folder / "deck.bdf"
    path.write_text(text)
    structure = Structure.from_deck(read_deck(path))
    try:
        check_free_flight(structure)
    except InputError as error:
        return [p.removeprefix(f"{path}: ") for p in error.problems]
    return []


def hinged(text: str, *bars: str) -> str:
    for bar in bars:
        assert bar in text
        text = text.replace(bar, bar + HINGE)
    return text


def test_a_sound_airframe_has_no_problems(tmp_path: Path) -> None:
    assert problems(DECK, tmp_path) == []


def test_a_soft_one_neither(tmp_path: Path) -> None:
    soft = DECK.replace("PBAR,3,1,.01,6.-5,3.-4,5.-5", "PBAR,3,1,1.-6,6.-9,3.-8,5.-9")
    assert soft != DECK
    assert problems(soft, tmp_path) == []


def test_the_outer_wing_beyond_a_hinge_moves_and_the_rest_does_not(
    tmp_path: Path,
) -> None:
    first, second = problems(hinged(DECK, RIGHT), tmp_path)
    assert first.startswith("7 motions without stiffness, expected the 6")
    assert second.startswith("freely moves in 1 way: grid 23 ")
    assert {w for w in second.split() if w.isdigit()} == {"1", "23", "24"}


def test_two_hinges_are_two_motions(tmp_path: Path) -> None:
    first, second = problems(hinged(DECK, RIGHT, LEFT), tmp_path)
    assert first.startswith("8 motions")
    assert second.startswith("freely moves in 2 ways: ")
    assert {w for w in second.split() if w.isdigit()} == {"2", "23", "24", "33", "34"}


def test_a_loose_piece_is_named_whole(tmp_path: Path) -> None:
    _, second = problems(DECK.replace("ENDDATA", PIECE + "ENDDATA"), tmp_path)
    assert second.startswith("freely moves in 6 ways: grid 91 T1 T2")


def test_all_that_is_wrong_comes_at_once(tmp_path: Path) -> None:
    text = DECK.replace("METHOD = 1", "METHOD = 1\nSPC = 1")
    text = text.replace("ENDDATA", PIECE + "SPC1,1,123456,3\nENDDATA")
    text = text.replace("BEGIN BULK", "BEGIN BULK\nPARAM,WTMASS,0.")
    mass, held, *loose = problems(text, tmp_path)
    assert mass.startswith("the airframe has a mass of 0, expected more")
    assert held.startswith("0 rigid-body modes, expected 6")
    assert "grid 91" in loose[-1]


def test_mass_on_a_line_is_no_airframe(tmp_path: Path) -> None:
    lines = [
        line
        for line in DECK.splitlines()
        if not line.startswith("CONM2")
        and not (line.startswith(",") and line.count(",") == 6)
    ]
    text = "\n".join(lines).replace(
        "ENDDATA", "CONM2,1,1,,5.\nCONM2,2,9,,5.\nENDDATA\n"
    )
    text = text.replace("CORD2R,10,,0.,0.,0.,1.,1.,1.", "CORD2R,10,,0.,0.,0.,1.,1.,1.,")
    (problem,) = problems(text, tmp_path)
    assert problem.startswith("the principal moments of inertia are 0")


def test_very_large_models_are_factorised_on_request(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(explaining, "_AT_ONCE", 10)
    case = load_case(HERE / "tiny_case.yaml")
    assert "not factorised (120 freedoms)" in explaining.explain(case)
    assert "no mechanism" in explaining.explain(case, thorough=True)

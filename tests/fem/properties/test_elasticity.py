"""Materials at the bounds of what a sheet, a bar and a solid can be made of."""

from pathlib import Path

import pytest

from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure

GRIDS = """GRID,1,,0,0,0
GRID,2,,1,0,0
GRID,3,,1,1,0
GRID,4,,0,1,0
GRID,5,,0,0,1
"""
BAR = "CBAR,1,1,1,2,0.,0.,1.\nPBAR,1,1,1.-3,1.-6,1.-6,1.-6\n"
SHEET = "CQUAD4,1,1,1,2,3,4\nPSHELL,1,1,.01,1,,1\n"
LAMINATE = "CQUAD4,1,1,1,2,3,4\nPCOMP,1\n,1,.01,0.\n"
SOLID = "CTETRA,1,1,1,2,4,5\nPSOLID,1,1\n"


def assembled(folder: Path, element: str, material: str) -> Structure:
    deck = folder / "deck.bdf"
    deck.write_text(f"BEGIN BULK\n{GRIDS}{element}{material}\nENDDATA\n")
    structure = Structure.from_deck(read_deck(deck))
    assert structure.stiffness.diagonal().max() > 0.0
    return structure


@pytest.mark.parametrize("element", [BAR, SHEET, LAMINATE])
def test_bars_and_sheets_may_keep_their_volume(tmp_path: Path, element: str) -> None:
    assembled(tmp_path, element, "MAT1,1,7.+10,,0.5")


@pytest.mark.parametrize(
    ("element", "material", "told"),
    [
        (SOLID, "MAT1,1,7.+10,,0.5", "CTETRA 1: Poisson's ratio of material 1 is 0.5"),
        (SHEET, "MAT1,1,7.+10,,1.", "MAT1 1: NU 1, expected between -1 and 1"),
        (SHEET, "MAT1,1,7.+10,1.+10", "MAT1 1: Poisson's ratio 2.5 "),
        (LAMINATE, "MAT8,1,4.+10,1.+10,2.5,5.+9", "MAT8 1: NU12 2.5, .* below 2,"),
        (LAMINATE, "MAT8,1,4.+10,1.+10,1.+299,5.+9", "MAT8 1: NU12 1e"),
        (LAMINATE, "MAT8,1,1.+308,1.+308,.9,5.+9", "beyond what can be computed"),
    ],
)
def test_what_has_no_positive_stiffness_is_named(
    tmp_path: Path, element: str, material: str, told: str
) -> None:
    with pytest.raises(InputError, match=told):
        assembled(tmp_path, element, material)

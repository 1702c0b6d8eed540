"""Images of superelements: the same answers as parts that are written out."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.points import read_points
from fem.solution.run import run_deck

HEAD = "SOL 101\nCEND\nSPC = 5\nLOAD = 9\nDISP = ALL\nSUPER = ALL\nBEGIN BULK\n"
SHEET = "PSHELL,1,1,.1,1,,1\nMAT1,1,70.,,.3\n"
MAIN = (
    "GRID,1,,0.,0.,0.\nGRID,2,,0.,1.,0.\nGRID,3,,1.,0.,0.\nGRID,4,,1.,1.,0.\n"
    "CQUAD4,1,1,1,3,4,2\nSPC1,5,123456,1,2,3\nPLOAD2,9,.01,1\n" + SHEET
)
WING = (
    "GRID,11,,1.,0.,0.\nGRID,12,,2.,.2,.1\nGRID,13,,1.,1.,0.\nGRID,14,,2.,1.1,.3\n"
    "CQUAD4,11,1,11,12,14,13\n"
    "CONM2,12,14,,2.,.1,.2,.3\n" + SHEET
)
# Its reflection by the plane x = 0.5, written out with the same order of grids.
OTHER = (
    "GRID,21,,0.,0.,0.\nGRID,22,,-1.,.2,.1\nGRID,23,,0.,1.,0.\nGRID,24,,-1.,1.1,.3\n"
    "CQUAD4,21,1,21,22,24,23\n"
    "CONM2,22,24,,2.,-.1,.2,.3\n" + SHEET
)
PLANE = "POINT,7,,.5,0.,0.\nPOINT,8,,.5,1.,0.\nPOINT,9,,.5,0.,1.\n"
IMAGE = "SEBULK,2,MIRROR,1\nSEMPLN,2,PLANE,7,8,9\n" + PLANE
GRAVITY = "GRAV,9,,.001,1.,2.,3.\n"


def places(tmp_path: Path, text: str) -> list[np.ndarray]:
    """Place and displacement in basic axes of all grids, in order of place."""
    path, out = tmp_path / "model.bdf", tmp_path / "model.h5"
    path.write_text(HEAD + text + "ENDDATA\n")
    deck = read_deck(path)
    run_deck(deck, out)
    points = read_points(deck)
    with h5py.File(out) as file:
        u = np.asarray(file["static/1/displacement"])
    rows = np.concatenate([points.xyz.round(9), u], axis=1)
    return [rows[k] for k in np.lexsort(rows[:, :3].T)]


def test_a_mirror_image_is_the_part_written_reflected(tmp_path):
    """Pressure acts along the reflected normal: against the grids' own order."""
    image = (
        MAIN
        + IMAGE
        + f"BEGIN SUPER = 1\n{WING}PLOAD2,9,.02,11\n"
        + "BEGIN SUPER = 2\nPLOAD2,9,.03,11\n"
    )
    written = (
        MAIN
        + f"BEGIN SUPER = 1\n{WING}PLOAD2,9,.02,11\n"
        + f"BEGIN SUPER = 2\n{OTHER}PLOAD2,9,-.03,21\n"
    )
    np.testing.assert_allclose(places(tmp_path, image), places(tmp_path, written))


def test_a_repeated_image_is_the_part_placed_again(tmp_path):
    """Moved by SELOC to the far edge of the first."""
    plates = (
        "GRID,11,,0.,0.,0.\nGRID,12,,1.,0.,0.\nGRID,13,,0.,1.,0.\nGRID,14,,1.,1.,0.\n"
    )
    part = plates + "CQUAD4,11,1,11,12,14,13\nCBAR,12,2,11,12,0.,0.,1.\n" + SHEET
    part += "PBAR,2,1,.1,.01,.02,.01\n"
    further = part
    for k in (11, 12, 13, 14):
        further = further.replace(f"GRID,{k},,", f"GRID,{k},1,")
    main = MAIN + "POINT,7,,2.,0.,0.\nPOINT,8,,3.,0.,0.\nPOINT,9,,2.,1.,0.\n"
    place = "SELOC,1,11,12,13,3,7,4\n"
    again = "SELOC,2,11,12,13,7,8,9\n"
    load = "FORCE,9,14,,.02,0.,0.,1.\n"
    begin = f"BEGIN SUPER = 1\n{part}"
    image = main + place + again + "SEBULK,2,REPEAT,1\n" + begin
    image += "BEGIN SUPER = 2\n" + load
    written = main + place + again + begin + f"BEGIN SUPER = 2\n{part}{load}"
    np.testing.assert_allclose(places(tmp_path, image), places(tmp_path, written))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("SEBULK,2,MIRROR,1\n", "expected SEMPLN 2 with the plane"),
        (
            "SEBULK,2,MIRROR,3\nSEMPLN,2,PLANE,7,8,9\n",
            "expected one with BEGIN SUPER = 3",
        ),
        ("SEBULK,2,REPEAT,1\nSELOC,1,11,12,13,1,2,3\n", "expected SELOC 2"),
        ("SEBULK,2,MIRROR,1\nSEMPLN,2,PLANE,7,8,99\n", "point 99 is not in the main"),
        ("SEBULK,2,MIRROR,1\nSEMPLN,2,PLANE,7,8,8\n", "three points lie on a line"),
        ("SEBULK,2,MIRROR,1\nSEMPLN,2,PLANE,7,9,4\n", "expected a basic axis"),
    ],
)
def test_what_an_image_lacks_is_named(tmp_path, text, said):
    path = tmp_path / "model.bdf"
    path.write_text(HEAD + MAIN + PLANE + text + f"BEGIN SUPER = 1\n{WING}ENDDATA\n")
    with pytest.raises(InputError, match=said):
        read_deck(path)


def test_a_mirror_image_of_what_cannot_be_reflected_is_refused(tmp_path):
    bar = "CBAR,13,2,12,14,0.,0.,1.\nPBAR,2,1,.1,.01,.02,.01\nFORCE,9,12,,1.,1.\n"
    path = tmp_path / "model.bdf"
    path.write_text(HEAD + MAIN + IMAGE + f"BEGIN SUPER = 1\n{WING}{bar}ENDDATA\n")
    with pytest.raises(InputError, match="not supported with CBAR, PBAR; write it"):
        read_deck(path)

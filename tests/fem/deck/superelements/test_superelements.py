"""Superelements as one model: the same answers as the model written in one piece."""

from pathlib import Path

import h5py
import numpy as np
import pytest

from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.points import read_points
from fem.model.structure import Structure
from fem.recovery.monitor_points import monitor_points
from fem.solution.run import run_deck

HEAD = "SOL 101\nCEND\nSPC = 5\nLOAD = 9\nDISP = ALL\nSUPER = ALL\nBEGIN BULK\n"
MATERIAL = "MAT1,3,7.+10,,.3,2700.\nPBAR,7,3,1.-3,2.-6,3.-6,4.-6\n"
# A frame of three bars, bent and twisted.
ONE = (
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,2.,0.\nGRID,4,,1.,2.,-1.\n"
    "CBAR,1,7,1,2,0.,0.,1.\nCBAR,2,7,2,3,0.,0.,1.\nCBAR,3,7,3,4,0.,1.,0.\n"
    "SPC1,5,123456,1\nFORCE,9,3,,1000.,0.,0.,1.\nFORCE,9,4,,500.,1.,0.,0.\n" + MATERIAL
)
RESIDUAL = (
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nCBAR,1,7,1,2,0.,0.,1.\nSPC1,5,123456,1\n"
    + MATERIAL
)
# Grids 2 to 4 with ids of their own, written at their place.
PART = (
    "GRID,1,,1.,0.,0.\nGRID,2,,1.,2.,0.\nGRID,3,,1.,2.,-1.\n"
    "CBAR,1,7,1,2,0.,0.,1.\nCBAR,2,7,2,3,0.,1.,0.\n"
    "FORCE,9,2,,1000.,0.,0.,1.\nFORCE,9,3,,500.,1.,0.,0.\n" + MATERIAL
)
# The same part, written along other axes: its (x, y, z) is the main (y, z, x).
TURNED = (
    "GRID,1,,0.,0.,0.\nGRID,2,,2.,0.,0.\nGRID,3,,2.,-1.,0.\n"
    "CBAR,1,7,1,2,0.,1.,0.\nCBAR,2,7,2,3,1.,0.,0.\n"
    "FORCE,9,2,,1000.,0.,1.,0.\nFORCE,9,3,,500.,0.,0.,1.\n" + MATERIAL
)
BEGIN = "BEGIN BULK SUPER = 1\n"


def displacements(tmp_path: Path, text: str) -> dict[int, np.ndarray]:
    """(6,) in basic axes by grid."""
    path, out = tmp_path / "model.bdf", tmp_path / "model.h5"
    path.write_text(HEAD + text + "ENDDATA\n")
    deck = read_deck(path)
    run_deck(deck, out)
    points = read_points(deck)
    with h5py.File(out) as file:
        u = np.asarray(file["static/1/displacement"]).reshape(-1, 2, 3)
    turned = np.einsum("gij,gkj->gki", points.rotation, u).reshape(-1, 6)
    return dict(zip(points.grid_id.tolist(), turned))


def agree(tmp_path: Path, text: str, tips: tuple[int, int]) -> None:
    one = displacements(tmp_path, ONE)
    found = displacements(tmp_path, text)
    size = np.abs(one[3]).max()
    for theirs, ours in zip((2, 3, 4), (2, *tips)):
        np.testing.assert_allclose(found[ours], one[theirs], atol=1e-9 * size)


def test_points_that_coincide_are_joined(tmp_path):
    """The ids of the part are in use: its points get 10 more."""
    agree(tmp_path, RESIDUAL + BEGIN + PART, (12, 13))


def test_pairs_of_points_are_joined(tmp_path):
    manual = "SEBULK,1,PRIMARY,,MANUAL\nSECONCT,1,0,,,,,,,+\n+,1,2\n"
    agree(tmp_path, RESIDUAL + manual + BEGIN + PART, (12, 13))
    with pytest.raises(InputError, match=r"singular|nothing holds|mechanism"):
        displacements(tmp_path, RESIDUAL + manual.split("SECONCT")[0] + BEGIN + PART)


def test_a_part_is_placed_by_three_points(tmp_path):
    """Its loads and orientations are along its own axes, and turn with it."""
    places = "GRID,11,,1.,2.,0.\nGRID,12,,1.,2.,-1.\nSELOC,1,1,2,3,2,11,12\n"
    agree(tmp_path, RESIDUAL + places + BEGIN + TURNED, (11, 12))


def test_parts_of_parts_are_joined_with_each_other(tmp_path):
    first, rest = PART.split("CBAR,1,7,1,2,0.,0.,1.\n")
    bar, tip = "CBAR,1,7,1,2,0.,0.,1.\n", "CBAR,2,7,2,3,0.,1.,0.\n"
    grids = first.splitlines(keepends=True)
    loads = rest.replace(tip, "")
    one = grids[0] + grids[1] + bar + MATERIAL
    two = grids[1] + grids[2] + tip + loads
    text = RESIDUAL + BEGIN + one + BEGIN.replace("1", "2") + two
    agree(tmp_path, text, (12, 23))


def test_residual_without_elements_holds_the_joint_only(references):
    """The stored deck of a cantilever in two parts, and the same in one."""
    from fem.model.structure import Structure

    path = references / "reduction" / "cantilever_bar" / "guyanSuperStatic.dat"
    deck = read_deck(path)
    assert len(deck.cards["CBAR"]) == 10
    assert len(deck.cards["GRID"]) == 11
    assert Structure.from_deck(deck).mass.sum() > 0.0


@pytest.mark.parametrize(
    ("main", "message"),
    [
        ("SEBULK,2,PRIMARY\n", "BEGIN SUPER = 2 is not in the deck"),
        ("SEBULK,1,COLLCTR\n", "type COLLCTR, expected PRIMARY"),
        ("SELOC,1,1,2,9,2,1,2\n", "grid 9 is not in the superelement"),
        ("SECONCT,1,0,,,,,,,+\n+,8,2\n", "superelement 1 has no point 8"),
    ],
)
def test_what_does_not_fit_is_said(tmp_path, main, message):
    path = tmp_path / "model.bdf"
    path.write_text(HEAD + RESIDUAL + main + BEGIN + PART + "ENDDATA\n")
    with pytest.raises(InputError, match=message):
        read_deck(path)


def test_gravity_of_one_part_alone_is_refused(tmp_path):
    path = tmp_path / "model.bdf"
    gravity = "GRAV,9,,9.81,0.,0.,-1.\n"
    path.write_text(HEAD + RESIDUAL + BEGIN + PART + gravity + "ENDDATA\n")
    with pytest.raises(InputError, match="own superelement only"):
        read_deck(path)
    everywhere = HEAD + RESIDUAL + gravity + BEGIN + PART + gravity + "ENDDATA\n"
    path.write_text(everywhere)
    assert len(read_deck(path).cards["GRAV"]) == 1


def test_joined_grids_with_other_axes_are_tied(tmp_path):
    turned = "CORD2R,4,,0.,0.,0.,0.,1.,1.,+\n+,1.,1.,0.\n"
    part = PART.replace("GRID,1,,1.,0.,0.\n", turned + "GRID,1,,1.,0.,0.,4\n")
    agree(tmp_path, RESIDUAL + BEGIN + part, (12, 13))


def test_masses_on_ids_that_are_in_use_are_refused(tmp_path):
    path = tmp_path / "model.bdf"
    text = HEAD + RESIDUAL + BEGIN + PART + "NSM1,4,PBAR,1.,7\n"
    path.write_text(text + "ENDDATA\n")
    with pytest.raises(InputError, match="expected ids of its own"):
        read_deck(path)


def test_monitor_points_of_a_part_speak_of_its_own_grids_and_elements(tmp_path):
    """Ids 1 to 3 are in use in the residual: the part's are others in the whole."""
    monitors = (
        "MONPNT1,ROOT,LOADS\n,123456,ARM,,{at}\nAECOMP,ARM,SET1,40\n"
        "SET1,40,{grids}\nMONPNT3,CUT,FORCES\n,123456,41,42,,{at},SMAD\n"
        "SET1,41,{joint}\nSET1,42,{inside}\n"
    )
    main, turned = "1.,1.,0.", "1.,0.,0."  # one place, in either frame
    of_part = {"grids": "2,3", "joint": "1", "inside": "1,2"}
    one = _monitored(
        tmp_path, ONE + monitors.format(grids="3,4", joint="2", inside="2,3", at=main)
    )
    # In the main bulk data the same names and numbers mean something else.
    other = "AECOMP,ARM,SET1,40\nSET1,40,2\nSET1,41,1\nSET1,42,1\n"
    places = "GRID,11,,1.,2.,0.\nGRID,12,,1.,2.,-1.\nSELOC,1,1,2,3,2,11,12\n"
    for text, at in (
        (RESIDUAL + other + BEGIN + PART, main),
        (RESIDUAL + other + places + BEGIN + TURNED, turned),
    ):
        found = _monitored(tmp_path, text + monitors.format(**of_part, at=at))
        assert [name for name, _ in found] == ["ROOT", "CUT"]
        for (_, theirs), (_, ours) in zip(found, one):
            np.testing.assert_allclose(theirs, ours, rtol=1e-9, atol=1e-6)


def _monitored(tmp_path: Path, text: str) -> list[tuple[str, np.ndarray]]:
    """Place and grids, or the resultant in basic axes of a bent shape, by name."""
    path = tmp_path / "model.bdf"
    path.write_text(HEAD + text + "ENDDATA\n")
    structure = Structure.from_deck(read_deck(path))
    points = structure.points
    x, y, z = points.xyz.T
    shape = np.array([y * z, x * x - z, y * y, 0.1 * x, x * y, z - x]).T
    turn = points.rotation.transpose(0, 2, 1)
    local = np.einsum("gij,gkj->gki", turn, shape.reshape(-1, 2, 3))
    found = []
    for point in monitor_points(structure).points:
        grids = np.sort(points.xyz[point.grids], axis=0)
        values = np.concatenate([point.point, grids.ravel()])
        if point.elastic is not None:
            load = (point.elastic @ local.ravel()).reshape(2, 3)
            values = (load @ point.rotation.T).ravel()
        found.append((point.name, values))
    return found

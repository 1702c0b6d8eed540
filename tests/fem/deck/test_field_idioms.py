"""Ways of writing that other programs' users have, and that Nastran takes."""

import h5py
import numpy as np
import pytest

from fem.cli import _status
from fem.deck.reader import read_deck
from fem.deck.text.values import Malformed, components, real
from fem.elements.shells.shell_normals import deck_normals
from fem.errors import InputError
from fem.loads.static import load_factors
from fem.model.points import read_points
from fem.model.structure import Structure
from fem.solution import run_deck

PLATES = (
    "GRID,1\nGRID,2,,1.\nGRID,3,,1.,1.\nGRID,4,,,1.\nGRID,5,,2.\nGRID,6,,2.,1.\n"
    "CQUAD4,1,1,1,2,3,4\nCQUAD4,5,1,2,5,6,3\nPSHELL,1,1,.01,1,,1\nMAT1,1,7.+10,,.3\n"
    "CROD,3,2,1,2\nPROD,2,1,1.-4\n"
)


def test_end_of_the_deck_in_large_fields(read):
    end = (
        "ENDDATA*                                                                *\n*\n"
    )
    deck = read(f"SOL 101\nCEND\nBEGIN BULK\n{PLATES}{end}", alone=True)
    assert not deck.notices


@pytest.mark.parametrize("text", ["2.0  E+7", "2.0E 7", "2.0 D07", "2.+7"])
def test_exponents_of_fortran_formats(text):
    assert real(text) == 2.0e7


@pytest.mark.parametrize("text", ["2.0  7", "2. 0", "2.0 +7", "E7"])
def test_numbers_that_fall_apart_are_no_numbers(text):
    with pytest.raises(Malformed):
        real(text)


def test_components_may_stand_in_groups(read):
    deck = read("SPC1    7       12 456  3\n")
    assert deck.cards["SPC"]["c"].tolist()[-1] == "12456"
    for text in ("1  2", "12 7", "1 -2"):
        with pytest.raises(Malformed):
            components(text)


def test_reference_point_that_is_no_grid_is_the_origin(read):
    deck = read("PARAM,GRDPNT,77\n")
    assert "PARAM GRDPNT 77: there is no such grid" in "".join(deck.notices)
    np.testing.assert_allclose(Structure.from_deck(deck).weight.cg[1, 0], 1.0)


@pytest.mark.parametrize("load", ["PLOAD2,1,3.,1,THRU,9", "PLOAD4,1,1,3.,,,,THRU,9"])
def test_ranges_of_loaded_elements_may_have_gaps(read, load):
    deck = read(PLATES + load, alone=True)
    assert deck.cards[load[:6]]["eids"][0].tolist() == [1, 5]
    assert "7 of the ids between THRU" in "".join(deck.notices)


@pytest.mark.parametrize("load", ["PLOAD2,1,3.,7,THRU,9", "PLOAD4,1,7,3.,,,,THRU,9"])
def test_ranges_without_any_element_are_refused(read, load):
    with pytest.raises(InputError, match="7 is not defined"):
        read(PLATES + load, alone=True)


def test_lines_of_action_through_grids_do_not_stiffen_rotations(read):
    """Springs along a diagonal: rounding of their arms counts as no stiffness."""
    turned = "CORD2R,1,0,0.,0.,0.,-.70710678119,0.,.70710678119\n,.70710678119,0.,.7\n"
    deck = read(
        "GRID,7,,-.10606601718,9.1845476537-18,.10606601718\n"
        "GRID,8,,-.31819805153,2.7553642961-17,.31819805153,1\n"
        f"{turned}CBUSH,1,2,7,8,0.,1.,0.\nPBUSH,2,K,4.3\nSPC1,1,123,7\nSPC1,1,12,8\n",
        alone=True,
        case="SPC = 1",
    )
    structure = Structure.from_deck(deck)
    held = set(structure.autospc.dof.tolist())
    assert held >= {3, 4, 5, 9, 10, 11}
    assert structure.stiffness.shape == (1, 1)


def test_bailout_sees_no_load_in_the_rounding_of_a_motion(tmp_path, capsys):
    """A ring under pressure in its plane that nothing holds across it."""
    grids, quads, loads = [], [], []
    angles = np.radians(np.linspace(0.0, 90.0, 5))
    for k, angle in enumerate(angles, start=1):
        for row, radius in ((0, 0.5), (10, 1.0)):
            x, y = radius * np.cos(angle), radius * np.sin(angle)
            grids.append(f"GRID,{k + row},,{x:.9f},{y:.9f}\n")
        share = 0.5 if k in (1, len(angles)) else 1.0
        x, y = -share * np.cos(angle), -share * np.sin(angle)
        loads.append(f"FORCE,1,{k + 10},,100.,{x:.9f},{y:.9f}\n")
        if k > 1:
            quads.append(f"CQUAD4,{k},1,{k - 1},{k},{k + 10},{k + 9}\n")
    ends = "SPC1,1,24,1,11\nSPC1,1,15,5,15\nPSHELL,1,1,.1,1,,1\nMAT1,1,2.+11,,.3\n"
    bulk = "".join([*grids, *quads, *loads, ends, "PARAM,BAILOUT,-1\n"])
    deck = tmp_path / "ring.bdf"
    deck.write_text(f"SOL 101\nCEND\nSPC=1\nLOAD=1\nBEGIN BULK\n{bulk}ENDDATA\n")
    assert _status([str(deck), "--out", str(tmp_path)]) == 0
    assert "no load acts along it" in "".join(capsys.readouterr())


def test_normals_of_shells_may_be_given(read):
    fold = PLATES.replace("GRID,5,,2.", "GRID,5,,1.,,1.").replace(
        "GRID,6,,2.,1.", "GRID,6,,1.,1.,1."
    )
    frame = "CORD2R,4,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n"
    deck = read(fold + frame + "SNORM,2,4,0.,3.,4.\nSNORM,3,,0.,0.,-2.\n", alone=True)
    normals = deck_normals(deck, read_points(deck))
    np.testing.assert_allclose(normals[1], [0.8, 0.0, 0.6], atol=1e-12)
    np.testing.assert_allclose(normals[2], [0.0, 0.0, -1.0], atol=1e-12)
    np.testing.assert_allclose(normals[0], [0.0, 0.0, 1.0], atol=1e-12)
    without = read(fold, alone=True)
    assert not deck_normals(without, read_points(without))[1:3].any()
    faulty = read(fold + "SNORM,2,0,0.,0.,0.\n", alone=True)
    with pytest.raises(InputError, match="the normal has no length"):
        deck_normals(faulty, read_points(faulty))


BAR_WITH_SETS = (
    "SPC1,1,123,1\nSPC1,2,456,1\nSPCADD,9,1,2\nSPCADD,10,9\nLOAD,5,1.,1.,6\n"
    "LOAD,6,1.,1.,1\n"
)


def test_constraints_that_combine_combinations_are_refused(read):
    words = "SPCADD 10: set 9 combines sets itself, expected sets of SPC"
    with pytest.raises(InputError, match=words):
        read(BAR_WITH_SETS, case="SPC=10\nLOAD=1")


def test_loads_that_combine_combinations_leave_them_out(read):
    """As in NX Nastran 8.5: reactions of `pload4/cquad4` of pyNastran's models."""
    deck = read(BAR_WITH_SETS + "LOAD,7,2.,3.,1,1.,5\n", case="SPC=9\nLOAD=7")
    told = "LOAD 7: set 5 combines sets itself, expected sets of FORCE"
    assert told in "".join(deck.notices)
    assert load_factors(deck, 7) == {1: 6.0}
    with pytest.raises(InputError, match=r"load set 6 combines sets itself \(LOAD 5\)"):
        load_factors(deck, 5)


def test_sets_under_the_number_of_a_combination_are_combined(read):
    bulk = BAR_WITH_SETS + "SPC1,9,123456,1\n"
    structure = Structure.from_deck(read(bulk, case="SPC=10\nLOAD=1"))
    assert structure.stiffness.shape == (12, 12)


def test_reactions_of_a_structure_held_at_all_its_stiffness(tmp_path):
    """Rotations of solids without stiffness are no reason to refuse it."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    corners += [(x, y, 1) for x, y, _ in corners]
    grids = [f"GRID,{k},,{x}.,{y}.,{z}.\n" for k, (x, y, z) in enumerate(corners, 1)]
    bulk = "CHEXA,1,1,1,2,3,4,5,6\n,7,8\nPSOLID,1,1\nMAT1,1,7.+10,,.3\n"
    bulk += "SPC1,1,123,1,THRU,8\nPLOAD4,1,1,100.,,,,5,7\n"
    path = tmp_path / "block.bdf"
    case = "SOL 101\nCEND\nSPC=1\nLOAD=1\nBEGIN BULK\n"
    path.write_text(case + "".join(grids) + bulk + "ENDDATA\n")
    results = run_deck(read_deck(path), tmp_path / "block.h5")
    with h5py.File(results) as file:
        force = file["static/1/spc_force"][:, :3].sum(axis=0)
    np.testing.assert_allclose(force, [0.0, 0.0, 100.0], atol=1e-9)


def test_masses_alone_hold_nothing(read):
    deck = read("GRID,1\nCONM2,1,1,,2.\nSPC1,1,123,1\n", alone=True, case="SPC=1")
    with pytest.raises(InputError, match="expected elements that hold the grids"):
        _ = Structure.from_deck(deck).stiffness


def test_absent_directions_of_isotropic_sheets_count_for_nothing(read):
    turned = PLATES.replace("CQUAD4,1,1,1,2,3,4", "CQUAD4,1,1,1,2,3,4,9")
    deck = read(turned, alone=True)
    assert deck.cards["CQUAD4"]["mcid"].tolist() == [-1, -1]
    assert "coordinate systems 9 of MCID are not defined" in "".join(deck.notices)
    orthotropic = turned.replace("MAT1,1,7.+10,,.3", "MAT8,1,7.+10,1.+10,.3,5.+9")
    orthotropic = orthotropic.replace("PROD,2,1", "MAT1,7,1.,,.3\nPROD,2,7")
    with pytest.raises(InputError, match="coordinate system 9 is not defined"):
        read(orthotropic, alone=True)


@pytest.mark.parametrize("thickness", [1e-2, 1e-4])
def test_a_thin_sheet_on_a_hinge_is_named_as_a_thick_one(read, thickness):
    """Stiffness across a sheet is thickness² of that along it."""
    grids = [(-1, 0), (0, 0), (1, 0), (-1, 1), (0, 1), (1, 1)]
    c, s = np.cos(0.6), np.sin(0.6)
    bulk = "".join(
        f"GRID,{k},,{x * c - y * s:.10f},{x * s + y * c:.10f}\n"
        for k, (x, y) in enumerate(grids, start=1)
    )
    bulk += f"PSHELL,1,1,{thickness},1,,1\nMAT1,1,1.+5,,.3\nSPC1,1,123,1,4\n"
    bulk += "CQUAD4,1,1,1,2,5,4\nCQUAD4,2,1,2,3,6,5\n"
    structure = Structure.from_deck(read(bulk, alone=True, case="SPC=1"))
    (found,) = structure.mechanisms()
    assert found.motions.shape[1] == 1
    assert len(found.rows) == 16

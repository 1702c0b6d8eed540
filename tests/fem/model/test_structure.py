"""Structure: sets, operators, damping, messages."""

import subprocess
import sys

import numpy as np
import pytest

import fem
from fem.errors import InputError

BAR = """\
SOL 103
CEND
SPC = 1
METHOD = 1
BEGIN BULK
EIGRL,1,,,4
CORD2R,5,,0.,0.,0.,0.,0.,1.
,0.,1.,0.
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.,5
GRID,3,,2.,0.,0.
CBAR,1,1,1,2,0.,0.,1.
CBAR,2,1,2,3,0.,0.,1.
PBAR,1,1,1.-3,1.-6,2.-6,1.-6
MAT1,1,7.+10,,.3,2700.,,,.02
SPC1,1,123456,1
"""


@pytest.fixture
def deck_of(tmp_path):
    def make(text: str, name: str = "model.bdf"):
        path = tmp_path / name
        path.write_text(text + "ENDDATA\n")
        return fem.read_deck(path)

    return make


def test_operator_gives_displacements_in_both_frames(deck_of):
    structure = fem.Structure.from_deck(deck_of(BAR))
    u_f = np.random.default_rng(0).normal(size=structure.size)
    u_g = structure.displacement(u_f)
    own = structure.operator([2, 3], (1, 2, 5)) @ u_f
    np.testing.assert_allclose(own, u_g.reshape(-1, 6)[1:][:, [0, 1, 4]].reshape(-1))
    # Frame 5 has its x axis along basic y, its y axis along minus basic x.
    basic = structure.operator(2, frame="basic") @ u_f
    x, y, z, rx, ry, rz = u_g[6:12]
    np.testing.assert_allclose(basic, [-y, x, z, -ry, rx, rz], atol=1e-15)
    # Its transpose makes loads: their work is the same.
    force = np.arange(1.0, 7.0)
    rows = structure.operator(2, frame="basic")
    assert (rows.T @ force) @ u_f == pytest.approx(force @ (rows @ u_f), rel=1e-12)


def test_unknown_grid_in_an_operator_is_named(deck_of):
    structure = fem.Structure.from_deck(deck_of(BAR))
    with pytest.raises(InputError, match="77"):
        structure.operator([2, 77])


@pytest.mark.parametrize(
    ("params", "stiff", "mass", "words"),
    [
        ("", 0.0, 0.0, ["GE", "W4"]),
        ("PARAM,G,.04\n", 0.0, 0.0, ["PARAM,G,0.04", "W3", "GE"]),
        ("PARAM,G,.04\nPARAM,W3,100.\nPARAM,W4,50.\n", 4e-4 + 4e-4, 0.0, []),
        ("PARAM,W4,50.\nPARAM,ALPHA1,.3\nPARAM,ALPHA2,.01\n", 0.0104, 0.3, []),
    ],
)
def test_damping_of_parameters_and_what_is_inactive(
    deck_of, params, stiff, mass, words
):
    structure = fem.Structure.from_deck(deck_of(BAR + params))
    assert structure.damping.stiffness_factor == pytest.approx(stiff, rel=1e-12)
    assert structure.damping.mass_factor == mass
    assert structure.damping.other is None
    said = " ".join(structure.damping_notices)
    assert bool(said) == bool(words)
    assert all(word in said for word in words)


def test_damping_of_one_of_two_materials_is_not_proportional(deck_of):
    text = BAR.replace("CBAR,2,1", "CBAR,2,2") + (
        "PBAR,2,2,1.-3,1.-6,2.-6,1.-6\nMAT1,2,7.+10,,.3,2700.\nPARAM,W4,50.\n"
    )
    structure = fem.Structure.from_deck(deck_of(text))
    assert structure.damping.stiffness_factor == 0.0
    expected = structure.elimination.reduce(structure.matrices.structural_damping) / 50
    np.testing.assert_allclose(
        structure.damping.other.toarray(), expected.toarray(), rtol=1e-12
    )


def test_loose_grid_is_constrained_and_reported(deck_of):
    text = BAR + "GRID,9,,5.,0.,0.\n"
    structure = fem.Structure.from_deck(deck_of(text))
    assert len(structure.autospc.dof) == 6
    assert any("grid 9 T1" in notice for notice in structure.notices)
    assert structure.size == 12


def test_singular_structure_is_named_by_grid_and_component(deck_of):
    text = BAR + "PARAM,AUTOSPC,NO\nGRID,9,,5.,0.,0.\nCBAR,9,1,9,10,0.,0.,1.\n"
    text += "GRID,10,,6.,0.,0.\n"
    structure = fem.Structure.from_deck(deck_of(text))
    lines = structure.singular_message()
    assert len(lines) == 1
    assert "6 motions" in lines[0]
    assert "grid 9 T1 T2 T3 R1 R2 R3, grid 10" in lines[0]


def test_sets_that_name_constrained_freedoms_are_refused(deck_of):
    structure = fem.Structure.from_deck(deck_of(BAR + "ASET,1,3,3,3\n"))
    with pytest.raises(InputError, match="ASET names grid 1 T3"):
        structure.free_rows(structure.analysis_dof, "ASET")


def test_subcases_share_what_does_not_depend_on_them(deck_of):
    text = (
        BAR.replace("METHOD = 1\n", "METHOD = 1\nSUBCASE 1\nSUBCASE 2\nSPC = 2\n")
        + "SPC1,2,123456,3\n"
    )
    deck = deck_of(text)
    first = fem.Structure.from_deck(deck)
    assert first.stiffness.shape == (12, 12)
    second = first.with_subcase(deck.subcase(2))
    assert second.matrices is first.matrices
    assert second.elimination.s.tolist() == list(range(12, 18))
    again = first.with_subcase(deck.subcase(1))
    assert again.stiffness is first.stiffness


def test_a_subcase_with_other_mass_has_a_model_of_its_own(deck_of):
    text = (
        BAR.replace("METHOD = 1\n", "METHOD = 1\nSUBCASE 1\nSUBCASE 2\nNSM = 5\n")
        + "NSML1,5,PBAR,3.,ALL\n"
    )
    deck = deck_of(text)
    first = fem.Structure.from_deck(deck)
    second = first.with_subcase(deck.subcase(2))
    assert second.weight.total == pytest.approx(first.weight.total + 3.0)
    assert second.points is first.points
    assert second.subcase.id == 2


def test_import_is_quick_and_every_public_name_is_there():
    code = (
        "import sys, fem\n"
        "assert not {'pandas', 'h5py', 'pyNastran', 'scipy'} & set(sys.modules)\n"
        "for name in fem.__all__: getattr(fem, name)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    with pytest.raises(AttributeError, match="nonsense"):
        fem.nonsense  # noqa: B018


def test_factors_of_parameters_on_matrices(tmp_path):
    """PARAM CK1, CM1 and CB1 multiply what elements give."""
    bulk = (
        "SOL 101\nCEND\nBEGIN BULK\n{}SPOINT,1\nCELAS4,1,3.,1\nCMASS4,2,5.,1\n"
        "CDAMP4,3,7.,1\nENDDATA\n"
    )
    path = tmp_path / "a.bdf"
    path.write_text(bulk.format("PARAM,CK1,2.\nPARAM,CM1,3.\nPARAM,CB1,4.\n"))
    m = fem.Structure.from_deck(fem.read_deck(path)).matrices
    found = [x.toarray().item() for x in (m.stiffness, m.mass, m.damping)]
    assert found == [6.0, 15.0, 28.0]


@pytest.mark.parametrize(("sol", "held"), [(101, 3), (103, 0)])
def test_freedoms_in_no_matrix_are_held_with_autospc_off(tmp_path, sol, held):
    """A grid with mass and without stiffness is inert in statics only."""
    path = tmp_path / "a.bdf"
    path.write_text(
        f"SOL {sol}\nCEND\nLOAD = 1\nMETHOD = 2\nBEGIN BULK\nEIGRL,2,,,1\n"
        "FORCE,1,2,,1.,1.\nGRID,1,,,,,,123456\nGRID,2,,1.,,,,23456\n"
        "GRID,3,,2.,,,,456\nCROD,1,1,1,2\nPROD,1,1,1.\nMAT1,1,1.,,.3,1.\n"
        "CONM2,9,3,,1.\nPARAM,AUTOSPC,NO\nENDDATA\n"
    )
    structure = fem.Structure(fem.read_deck(path))
    assert structure.size == 4 - held
    assert any("AUTOSPC is off" in text for text in structure.notices) == bool(held)

"""MASSSET: masses of subcases, S0 (S1 M1 + S2 M2 + ...), with closed forms."""

import h5py
import numpy as np
import pytest

import fem
from fem.algebra import statics
from fem.deck.units import in_si, units_of
from fem.errors import InputError
from fem.solution import run_deck

# Springs 1000 N/m to ground along x, masses of 4 kg: 2.516461 Hz.
BASE = """\
GRID,1,,0.,0.,0.,,23456
GRID,2,,1.,0.,0.,,23456
CELAS2,11,1000.,1,1
CELAS2,12,1000.,2,1
CONM2,21,1,,4.
CONM2,22,2,,4.
EIGRL,5,,,2
"""
SETS = """\
MASSSET,10,1.,1.,0
MASSSET,20,1.,1.,0,1.,1
MASSSET,30,0.5,1.,0,2.,1
+,0.,2
"""
INCREMENTS = """\
BEGIN MASSID = 1 LABEL = 'full tanks'
GRID,1,,77.,0.,0.
PARAM,WTMASS,3.
CONM2,21,1,,12.
BEGIN MASSID=2
CROD,31,3,1,2
PROD,3,4,0.5
MAT1,4,1.+9,,.3,8.
"""
CASE = """\
METHOD = 5
SUBCASE 1
 MASSSET = 10
SUBCASE 2
 MASSSET = 20
SUBCASE 3
 MASSSET = 30
SUBCASE 4
"""


def deck(tmp_path, case=CASE, sets=SETS, increments=INCREMENTS, base=BASE):
    path = tmp_path / "deck.bdf"
    path.write_text(
        f"SOL 103\nCEND\n{case}BEGIN BULK\n{base}{sets}{increments}ENDDATA\n"
    )
    return path


def hertz(mass: float) -> float:
    """Of a spring of 1000 N/m."""
    return np.sqrt(1000.0 / mass) / (2.0 * np.pi)


def test_each_subcase_vibrates_with_its_mass(tmp_path):
    model = fem.read_deck(deck(tmp_path))
    run_deck(model, tmp_path / "out.h5")
    with h5py.File(tmp_path / "out.h5") as file:
        found = [
            file[name]["frequency_hz"][:]
            for name in ("modes", "modes_2", "modes_3", "modes_4")
        ]
    plain = [hertz(4.0)] * 2
    assert found[0] == pytest.approx(plain, rel=1e-12)
    assert found[1] == pytest.approx([hertz(16.0), hertz(4.0)], rel=1e-12)
    # half of (4 + 2 x 12) and half of 4
    assert found[2] == pytest.approx([hertz(14.0), hertz(2.0)], rel=1e-12)
    assert found[3] == pytest.approx(plain, rel=1e-12)


def test_elements_properties_and_materials_of_an_increment_make_its_mass(tmp_path):
    sets = "MASSSET,40,1.,0.,0,1.,2\n"
    model = fem.read_deck(deck(tmp_path, "MASSSET = 40\n", sets))
    structure = fem.Structure.from_deck(model)
    # A rod of 1 m, 0.5 m2 and 8 kg/m3, without stiffness.
    assert structure.rigid_mass.total == pytest.approx(4.0, rel=1e-12)
    assert structure.rigid_mass.center[0] == pytest.approx(0.5, rel=1e-12)
    assert structure.stiffness.toarray() == pytest.approx(1000.0 * np.eye(2))
    assert any("MASSSET 40: the mass is 0 x the base" in n for n in structure.notices)
    assert any("not used: GRID (1), PARAM (1)" in n for n in structure.notices)


def test_a_set_without_the_base_says_so(tmp_path):
    model = fem.read_deck(deck(tmp_path, "MASSSET = 40\n", "MASSSET,40,1.,1.,2\n"))
    structure = fem.Structure.from_deck(model)
    assert any("without 0 the mass of the main bulk" in n for n in structure.notices)


def test_subcases_share_all_but_the_mass(tmp_path):
    model = fem.read_deck(deck(tmp_path))
    first, second, _, last = (
        fem.Structure.from_deck(model).with_subcase(c) for c in model.case_control
    )
    second = first.with_subcase(second.subcase)
    assert second.stiffness is first.stiffness
    assert second.blocks is first.blocks
    assert second.elimination is first.elimination
    assert last.subcase.massset == 0


def test_units_of_an_increment_are_the_decks(tmp_path):
    model = in_si(fem.read_deck(deck(tmp_path)), units_of("mm-t-N"))
    second = fem.Structure.from_deck(model, 2)
    assert second.rigid_mass.total == pytest.approx(20.0e3, rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"case": "METHOD = 5\nMASSSET = 99\n"},
            "MASSSET = 99 is not defined; expected a set of MASSSET",
        ),
        (
            {"sets": "MASSSET,10,1.,1.,3\n", "case": ""},
            "BEGIN MASSID = 3 is not in the deck; it has 1, 2",
        ),
        ({"sets": "MASSSET,10,,1.,1\n", "case": ""}, "field S0 is blank"),
        ({"sets": "MASSSET,1,1.,1.,1\n", "case": ""}, "has the same number"),
        (
            {"increments": "BEGIN MASSID=1\nCONM2,5,9,,4.\n", "case": "", "sets": ""},
            "CONM2 5: grid 9 is not defined",
        ),
        (
            {"increments": "BEGIN MASSID=1\nCROD,5,8,1,2\n", "case": "", "sets": ""},
            "CROD 5: PROD 8 is not defined",
        ),
        (
            {"increments": "BEGIN MASSID=1\nCONM3,5,1,,4.\n", "case": "", "sets": ""},
            "CONM3 (1 card",
        ),
        (
            {"increments": "BEGIN SUPER=2 MASSID=1\n", "case": "", "sets": ""},
            "BEGIN SUPER=2 is not in the deck",
        ),
        (
            {"increments": "BEGIN MASSID=0\n", "case": "", "sets": ""},
            "MASSID = 0 is the main bulk data",
        ),
    ],
)
def test_what_does_not_fit_is_named(tmp_path, changes, message):
    with pytest.raises(InputError) as error:
        fem.read_deck(deck(tmp_path, **changes))
    assert any(message in text for text in error.value.problems)


def test_gravity_follows_the_mass_with_one_factor_of_the_stiffness(
    tmp_path, monkeypatch
):
    factors, factorize = [], statics.factorize

    def counted(matrix, **options):
        factors.append(matrix)
        return factorize(matrix, **options)

    monkeypatch.setattr(statics, "factorize", counted)
    case = "LOAD = 7\nSUBCASE 1\n MASSSET = 10\nSUBCASE 2\n MASSSET = 20\n"
    path = deck(tmp_path, case, base=BASE + "GRAV,7,,10.,1.,0.,0.\n")
    path.write_text(path.read_text().replace("SOL 103", "SOL 101"))
    run_deck(fem.read_deck(path), tmp_path / "out.h5")
    with h5py.File(tmp_path / "out.h5") as file:
        moved = [file[f"static/{k}/displacement"][:, 0] for k in (1, 2)]
    assert moved[0] == pytest.approx([0.04, 0.04], rel=1e-12)
    assert moved[1] == pytest.approx([0.16, 0.04], rel=1e-12)
    assert len(factors) == 1


def test_increments_of_superelements_are_those_of_the_whole(tmp_path):
    """Ids of the part are in use elsewhere: its increment follows it."""
    part = """\
BEGIN SUPER = 1
GRID,1,,2.,0.,0.,,23456
GRID,2,,1.,0.,0.,,23456
CELAS2,11,1000.,1,1
CROD,31,3,1,2
PROD,3,4,0.5
MAT1,4,1.+4,,.3
CONM2,21,1,,4.
BEGIN SUPER = 1 MASSID = 1
CONM2,21,1,,12.
CROD,41,3,1,2
PROD,3,4,0.5
MAT1,4,1.,,.3,8.
"""
    case = "METHOD = 5\nSUBCASE 1\n MASSSET = 20\n"
    sets = "MASSSET,20,1.,1.,0,2.,1\nSEBULK,1,PRIMARY\n"
    with h5py.File(
        run_deck(fem.read_deck(deck(tmp_path, case, sets, part)), tmp_path / "parts.h5")
    ) as file:
        found = file["modes/frequency_hz"][()]
    # The interior grid follows the boundary statically: 5/6 of its motion.
    share = 5000.0 / 6000.0
    k = np.array([1000.0, 1000.0 + 1000.0 * share])
    m = np.array([4.0, 4.0 + 2 * 2.0 + share**2 * (4.0 + 2 * (12.0 + 2.0))])
    expected = np.sqrt(k / m) / (2 * np.pi)
    np.testing.assert_allclose(found, sorted(expected)[:2], rtol=1e-9)

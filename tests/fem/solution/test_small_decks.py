"""Small decks with closed-form answers, as they are found in practice."""

import h5py
import numpy as np
import pytest

import fem
from fem.solution import run_deck

# A bar of stiffness E A / L = 5e6 along x.
ROD = """\
GRID,11,,0.,0.,0.
GRID,12,,4.,0.,0.
CROD,1,7,11,12
PROD,7,3,2.
MAT1,3,1.0+7,,.3
SPC1,5,123456,11
SPC1,5,23456,12
FORCE,9,12,,1000.,1.,0.,0.
FORCE,10,12,,500.,1.,0.,0.
"""


class Said(list):
    """A console that remembers."""

    def say(self, text):
        self.append(text)

    def progress(self, task):
        return lambda done, total: None


@pytest.fixture
def solve(tmp_path):
    """Function from SOL, case control and bulk data to the result file."""
    files = []

    def go(sol, case, bulk, ignore=()):
        path = tmp_path / "deck.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}\nBEGIN BULK\n{bulk}\nENDDATA\n")
        out = tmp_path / f"deck{len(files)}.h5"
        said = Said()
        run_deck(fem.read_deck(path, ignore=ignore), out, fem.Options(console=said))
        files.append(h5py.File(out))
        files[-1].said = said
        return files[-1]

    yield go
    for file in files:
        file.close()


def test_subcases_after_a_bare_output_line_are_solved(solve):
    case = "OUTPUT\nDISPLACEMENT(PLOT,REAL) = ALL\nSUBCASE 1\nLOAD = 9\nSPC = 5"
    assert solve(101, case, ROD)["static/1/displacement"][1, 0] == pytest.approx(2e-4)


def test_constraints_after_a_bare_output_line_hold(solve):
    """sqrt(k/m)/2 pi; the free pair would have 0 and 290.6 Hz."""
    masses = "EIGRL,4,,,2\nCONM2,21,12,,3.\nCONM2,22,11,,3.\n"
    case = "METHOD = 4\nOUTPUT\nDISP(PLOT) = ALL\nSUBCASE 1\nSPC = 5"
    file = solve(103, case, ROD + masses)
    assert file["modes/frequency_hz"][:] == pytest.approx(
        [np.sqrt(5e6 / 3.0) / (2 * np.pi)]
    )


def test_sums_of_subcases(solve):
    case = (
        "SPC=5\nFORCE=ALL\nSUBCASE 1\nLOAD=9\nSUBCASE 2\nLOAD=10\n"
        "SUBCOM 3\nSUBSEQ=1.,2.\nREPCASE 4\nSUBCASE 5\nLOAD=10\nSYMCOM 6\nSYMSEQ=1.,-1."
    )
    file = solve(101, case, ROD)
    moved = [file[f"static/{i}/displacement"][1, 0] for i in range(1, 7)]
    assert moved == pytest.approx(np.array([2, 1, 4, 4, 1, 0]) * 1e-4, abs=1e-12)
    assert file["static/3/spc_force"][0, 0] == pytest.approx(-2000.0)
    assert file["static/3/element_force/CROD/value"][0, 0] == pytest.approx(2000.0)


@pytest.mark.parametrize(
    ("card", "force"),
    [
        # X1 and X2 with P2 left blank: the load falls to zero, 600 * 2 / 2.
        ("FYE,LE,1.,600.,3.", 600.0),
        ("FYE,FR,.25,600.,.75", 600.0),
        # X2 blank, or the same as X1: a concentrated load.
        ("FYE,LE,1.,600.", 600.0),
        ("FYE,LE,1.,600.,1.,50.", 600.0),
        # P1 blank: it rises from zero.
        ("FYE,LE,1.,,3.,600.", 600.0),
        ("FYE,LE,1.,600.,3.,600.", 1200.0),
    ],
)
def test_blank_fields_of_loads_on_bars(solve, card, force):
    bulk = (
        "GRID,11\nGRID,12,,4.\nCBAR,1,7,11,12,0.,1.,0.\nPBAR,7,3,1.,1.,1.,1.\n"
        f"MAT1,3,1.2+7,,.3\nSPC1,5,123456,11\nPLOAD1,9,1,{card}\n"
    )
    file = solve(101, "SPC = 5\nLOAD = 9", bulk)
    assert file["static/1/spc_force"][0, 1] == pytest.approx(-force)


def test_a_load_that_falls_to_zero_bends_as_beam_theory_has_it(solve):
    """Tip of a cantilever: the integral of q x² (3 L - x) / (6 E I) over the load."""
    bulk = (
        "GRID,11\nGRID,12,,4.\nCBAR,1,7,11,12,0.,1.,0.\nPBAR,7,3,1.,1.,1.,1.\n"
        "MAT1,3,1.2+7,,.3\nSPC1,5,123456,11\nPLOAD1,9,1,FYE,LE,1.,600.,3.\n"
    )
    file = solve(101, "SPC = 5\nLOAD = 9", bulk)
    assert file["static/1/displacement"][1, 1] == pytest.approx(2.51666667e-4, rel=1e-6)


def test_guyan_reduction_by_omit(solve):
    """Two equal springs k in series, the mass between them omitted: 209.88 Hz."""
    bulk = (
        "GRID,11\nGRID,12,,1.\nGRID,13,,2.\nCROD,1,7,11,12\nCROD,2,7,12,13\n"
        "PROD,7,3,2.\nMAT1,3,1.0+7,,.3\nCONM2,21,12,,3.\nCONM2,22,13,,5.\n"
        "SPC1,5,123456,11\nSPC1,5,23456,12,13\nEIGRL,4,,,1\n"
    )
    case = "SPC = 5\nMETHOD = 4"
    # Static shape (1/2, 1): k/2 over 5 + 3/4.
    expected = np.sqrt(1e7 / (5.0 + 0.25 * 3.0)) / (2 * np.pi)
    for card in ("OMIT1,1,12", "OMIT,12,1", "ASET,13,1", "CSET1,1,13"):
        file = solve(103, case, f"{bulk}{card}\n")
        assert file["modes/frequency_hz"][:] == pytest.approx([expected]), card


def test_scalar_points_that_their_use_defines(solve):
    """A chain of three masses: 2 sqrt(k/m) sin((2 n - 1) pi / 14) / 2 pi."""
    bulk = "EIGRL,4,,,3\n" + "".join(
        f"CELAS4,{k},800.,{k - 1},{k}\nCMASS4,{10 + k},2.,{k}\n" for k in (1, 2, 3)
    )
    file = solve(103, "METHOD = 4", bulk)
    n = np.arange(1, 4)
    expected = 2.0 * 20.0 * np.sin((2 * n - 1) * np.pi / 14.0) / (2 * np.pi)
    assert file["modes/frequency_hz"][:] == pytest.approx(expected)
    assert any("3 scalar points are defined by scalar elements" in t for t in file.said)


@pytest.mark.parametrize(
    "passenger",
    [
        "MAT4,3,204.,900.",
        "MATT1,3,7\nTABLEM1,7",
        "AEROS,,,1.,10.,10.\nCAERO1,1001,1\nAELIST,7,1001,THRU,1008\nTRIM,1,.3",
        "PBEAM3,77,3,1.,1.,1.,1.",
        "PBARL,78,999,,ROD\n,.1",  # no element has it, no material is looked for
        "BCTABLE,1\nTEMPN1,1\nEPOINT,99\nPELAST,7\nPBUSHT,7",
    ],
)
def test_cards_that_cannot_matter_are_named_and_passed_over(solve, passenger):
    file = solve(101, "SPC = 5\nLOAD = 9", f"{ROD}{passenger}\n")
    assert file["static/1/displacement"][1, 0] == pytest.approx(2e-4)
    named = passenger.split(",")[0]
    said = [t for t in file.said if "cards without effect here" in t]
    assert named == "PBARL" or f"{named} (1)" in said[0]


@pytest.mark.parametrize("name", ["MPC", "SPC"])
def test_selected_constraints_that_are_not_there_constrain_nothing(solve, name):
    bulk = ROD.replace("SPC1,5,", "SPC1,6,") if name == "SPC" else ROD
    case = "MPC = 77\nSPC = 5" if name == "MPC" else "SPC = 5"
    bulk += "GRID,13,,,,,,123456\n"
    if name == "SPC":
        bulk = bulk.replace("GRID,11,,0.,0.,0.", "GRID,11,,,,,,123456")
        bulk = bulk.replace("GRID,12,,4.,0.,0.", "GRID,12,,4.,,,,23456")
    file = solve(101, f"{case}\nLOAD = 9", bulk)
    assert file["static/1/displacement"][1, 0] == pytest.approx(2e-4)
    number = {"MPC": 77, "SPC": 5}[name]
    assert any(f"{name} = {number} is selected and not in" in t for t in file.said)


@pytest.mark.parametrize(
    "spc",
    [
        "SPC1,5,123456,11\nSPC1,5,23456,12,THRU,99999999",
        "SPC1,5,23456,10,THRU,14\nSPC,5,11,1",
        "SPC1,5,23456,1,THRU,50,EXCEPT,20\nSPC1,5,1,1,THRU,11",
        "SPC1,5,23456,2,THRU,40,BY,1\nSPC1,5,1,5,THRU,11,BY,3",
    ],
)
def test_ranges_hold_the_points_that_exist(solve, spc):
    rod = "".join(x for x in ROD.splitlines(True) if not x.startswith("SPC"))
    file = solve(101, "SPC = 5\nLOAD = 9", f"{rod}{spc}\n")
    assert file["static/1/displacement"][1, 0] == pytest.approx(2e-4)


def test_matrices_in_sums_with_factors(solve):
    """K + 0.5 KADD + KADD: 500 / (1e3 + 1.5 * 2e3)."""
    bulk = (
        "GRID,1,,,,,,23456\nCELAS2,1,1000.,1,1\nFORCE,9,1,,500.,1.\n"
        "DMIG,KADD,0,6,1,1\nDMIG,KADD,1,1,,1,1,2000.\n"
    )
    file = solve(101, "LOAD = 9\nK2GG = 0.5*KADD, KADD", bulk)
    assert file["static/1/displacement"][0, 0] == pytest.approx(0.125)


def test_poisson_ratio_of_rods_with_both_moduli_does_not_count(solve):
    bulk = ROD.replace("1.0+7,,.3", "1.0+7,5.+5,16.7")
    file = solve(101, "SPC = 5\nLOAD = 9", bulk)
    assert file["static/1/displacement"][1, 0] == pytest.approx(2e-4)


def test_free_fields_go_on_beyond_the_eighth(solve):
    bulk = ROD.replace(
        "SPC1,5,23456,12\n", "SPC1,5,23456,12,12,12,12,12,12,12,12,12,12,12\n"
    )
    file = solve(101, "SPC = 5\nLOAD = 9", bulk)
    assert file["static/1/displacement"][1, 0] == pytest.approx(2e-4)


def test_isotropic_shell_with_a_system_normal_to_it(solve):
    """Its material axes change nothing; a laminate's would."""
    bulk = (
        "EIGRL,1,,,8\nCORD2R,3,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\nMAT1,2,7.+10,,.3,2700.\n"
        "GRID,1\nGRID,2,,1.\nGRID,3,,1.,0.,1.\nGRID,4,,0.,0.,1.\n"
        "PSHELL,1,2,.01,2,,2\nCQUAD4,1,1,1,2,3,4"
    )
    plain = solve(103, "METHOD = 1", bulk)["modes/frequency_hz"][:]
    normal = solve(103, "METHOD = 1", bulk + ",3")["modes/frequency_hz"][:]
    np.testing.assert_allclose(normal[6:], plain[6:], rtol=1e-12)
    laminate = bulk.replace("PSHELL,1,2,.01,2,,2", "PCOMP,1\n,2,.01,0.,YES")
    with pytest.raises(fem.InputError, match="is normal to the element"):
        solve(103, "METHOD = 1", laminate + ",3")


@pytest.mark.parametrize(
    ("bulk", "case", "words"),
    [
        (ROD.replace("9,12,,1000.,1.", "9,12,,1.+300,1.+300"), "", "FORCE 9: its load"),
        (ROD + "LOAD,8,1.+300,1.+300,9\n", "LOAD = 8", "the load at grid 12 T1 is inf"),
        (
            ROD.replace("PROD,7,3,2.", "PROD,7,3,1.+302"),
            "",
            "CROD 1: the stiffness is beyond",
        ),
        (ROD + "GRID,14,,1.+300\n", "", "GRID 14: found \\(1e\\+300, 0, 0\\)"),
        (
            ROD + "CELAS2,8,1.+200,11,2\n",
            "",
            "CELAS2 8: the stiffness is beyond what can be computed with",
        ),
        (
            ROD + "DMIG,KADD,0,6,2,0\nDMIG,KADD,12,1,,12,1,1.+300\n",
            "K2GG = KADD",
            "DMIG KADD: found 1e\\+300, expected no more than 1e\\+100",
        ),
        (
            ROD.replace("1000.,1.", "1.+300,1.").replace("3,2.", "3,1.-20"),
            "",
            "displacement is inf at grid 12 T1",
        ),
        (ROD.replace(",.3\n", ",1.\n"), "", "MAT1 3: NU 1, expected between -1 and 1"),
        (ROD.replace(",.3\n", ",-1.\n"), "", "MAT1 3: NU -1, expected between -1"),
        (ROD.replace("1.0+7", "-1.0+7"), "", "MAT1 3: E -1e\\+07, expected 0 or more$"),
        (
            ROD + "RBE3,10,,12,,1.,123,11\n",
            "",
            "RBE3 field REFC is blank",
        ),
        (ROD + "EIGRL,1,,,-3\n", "", "ND -3, expected"),
        (ROD + "EIGRL,1,,1.+300\n", "", "V2 1e\\+300 Hz, expected at most"),
        (ROD + "TSTEP,1,1000000000,.1\n", "", "at most 50000000 steps"),
        (ROD + "TSTEP,1,10,1.-300\n", "", "steps of 1e-15 to"),
        (ROD, "K2GG = 0.5KADD", "DMIG 0.5KADD is not in the deck"),
        (ROD, "K2GG = X*KADD", "expected NAME or FACTOR\\*NAME"),
        (ROD + "CBUSH2D,1\n", "", "not supported"),
        (ROD + "SEBULK,3,PRIMARY\n", "", "BEGIN SUPER = 3 is not in the deck"),
    ],
)
@pytest.mark.filterwarnings("ignore:overflow")
def test_what_is_no_number_is_named_and_not_written(solve, bulk, case, words, tmp_path):
    with pytest.raises(fem.InputError, match=words):
        solve(101, f"SPC = 5\nLOAD = 9\n{case}", bulk)
    assert not list(tmp_path.glob("*.h5"))


def test_hints_are_slips_only(solve):
    for name, hint in (("CBRA", "CBAR"), ("GIRD", "GRID"), ("ZZTOPQ", "")):
        with pytest.raises(fem.InputError) as caught:
            solve(101, "SPC = 5\nLOAD = 9", f"{ROD}{name},1\n")
        assert ("did you mean" in str(caught.value)) == bool(hint)
        assert hint in str(caught.value)


@pytest.mark.parametrize(
    ("table", "delay", "given"),
    [
        ("0.,0.,.15,1.5,.3,3.", "", "10 at 1 s"),
        ("0.,0.,.5,5.,10.,5.", ".2", "-2 at 0 s"),
        ("0.,1.,.3,1.", "", ""),  # continued, it stays as it is
        ("0.,0.,2.,2.", "", ""),
    ],
)
def test_tables_that_end_before_the_run(solve, table, delay, given):
    bulk = (
        "GRID,1,,,,,,23456\nCELAS2,1,800.,1,1\nCONM2,2,1,,2.\nTSTEP,6,100,.01\n"
        f"TLOAD1,50,60,{delay},,80\nDAREA,60,1,1,4.\nTABLED1,80\n,{table},ENDT\n"
    )
    file = solve(109, "DLOAD = 50\nTSTEP = 6", bulk)
    said = [text for text in file.said if "TABLED1 80" in text]
    assert len(said) == bool(given)
    assert not given or f"it gives {given}" in said[0]


# 8 x 2.5 = 20, and 4e7.
_ARGUMENTS = """\
,DESVAR,30
,DTABLE,TWO
DTABLE,TWO,2.5
DEQATN,60,F(A,B)=A*B
DEQATN  61      F(A,B)=SQRT(A*2.)*
        1.E7+0.*B"""


@pytest.mark.parametrize(
    ("relations", "moved"),
    [
        # The area is 8, not 2.
        ("DVPREL1,40,PROD,7,A\n,30,1.", 5e-5),
        ("DVPREL1,40,PROD,7,4\n,30,1.", 5e-5),
        ("DVPREL1,40,PROD,7,A,,,2.\n,30,.25", 1e-4),
        ("DLINK,1,31,1.,2.,30,.5\nDVPREL1,40,PROD,7,A\n,31,1.", 4e-4 / 9.0),
        ("DVMREL1,40,MAT1,3,E\n,30,1.+7", 2e-4 / 8.0),
        ("DVGRID,30,12,,1.,1.", 2e-4),
        (f"DVPREL2,40,PROD,7,A,,,60\n{_ARGUMENTS}", 2e-5),
        (f"DVMREL2,40,MAT1,3,E,,,61\n{_ARGUMENTS}", 2e-4 / 4.0),
    ],
)
def test_design_variables_begin_with_their_values(solve, relations, moved):
    design = f"DESVAR,30,AREA,8.,.1,100.\nDRESP1,50,W,WEIGHT\n{relations}\n"
    case = "ANALYSIS = STATICS\nSPC = 5\nSUBCASE 1\nLOAD = 9\nDESOBJ(MIN) = 50"
    file = solve(200, case, ROD + design)
    assert file["static/1/displacement"][1, 0] == pytest.approx(moved)
    assert any("nothing is optimised" in t for t in file.said) == ("DVG" not in design)


def test_design_values_reach_sections_plies_and_shells(solve):
    """Shapes, plies and thickness by the names of Nastran's guide."""
    bulk = (
        "GRID,1\nGRID,2,,1.\nGRID,3,,1.,1.\nGRID,4,,,1.\nMAT1,3,7.+10,,.3,1000.\n"
        "SPC1,5,123456,1\nFORCE,9,3,,1.,1.\nCQUAD4,1,1,1,2,3,4\nPSHELL,1,3,9.,3\n"
        "CQUAD4,2,2,1,2,3,4\nPCOMP,2\n,3,9.,0.,,3,9.\nCBAR,3,3,1,2,0.,1.,0.\n"
        "PBARL,3,3,,BAR\n,9.,9.\n"
        "DESVAR,30,X,.1\nDVPREL1,1,PSHELL,1,T\n,30,1.\nDVPREL1,2,PCOMP,2,T2\n,30,2.\n"
        "DVPREL1,3,PCOMP,2,T1\n,30,3.\nDVPREL1,4,PBARL,3,DIM1\n,30,4.\n"
        "DVPREL1,5,PBARL,3,DIM2\n,30,5.\n"
    )
    case = "ANALYSIS = STATICS\nSPC = 5\nLOAD = 9"
    file = solve(200, case, bulk)
    assert file["mass/total"][()] == pytest.approx(1000.0 * (0.1 + 0.5 + 0.2))


@pytest.mark.parametrize(
    ("relation", "words"),
    [
        ("DVPREL1,40,PROD,7,Q\n,30,1.", "field Q of PROD is not known"),
        ("DVPREL1,40,PROD,8,A\n,30,1.", "PROD 8 is not in the deck"),
        ("DVPREL1,40,PROD,7,A\n,31,1.", "DESVAR 31 is not defined"),
        ("DVPREL2,40,PROD,7,A,,,60", "DEQATN 60 is not defined"),
        (
            "DVPREL2,40,PROD,7,A,,,60\n,DESVAR,31\nDEQATN,60,F(A)=A",
            "DESVAR 31 is not defined",
        ),
    ],
)
def test_design_relations_that_cannot_be_followed_are_refused(solve, relation, words):
    bulk = f"{ROD}DESVAR,30,AREA,8.\n{relation}\n"
    case = "ANALYSIS = STATICS\nSPC = 5\nLOAD = 9"
    with pytest.raises(fem.InputError, match=words):
        solve(200, case, bulk)
    card = relation.split(",")[0]
    file = solve(200, case, bulk, ignore=[card])
    assert file["static/1/displacement"][1, 0] == pytest.approx(2e-4)


def test_two_elements_on_a_card_are_both_read(solve):
    """Three masses in a row, and two rods: eigenvalues by hand."""
    bulk = (
        "EIGRL,1,,,8\nSPOINT,1,2,3\nCELAS4,1,100.,0,1,2,200.,1,2\n"
        "CELAS3,3,7,2,3,4,7,3,0\nPELAS,7,300.\nCMASS4,11,1.,1,,12,2.,2\n"
        "CMASS3,13,9,3,,14,9,3\nPMASS,9,1.5\n"
        "GRID,11\nGRID,12,,1.\nGRID,13,,2.\nCROD,21,1,11,12,22,1,12,13\n"
        "PROD,1,1,1.\nMAT1,1,1.,,.3,1.\nSPC1,1,123,11\nSPC1,1,23,12,13\n"
    )
    file = solve(103, "METHOD = 1\nSPC = 1", bulk)
    k = np.array([[300.0, -200, 0], [-200, 500, -300], [0, -300, 600]])
    springs = np.linalg.eigvals(k / np.array([[1.0], [2.0], [3.0]]))
    # Lumped: k [2 -1; -1 1], m diag(1, 1/2).
    rods = np.linalg.eigvals(np.array([[2.0, -1.0], [-2.0, 2.0]]))
    hertz = np.sqrt(np.sort(np.concatenate([springs, rods]))) / (2 * np.pi)
    assert file["modes/frequency_hz"][:] == pytest.approx(hertz, rel=1e-9)


def test_motions_without_stiffness_and_mass_are_held_in_modes(solve):
    """A free bar spins about its axis without either; left is the axial mode."""
    bulk = (
        "EIGRL,1,,,8\nMAT1,2,7.+10,,.3,2700.\nPBARL,1,2,,TUBE\n,.2,.18\n"
        "GRID,1\nGRID,2,,2.\nCBAR,1,1,1,2,0.,0.,1.\n"
    )
    file = solve(103, "METHOD = 1", bulk)
    hertz = file["modes/frequency_hz"][:]
    # Two halves of the mass on a spring E A / L: omega² = 4 E / (rho L²).
    axial = np.sqrt(4.0 * 7e10 / 2700.0 / 4.0) / (2.0 * np.pi)
    assert hertz[:5] == pytest.approx(np.zeros(5), abs=1e-9)
    assert hertz[5:] == pytest.approx([axial])


FLOATING = """\
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,2.,0.,0.
CBAR,1,1,1,2,0.,0.,1.
CBAR,2,1,2,3,0.,0.,1.
PBAR,1,1,1.-4,1.-8,1.-8,1.-8
MAT1,1,7.+10,,.3
CONM2,11,1,,2.
CONM2,12,2,,2.
CONM2,13,3,,2.
DAREA,9,3,3,6.
DAREA,9,1,3,6.
TLOAD1,5,9,,,7
RLOAD1,6,9,,,1.
TABLED1,7
,0.,1.,1.,1.,ENDT
TSTEP,2,100,.001
FREQ,3,2.
"""


def test_motions_without_stiffness_and_mass_are_held_in_time_and_frequency(tmp_path):
    """Bars in a row between lumped masses turn freely about their line.

    The center of gravity under 12 N on 6 kg: 2 t^2 / 2 and 2 / -w^2.
    """
    for sol, case in ((109, "TSTEP = 2\nDLOAD = 5"), (108, "FREQ = 3\nDLOAD = 6")):
        path = tmp_path / f"floating{sol}.bdf"
        text = f"SOL {sol}\nCEND\n{case}\nDISP = ALL\nBEGIN BULK\n{FLOATING}ENDDATA\n"
        path.write_text(text)
        said: list[str] = []

        class Said(fem.solution.options.Quiet):
            def say(self, text, said=said):
                said.append(text)

        out = fem.solution.run_deck(
            fem.read_deck(path),
            path.with_suffix(".h5"),
            fem.solution.Options(console=Said()),
        )
        with h5py.File(out) as file:
            kind = "transient" if sol == 109 else "frequency"
            u = file[f"{kind}/1/displacement"][-1]
        if sol == 109:
            assert any("held at grid" in text for text in said)
            # Nastran's scheme: the load at t = 0 counts as a third of a step.
            assert u[:, 2].mean() == pytest.approx(0.01, rel=1e-2)
        else:
            omega = 2.0 * np.pi * 2.0
            assert u[:, 2].mean() == pytest.approx(-2.0 / omega**2, rel=1e-9)
        assert u[:, 3] == pytest.approx(0.0, abs=1e-12)


SPRINGS = """\
GRID,1,,0.,0.,0.,,23456
GRID,2,,1.,0.,0.,,23456
GRID,3,,2.,0.,0.,,23456
CELAS2,1,1.1,1,1,2,1
FORCE,1,3,,7.,1.,0.,0.
FORCE,2,3,,1.7,1.,0.,0.
FORCE,3,3,,0.3,1.,0.,0.
SPC1,5,123456,1
"""


@pytest.mark.parametrize(("stiffness", "said"), [("1.1", False), ("3.+11", True)])
def test_reactions_that_lose_digits_are_said(solve, stiffness, said):
    """A displacement of 16 digits times a stiffness 3e11 times as large as others."""
    case = "SPC = 5\n" + "".join(f"SUBCASE {k}\nLOAD = {k}\n" for k in (1, 2, 3))
    found = solve(101, case, f"{SPRINGS}CELAS2,2,{stiffness},2,1,3,1")
    warned = [text for text in found.said if "loads and reactions balance to" in text]
    assert bool(warned) is said

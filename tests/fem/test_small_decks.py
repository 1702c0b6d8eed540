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

"""The listing like F06 and PUNCH files: what an engineer searches for stands there."""

import re

import numpy as np
import pytest

import fem
from fem.files.export import export
from fem.solution import run_deck

BEAM = """\
GRID,1,,0.,0.,0.
=,*1,=,*.1,==
=9
CBAR,1,1,1,2,0.,1.,0.
=,*1,=,*1,*1,==
=8
PBAR,1,1,.01,2.-6,3.-6,4.-6
,.1,.1,-.1,-.1
MAT1,1,7.+10,,.3,2700.
SPC1,1,123456,1
FORCE,7,11,,-1000.,1.,.5
EIGRL,1,,,12
"""


@pytest.fixture
def write(tmp_path):
    def go(sol, case, **wanted):
        path = tmp_path / "deck.bdf"
        path.write_text(f"SOL {sol}\nCEND\n{case}BEGIN BULK\n{BEAM}ENDDATA\n")
        deck = fem.read_deck(path)
        out = run_deck(deck, tmp_path / "deck.h5")
        files = export(
            out, deck, op2=False, paraview=False, say=lambda text: None, **wanted
        )
        return {file.suffix: file.read_text() for file in files}

    return go


def numbers(text, heading, row):
    """Numbers of the first row of a name after a heading."""
    after = text.split(heading, 1)[1]
    line = next(x for x in after.splitlines() if x.split()[:1] == [row])
    return [float(x) for x in re.findall(r"[-+]?\d\.\d+E[-+]\d+", line)]


def test_a_static_listing_has_resultants_epsilon_extremes_and_tables(write):
    case = "TITLE = T\nSPC = 1\nLOAD = 7\nDISP = ALL\nSPCF = ALL\nFORCE = ALL\n"
    text = write(101, case, f06=True)[".f06"]
    moment = [0.0, 0.0, -500.0]
    assert numbers(text, "OLOAD    RESULTANT", "TOTALS") == pytest.approx(
        [-1000.0, -500.0, 0.0, *moment]
    )
    assert numbers(text, "SPCFORCE    RESULTANT", "TOTALS") == pytest.approx(
        [1000.0, 500.0, 0.0, 0.0, 0.0, 500.0], abs=1e-6
    )
    epsilon, work = re.search(r"EPSILON +(\S+) +EXTERNAL WORK +(\S+)", text).groups()
    assert abs(float(epsilon)) < 1e-9
    tip = 500.0 / (3.0 * 7e10 * 2e-6)
    assert float(work) == pytest.approx(500.0 * tip + 1000.0 * 1000.0 / 7e8, rel=1e-6)
    assert numbers(text, "(MAXMIN)", "MINIMUM")[1] == pytest.approx(-tip, rel=1e-5)
    assert "D I S P L A C E M E N T   V E C T O R" in text
    assert "F O R C E S   I N   B A R   E L E M E N T S" in text
    head = text.split("W E I G H T   G E N E R A T O R")[1]
    assert "2.700000E+01" in head.split("OLOAD")[0]


def test_effective_masses_are_listed_and_add_up(write):
    case = "SPC = 1\nMETHOD = 1\nMEFFMASS(GRID=1,ALL) = YES\n"
    text = write(103, case, f06=True)[".f06"]
    assert "R E A L   E I G E N V A L U E S" in text
    share = numbers(text, "MODAL EFFECTIVE MASS FRACTION", "TOTAL")
    assert share[1] > 0.8
    assert max(share) < 1.0 + 1e-9
    factors = numbers(text, "MODAL PARTICIPATION FACTORS", "1")
    first = numbers(text, "MODAL EFFECTIVE MASS\n", "1")
    # Of mass-normalised modes the effective mass is the square of the factor.
    assert first[1:] == pytest.approx(np.square(factors[1:]), rel=1e-4, abs=1e-9)


def test_load_factors_are_listed(write):
    case = "SPC = 1\nSUBCASE 1\nLOAD = 7\nSUBCASE 2\nMETHOD = 1\n"
    text = write(105, case, f06=True)[".f06"]
    assert "(LOAD FACTORS OF BUCKLING)" in text


def test_requests_with_punch_write_their_results(write):
    case = "TITLE = T\nSPC = 1\nLOAD = 7\nDISP(PUNCH) = ALL\nFORCE = ALL\n"
    text = write(101, case)[".pch"]
    lines = text.splitlines()
    assert {len(line) for line in lines} == {80}
    assert [int(line[72:]) for line in lines] == [*range(1, len(lines) + 1)]
    at = next(k for k, x in enumerate(lines) if x.startswith("        11       G"))
    tip = float(lines[at][36:54])
    assert tip == pytest.approx(-500.0 / (3.0 * 7e10 * 2e-6), rel=1e-6)
    assert lines[at + 1].startswith("-CONT-")
    assert "$ELEMENT FORCES" not in text
    whole = write(101, case, punch=True)[".pch"]
    assert re.search(r"\$ELEMENT TYPE = +34  CBAR", whole)


def test_nothing_is_written_that_nobody_wants(write):
    assert write(101, "SPC = 1\nLOAD = 7\n") == {}

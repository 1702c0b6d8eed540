"""The cases of the verification page that take a second or less meet their targets."""

import pytest

from benchmarks.verification.cases import CASES
from benchmarks.verification.row import Row, convergence, field, figure, listed
from benchmarks.verification.table import page

# Seconds long; `make verify` runs them, and the slow tests.
LONG = {
    *("straight_beam", "rectangular_plates", "plates", "plate_transients"),
    *("quadratic_cantilevers", "thick_plate", "restrained_torsion"),
    "plate_reactions",
    "plates_that_buckle",
    *("curved_roof", "curved_hemisphere", "plates_of_any_thickness"),
    *("shear_forces", "euler_columns", "cook_membrane", "sheet_cantilever"),
}


def check(case, references_folder):
    rows = case.rows(references_folder)
    assert rows, case.name
    misses = [row for row in rows if not row.ok]
    assert not misses, "\n".join(f"{r.case}, {r.quantity}: {r}" for r in misses)


@pytest.mark.parametrize(
    "case",
    [c for c in CASES if c.needs_references],
    ids=lambda c: c.name,
)
def test_figures_of_other_solvers(case, references):
    check(case, references)


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(c, marks=[pytest.mark.slow] * (c.name in LONG), id=c.name)
        for c in CASES
        if not c.needs_references
    ],
)
def test_published_benchmarks(case, tmp_path):
    check(case, tmp_path)


def test_cases_that_need_absent_decks_are_skipped(tmp_path):
    case = next(c for c in CASES if c.needs_references)
    assert case.rows(tmp_path / "nowhere") is None
    text = page([("Group", [], [case.name])])
    assert f"not there: {case.name}" in text


def test_rows_measure_the_largest_difference():
    row = listed("c", "q", [1.0, 2.2, 3.0], [1.0, 2.0, 3.0], "s", target=0.05)
    assert (row.ours, row.theirs) == (2.2, 2.0)
    assert not row.ok
    row = field("c", "q", [[0.0, 4.0], [1.0, 1.0]], [[0.1, 4.0], [1.0, 1.0]], "s")
    assert row.difference == pytest.approx(0.025)
    with pytest.raises(ValueError, match="figures against"):
        field("c", "q", [1.0, 2.0], [1.0], "s")


def test_page_lists_what_is_outside_its_target_first():
    good = figure("good case", "q", 1.0, 1.0, "s")
    bad = figure("bad case", "q", 1.1, 1.0, "s")
    series = convergence("refined", "q", [("2", 1.3), ("4", 1.001)], 1.0, "s")
    assert [r.ok for r in series] == [True, True]
    assert series[0].target is None
    text = page([("Group", [good, bad, *series], [])])
    assert text.index("Outside the target") < text.index("## Group")
    assert text.count("bad case") == 2
    assert "2: +30.00 %, 4: +0.10 %" in text
    assert isinstance(good, Row)

"""A small study on the conceptual aircraft: what it claims, and that it resumes."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from drake_landing.cache import Cache
from drake_landing.case.simulation import Simulation, Transient
from drake_landing.reference.studies import PLANS, Study, run_study
from drake_landing.reference.studies import study as story
from drake_landing.reference.studies.plan import RunName
from drake_landing.results.comparison import COLUMNS

PLAN = replace(
    PLANS["modes"],
    name="small",
    level="con",
    topologies=("2",),
    selections=("count 0", "guyan count 40", "count 40", "relevance 40", "pulses 40"),
    further_bases=("craig-bampton",),
    counts=(20, 40, 120),
    candidates=200.0,
    simulation=Simulation(duration=0.12),
    transient=Transient(step=2.5e-4),
)


QUICK = replace(
    PLAN,
    name="quick",
    selections=("count 0", "count 20"),
    further_bases=(),
    counts=(20,),
    candidates=60.0,
    simulation=Simulation(duration=0.05),
    transient=Transient(step=5e-4),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("study")


@pytest.fixture(scope="module")
def study(folder: Path) -> Study:
    return run_study(PLAN, folder / "out", cache=Cache(folder / "cache"))


@pytest.fixture(scope="module")
def quick(folder: Path) -> Study:
    return run_study(QUICK, folder / "quick", cache=Cache(folder / "cache"))


def vertical(study: Study, selection: str) -> pd.DataFrame:
    table = study.measures
    keep = (table["selection"] == selection) & (table["axis"] == "z")
    return table.loc[keep & table["point"].isin(PLAN.points)]


@pytest.mark.slow
def test_relevant_modes_come_closer_than_the_lowest(study: Study) -> None:
    rigid, reduced, lowest, relevant, combined = (
        vertical(study, s)["rms_error"].max() for s in PLAN.selections
    )
    assert rigid > 0.8
    assert combined < relevant < 0.4 * lowest < lowest < rigid
    assert reduced == pytest.approx(lowest, rel=0.1)  # a beam model loses nothing


def test_budget_adds_up_to_the_difference(quick: Study) -> None:
    for run in quick.runs:
        whole = run.landing.acceleration - run.transient
        np.testing.assert_allclose(
            run.budget.total, whole, atol=1e-9 * np.abs(whole).max()
        )


@pytest.mark.slow
def test_the_difference_is_truncation(study: Study) -> None:
    # Linear modes reproduce the multibody model, and the scheme of the transient.
    table = study.budgets[study.budgets["point"].isin(PLAN.points)]
    assert table["formulation"].max() < 2e-3
    assert table["integration"].max() < 1e-2
    assert table["rest"].max() < 3e-2
    elastic = table[table["modes"] > 0]
    assert (elastic["truncation"] / elastic["total"]).between(0.6, 1.6).all()


@pytest.mark.slow
def test_truncation_was_expected(study: Study) -> None:
    table = study.budgets[study.budgets["point"].isin(PLAN.points)]
    ratio = table["expected"] / table["truncated"]
    # Pulses of 0.6 s tell of 0.12 s.
    assert ratio.between(1.0 / 3.0, 3.0).all()


@pytest.mark.slow
def test_interface_of_the_beam_aircraft_loses_nothing(study: Study) -> None:
    # Its masses sit at the nodes that the reduction keeps.
    table = study.bases[study.bases["point"].isin(PLAN.points)]
    assert set(table["basis"]) == {"full-modes", "guyan", "craig-bampton"}
    every = table[table["set"] == "all"].pivot(
        index="point", columns="basis", values="rms_error"
    )
    for basis in ("guyan", "craig-bampton"):
        np.testing.assert_allclose(every[basis], every["full-modes"], atol=1e-3)
    spectra = study.spectra.set_index(["basis", "below_hz"])
    assert (spectra["same"]["guyan"] == spectra["modes"]["full-modes"]).all()
    budget = study.budgets.set_index("selection")
    assert budget.loc["guyan count 40", "reduction"].max() < 1e-3
    assert (budget.loc["count 40", "reduction"] == 0.0).all()


@pytest.mark.slow
def test_residual_vectors_do_not_cure_accelerations(study: Study) -> None:
    table = study.bases[study.bases["point"].isin(PLAN.points)]
    plain = table[table["set"] == "lowest 40"].set_index(["basis", "point"])
    more = table[table["set"] == "lowest 40, residual vectors"]
    assert more["modes"].min() > 40
    before = plain.loc["full-modes", "rms_error"].max()
    assert more["rms_error"].max() > 0.3 * before


@pytest.mark.slow
def test_foreign_damping_leaves_a_gap_that_modes_do_not_close(study: Study) -> None:
    table = study.gaps[study.gaps["point"].isin(PLAN.points)]
    worst = table.groupby(["practice", "modes"])["rms_error"].max().to_dict()
    right = "as in this study"
    assert worst[right, 120] < 0.4 * worst[right, 20]
    for practice in ("modal damping 1% of critical", "transient at 5 ms"):
        assert worst[practice, 120] > 0.7 * worst[practice, 40]
        assert worst[practice, 120] > 3.0 * worst[right, 120]


def test_files(quick: Study, folder: Path) -> None:
    out = folder / "quick"
    table = pd.read_csv(out / "comparison.csv")
    assert list(table.columns) == COLUMNS
    assert table["run"].nunique() == len(QUICK.selections)
    assert set(pd.read_csv(out / "gears.csv")["gear"]) == {
        *("nose", "main_left", "main_right")
    }
    page = (out / "report.html").read_text(encoding="utf-8")
    assert page.count("<svg") == len(quick.runs) + 2
    assert "<script" not in page
    for name in ("measures", "budget", "convergence", "bases", "spectra", "gaps"):
        assert len(pd.read_csv(out / f"{name}.csv"))
    with np.load(out / "histories.npz") as file:
        assert file["multibody"].shape == file["transient"].shape


@pytest.mark.slow
def test_second_time_computes_nothing(
    quick: Study, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(*_args: object) -> None:
        raise AssertionError("was to come from the cache")

    monkeypatch.setattr("drake_landing.reference.studies.landings._fly", never)
    monkeypatch.setattr("drake_landing.reference.studies.transients._respond", never)
    monkeypatch.setattr("drake_landing.airframe.basis._elastic", never)
    again = run_study(QUICK, folder / "again", cache=Cache(folder / "cache"))
    pd.testing.assert_frame_equal(again.comparison, quick.comparison)


@pytest.mark.slow
def test_an_interrupted_study_keeps_its_landings(
    quick: Study, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_args: object) -> None:
        raise KeyboardInterrupt

    cache = Cache(folder / "other_cache")
    monkeypatch.setattr(story, "respond_all", interrupted)
    plan = replace(QUICK, selections=("count 0",))
    with pytest.raises(KeyboardInterrupt):
        run_study(plan, folder / "broken", cache=cache)
    monkeypatch.undo()
    monkeypatch.setattr(
        "drake_landing.reference.studies.landings._fly",
        lambda _task: pytest.fail("flown twice"),
    )
    resumed = run_study(plan, folder / "broken", cache=cache)
    first = quick.runs[0].landing.acceleration
    np.testing.assert_allclose(
        resumed.runs[0].landing.acceleration, first, atol=1e-9 * np.abs(first).max()
    )


def test_names_of_runs() -> None:
    name = RunName(topology="1", selection="guyan count 73")
    assert str(name) == "topology_1_guyan_count_73"
    assert (name.basis, str(name.parsed)) == ("guyan", "count 73")
    assert name.words == "Guyan, lowest 73 modes"
    name = RunName(topology="2", selection="relevance error <= 2 %")
    assert str(name) == "topology_2_relevance_error_2pc"
    assert RunName(topology="1", selection="count 0").words == "rigid airframe"
    with pytest.raises(ValueError, match="expected"):
        RunName(topology="1", selection="most of them")

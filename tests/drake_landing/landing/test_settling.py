"""Runs end when they have shown their extremes, or say that they may not have."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drake_landing.airframe.body import load_airframe
from drake_landing.landing import run as flight
from drake_landing.landing import settling
from drake_landing.landing.run import build_landing, fly
from drake_landing.landing.settling import LIMIT, Settling, late, swing_of
from drake_landing.process import run
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.results.late_extremes import flagged
from tests.drake_landing.one_aircraft import SI, case_of

TIME = np.linspace(0.0, 2.0, 401)


def swinging(rate: float) -> np.ndarray:
    """(t, 1) a swing of 0.5 s that grows by a rate, 1/s."""
    return (np.exp(rate * TIME) * np.sin(4 * np.pi * TIME))[:, None]


@pytest.mark.parametrize(("rate", "found"), [(-0.5, False), (0.0, False), (0.1, True)])
def test_what_grows_is_late(rate: float, found: bool) -> None:
    assert late(TIME, swinging(rate), 0.5).tolist() == [found]


def test_an_extreme_of_the_lesser_sign_counts_too() -> None:
    values = 3.0 * np.exp(-5.0 * TIME) - 1.0 * (TIME > 1.8)
    assert late(TIME, values[:, None], 0.5).all()


def test_small_histories_do_not_count() -> None:
    both = np.hstack([swinging(-0.5), 0.02 * swinging(0.3)])
    assert not late(TIME, both, 0.5).any()


@given(st.floats(0.01, 1e6), st.booleans())
def test_scale_and_sign_do_not_matter(scale: float, turned: bool) -> None:
    factor = -scale if turned else scale
    for rate in (-0.2, 0.3):
        values = swinging(rate)
        assert (late(TIME, factor * values, 0.5) == late(TIME, values, 0.5)).all()


def test_runs_within_one_swing_are_late_altogether() -> None:
    assert late(TIME, swinging(-1.0), 3.0).all()
    assert swing_of(0.0) == 0.1
    assert swing_of(4.0) == 0.25


def test_tables_flag_extremes_at_the_end() -> None:
    table = pd.DataFrame({"value": [1.0, 2.0], "time_of_min": [0.1, 0.1]})
    table["time_of_max"] = [0.5, 0.95]
    assert flagged(table, 1.0, 0.2)["last_swing"].tolist() == [False, True]
    assert "last_swing" not in flagged(table[["value"]], 1.0, 0.2)


@pytest.mark.slow
def test_a_landing_that_ends_by_itself_has_the_extremes_of_a_longer_one(
    tmp_path: Path,
) -> None:
    case = case_of(tmp_path, SI, ("duration: 0.08", "duration: auto"))
    aircraft = prepare_aircraft(case, tmp_path)
    body = load_airframe(case.airframe, aircraft).body

    def flown(duration: float | str, swing: float = 0.17) -> pd.DataFrame:
        points = aircraft.monitoring
        landing = build_landing(body, aircraft.gears, points, np.eye(3), case.scenario)
        simulation = case.simulation.model_copy(update={"duration": duration})
        history = fly(
            landing,
            case.scenario,
            simulation,
            points,
            np.eye(3),
            settling=Settling(swing=swing),
        )
        return pd.concat(
            [
                *history.attachment.values(),
                *history.monitoring.values(),
                *(t[["stroke"]] for t in history.strut.values()),
            ],
            axis="columns",
        )

    auto = flown("auto")
    assert 0.3 < auto.index[-1] < LIMIT
    longer = flown(auto.index[-1] + 0.6)
    size = np.abs(longer.to_numpy()).max(axis=0)
    missed = size - np.abs(auto.to_numpy()).max(axis=0)
    counts = size > 0.05 * size.max()
    assert (missed[counts] / size[counts]).max() < 0.05


@pytest.mark.usefixtures("blank_curves")
def test_a_run_that_is_too_short_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ended by the limit while loads still grow."""
    for module in (settling, flight, run):
        monkeypatch.setattr(module, "LIMIT", 0.1)
    monkeypatch.setattr(settling, "_LEAST", 0.05)
    monkeypatch.setattr(run, "swing_of", lambda _: 0.02)
    case = case_of(tmp_path, SI, ("duration: 0.08", "duration: auto"))
    result = run.run_case(case, tmp_path / "out")
    assert result.history.time[-1] == pytest.approx(0.1)
    assert {"acceleration", "section load"} <= set(result.late.kind)
    assert (result.late.time > result.loads.time[-1] - result.swing).all()
    table = pd.read_csv(tmp_path / "out" / "gears.csv")
    assert table["last_swing"].any()
    page = (tmp_path / "out" / "report.html").read_text()
    assert "a longer run may find more" in page
    assert "Extremes in the last swing" in page

"""What is known of a landing from its screening and a transient that ends early."""

from pathlib import Path

import h5py
import pandas as pd
import pytest

from drake_landing.campaign.confirm import confirmed_file
from drake_landing.campaign.selection import (
    known_stress,
    last_peak,
    screening_errors,
    to_confirm,
)
from drake_landing.campaign.task import case_file

COMPONENT = ["skin", "skin", "skin", "spar"]


def _landing(folder: Path, number: int, value: list[float], time: list[float]) -> None:
    with h5py.File(case_file(folder, number), "w") as file:
        file["stress/equivalent"], file["stress/time"] = value, time
        file["stress/high"], file["stress/low"] = value, [-v for v in value]


def _transient(folder: Path, number: int, value: list[float], until: float) -> None:
    with h5py.File(confirmed_file(folder, number), "w") as file:
        file.attrs["until"] = until
        file["stress/equivalent"], file["stress/time"] = value, [0.1] * len(value)
        file["stress/high"], file["stress/low"] = value, [-v for v in value]


def test_late_peaks_are_the_screened_ones(tmp_path: Path) -> None:
    _landing(tmp_path, 0, [100.0, 9.0, 50.0, 7.0], [0.1, 0.9, 0.8, 0.2])
    _transient(tmp_path, 0, [101.0, 4.0, 60.0, 7.1], until=0.4)
    known = known_stress(tmp_path, 0)
    # The second peaks after the transient; the third has exceeded that before its end.
    assert known.equivalent.tolist() == [101.0, 9.0, 60.0, 7.1]
    assert known.time.tolist() == [0.1, 0.9, 0.1, 0.1]
    assert known.confirmed.tolist() == [True, False, True, True]
    assert known.high.tolist() == [101.0, 9.0, 60.0, 7.1]
    assert known.low.tolist() == [-101.0, -9.0, -60.0, -7.1]


def test_errors_are_of_what_the_transient_covers(tmp_path: Path) -> None:
    _landing(tmp_path, 0, [102.0, 90.0, 50.0, 7.0], [0.1, 0.9, 0.3, 0.2])
    _transient(tmp_path, 0, [100.0, 4.0, 49.0, 7.0], until=0.4)
    table = screening_errors(tmp_path, [0], COMPONENT, 0.99)
    assert table.worst["skin"] == pytest.approx(0.02)
    assert table.peak["skin"] == pytest.approx(0.02)
    assert table.worst["spar"] == 0.0


def test_transients_end_when_the_elements_that_matter_have_peaked(
    tmp_path: Path,
) -> None:
    _landing(tmp_path, 0, [100.0, 9.0, 50.0, 7.0], [0.1, 0.9, 0.3, 0.2])
    _landing(tmp_path, 1, [80.0, 9.9, 60.0, 6.0], [0.6, 0.7, 0.5, 0.4])
    # The second element never reaches a tenth of the skin's largest.
    assert last_peak(tmp_path, 0, COMPONENT) == 0.3
    wanted = to_confirm(tmp_path, [0, 1], COMPONENT, {"skin": 0.01, "spar": 0.01})
    assert wanted.elements.to_dict() == {0: 2, 1: 1}
    assert wanted.last_peak.to_dict() == {0: 0.2, 1: 0.5}


def test_airframes_without_a_sample_leave_the_errors_of_others(tmp_path: Path) -> None:
    _landing(tmp_path, 0, [100.0, 9.0, 50.0, 7.0], [0.1, 0.1, 0.1, 0.1])
    _transient(tmp_path, 0, [101.0, 9.0, 50.0, 7.0], until=0.4)
    both = [screening_errors(tmp_path, own, COMPONENT, 0.99) for own in ([], [0])]
    assert pd.concat(both).reset_index()["component"].tolist() == ["skin", "spar"]

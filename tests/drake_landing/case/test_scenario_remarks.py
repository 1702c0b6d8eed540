"""Numbers of a scenario that cannot be meant, or mean nothing, are said."""

from pathlib import Path

import pytest

from drake_landing.process.explain import explain
from fem.errors import InputError
from tests.drake_landing.one_aircraft import SI, case_of


def test_a_sink_rate_in_feet_is_noticed(tmp_path: Path) -> None:
    hard, fine = ("sink_rate: 1.5", "sink_rate: 4"), ("step: 5.0e-4", "step: 1.0e-4")
    told = explain(case_of(tmp_path, SI, hard, fine), tmp_path)
    (note,) = (line for line in told.splitlines() if "scenario.sink_rate" in line)
    assert "4 ft/s would be 1.22 m/s" in note
    assert not case_of(tmp_path).scenario.remarks


def test_an_aircraft_that_rolls_has_no_sink_energy(tmp_path: Path) -> None:
    rolling = (
        "scenario: {sink_rate: 1.5, forward_speed: 30, pitch: 1, roll: 1}",
        "scenario: {start: rolling, lift: none, forward_speed: 10}",
    )
    told = explain(case_of(tmp_path, SI, rolling), tmp_path)
    assert "kg in all" in told
    assert "sink energy" not in told


def test_an_unknown_key_that_resembles_nothing_gets_the_known_ones(
    tmp_path: Path,
) -> None:
    with pytest.raises(InputError) as caught:
        case_of(tmp_path, SI, ("select: count 5", "select: count 5\n  mass: 7"))
    assert "basis" in str(caught.value)
    assert "did you mean" not in str(caught.value)
    with pytest.raises(InputError, match="did you mean 'select'"):
        case_of(tmp_path, SI, ("select: count 5", "selct: count 5"))

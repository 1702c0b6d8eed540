"""One aircraft in several units and frames, masses or weights: one landing."""

from pathlib import Path

import numpy as np
import pytest

from drake_landing.airframe.body import load_airframe
from drake_landing.airframe.selection import expected_pulses
from drake_landing.case.axes import rotation_AB
from drake_landing.landing.run import build_landing, fly
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.explain import explain
from drake_landing.transient.response import transient_response
from tests.drake_landing.one_aircraft import (
    MM_T_N,
    SI,
    SLINCHES,
    WEIGHTS,
    Written,
    case_of,
)

WAYS = {
    "mm-t-N": MM_T_N,
    "weights in lb with WTMASS": WEIGHTS,
    "toward +x": Written(forward="x"),
    "toward +y": Written(forward="y"),
}
DURATION = 0.25  # s, past the largest loads


def landing(folder: Path, how: Written) -> dict[str, np.ndarray]:
    """What the models found, in aft, starboard and up."""
    case = case_of(folder, how, ("duration: 0.08", f"duration: {DURATION}"))
    aircraft = prepare_aircraft(case, folder)
    airframe = load_airframe(case.airframe, aircraft)
    R_AB, points = rotation_AB(case.airframe.axes), aircraft.monitoring
    built = build_landing(airframe.body, aircraft.gears, points, R_AB, case.scenario)
    history = fly(built, case.scenario, case.simulation, points, R_AB)
    loads = history.attachment_loads().resampled(5e-4, DURATION)
    response = transient_response(airframe.structure, loads, points)
    vectors = loads.load.reshape(*loads.load.shape[:2], 2, 3)
    return {
        "frequency": airframe.body.frequency,
        "load": vectors @ R_AB.T,
        **{point: table.to_numpy() @ R_AB.T for point, table in response.items()},
    }


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    return landing(tmp_path_factory.mktemp("SI"), SI)


@pytest.mark.parametrize("way", WAYS)
def test_units_frames_and_weights_change_nothing(
    way: str, reference: dict[str, np.ndarray], tmp_path: Path
) -> None:
    found = landing(tmp_path, WAYS[way])
    assert np.abs(reference["load"]).max() > 2e3
    for name, values in reference.items():
        error = np.abs(found[name] - values) / np.abs(values).max()
        # Ten times what one unit in the last place of E does to the same landing.
        assert error.max() < 1e-9, name


def test_check_says_the_same_of_masses_and_weights(tmp_path: Path) -> None:
    """All but what the deck looks like: its units, its times."""
    relevant = ("select: count 5", "select: relevance error <= 10 %")

    def told(how: Written) -> list[str]:
        lines = explain(case_of(tmp_path, how, relevant), tmp_path).splitlines()
        other = ("flies toward", "factorised in", "processor time")
        return [line for line in lines if not any(text in line for text in other)]

    assert told(WEIGHTS) == told(SLINCHES) == told(SI)


def test_expected_pulses_are_the_same_of_masses_and_weights(tmp_path: Path) -> None:
    """They rank the modes: on them rests what relevance chooses."""

    def pulses(how: Written) -> list[np.ndarray]:
        case = case_of(tmp_path, how)
        aircraft = prepare_aircraft(case, tmp_path)
        found = expected_pulses(
            aircraft.structure(), case.airframe, aircraft, case.scenario
        )
        return [pulse.load for pulse in found]

    for one, other in zip(pulses(WEIGHTS), pulses(SI), strict=True):
        assert one == pytest.approx(other, rel=1e-9, abs=1e-6)

"""25.483 over time: the loads of one gear alone on the free airframe."""

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import trapezoid

from drake_landing.airframe.body import load_airframe
from drake_landing.case.axes import rotation_AB
from drake_landing.case.reading import parse_case
from drake_landing.landing.one_gear import airframe_answer, gear_of_side
from drake_landing.landing.run import build_landing, fly
from drake_landing.process.aircraft import prepare_aircraft
from fem.errors import InputError

HERE = Path(__file__).resolve().parents[1]


def flown(scenario: str):
    text = (
        (HERE / "tiny_case.yaml").read_text().replace("duration: 0.4", "duration: 0.2")
    )
    text = text.replace("{sink_rate: 1.2, forward_speed: 40}", scenario)
    case = parse_case(text, folder=HERE)
    aircraft = prepare_aircraft(case, HERE)
    body = load_airframe(case.airframe, aircraft).body
    R_AB = rotation_AB(case.airframe.axes)
    landing = build_landing(
        body, aircraft.gears, aircraft.monitoring, R_AB, aircraft.scenario
    )
    history = fly(landing, case.scenario, case.simulation, aircraft.monitoring, R_AB)
    return landing, history, aircraft


@pytest.fixture(scope="module")
def both():
    return flown("{sink_rate: 1.2, forward_speed: 40, pitch: 2}")


@pytest.fixture(scope="module")
def one():
    return flown("{sink_rate: 1.2, forward_speed: 40, pitch: 2, one_gear: starboard}")


def test_the_gear_has_the_loads_that_it_has_beside_the_other(both, one):
    before, after = both[1].attachment, one[1].attachment
    assert np.array_equal(after["main_right"], before["main_right"])
    assert not after["main_left"].to_numpy().any()
    assert not after["nose"].to_numpy().any()


def test_with_all_loads_the_answer_is_that_of_the_landing(both):
    """The landing itself turns by a degree or two; the answer does not."""
    landing, history, aircraft = both
    found, amplitudes = airframe_answer(
        history, landing.body, list(history.attachment), aircraft.monitoring, np.eye(3)
    )
    for point in ("centre", "right_tip", "nose"):
        vertical = history.monitoring[point].z.to_numpy()
        error = np.abs(found[point].z.to_numpy() - vertical).max()
        assert error < 0.03 * np.abs(vertical).max()
    change = history.amplitudes - history.amplitudes[0]
    assert amplitudes == pytest.approx(change, abs=0.03 * np.abs(change).max())


def test_what_is_unbalanced_is_reacted_by_inertia(one):
    """The first mode less, the airframe is rigid: m a = F, J α = r x F."""
    landing, history, _ = one
    body = landing.body
    table = history.attachment["main_right"]
    row = int(body.rows([52])[0])
    force = table[["fx", "fy", "fz"]].to_numpy()
    moment = table[["mx", "my", "mz"]].to_numpy()
    about = moment + np.cross(body.p_BN[row] - body.p_BG, force)
    turning = np.linalg.solve(body.inertia_G, about.T).T
    # The wing on the side of the load goes up faster than that on the other.
    tips = {side: history.monitoring[f"{side}_tip"].z for side in ("right", "left")}
    rolling = (tips["right"] - tips["left"]).to_numpy() / 16.0
    late = history.time > 0.02
    mean = float(trapezoid(turning[late, 0], history.time[late]))
    assert float(trapezoid(rolling[late], history.time[late])) == pytest.approx(
        mean, rel=0.25
    )
    assert mean > 0.0


def test_a_side_without_gears_is_refused(both):
    nose = [gear for gear in both[0].gears if gear.name == "nose"]
    with pytest.raises(InputError, match="no gear stands on that side"):
        gear_of_side(nose, "port")
    with pytest.raises(InputError, match="expected a touchdown with lift: weight"):
        flown("{sink_rate: 1.2, one_gear: port, lift: none}")

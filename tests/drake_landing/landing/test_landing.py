"""The landing run on a hand-made modal body: momentum, energy, axes, messages."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator

from drake_landing.case.axes import gear_in_A, rotation_AB
from drake_landing.case.deck_frame import Axes
from drake_landing.case.reading import load_case
from drake_landing.case.scenario import Scenario
from drake_landing.case.schema import Case
from drake_landing.case.simulation import Simulation
from drake_landing.landing.history import LandingHistory, gear_peaks
from drake_landing.landing.run import (
    LandingError,
    build_landing,
    fast_mode_notices,
    fly,
)
from systems.airframe.modal_body import ModalBody

POINTS = {"nose": 1, "tail": 9}


@pytest.fixture(scope="module")
def case() -> Case:
    return load_case(Path(__file__).parents[1] / "tiny_case.yaml")


@pytest.fixture(scope="module")
def body() -> ModalBody:
    """Mass properties of the tiny aircraft, one bending mode made up by hand."""
    position = [[0, 0, 0], [16, 0, 0], [2, 0, -0.5], [8.6, 2, -0.3], [8.6, -2, -0.3]]
    translation = np.zeros((5, 3, 1))
    translation[:, 2, 0] = [0.8, 1.0, 0.4, -0.2, -0.2]
    return ModalBody(
        mass=5430.0,
        p_BG=np.array([7.326, 0, 0.022]),
        inertia_G=np.diag([34042.0, 78015.0, 110658.0]),
        frequency=np.array([7.0]),
        modal_mass=np.array([900.0]),
        modal_damping=np.array([[1000.0]]),
        node_id=np.array([1, 9, 51, 52, 53]),
        p_BN=np.array(position, dtype=float),
        translation=translation,
        rotation=np.zeros((5, 3, 1)),
    )


@pytest.fixture(scope="module")
def history(case: Case, body: ModalBody) -> LandingHistory:
    landing = build_landing(body, case.gears, POINTS, np.eye(3), case.scenario)
    return fly(landing, case.scenario, Simulation(duration=0.15), POINTS, np.eye(3))


def test_impulse_of_the_attachment_loads_is_the_momentum_of_the_airframe(
    history: LandingHistory, body: ModalBody
) -> None:
    loads = history.attachment_loads().resampled(5e-4, 0.15)
    impulse = 5e-4 * loads.load[:, :, 2].sum()
    # The held end counts half a step beyond the end.
    impulse -= 2.5e-4 * loads.load[-1, :, 2].sum()
    height = history.motion["pz"].to_numpy()
    gain = np.gradient(height, history.time, edge_order=2)[-1] + 1.2
    assert impulse == pytest.approx(body.mass * gain, rel=2e-4)


def test_energy_balance_closes(history: LandingHistory) -> None:
    balance = history.energy["balance"].abs().max()
    assert balance < 1e-4 * history.figures["sink_energy"]


def test_touchdown_is_silent_and_symmetric(history: LandingHistory) -> None:
    loads = history.attachment_loads()
    assert np.abs(loads.load[loads.time < 3e-3]).max() < 1e-6
    right, left = history.attachment["main_right"], history.attachment["main_left"]
    assert right["fz"].to_numpy() == pytest.approx(left["fz"].to_numpy(), rel=1e-8)
    peaks = gear_peaks("r", history).set_index(["gear", "quantity"])["peak"]
    assert peaks["main_left", "tyre_vertical"] > 5e3
    assert peaks["main_left", "tyre_drag"] > 0
    assert peaks["main_left", "attachment_fx"] > 0  # drag points aft
    assert history.tire["nose"]["spin"].max() > 10  # rolling is positive
    assert np.all(np.diff(history.time) > 1e-9)


def test_results_do_not_depend_on_the_axes_of_the_deck(
    case: Case, body: ModalBody, history: LandingHistory
) -> None:
    axes = Axes(forward="y", up="-x")
    R_AB = rotation_AB(axes)
    assert np.linalg.det(R_AB) == pytest.approx(1)
    gears = [gear_in_A(gear, R_AB.T) for gear in case.gears]  # as the deck's user has
    landing = build_landing(body, gears, POINTS, R_AB, case.scenario)
    found = fly(landing, case.scenario, Simulation(duration=0.05), POINTS, R_AB)
    count = len(found.time) - 1  # the last step ends at the duration
    in_A = found.attachment_loads().load.reshape(-1, 3, 2, 3) @ R_AB.T
    expected = history.attachment_loads().load.reshape(-1, 3, 2, 3)
    assert in_A[:count] == pytest.approx(expected[:count], rel=1e-6, abs=1e-3)
    tail = found.monitoring["tail"].to_numpy()[:count] @ R_AB.T
    assert tail == pytest.approx(
        history.monitoring["tail"].to_numpy()[:count], rel=1e-6, abs=1e-6
    )


@pytest.mark.parametrize(("angles", "sign"), [({"roll": 2.0}, 1), ({"roll": -2.0}, -1)])
def test_a_low_wing_touches_first(
    case: Case, body: ModalBody, angles: dict[str, float], sign: int
) -> None:
    landing = build_landing(body, case.gears, POINTS, np.eye(3), case.scenario)
    scenario = Scenario(sink_rate=1.2, forward_speed=40, **angles)
    found = fly(landing, scenario, Simulation(duration=0.04), POINTS, np.eye(3))
    difference = found.leg("main_right", "vertical") - found.leg(
        "main_left", "vertical"
    )
    assert sign * difference.iloc[-1] > 1e3


def test_a_nose_up_attitude_lifts_the_nose_gear(case: Case, body: ModalBody) -> None:
    landing = build_landing(body, case.gears, POINTS, np.eye(3), case.scenario)
    scenario = Scenario(sink_rate=1.2, forward_speed=40, pitch=3)
    found = fly(landing, scenario, Simulation(duration=0.04), POINTS, np.eye(3))
    assert found.leg("nose", "vertical").max() == 0
    assert found.leg("main_left", "vertical").max() > 1e3


@pytest.mark.parametrize("failure", [RuntimeError("step too small"), SystemExit("nan")])
def test_a_simulation_that_breaks_down_says_when(
    case: Case, body: ModalBody, monkeypatch: pytest.MonkeyPatch, failure: BaseException
) -> None:
    """Drake raises SystemExit where a state is no longer finite."""

    def give_up(*_: object) -> None:
        raise failure

    monkeypatch.setattr(Simulator, "AdvanceTo", give_up)
    landing = build_landing(body, case.gears, POINTS, np.eye(3), case.scenario)
    with pytest.raises(LandingError, match=r"stopped at 0\.0000 s of 0\.4 s"):
        fly(landing, case.scenario, case.simulation, POINTS, np.eye(3))


def test_fast_modes_are_told_and_can_be_slowed(case: Case, body: ModalBody) -> None:
    fast = replace(
        body, frequency=np.array([700.0]), modal_damping=body.modal_damping * 1e5
    )
    assert fast_mode_notices(body, Simulation()) == ()
    assert "slow_modes_above" in fast_mode_notices(fast, Simulation())[0]
    simulation = Simulation(duration=0.02, slow_modes_above=100.0)
    assert "1 of 1 modes lie above 100 Hz" in fast_mode_notices(fast, simulation)[0]
    steps = []
    for bound in (None, 100.0):
        landing = build_landing(
            fast, case.gears, POINTS, np.eye(3), case.scenario, bound
        )
        history = fly(landing, case.scenario, simulation, POINTS, np.eye(3))
        steps.append(history.figures["steps"])
    assert steps[1] < 0.5 * steps[0]

"""A landing whose steps collapse ends after a stated number, with its cause."""

import numpy as np
import pytest

from drake_landing.case.scenario import Scenario
from drake_landing.case.simulation import Simulation
from drake_landing.landing import stall
from drake_landing.landing.lifetime import used_once
from drake_landing.landing.run import LandingError, build_landing, fly
from tests.drake_landing.landing_gears import aircraft_gears, changed
from tests.systems.synthetic_body import aircraft_body

FEW = 60  # steps: enough for these, the limit itself takes half a minute


def stopped(gears, monkeypatch, **simulation) -> str:
    """What is said of a landing that stops."""
    monkeypatch.setattr(stall, "STEPS", FEW)
    scenario = Scenario(sink_rate=1.0, forward_speed=0.0)
    landing = build_landing(aircraft_body(2), gears, {}, np.eye(3), scenario)
    with used_once(landing), pytest.raises(LandingError) as caught:
        fly(landing, scenario, Simulation(**simulation), {}, np.eye(3))
    return str(caught.value)


def test_a_damper_that_holds_like_a_rock_is_named(monkeypatch):
    nose, left, right = aircraft_gears()
    absorber = right.shock_absorber.model_dump() | {"compression_damping": 1e15}
    hard = changed(right, shock_absorber=absorber)
    told = stopped((nose, left, hard), monkeypatch, duration=0.2)
    assert f"{FEW} steps took it" in told
    assert "gear main_right: stroke" in told
    assert "fastest is plant" in told
    assert "of 0.2 s" in told


@pytest.mark.parametrize("simulation", [{"accuracy": 1e-300}, {"max_step": 1e-9}])
def test_a_step_that_nothing_can_take_ends(simulation, monkeypatch):
    told = stopped(aircraft_gears(), monkeypatch, duration=0.1, **simulation)
    assert "the landing simulation stopped at" in told


def test_an_ordinary_landing_is_not_stopped(monkeypatch):
    monkeypatch.setattr(stall, "STEPS", 20)
    scenario = Scenario(sink_rate=1.0, forward_speed=0.0)
    landing = build_landing(aircraft_body(2), aircraft_gears(), {}, np.eye(3), scenario)
    with used_once(landing):
        found = fly(landing, scenario, Simulation(duration=0.05), {}, np.eye(3))
    assert found.time[-1] == pytest.approx(0.05)

"""BLAS has one thread in a simulation, and its own number before and after."""

import numpy as np
import pytest
import scipy.sparse as sp
from threadpoolctl import threadpool_info, threadpool_limits

from drake_landing.case.reading import parse_case
from drake_landing.case.scenario import Scenario
from drake_landing.case.simulation import Simulation
from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.run import fly
from drake_landing.landing.threads import single_threaded_blas
from drake_landing.process import aircraft
from drake_landing.progress import Silent
from drake_landing.reference.d150 import generator
from fem.algebra.linear_solver import factorize
from tests.drake_landing.landing_gears import aircraft_gears
from tests.systems.synthetic_body import aircraft_body


def _threads() -> set[int]:
    return {i["num_threads"] for i in threadpool_info() if i["user_api"] == "blas"}


@pytest.fixture(autouse=True)
def two_threads():
    """Of every BLAS, PARDISO's among them."""
    factorize(sp.eye_array(3, format="csr"))
    with threadpool_limits(limits=2, user_api="blas"):
        assert _threads() == {2}
        yield
        assert _threads() == {2}


def _fail():
    assert _threads() == {1}
    raise ValueError("stop")


def test_threads_come_back_after_a_failure():
    with pytest.raises(ValueError, match="stop"), single_threaded_blas():
        _fail()


def test_decks_are_written_with_one_thread(monkeypatch, tmp_path):
    """The last digits of the sums in them would depend on the number of threads."""

    class Model:
        def write(self, path, topology):
            _fail()

    monkeypatch.setattr(aircraft, "parametric_aircraft", lambda name: Model())
    case = parse_case("name: one\nairframe: {model: con}\nscenario: {sink_rate: 1}\n")
    with pytest.raises(ValueError, match="stop"):
        aircraft.prepare_aircraft(case, tmp_path)
    monkeypatch.setattr(generator, "add_materials", lambda bench: _fail())
    with pytest.raises(ValueError, match="stop"):
        generator.write_model("full", tmp_path / "full.bdf")


def test_landing_runs_with_one_thread():
    landing = MakeLandingDiagram(aircraft_body(0), aircraft_gears())
    seen = set()

    class Watch(Silent):
        def share(self, done: float, text: str = "") -> None:
            seen.update(_threads())

    simulation = Simulation(duration=0.002, clearance=0.1)
    fly(landing, Scenario(sink_rate=1.0), simulation, {}, np.eye(3), Watch())
    assert seen == {1}

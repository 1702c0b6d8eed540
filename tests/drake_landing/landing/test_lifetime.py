"""One diagram for many landings: memory stays where it is."""

import gc
import weakref

import numpy as np
import psutil
import pytest

from drake_landing.landing.diagram import LandingDiagram, MakeLandingDiagram
from drake_landing.landing.initial_state import attitude
from drake_landing.landing.lifetime import used_once
from tests.drake_landing.landing_gears import aircraft_gears
from tests.drake_landing.landing_run import land
from tests.systems.synthetic_body import NOSE_TIP, aircraft_body

ALLOWED = 20e6  # bytes


def _resident() -> int:
    gc.collect()
    return psutil.Process().memory_info().rss


def _vary(landing: LandingDiagram, case: int):
    """Sets parameters of a case in a context, after its initial state."""

    def set_parameters(context) -> None:
        for absorber in landing.shock_absorbers.values():
            precharge = absorber.parameters.gas.precharge
            absorber.set_tunables(
                context, precharge=precharge * (1.0 + 0.001 * (case % 7))
            )

    return set_parameters


def _growth(landing: LandingDiagram, count: int, duration: float, accuracy: float):
    """Peak growth (bytes) after the tenth run, and the largest load of each run."""
    peaks, after_ten, growth = [], 0, 0
    for case in range(count):
        run = land(
            landing,
            duration=duration,
            accuracy=accuracy,
            sink_rate=1.0 + 2.0 * case / count,
            R_WB=attitude(0.0, 0.01 * (case % 5), 0.0),
            prepare=_vary(landing, case),
        )
        peaks.append(np.abs(run["attachment.load_in_airframe_axes"]).max())
        if case == 10:
            after_ten = _resident()
        elif case > 10:
            growth = max(growth, _resident() - after_ten)
    return growth, peaks


def test_short_landings_do_not_grow_memory():
    landing = MakeLandingDiagram(aircraft_body(10), aircraft_gears())
    growth, peaks = _growth(landing, 25, 0.02, 1e-2)
    assert len({round(peak) for peak in peaks}) == 25
    assert growth < ALLOWED


@pytest.mark.slow
@pytest.mark.timeout(1200)
def test_two_hundred_landings_do_not_grow_memory():
    landing = MakeLandingDiagram(
        aircraft_body(73), aircraft_gears(), monitor_nodes=[NOSE_TIP]
    )
    growth, peaks = _growth(landing, 200, 0.5, 1e-3)
    assert len({round(peak) for peak in peaks}) > 150
    print(f"200 landings: {growth / 1e6:.1f} MB after the tenth")
    assert growth < ALLOWED


def test_a_context_does_not_remember_the_run_before():
    """Same case, same result to the last bit, whatever was run in between."""
    landing = MakeLandingDiagram(aircraft_body(5), aircraft_gears())
    name = "attachment.load_in_airframe_axes"
    first = land(landing, duration=0.05, accuracy=1e-3)[name]
    land(landing, duration=0.05, accuracy=1e-3, prepare=_vary(landing, 3))
    again = land(landing, duration=0.05, accuracy=1e-3)[name]
    assert np.array_equal(first, again)


def test_a_diagram_that_is_used_once_goes():
    """Diagram, plant and every system, those in Python too: nothing is left behind."""
    landing = MakeLandingDiagram(aircraft_body(5), aircraft_gears())
    with used_once(landing):
        land(landing, duration=0.01, accuracy=1e-2)
        parts = {s.get_name(): s for s in landing.diagram.GetSystems()}
        parts["diagram"] = landing.diagram
        alive = {name: weakref.ref(system) for name, system in parts.items()}
        del parts
    del landing
    gc.collect()
    assert [name for name, system in alive.items() if system() is not None] == []

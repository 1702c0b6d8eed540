"""Microseconds per derivative evaluation of a landing, by system.

    OPENBLAS_NUM_THREADS=1 python -m benchmarks.derivatives [d150] [--callbacks]

Three gears with six wheels on an airframe with 73 modes, in the middle of a landing;
the paper's gears, or those of `d150`.
The total is timed without instruments. The shares are those of the Python callbacks,
each less the callbacks that it triggers upstream; the rest is Drake itself, the plant's
forward dynamics and the framework, and the instruments. Processor time; the totals are
the best of several rounds.
"""

import functools
import os
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import time
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from benchmarks.conceptual_landing import make_landing, modal_body
from drake_landing.landing.diagram import LandingDiagram
from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.attachment.attachment import Attachment, RigidAttachment
from systems.gear.elastic_legs import ElasticLegs
from systems.gear.energy_budget import EnergyBudget
from systems.gear.gear_forces import GearForces
from systems.gear.wheel_kinematics import WheelKinematics
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.side_load import SideLoad
from systems.tire.tire import Tire
from tests.drake_landing.landing_run import land

SYSTEMS: dict[str, tuple[Any, ...]] = {
    "airframe": (FlexibleAirframe,),
    "attachment": (RigidAttachment, Attachment),
    "tires": (Tire,),
    "shock absorbers": (ShockAbsorber,),
    "wheel kinematics": (WheelKinematics,),
    "side loads": (SideLoad,),
    "elastic legs": (ElasticLegs,),
    "gear forces": (GearForces,),
    "energy budget": (EnergyBudget,),
}


class ExclusiveTimer:
    """Seconds per name, less those of the timed calls inside."""

    def __init__(self, by_callback: bool = False) -> None:
        self._by_callback = by_callback
        self.seconds: dict[str, float] = defaultdict(float)
        self.calls: dict[str, int] = defaultdict(int)
        self._inner = [0.0]

    def wrap(self, name: str, function):
        if self._by_callback:
            name += " " + function.__qualname__.split(".")[-1]

        @functools.wraps(function)
        def timed(*args):
            self._inner.append(0.0)
            start = time.process_time()
            result = function(*args)
            elapsed = time.process_time() - start
            self.seconds[name] += elapsed - self._inner.pop()
            self.calls[name] += 1
            self._inner[-1] += elapsed
            return result

        return timed


@contextmanager
def instrumented(timer: ExclusiveTimer) -> Iterator[None]:
    """Callbacks of systems that are built inside are timed."""
    originals = []
    for name, classes in SYSTEMS.items():
        for cls in classes:
            for attribute, value in list(vars(cls).items()):
                if (
                    attribute.startswith("_calc")
                    or attribute == "DoCalcTimeDerivatives"
                ):
                    new = timer.wrap(name, value)
                elif attribute.endswith("_port"):
                    new = _timed_factory(timer, name, value)
                else:
                    continue
                originals.append((cls, attribute, value))
                setattr(cls, attribute, new)
    try:
        yield
    finally:
        for cls, attribute, value in originals:
            setattr(cls, attribute, value)


def _timed_factory(timer: ExclusiveTimer, name: str, factory):
    return lambda *args: timer.wrap(name, factory(*args))


def derivative_seconds(
    landing: LandingDiagram, context: Any, count: int, rounds: int
) -> float:
    """Best of several rounds of processor time per derivative evaluation."""
    state = context.get_continuous_state_vector().CopyToVector()
    states = [state, state + 1e-9]
    best = np.inf
    for _ in range(rounds):
        start = time.process_time()
        for i in range(count):
            context.SetContinuousState(states[i % 2])
            landing.diagram.EvalTimeDerivatives(context)
        best = min(best, (time.process_time() - start) / count)
    return float(best)


def build(energy_budget: bool = True) -> tuple[LandingDiagram, Any]:
    """The diagram, and its context 50 ms into a landing."""
    gears = "d150" if "d150" in sys.argv else "paper"
    landing = make_landing(modal_body(73), 73, energy_budget, gears)
    return landing, land(landing, duration=0.05, accuracy=1e-3).context


def main(count: int = 300, rounds: int = 5, by_callback: bool = False) -> None:
    """Prints the table; with `by_callback` one row per callback."""
    total = derivative_seconds(*build(), count, rounds)
    plain = derivative_seconds(*build(energy_budget=False), count, rounds)
    timer = ExclusiveTimer(by_callback)
    evaluations = count * rounds
    with instrumented(timer):
        landing, context = build()
        timer.seconds.clear()
        timer.calls.clear()
        start = time.process_time()
        derivative_seconds(landing, context, count, rounds)
        instrumented_total = (time.process_time() - start) / evaluations * 1e6
    print(f"{'system':40s}{'µs':>8s}{'calls':>8s}   per derivative")
    for name in sorted(timer.seconds, key=lambda n: -timer.seconds[n]):
        share = timer.seconds[name] / evaluations * 1e6
        print(f"{name:40s}{share:8.1f}{timer.calls[name] / evaluations:8.1f}")
    python = sum(timer.seconds.values()) / evaluations * 1e6
    print(f"{'rest (Drake, timers)':40s}{instrumented_total - python:8.1f}")
    print(f"{'total':40s}{total * 1e6:8.1f}")
    print(f"{'without budget':40s}{plain * 1e6:8.1f}")


if __name__ == "__main__":
    main(by_callback="--callbacks" in sys.argv)

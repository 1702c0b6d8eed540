"""Runs a landing of the synthetic aircraft and returns what was logged."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import Context

from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.equilibrium import (
    set_flight_equilibrium,
    set_static_equilibrium,
)
from drake_landing.landing.initial_state import set_initial_state


@dataclass(frozen=True)
class Run:
    """Logged signals by "<system>.<port>", (size, times), and the last context."""

    time: np.ndarray
    signals: dict[str, np.ndarray]
    context: Context
    evaluations: int

    def __getitem__(self, name: str) -> np.ndarray:
        return self.signals[name]


def land(
    landing: LandingDiagram,
    *,
    duration: float,
    sink_rate: float = 1.83,
    speed: float = 67.0,
    step: float | None = None,
    accuracy: float = 1e-5,
    scheme: str = "runge_kutta3",
    rolling: float | None = None,
    flying: bool = False,
    prepare: Callable[[Context], None] | None = None,
    **state,
) -> Run:
    """With error control at `accuracy`, or with a fixed `step`, s.

    Just above the runway, undeformed or `flying` as gravity and lift want it, or
    `rolling` at that speed in static equilibrium. `prepare` may set parameters in the
    context, after the initial state.
    """
    simulator = Simulator(landing.diagram)
    config = SimulatorConfig(
        integration_scheme=scheme,
        accuracy=accuracy,
        max_step_size=step or 5e-3,
        use_error_control=step is None,
    )
    ApplySimulatorConfig(config, simulator)
    context = simulator.get_mutable_context()
    state.setdefault("v_WG", [-speed, 0.0, -sink_rate])
    if rolling is None:
        set_initial_state(landing, context, **state)
        if flying:
            set_flight_equilibrium(landing, context)
    else:
        set_static_equilibrium(landing, context, speed=rolling)
    if prepare is not None:
        prepare(context)
    simulator.Initialize()
    simulator.AdvanceTo(duration)
    logs = {name: log.FindLog(context) for name, log in landing.loggers.items()}
    time = next(iter(logs.values())).sample_times()
    return Run(
        time.copy(),
        {name: log.data().copy() for name, log in logs.items()},
        context,
        simulator.get_integrator().get_num_derivative_evaluations(),
    )

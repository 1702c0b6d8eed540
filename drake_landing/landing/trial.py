"""One run of a scenario, and what its gears saw: for notebooks, tests and tables.

`landing.run` does the same for a case, and writes everything down; here is the short
way from a body, gears and a scenario to figures.
"""

import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import pandas as pd
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import Context

from drake_landing.case.scenario import Scenario
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.audit import Audit, Signals, audit, gear_loads
from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.start import make_scenario_diagram, set_scenario_state
from drake_landing.landing_integrators import DEFAULT
from systems.airframe.modal_body import ModalBody


@dataclass(frozen=True, kw_only=True)
class Trial:
    """A run.

    Attributes:
        landing: the diagram.
        scenario: that was run.
        simulator: holds the context, which holds the logs.
        seconds: processor time of the simulation.
    """

    landing: LandingDiagram = field(repr=False)
    scenario: Scenario
    simulator: Simulator = field(repr=False)
    seconds: float

    @property
    def context(self) -> Context:
        """Context of the diagram at the end of the run."""
        return self.simulator.get_context()

    @property
    def audit(self) -> Audit:
        """Errors of energy, momentum and symmetry."""
        return audit(self.landing, self.context, self.scenario)

    @property
    def peaks(self) -> pd.DataFrame:
        """Peaks of each gear, see `audit.gear_loads`."""
        return gear_loads(self.landing, self.context)

    def history(self, gear: str) -> pd.DataFrame:
        """A gear over time (s): sums over its wheels, and its strut.

        Columns: vertical, drag, side (N, of the runway on the tires; drag aft, side to
        starboard), stroke (m), rate (m/s), force (N, of the shock absorber), fx to mz
        (N and N m, on the airframe at the gear's first attachment, B).

        Raises:
            ValueError: there is no such gear.
        """
        gears = {g.name: g for g in self.landing.gears}
        if gear not in gears:
            raise ValueError(f"no gear {gear!r}, expected one of {', '.join(gears)}")
        signals = Signals(self.landing, self.context)
        wheels = gears[gear].wheel_names
        contact = np.sum([signals[f"tire_{w}.contact"][1:4] for w in wheels], axis=0)
        names = [name for g in self.landing.gears for name in g.attachments]
        loads = signals["attachment.load_in_airframe_axes"]
        load = loads.reshape(len(names), 6, -1)[names.index(gear)]
        strut = signals[f"strut_{gear}.strut"]
        force = signals[f"shock_absorber_{gear}.force"]
        return pd.DataFrame(
            np.vstack([contact, strut, force, load]).T,
            index=pd.Index(signals.time, name="time"),
            columns=[
                *("vertical", "drag", "side", "stroke", "rate", "force"),
                *("fx", "fy", "fz", "mx", "my", "mz"),
            ],
        )


def try_scenario(
    body: ModalBody,
    gears: Sequence[LandingGear],
    scenario: Scenario,
    *,
    duration: float,
    accuracy: float = 1e-4,
    max_step: float = 5e-3,
) -> Trial:
    """Runs a scenario.

    Args:
        body: of the airframe, x aft, y to starboard, z up.
        gears: in the same axes.
        scenario: a condition of CS-25 by its name, or anything else.
        duration: s.
        accuracy: of the integrator, see Simulation.
        max_step: s.

    Raises:
        ValueError: gears, airframe and scenario do not fit.
    """
    landing = make_scenario_diagram(body, gears, scenario)
    simulator = Simulator(landing.diagram)
    config = SimulatorConfig(
        integration_scheme=DEFAULT, accuracy=accuracy, max_step_size=max_step
    )
    ApplySimulatorConfig(config, simulator)
    context = simulator.get_mutable_context()
    set_scenario_state(landing, context, scenario)
    start = clock.process_time()
    simulator.Initialize()
    simulator.AdvanceTo(duration)
    return Trial(
        landing=landing,
        scenario=scenario,
        simulator=simulator,
        seconds=clock.process_time() - start,
    )

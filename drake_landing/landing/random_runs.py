"""Random landings of one diagram, for Drake's MonteCarloSimulation.

Drake draws random contexts by its systems' SetRandomState, which systems written in
Python cannot have, and which would not know how fittings and airframe belong together.
Here the factory draws scenario and parameters from the generator that it is given, and
the context is set as the simulation starts: the same draw for the same state of the
generator, as RandomSimulation promises.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from pydrake.common import RandomGenerator
from pydrake.common.schema import Distribution
from pydrake.systems.analysis import ApplySimulatorConfig, Simulator, SimulatorConfig
from pydrake.systems.framework import Context, EventStatus

from drake_landing.case.scenario import Scenario
from drake_landing.landing.diagram import LandingDiagram
from drake_landing.landing.start import set_scenario_state
from drake_landing.landing_integrators import DEFAULT
from systems.shock_absorber.strut_parameters import ShockAbsorberTunables
from systems.tire.tire import TireTunables


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """Random quantities of a landing, by Drake's distributions.

    Distributions are those of `pydrake.common.schema`: Gaussian(mean, stddev),
    Uniform(min, max), UniformDiscrete(values), of one number each. Draws are
    independent of each other.

    Attributes:
        scenario: field of the scenario -> its distribution, e.g. sink_rate, roll.
        struts: (gear, tunable of the shock absorber) -> of a factor on its value.
        tires: (wheel, "stiffness", "damping" or "friction") -> of the factor on the
            law.
    """

    scenario: Mapping[str, Distribution] = field(default_factory=dict)
    struts: Mapping[tuple[str, str], Distribution] = field(default_factory=dict)
    tires: Mapping[tuple[str, str], Distribution] = field(default_factory=dict)

    def require_fits(self, landing: LandingDiagram) -> None:
        """Raises ValueError where it names what the landing does not have."""
        unknown = [f"scenario.{name}" for name in self.scenario if name not in _FIELDS]
        for kind, given, systems, names in (
            ("struts", self.struts, landing.shock_absorbers, _TUNABLES),
            ("tires", self.tires, landing.tires, TireTunables.get_fields()),
        ):
            unknown += [
                f"{kind}.{owner}.{name}"
                for owner, name in given
                if owner not in systems or name not in names
            ]
        if unknown:
            raise ValueError(
                f"scatter: no {', '.join(unknown)}; scenario has {', '.join(_FIELDS)}; "
                f"struts {', '.join(landing.shock_absorbers)} have "
                f"{', '.join(_TUNABLES)}; tires {', '.join(landing.tires)} have "
                f"{', '.join(TireTunables.get_fields())}"
            )


_FIELDS = tuple(
    name for name, info in Scenario.model_fields.items() if info.annotation is float
)
_TUNABLES = tuple(ShockAbsorberTunables.get_fields())


def simulator_factory(
    landing: LandingDiagram,
    scenario: Scenario,
    scatter: Scatter,
    *,
    accuracy: float = 1e-3,
    max_step: float = 5e-3,
) -> Callable[[RandomGenerator], Simulator]:
    """The first argument of pydrake's RandomSimulation and MonteCarloSimulation.

        results = MonteCarloSimulation(
            make_simulator=simulator_factory(landing, scenario, scatter),
            output=lambda system, context: ...,
            final_time=0.4,
            num_samples=100,
            generator=RandomGenerator(1),
        )

    All simulators share the diagram, each has a context of its own. What was drawn is
    in the context: the state at the start, and the numeric parameters.

    Args:
        landing: of `make_scenario_diagram` for this scenario.
        scenario: what is not random.
        scatter: what is.
        accuracy, max_step: of the integrator, see `Simulation`.

    Raises:
        ValueError: scatter names what is not there; when called, a draw is out of the
            range of its field.
    """
    scatter.require_fits(landing)

    def make_simulator(generator: RandomGenerator) -> Simulator:
        draw = _drawn(scatter, generator)
        given = scenario.model_dump(exclude={"preset"}) | draw["scenario"]
        drawn = type(scenario).model_validate(given)
        simulator = Simulator(landing.diagram)
        config = SimulatorConfig(
            integration_scheme=DEFAULT,
            accuracy=accuracy,
            max_step_size=max_step,
            use_error_control=True,
        )
        ApplySimulatorConfig(config, simulator)
        simulator.get_mutable_context().SetAccuracy(accuracy)

        started = []

        def start(context: Context) -> EventStatus:
            # First called as the simulation is initialised: what Drake drew for the
            # context, and the first sample of the logs, give way to this draw.
            if not started:
                started.append(True)
                _set_start(landing, context, drawn, draw)
                for logger in landing.loggers.values():
                    logger.FindMutableLog(context).Clear()
            return EventStatus.DidNothing()

        simulator.set_monitor(start)
        return simulator

    return make_simulator


def _drawn(scatter: Scatter, generator: RandomGenerator) -> dict[str, dict[Any, float]]:
    return {
        kind: {
            key: float(distribution.Sample(generator))
            for key, distribution in getattr(scatter, kind).items()
        }
        for kind in ("scenario", "struts", "tires")
    }


def _set_start(
    landing: LandingDiagram,
    context: Context,
    scenario: Scenario,
    draw: dict[str, dict[Any, float]],
) -> None:
    set_scenario_state(landing, context, scenario)
    for (gear, name), factor in draw["struts"].items():
        absorber = landing.shock_absorbers[gear]
        nominal = getattr(ShockAbsorberTunables(absorber.parameters.tunables), name)
        absorber.set_tunables(context, **{name: factor * nominal})
    factors: dict[str, dict[str, float]] = {}
    for (wheel, name), factor in draw["tires"].items():
        factors.setdefault(wheel, {})[name] = factor
    for wheel, given in factors.items():
        landing.tires[wheel].set_factors(context, **given)

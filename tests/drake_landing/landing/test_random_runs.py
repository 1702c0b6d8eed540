"""Default and random contexts of a landing, and Drake's MonteCarloSimulation of it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.common import RandomGenerator
from pydrake.common.schema import Gaussian, Uniform
from pydrake.systems.analysis import MonteCarloSimulation, RandomSimulation

from drake_landing.case.scenario import Scenario
from drake_landing.landing.diagram import MakeLandingDiagram
from drake_landing.landing.initial_state import tire_clearances
from drake_landing.landing.random_runs import Scatter, simulator_factory
from tests.drake_landing.landing_gears import aircraft_gears
from tests.systems.synthetic_body import aircraft_body

SCENARIO = Scenario(sink_rate=1.0)
SCATTER = Scatter(
    scenario={"sink_rate": Uniform(min=0.5, max=3.0), "roll": Gaussian(0.0, 1.0)},
    struts={("nose", "precharge"): Gaussian(mean=1.0, stddev=0.05)},
    tires={("main_left_left", "friction"): Uniform(min=0.5, max=1.0)},
)


@pytest.fixture(scope="module")
def landing():
    return MakeLandingDiagram(aircraft_body(2), aircraft_gears())


@pytest.mark.parametrize("random", [False, True])
def test_wheels_of_a_context_of_drake_hang_above_the_ground(landing, random):
    context = landing.diagram.CreateDefaultContext()
    if random:
        landing.diagram.SetRandomContext(context, RandomGenerator(3))
    clearances = tire_clearances(landing, context)
    assert min(clearances.values()) == pytest.approx(1.0)
    own = landing.attachment.GetMyContextFromRoot(context)
    gap = landing.attachment.GetOutputPort("gap").Eval(own)
    assert_allclose(gap, 0.0, atol=1e-12)
    rates = landing.diagram.EvalTimeDerivatives(context).CopyToVector()
    assert_allclose(rates, 0.0, atol=1e-6)


def found(landing):
    """Sink rate at the start, roll, precharge, friction, and largest load of a run."""

    def output(_, context):
        state = landing.loggers["plant.state"].FindLog(context).data()
        load = landing.loggers["attachment.load_in_airframe_axes"].FindLog(context)
        strut, tire = landing.shock_absorbers["nose"], landing.tires["main_left_left"]
        values.append(
            [
                -state[landing.plant.num_positions() + 5, 0],
                strut.tunables(context)[0],
                tire.factors(context)[2],
            ]
        )
        return float(np.abs(load.data()).max())

    values: list[list[float]] = []
    return output, values


def test_monte_carlo_draws_states_and_parameters_and_can_be_repeated(landing):
    make = simulator_factory(landing, SCENARIO, SCATTER)
    output, values = found(landing)
    results = MonteCarloSimulation(
        make_simulator=make,
        output=output,
        final_time=0.02,
        num_samples=6,
        generator=RandomGenerator(7),
    )
    loads = [result.output for result in results]
    assert len(set(loads)) == 6
    sink, precharge, friction = np.array(values).T
    assert sink.min() > 0.45
    assert sink.max() < 3.1
    assert np.ptp(sink) > 0.3
    assert np.ptp(precharge) > 100.0
    assert ((friction >= 0.5) & (friction <= 1.0)).all()
    again = RandomSimulation(
        make_simulator=make,
        output=output,
        final_time=0.02,
        generator=results[2].generator_snapshot,
    )
    assert again == loads[2]


def test_scatter_names_what_is_not_there(landing):
    wrong = Scatter(
        scenario={"sink_rte": Uniform(1.0, 2.0)},
        struts={("nose", "stiffness"): Uniform(1.0, 2.0)},
        tires={("tail", "friction"): Uniform(1.0, 2.0)},
    )
    expected = r"sink_rte, struts\.nose\.stiffness, tires\.tail"
    with pytest.raises(ValueError, match=expected):
        simulator_factory(landing, SCENARIO, wrong)


def test_draw_out_of_range_is_named(landing):
    wild = Scatter(scenario={"sink_rate": Uniform(min=20.0, max=30.0)})
    with pytest.raises(ValueError, match="sink_rate"):
        simulator_factory(landing, SCENARIO, wild)(RandomGenerator(1))

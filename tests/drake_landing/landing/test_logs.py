"""Tables of logged ports."""

import numpy as np
import pytest
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import ConstantVectorSource, Integrator, LogVectorOutput

from drake_landing.landing.logs import log_table


@pytest.fixture
def run():
    """Integral of 2, logged at every step for 0.1 s."""
    builder = DiagramBuilder()
    two = builder.AddSystem(ConstantVectorSource([2.0]))
    integral = builder.AddSystem(Integrator(1))
    builder.Connect(two.get_output_port(), integral.get_input_port())
    logger = LogVectorOutput(integral.get_output_port(), builder)
    simulator = Simulator(builder.Build())
    simulator.AdvanceTo(0.06)
    simulator.AdvanceTo(0.06 + 1e-13)  # an instant logged twice
    simulator.AdvanceTo(0.1)
    return logger, simulator.get_context()


def test_table_has_the_logged_values_over_time(run):
    table = log_table(*run, columns=["integral"])
    assert list(table.columns) == ["integral"]
    assert table.index.name == "time"
    assert table.index[-1] == pytest.approx(0.1)
    np.testing.assert_allclose(table["integral"], 2 * table.index, atol=1e-9)


def test_an_instant_logged_twice_is_one_row(run):
    logger, context = run
    raw = logger.FindLog(context).sample_times()
    table = log_table(logger, context, ["integral"])
    assert len(table) < len(raw)
    assert np.diff(table.index).min() > 1e-9


def test_wrong_number_of_columns_is_refused(run):
    with pytest.raises(ValueError, match="2 columns, expected 1"):
        log_table(*run, columns=["a", "b"])

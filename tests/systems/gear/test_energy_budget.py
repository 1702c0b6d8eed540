"""The energy budget sums and integrates."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pydrake.systems.analysis import Simulator

from systems.gear.energy_budget import EnergyBudget
from tests.systems.small_gears import two_gears, violent_state


def test_total_is_plant_plus_stored_plus_integral_of_the_powers():
    plant, *_ = two_gears(gravity=9.81)
    budget = EnergyBudget(plant, ["tire"], ["tire", "strut"])
    context = budget.CreateDefaultContext()
    state = violent_state(plant)
    budget.GetInputPort("plant_state").FixValue(context, state)
    for name, value in (
        ("energy_tire", 120.0),
        ("power_tire", 3e4),
        ("power_strut", 1e4),
    ):
        budget.GetInputPort(name).FixValue(context, [value])
    Simulator(budget, context).AdvanceTo(0.5)
    dissipated = budget.GetOutputPort("dissipated").Eval(context)[0]
    assert_allclose(dissipated, 0.5 * 4e4)
    of_plant = plant.CreateDefaultContext()
    plant.SetPositionsAndVelocities(of_plant, state)
    kinetic = plant.EvalKineticEnergy(of_plant)
    potential = plant.EvalPotentialEnergy(of_plant)
    assert np.abs(potential) > 100.0
    total = budget.GetOutputPort("total").Eval(context)[0]
    assert_allclose(total, kinetic + potential + 120.0 + dissipated)


def test_unit_must_be_positive():
    with pytest.raises(ValueError, match="expected > 0"):
        EnergyBudget(two_gears()[0], [], [], unit=0.0)

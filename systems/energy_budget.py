"""Where the energy of a landing goes: a budget that ought to stay constant."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from pydrake.common.value import Value
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import (
    BasicVector,
    DiagramBuilder,
    LeafSystem,
    ValueProducer,
)


class EnergyBudget(LeafSystem):
    """Kinetic and stored energy of everything, plus the integral of all that is lost.

    The integral is a state rather than a quadrature of logged powers: slip at spin-up
    burns several times the sink energy within some hundredths of a second, and only the
    integrator's own stages follow that closely enough. The state is the energy over
    `unit`, so that Drake's absolute error test is a relative one.

    | port | size | unit | |
    |---|---|---|---|
    | in `plant_state` | nq + nv | | |
    | in `energy_<name>` for each stored | 1 | J | |
    | in `power_<name>` for each dissipating | 1 | W | |
    | out `dissipated` | 1 | J | integral of all powers since the start |
    | out `total` | 1 | J | dissipated + stored + energy of the plant |

    Args:
        plant: finalised; its kinetic and potential energy are part of the budget.
        stored: names of the systems that store energy.
        dissipating: names of those that dissipate.
        unit: energy that the accuracy of the integrator refers to, J.

    Raises:
        ValueError: unit is not positive.
    """

    def __init__(
        self,
        plant: MultibodyPlant,
        stored: Sequence[str],
        dissipating: Sequence[str],
        unit: float = 1e5,
    ) -> None:
        super().__init__()
        if not unit > 0:
            raise ValueError(f"energy budget: unit is {unit} J, expected > 0")
        self._plant, self._unit = plant, unit
        declare: Any = self.DeclareVectorInputPort
        self._state = declare("plant_state", plant.num_multibody_states())
        self._stored = [declare(f"energy_{name}", 1) for name in stored]
        self._powers = [declare(f"power_{name}", 1) for name in dissipating]
        self.DeclareContinuousState(BasicVector([0.0]))
        self._context: Any = self.DeclareCacheEntry(
            "plant_context",
            ValueProducer(
                allocate=lambda: Value(plant.CreateDefaultContext()),
                calc=self._calc_context,
            ),
            {self._state.ticket()},
        )
        dissipated = {self.xc_ticket()}
        self.DeclareVectorOutputPort("dissipated", 1, self._calc_dissipated, dissipated)
        sources = {port.ticket() for port in self._stored} | {self._context.ticket()}
        self.DeclareVectorOutputPort("total", 1, self._calc_total, sources | dissipated)

    def _calc_context(self, context, value) -> None:
        state = self._state.Eval(context)
        self._plant.SetPositionsAndVelocities(value.get_mutable_value(), state)

    def DoCalcTimeDerivatives(self, context, derivatives) -> None:
        power = sum(port.Eval(context)[0] for port in self._powers)
        derivatives.SetFromVector(np.array([power / self._unit]))

    def _dissipated(self, context) -> float:
        return self._unit * context.get_continuous_state_vector().GetAtIndex(0)

    def _calc_dissipated(self, context, output) -> None:
        output.SetAtIndex(0, self._dissipated(context))

    def _calc_total(self, context, output) -> None:
        plant_context = self._context.Eval(context)
        total = self._dissipated(context)
        total += sum(port.Eval(context)[0] for port in self._stored)
        total += self._plant.EvalKineticEnergy(plant_context)
        total += self._plant.EvalPotentialEnergy(plant_context)
        output.SetAtIndex(0, total)


def AddEnergyBudget(
    builder: DiagramBuilder,
    plant: MultibodyPlant,
    systems: Sequence[LeafSystem],
    unit: float = 1e5,
) -> EnergyBudget:
    """Adds the system `energy_budget` and connects it.

    Args:
        builder: that already holds plant and systems.
        plant: finalised.
        systems: with ports `energy` and `dissipated_power`, each with its own name.
        unit: see EnergyBudget, J.
    """
    names = [system.get_name() for system in systems]
    budget = EnergyBudget(plant, names, names, unit)
    builder.AddNamedSystem("energy_budget", budget)
    builder.Connect(plant.GetOutputPort("state"), budget.GetInputPort("plant_state"))
    for name, system in zip(names, systems):
        for port, kind in (("energy", "energy"), ("dissipated_power", "power")):
            source = system.GetOutputPort(port)
            builder.Connect(source, budget.GetInputPort(f"{kind}_{name}"))
    return budget

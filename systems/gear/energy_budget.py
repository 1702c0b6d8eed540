"""Where the energy of a landing goes: a budget that ought to stay constant."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import (
    BasicVector_,
    DiagramBuilder,
    LeafSystem,
    LeafSystem_,
)

from systems.tools.plant_context import declare_plant_context
from systems.tools.template import default_instantiation, for_scalars
from systems.tools.weak_methods import weakly


@for_scalars
def EnergyBudget_(T):
    class Impl(LeafSystem_[T]):
        """Kinetic and stored energy of everything, what is lost, less what is supplied.

        The integrals are states rather than quadratures of logged powers: slip at
        spin-up burns several times the sink energy within some hundredths of a second,
        and only the integrator's own stages follow that closely enough. A state is an
        energy over `unit`, so that Drake's absolute error test is a relative one.

        | port | size | unit | meaning and sign |
        |---|---|---|---|
        | in `plant_state` | nq + nv | | positions and velocities of the plant |
        | in `energy_<name>` for each stored | 1 | J | |
        | in `power_<name>` for each dissipating | 1 | W | lost, >= 0 |
        | in `supply_<name>` for each supplying | 1 | W | of external loads, gained |
        | out `dissipated` | 1 | J | integral of all lost powers since the start |
        | out `supplied` | 1 | J | integral of all supplied powers since the start |
        | out `total` | 1 | J | dissipated - supplied + stored + of the plant |

        Args:
            plant: finalised; its kinetic and potential energy are part of the budget.
            stored: names of the systems that store energy.
            dissipating: names of those that dissipate.
            supplying: names of those that have external loads.
            unit: energy that the accuracy of the integrator refers to, J.

        Raises:
            ValueError: unit is not positive.
        """

        def _construct(
            self,
            plant: MultibodyPlant,
            stored: Sequence[str],
            dissipating: Sequence[str],
            supplying: Sequence[str] = (),
            unit: float = 1e5,
            converter=None,
        ):
            LeafSystem_[T].__init__(self, converter=converter)
            if not unit > 0:
                raise ValueError(f"energy budget: unit is {unit} J, expected > 0")
            self._given = plant, stored, dissipating, supplying, unit
            self._plant = plant if T is float else plant.ToAutoDiffXd()
            self._unit = unit
            declare: Any = self.DeclareVectorInputPort
            self._state = declare("plant_state", plant.num_multibody_states())
            self._stored = [declare(f"energy_{name}", 1) for name in stored]
            self._powers = [declare(f"power_{name}", 1) for name in dissipating]
            self._supplies = [declare(f"supply_{name}", 1) for name in supplying]
            self.DeclareContinuousState(BasicVector_[T]([0.0, 0.0]))
            self._context = declare_plant_context(self, self._plant)
            integrals = {self.xc_ticket()}
            sources = {port.ticket() for port in self._stored} | {
                self._context.ticket()
            }
            vector = self.DeclareVectorOutputPort
            vector("dissipated", 1, weakly(self._calc_dissipated), integrals)
            vector("supplied", 1, weakly(self._calc_supplied), integrals)
            vector("total", 1, weakly(self._calc_total), sources | integrals)

        def _construct_copy(self, other, converter=None):
            Impl._construct(self, *other._given, converter=converter)

        def DoCalcTimeDerivatives(self, context, derivatives) -> None:
            lost, supplied = (
                sum((port.Eval(context)[0] for port in ports), T(0.0))
                for ports in (self._powers, self._supplies)
            )
            derivatives.SetFromVector(np.array([lost, supplied]) / self._unit)

        def _integral(self, context, i: int) -> Any:
            return self._unit * context.get_continuous_state_vector().GetAtIndex(i)

        def _calc_dissipated(self, context, output) -> None:
            output.SetAtIndex(0, self._integral(context, 0))

        def _calc_supplied(self, context, output) -> None:
            output.SetAtIndex(0, self._integral(context, 1))

        def _calc_total(self, context, output) -> None:
            plant_context = self._context.Eval(context)
            total = self._integral(context, 0) - self._integral(context, 1)
            total += sum(port.Eval(context)[0] for port in self._stored)
            total += self._plant.EvalKineticEnergy(plant_context)
            total += self._plant.EvalPotentialEnergy(plant_context)
            output.SetAtIndex(0, total)

    return Impl


EnergyBudget = default_instantiation(EnergyBudget_)


def AddEnergyBudget(
    builder: DiagramBuilder,
    plant: MultibodyPlant,
    systems: Sequence[LeafSystem],
) -> Any:
    """Adds the system `energy_budget` and connects it.

    Args:
        builder: that already holds plant and systems.
        plant: finalised.
        systems: each with its own name, and with any of the ports `energy`,
            `dissipated_power` and `external_power`.
    """
    by_port = {
        port: [s for s in systems if s.HasOutputPort(port)] for port in _KIND_OF_PORT
    }
    names = [[system.get_name() for system in group] for group in by_port.values()]
    budget = EnergyBudget(plant, *names)
    builder.AddNamedSystem("energy_budget", budget)
    builder.Connect(plant.GetOutputPort("state"), budget.GetInputPort("plant_state"))
    for port, group in by_port.items():
        for system in group:
            target = f"{_KIND_OF_PORT[port]}_{system.get_name()}"
            source = system.GetOutputPort(port)
            builder.Connect(source, budget.GetInputPort(target))
    return budget


_KIND_OF_PORT = {
    "energy": "energy",
    "dissipated_power": "power",
    "external_power": "supply",
}

"""A drop test: one leg, its sprung mass guided vertically, wheels that may spin.

The carriage moves at a constant speed toward -x. Shock absorber and tire are the
systems under test; the rig adds masses alone.
"""

from dataclasses import dataclass

import numpy as np
from pydrake.systems.analysis import (
    ApplySimulatorConfig,
    Simulator,
    SimulatorConfig,
)
from pydrake.systems.framework import BasicVector, DiagramBuilder, LeafSystem
from pydrake.systems.primitives import LogVectorOutput

from systems.runway.runway import Runway
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.strut_parameters import ShockAbsorberParameters
from systems.tire.tire import Tire
from systems.tire.tire_parameters import TireParameters


@dataclass(frozen=True, kw_only=True)
class Rig:
    """Masses and initial state of a drop: kg, kg m², m/s, N; values of one leg."""

    shock_absorber: ShockAbsorberParameters
    tire: TireParameters
    sprung_mass: float
    unsprung_mass: float
    sink_rate: float
    wheels: int = 2
    wheel_inertia: float = 18.0
    forward_speed: float = 0.0
    sprung_force: float = 0.0
    unsprung_force: float = 0.0
    clearance: float = 1e-3


class Masses(LeafSystem):
    """States: heights of sprung and unsprung mass, their rates, spin of a wheel.

    Inputs `force` (1) of the strut, `wrench` (6) of one tire. Outputs `strut_state`
    (2), `wheel` (12), `state` (5), `kinetic_energy` (1).
    """

    def __init__(self, rig: Rig) -> None:
        LeafSystem.__init__(self)
        self._rig = rig
        start = rig.tire.radius + rig.clearance
        sink = -rig.sink_rate
        # The sprung mass is where the stroke is its height below the wheel's start.
        self.DeclareContinuousState(BasicVector([start, start, sink, sink, 0.0]))
        self._force = self.DeclareVectorInputPort("force", 1)
        self._wrench = self.DeclareVectorInputPort("wrench", 6)
        for name, size, calc in (
            ("strut_state", 2, self._calc_strut),
            ("wheel", 12, self._calc_wheel),
            ("state", 5, self._calc_state),
            ("kinetic_energy", 1, self._calc_energy),
        ):
            self.DeclareVectorOutputPort(
                name, size, calc, prerequisites_of_calc={self.xc_ticket()}
            )

    def _x(self, context):
        return context.get_continuous_state_vector().CopyToVector()

    def _calc_strut(self, context, output):
        zs, zu, vs, vu, _ = self._x(context)
        output.SetFromVector([zu - zs, vu - vs])

    def _calc_wheel(self, context, output):
        _, zu, _, vu, spin = self._x(context)
        v = self._rig.forward_speed
        output.SetFromVector([0, 0, zu, 0, 1, 0, -v, 0, vu, 0, spin, 0])

    def _calc_state(self, context, output):
        output.SetFromVector(self._x(context))

    def _calc_energy(self, context, output):
        r = self._rig
        _, _, vs, vu, spin = self._x(context)
        output.SetAtIndex(
            0,
            0.5
            * (
                r.sprung_mass * vs**2
                + r.unsprung_mass * vu**2
                + r.wheels * r.wheel_inertia * spin**2
            ),
        )

    def DoCalcTimeDerivatives(self, context, derivatives):
        r = self._rig
        _, _, vs, vu, _ = self._x(context)
        force = self._force.Eval(context)[0]
        wrench = self._wrench.Eval(context)
        derivatives.get_mutable_vector().SetFromVector(
            [
                vs,
                vu,
                (force + r.sprung_force) / r.sprung_mass,
                (r.wheels * wrench[5] - force + r.unsprung_force) / r.unsprung_mass,
                wrench[1] / r.wheel_inertia,
            ]
        )


def drop(
    rig: Rig, duration: float, *, accuracy: float = 1e-7, runway: Runway | None = None
) -> dict[str, np.ndarray]:
    """Runs a drop; logged ports as {name: (n, nt)} and "time"."""
    builder = DiagramBuilder()
    masses = builder.AddNamedSystem("masses", Masses(rig))
    strut = builder.AddNamedSystem("strut", ShockAbsorber(rig.shock_absorber))
    tire = builder.AddNamedSystem("tire", Tire(rig.tire, runway))
    for out, into in (
        (masses.GetOutputPort("strut_state"), strut.GetInputPort("strut_state")),
        (masses.GetOutputPort("wheel"), tire.GetInputPort("wheel")),
        (strut.GetOutputPort("force"), masses.GetInputPort("force")),
        (tire.GetOutputPort("wrench"), masses.GetInputPort("wrench")),
    ):
        builder.Connect(out, into)
    logs = {
        f"{system.get_name()}_{port}": LogVectorOutput(
            system.GetOutputPort(port), builder
        )
        for system, ports in (
            (masses, ("state", "kinetic_energy", "strut_state")),
            (strut, ("force", "energy", "dissipated_power", "components")),
            (tire, ("wrench", "contact", "energy", "dissipated_power")),
        )
        for port in ports
    }
    simulator = Simulator(builder.Build())
    ApplySimulatorConfig(
        SimulatorConfig(
            integration_scheme="runge_kutta3", accuracy=accuracy, max_step_size=2e-3
        ),
        simulator,
    )
    simulator.Initialize()
    simulator.AdvanceTo(duration)
    context = simulator.get_context()
    result = {name: log.FindLog(context).data() for name, log in logs.items()}
    result["time"] = logs["masses_state"].FindLog(context).sample_times()
    return result

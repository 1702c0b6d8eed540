"""A drop test of one gear: its share of the aircraft on a rail, wheels free to spin.

Small enough to be converted to AutoDiffXd and to be run a thousand times: for the
design of a shock absorber, for drop tests of 25.723, for tries of a controller.
"""

from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy.typing as npt
import pandas as pd
from pydrake.autodiffutils import AutoDiffXd
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import PrismaticJoint, SpatialInertia
from pydrake.systems.analysis import (
    ApplySimulatorConfig,
    ResetIntegratorFromFlags,
    Simulator_,
    SimulatorConfig,
)
from pydrake.systems.framework import Context, Diagram, DiagramBuilder, LeafSystem
from pydrake.systems.primitives import LogVectorOutput, VectorLogSink

from drake_landing.gears.bodies import AddLandingGear
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.mounted import each_of
from drake_landing.gears.systems import AddGearSystems
from drake_landing.landing_integrators import DEFAULT
from systems.gear.energy_budget import AddEnergyBudget
from systems.runway.runway import Runway
from systems.shock_absorber.strut_parameters import ShockAbsorberTunables
from systems.tools.checks import require


@dataclass(frozen=True, kw_only=True)
class DropRig:
    """A rig and what it was made from.

    Attributes:
        diagram: systems `plant` and those of `AddGearSystems`, and `energy_budget`.
        gear: its data.
        mass: kg, gear and all that it stops.
        height: m, of the carriage on its rail when the lowest tire touches the ground.
        scalar: float or AutoDiffXd.
        loggers: of floats, one sample a step: `strut` (stroke, rate), `force`, of each
            wheel `contact_<wheel>`, of the budget `total`.
    """

    diagram: Diagram = field(repr=False)
    gear: LandingGear
    mass: float
    height: float
    scalar: Any = float
    loggers: dict[str, VectorLogSink] = field(default_factory=dict, repr=False)

    @property
    def strut(self) -> Any:
        """The rig's shock absorber."""
        return self.diagram.GetSubsystemByName("shock_absorbers")

    def ToAutoDiffXd(self) -> Self:
        """Copy of the rig for AutoDiffXd, without logs."""
        return replace(
            self, diagram=self.diagram.ToAutoDiffXd(), scalar=AutoDiffXd, loggers={}
        )

    def set_drop(
        self,
        context: Context,
        *,
        sink_rate: Any,
        speed: Any = 0.0,
        clearance: float = 1e-3,
        **tunables: Any,
    ) -> None:
        """Sets the state just above the runway, and the law of the shock absorber.

        Args:
            context: of the diagram, in its default state.
            sink_rate: m/s; a number of the rig's scalar, as all below.
            speed: m/s, toward -x.
            clearance: of the lowest tire, m.
            tunables: of `ShockAbsorberTunables`, N, m, N s²/m².
        """
        plant: Any = self.diagram.GetSubsystemByName("plant")
        of_plant = plant.GetMyMutableContextFromRoot(context)
        rails = [plant.GetJointByName(name) for name in ("up", "forward")]
        rails[0].set_translation(of_plant, self._number(self.height + clearance))
        for rail, rate in zip(rails, (-sink_rate, speed)):
            rail.set_translation_rate(of_plant, self._number(rate))
        fields = list(ShockAbsorberTunables.get_fields())
        own = self.strut.GetMyMutableContextFromRoot(context)
        vector = own.get_mutable_numeric_parameter(0)
        for name, value in tunables.items():
            if name not in fields:
                raise ValueError(
                    f"drop rig: no tunable {name}, expected one of {', '.join(fields)}"
                )
            vector.SetAtIndex(fields.index(name), self._number(value))

    def _number(self, value: Any) -> Any:
        return value if isinstance(value, AutoDiffXd) else self.scalar(value)

    def drop(
        self,
        *,
        sink_rate: float,
        speed: float = 0.0,
        duration: float,
        accuracy: float = 1e-5,
        **tunables: float,
    ) -> pd.DataFrame:
        """One drop, of a rig with logs.

        Args:
            sink_rate, speed, tunables: see `set_drop`.
            duration: s.
            accuracy: of the integrator.

        Returns:
            Over time (s): stroke (m), rate (m/s), force of the shock absorber (N),
            vertical load and drag of all tires (N), total of the energy budget (J).
        """
        simulator = Simulator_[float](self.diagram)
        config = SimulatorConfig(
            integration_scheme=DEFAULT,
            accuracy=accuracy,
            max_step_size=5e-3,
            use_error_control=True,
        )
        ApplySimulatorConfig(config, simulator)
        context = simulator.get_mutable_context()
        self.set_drop(context, sink_rate=sink_rate, speed=speed, **tunables)
        simulator.AdvanceTo(duration)
        logs = {name: log.FindLog(context) for name, log in self.loggers.items()}
        data = {name: log.data() for name, log in logs.items()}
        contact = sum(data[f"contact_{wheel}"] for wheel in self.gear.wheel_names)
        columns = {
            "stroke": data["strut"][0],
            "rate": data["strut"][1],
            "force": data["force"][0],
            "vertical": contact[1],
            "drag": contact[2],
            "total": data["total"][0],
        }
        time = pd.Index(logs["strut"].sample_times(), name="time")
        return pd.DataFrame(columns, index=time)

    def peak_force(
        self,
        *,
        sink_rate: Any,
        speed: Any = 0.0,
        duration: float,
        step: float = 1e-3,
        **tunables: Any,
    ) -> Any:
        """Largest force of the shock absorber at even steps of a drop, N.

        With steps of fixed length the peak is a smooth function of its arguments: in
        AutoDiffXd it has their gradient.

        Args:
            sink_rate, speed, tunables: see `set_drop`.
            duration, step: s.
        """
        simulator = Simulator_[self.scalar](self.diagram)
        context = simulator.get_mutable_context()
        self.set_drop(context, sink_rate=sink_rate, speed=speed, **tunables)
        integrator = ResetIntegratorFromFlags(simulator, DEFAULT, step)
        integrator.set_fixed_step_mode(True)
        force = self.strut.GetOutputPort("force")
        own = self.strut.GetMyContextFromRoot(context)
        found = []
        for i in range(1, round(duration / step) + 1):
            simulator.AdvanceTo(i * step)
            found.append(force.Eval(own)[0])
        return max(found)


def drop_rig(
    gear: LandingGear,
    *,
    mass: float,
    p_BA: npt.ArrayLike,
    runway: Runway | None = None,
    controller: LeafSystem | None = None,
    log: bool = True,
) -> DropRig:
    """Builds the rig: lift equals weight, the carriage does not turn.

    Args:
        gear: its data, B being x aft, y to starboard, z up.
        mass: kg, gear and all that it stops.
        p_BA: (3,) attachment point in B, m.
        runway: default flat and dry.
        controller: of the shock absorber's valve, with the input `strut_state` (2) and
            the output `damping_command` (1); default none.
        log: adds loggers.

    Raises:
        ValueError: mass is not more than the gear's, or a parameter is out of range.
    """
    require("drop rig", "mass", mass, "kg", above=gear.mass)
    builder = DiagramBuilder()
    plant = builder.AddNamedSystem("plant", MultibodyPlant(0.0))
    leg = AddLandingGear(plant, gear, p_BA)
    carriage = plant.AddRigidBody("carriage", SpatialInertia.Zero())
    rest = SpatialInertia.SolidSphereWithMass(mass - gear.mass, 1.0)
    load = plant.AddRigidBody("load", rest)
    world, between = plant.world_frame(), carriage.body_frame()
    fitting = leg.fitting.body_frame()
    plant.AddJoint(PrismaticJoint("forward", world, between, [-1.0, 0.0, 0.0]))
    plant.AddJoint(PrismaticJoint("up", between, fitting, [0.0, 0.0, 1.0]))
    plant.WeldFrames(fitting, load.body_frame())
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, 0.0])
    plant.Finalize()
    parts = AddGearSystems(
        builder,
        plant,
        [gear],
        {gear.name: leg},
        runway,
        connect_plant=False,
        together=True,
    )
    builder.Connect(
        parts.gear_forces.GetOutputPort("all_generalized_force"),
        plant.GetInputPort("applied_generalized_force"),
    )
    budget = AddEnergyBudget(builder, plant, list(parts.by_name.values()))
    strut = parts.shock_absorbers[gear.name].system
    kinematics = parts.wheel_kinematics
    if controller is not None:
        builder.AddNamedSystem("controller", controller)
        for source, port, target in (
            (kinematics.GetOutputPort(f"strut_{gear.name}"), "strut_state", controller),
            (controller.GetOutputPort("damping_command"), "damping_command", strut),
        ):
            builder.Connect(source, target.GetInputPort(port))
    ports = {
        "strut": kinematics.GetOutputPort(f"strut_{gear.name}"),
        "force": strut.GetOutputPort("force"),
        "total": budget.GetOutputPort("total"),
    }
    contacts = each_of(builder, parts.tires, "contact")
    ports |= {f"contact_{wheel}": port for wheel, port in contacts.items()}
    loggers = {n: LogVectorOutput(p, builder) for n, p in ports.items()} if log else {}
    diagram = builder.Build()
    context = diagram.CreateDefaultContext()
    clearances = [tire.clearance(context) for tire in parts.tires.values()]
    return DropRig(
        diagram=diagram,
        gear=gear,
        mass=mass,
        height=-float(min(clearances)),
        loggers=loggers,
    )

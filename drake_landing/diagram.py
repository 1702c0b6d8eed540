"""The diagram of a landing: airframe, gears, tyres, and what connects them.

    plant.state ─▸ wheel_kinematics ─▸ tire_*, shock_absorber_* ─▸ gear_forces
    gear_forces, airframe.node_*, plant.state ─▸ attachment
    attachment.wrench_on_airframe ─▸ airframe
    attachment.wrench_on_gear, gear_forces ─▸ plant

Systems are named `plant`, `airframe`, `attachment`, `wheel_kinematics`, `gear_forces`,
`tire_<wheel>`, `shock_absorber_<gear>` and `energy_budget`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, cast

from pydrake.multibody.plant import (
    ExternallyAppliedSpatialForceMultiplexer,
    MultibodyPlant,
)
from pydrake.systems.framework import Diagram, DiagramBuilder, LeafSystem
from pydrake.systems.primitives import LogVectorOutput, VectorLogSink

from drake_landing.gear import LandingGear
from drake_landing.gear_bodies import AddLandingGear, GearBodies
from drake_landing.gear_parameters import shock_absorber_parameters, tire_parameters
from systems.attachment import Attachment, RigidAttachment
from systems.bushing_attachment import BushingAttachment
from systems.energy_budget import AddEnergyBudget, EnergyBudget
from systems.flexible_airframe import FlexibleAirframe
from systems.gear_forces import GearForces
from systems.modal_body import ModalBody
from systems.runway import Runway
from systems.shock_absorber import ShockAbsorber
from systems.side_load import SideLoad
from systems.tire import Tire
from systems.wheel_kinematics import WheelKinematics

_LOGGED = {
    "airframe": ("pose", "modal_amplitudes", "monitor_acceleration", "energy"),
    "attachment": ("load_in_airframe_axes", "gap"),
    "plant": ("state",),
    "energy_budget": ("total", "dissipated"),
    "tire": ("contact", "wrench", "energy"),
    "shock_absorber": ("force", "components", "energy"),
}


@dataclass(frozen=True, kw_only=True)
class LandingDiagram:
    """A landing diagram and its parts.

    One can serve any number of runs, each with its own context: `set_initial_state` of
    `initial_state`, then a Simulator.

    Attributes:
        diagram: the whole, with the optional input `external_load` of the airframe.
        plant: the gears' bodies.
        airframe, attachment, wheel_kinematics, gear_forces: one each.
        tires: by wheel.
        shock_absorbers: by gear.
        bodies: bodies and joints, by gear.
        energy_budget: None where not asked for.
        loggers: by "<system>.<port>", one sample per integration step.
        body, gears, runway: what it was made from.
    """

    diagram: Diagram = field(repr=False)
    plant: MultibodyPlant = field(repr=False)
    airframe: FlexibleAirframe = field(repr=False)
    attachment: Attachment = field(repr=False)
    wheel_kinematics: WheelKinematics = field(repr=False)
    gear_forces: GearForces = field(repr=False)
    tires: dict[str, Any] = field(repr=False)
    shock_absorbers: dict[str, Any] = field(repr=False)
    bodies: dict[str, GearBodies] = field(repr=False)
    energy_budget: EnergyBudget | None = field(repr=False)
    loggers: dict[str, VectorLogSink] = field(repr=False)
    body: ModalBody = field(repr=False)
    gears: tuple[LandingGear, ...]
    runway: Runway

    def graphviz(self, max_depth: int = 1) -> str:
        """The diagram's picture in the dot language."""
        return self.diagram.GetGraphvizString(
            max_depth=max_depth, options={"plant/split": "I/O"}
        )


def MakeLandingDiagram(
    body: ModalBody,
    gears: Sequence[LandingGear],
    runway: Runway | None = None,
    *,
    monitor_nodes: Sequence[int] = (),
    attachment: Literal["rigid", "bushing"] = "rigid",
    gravity: float = 0.0,
    energy_budget: bool = True,
    log: bool = True,
) -> LandingDiagram:
    """Builds the diagram of an aircraft that lands.

    Args:
        body: the airframe, without its gears.
        gears: one or more; each is held at its attachment node.
        runway: default flat and dry.
        monitor_nodes: grids whose accelerations are wanted.
        attachment: `rigid`, or `bushing` for elastic fittings.
        gravity: m/s², for airframe and gears; 0 stands for lift equal to weight.
        energy_budget: adds the audit, at a few per cent of the run time.
        log: adds loggers of the signals that reports need.

    Raises:
        ValueError: no gear, a name used twice, an attachment or monitoring node that
            the body does not have, or a parameter out of range.
    """
    names = [gear.name for gear in gears]
    if not names or len(set(names)) < len(names):
        raise ValueError(f"landing diagram: gears {names}, expected unique names")
    runway = Runway() if runway is None else runway
    builder = DiagramBuilder()
    plant = builder.AddNamedSystem("plant", MultibodyPlant(0.0))
    nodes = [gear.attachment_node for gear in gears]
    bodies = {
        gear.name: AddLandingGear(plant, gear, p_BA)
        for gear, p_BA in zip(gears, body.p_BN[body.rows(nodes)])
    }
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -gravity])
    plant.Finalize()

    airframe = builder.AddNamedSystem(
        "airframe", FlexibleAirframe(body, nodes, monitor_nodes, gravity)
    )
    fittings = [parts.fitting for parts in bodies.values()]
    kind = {"rigid": RigidAttachment, "bushing": BushingAttachment}[attachment]
    held = builder.AddNamedSystem("attachment", kind(plant, fittings))
    wheels = {n: b for parts in bodies.values() for n, b in parts.wheels.items()}
    struts = {name: parts.strut for name, parts in bodies.items()}
    kinematics = builder.AddNamedSystem(
        "wheel_kinematics", WheelKinematics(plant, wheels, struts)
    )
    forces = builder.AddNamedSystem("gear_forces", GearForces(plant, wheels, struts))
    tires, absorbers = {}, {}
    tire, absorber = cast(Any, Tire), cast(Any, ShockAbsorber)
    for gear in gears:
        law = tire_parameters(gear.tyre)
        for wheel in gear.wheel_names:
            tires[wheel] = builder.AddNamedSystem(f"tire_{wheel}", tire(law, runway))
        absorbers[gear.name] = builder.AddNamedSystem(
            f"shock_absorber_{gear.name}",
            absorber(shock_absorber_parameters(gear.shock_absorber)),
        )

    _connect_gears(builder, kinematics, forces, tires, absorbers)
    for gear in gears:
        if gear.shock_absorber.bearing_friction > 0:
            _add_side_load(builder, gear, kinematics, tires, absorbers[gear.name])
    _connect_attachment(builder, plant, airframe, held, kinematics, forces)
    builder.ExportInput(airframe.GetInputPort("external_load"), "external_load")
    systems = {"plant": plant, "airframe": airframe, "attachment": held}
    systems |= {f"tire_{name}": tire for name, tire in tires.items()}
    systems |= {f"shock_absorber_{name}": a for name, a in absorbers.items()}
    budget = None
    if energy_budget:
        others = [system for name, system in systems.items() if name != "plant"]
        budget = AddEnergyBudget(builder, plant, others)
        systems["energy_budget"] = budget
    loggers = _add_loggers(builder, systems) if log else {}
    diagram = builder.Build()
    diagram.set_name("landing")
    return LandingDiagram(
        diagram=diagram,
        plant=plant,
        airframe=airframe,
        attachment=held,
        wheel_kinematics=kinematics,
        gear_forces=forces,
        tires=tires,
        shock_absorbers=absorbers,
        bodies=bodies,
        energy_budget=budget,
        loggers=loggers,
        body=body,
        gears=tuple(gears),
        runway=runway,
    )


def _connect_gears(
    builder: DiagramBuilder,
    kinematics: WheelKinematics,
    forces: GearForces,
    tires: dict[str, Any],
    absorbers: dict[str, Any],
) -> None:
    for name, tire in tires.items():
        _connect(builder, kinematics, f"wheel_{name}", tire, "wheel")
        _connect(builder, tire, "wrench", forces, f"tire_{name}")
    for name, absorber in absorbers.items():
        _connect(builder, kinematics, f"strut_{name}", absorber, "strut_state")
        _connect(builder, absorber, "force", forces, f"strut_{name}")


def _add_side_load(
    builder: DiagramBuilder,
    gear: LandingGear,
    kinematics: WheelKinematics,
    tires: dict[str, Any],
    absorber: Any,
) -> None:
    side_load = SideLoad(gear.wheel_names)
    builder.AddNamedSystem(f"side_load_{gear.name}", side_load)
    _connect(builder, kinematics, f"strut_axis_{gear.name}", side_load, "strut_axis")
    for wheel in gear.wheel_names:
        _connect(builder, tires[wheel], "wrench", side_load, f"tire_{wheel}")
    _connect(builder, side_load, "side_load", absorber, "side_load")


def _connect_attachment(
    builder: DiagramBuilder,
    plant: MultibodyPlant,
    airframe: FlexibleAirframe,
    held: Attachment,
    kinematics: WheelKinematics,
    forces: GearForces,
) -> None:
    for system in (kinematics, held):
        _connect(builder, plant, "state", system, "plant_state")
    for port in ("pose", "velocity", "free_acceleration", "compliance"):
        _connect(builder, airframe, f"node_{port}", held, f"node_{port}")
    _connect(builder, airframe, "pose", held, "airframe_pose")
    _connect(builder, held, "wrench_on_airframe", airframe, "attachment_wrench")
    for port in ("spatial_forces", "generalized_force"):
        _connect(builder, forces, port, held, port)
    _connect(builder, forces, "generalized_force", plant, "applied_generalized_force")
    both = builder.AddNamedSystem(
        "spatial_forces", ExternallyAppliedSpatialForceMultiplexer(2)
    )
    builder.Connect(forces.GetOutputPort("spatial_forces"), both.get_input_port(0))
    builder.Connect(held.GetOutputPort("wrench_on_gear"), both.get_input_port(1))
    builder.Connect(both.get_output_port(), plant.GetInputPort("applied_spatial_force"))


def _add_loggers(
    builder: DiagramBuilder, systems: dict[str, LeafSystem]
) -> dict[str, VectorLogSink]:
    loggers = {}
    for name, system in systems.items():
        kind = next(kind for kind in _LOGGED if name.startswith(kind))
        for port in _LOGGED[kind]:
            logger = LogVectorOutput(system.GetOutputPort(port), builder)
            logger.set_name(f"log {name} {port}")
            loggers[f"{name}.{port}"] = logger
    return loggers


def _connect(
    builder: DiagramBuilder, source: Any, output: str, target: Any, port: str
) -> None:
    builder.Connect(source.GetOutputPort(output), target.GetInputPort(port))

"""The diagram of a landing: airframe, gears, tires, and what connects them.

    plant.state ─▸ wheel_kinematics ─▸ tire_*, shock_absorber_* ... ─▸ gear_forces
    gear_forces, airframe.node_*, plant.state ─▸ attachment
    attachment.wrench_on_airframe ─▸ airframe
    attachment.wrench_on_gear, gear_forces ─▸ plant

Systems are named `plant`, `airframe`, `attachment`, `wheel_kinematics`, `gear_forces`,
`tire_<wheel>`, `shock_absorber_<gear>` (`together`: `tires`, `shock_absorbers`) and
`energy_budget`; where there are such, `brake_<wheel>`, `pitch_damper_<gear>`,
`side_load`, `elastic_legs`, `lift` and `reverse_thrust`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import Diagram, DiagramBuilder, LeafSystem
from pydrake.systems.primitives import Adder, LogVectorOutput, VectorLogSink

from drake_landing.gears.attachment_points import (
    attachment_places,
    attachment_points,
    require_shared_loads,
)
from drake_landing.gears.bodies import AddLandingGear, GearBodies, wheel_centers
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.mounted import MountedShockAbsorber, MountedTire, each_of
from drake_landing.gears.systems import AddGearSystems, GearSystems, connect
from drake_landing.landing.lift import AddLift, Lift
from systems.airframe.distributed_load import DistributedLoad
from systems.airframe.flexible_airframe import FlexibleAirframe
from systems.airframe.modal_body import ModalBody
from systems.airframe.quasi_steady_lift import QuasiSteadyLift
from systems.attachment.attachment import Attachment, RigidAttachment
from systems.attachment.bushing_attachment import BushingAttachment
from systems.gear.energy_budget import AddEnergyBudget
from systems.runway.runway import Runway

_OFF_GROUND = 1.0  # m

# Of each tire, and of each shock absorber.
_OF_TIRES = ("contact", "wrench")
_OF_ABSORBERS = ("force", "components")
_LOGGED = {
    "airframe": ("pose", "modal_amplitudes", "monitor_acceleration", "energy"),
    "attachment": ("load_in_airframe_axes", "gap"),
    "plant": ("state",),
    "energy_budget": ("total", "dissipated", "supplied"),
    "tire": ("energy",),
    "shock_absorber": ("energy",),
    "brake": ("torque",),
    "pitch_damper": ("torque", "energy"),
    "elastic_legs": ("energy",),
    "lift": ("force", "node_force"),
    "reverse_thrust": ("force", "node_force"),
}


@dataclass(frozen=True, kw_only=True)
class LandingDiagram:
    """A landing diagram and its parts.

    Build it once: Drake does not give back the memory of systems written in Python.
    Any number of runs can follow, each with a context of its own, which holds state,
    parameters and logs and vanishes with the Simulator:

        simulator = Simulator(landing.diagram)
        context = simulator.get_mutable_context()
        set_initial_state(landing, context, v_WG=[-67.0, 0.0, -3.05])
        landing.shock_absorbers["nose"].set_tunables(context, precharge=13e3)  # N
        simulator.AdvanceTo(1.0)
        log = landing.loggers["attachment.load_in_airframe_axes"].FindLog(context)

    Attributes:
        diagram: the whole; without lift with the optional input `external_load` of
            the airframe.
        plant: the gears' bodies.
        airframe, attachment, wheel_kinematics, gear_forces: one each.
        tires: by wheel.
        shock_absorbers: by gear.
        brakes: by wheel, of gears that have them.
        pitch_dampers: by gear, of bogies.
        elastic_legs: of all gears that bend; None where none does.
        bodies: bodies and joints, by gear.
        lift: None where lift equals weight and neither acts.
        reverse_thrust: None where there is none.
        energy_budget: None where not asked for.
        loggers: by "<system>.<port>", one sample per integration step; of single tires
            and shock absorbers as "tire_<wheel>.contact", "tire_<wheel>.wrench",
            "shock_absorber_<gear>.force" and "shock_absorber_<gear>.components"; stroke
            and rate of a gear as "strut_<gear>.strut", what a leg bends as
            "elastic_legs.deflection_<gear>".
        body, gears, runway, gravity: what it was made from.
    """

    diagram: Diagram = field(repr=False)
    plant: MultibodyPlant = field(repr=False)
    airframe: FlexibleAirframe = field(repr=False)
    attachment: Attachment = field(repr=False)
    wheel_kinematics: Any = field(repr=False)
    gear_forces: Any = field(repr=False)
    tires: dict[str, MountedTire] = field(repr=False)
    shock_absorbers: dict[str, MountedShockAbsorber] = field(repr=False)
    brakes: dict[str, Any] = field(repr=False)
    pitch_dampers: dict[str, Any] = field(repr=False)
    elastic_legs: Any = field(repr=False)
    bodies: dict[str, GearBodies] = field(repr=False)
    lift: DistributedLoad | QuasiSteadyLift | None = field(repr=False)
    reverse_thrust: DistributedLoad | None = field(repr=False)
    energy_budget: Any = field(repr=False)
    loggers: dict[str, VectorLogSink] = field(repr=False)
    body: ModalBody = field(repr=False)
    gears: tuple[LandingGear, ...]
    runway: Runway
    gravity: float

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
    bushing: Mapping[str, float] | None = None,
    gravity: float = 0.0,
    lift: Lift | None = None,
    brakes: bool = False,
    energy_budget: bool = True,
    log: bool = True,
    together: bool = False,
) -> LandingDiagram:
    """Builds the diagram of an aircraft that lands.

    Args:
        body: the airframe, without its gears.
        gears: one or more; each is held at its attachment nodes.
        runway: default flat and dry.
        monitor_nodes: grids whose accelerations are wanted.
        bushing: stiffness and damping of elastic fittings, arguments of
            BushingAttachment; default none: held without play.
        gravity: m/s², for airframe and gears; 0 stands for lift equal to weight.
        lift: carried by the airframe, beside gravity.
        brakes: applied from the start, on gears that have them; by default none are.
        energy_budget: adds the audit, at a few per cent of the run time.
        log: adds loggers of the signals that reports need.
        together: one system for all tires and one for all shock absorbers, as in
            `AddGearSystems`; the same landing in less time.

    Raises:
        ValueError: no gear, a name used twice, an attachment or monitoring node that
            the body does not have, a gear that is held too little or, for a rigid
            airframe, too much, lift without gravity, or a parameter out of range.
    """
    names = [gear.name for gear in gears]
    if not names or len(set(names)) < len(names):
        raise ValueError(f"landing diagram: gears {names}, expected unique names")
    runway = Runway() if runway is None else runway
    builder = DiagramBuilder()
    plant = builder.AddNamedSystem("plant", MultibodyPlant(0.0))
    places = attachment_places(body, gears)
    bodies = {
        gear.name: AddLandingGear(plant, gear, places[gear.name]) for gear in gears
    }
    plant.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -gravity])
    plant.Finalize()

    nodes = [node for gear in gears for node in gear.attachments.values()]
    height = _default_height(body, gears)
    for gear in gears:
        p_WA = places[gear.name] - body.p_BG + [0.0, 0.0, height]
        fitting = bodies[gear.name].fitting
        plant.SetDefaultFloatingBaseBodyPose(fitting, RigidTransform(p_WA))
    airframe = builder.AddNamedSystem(
        "airframe", FlexibleAirframe(body, nodes, monitor_nodes, gravity, height)
    )
    points = attachment_points(gears, bodies, places)
    held: Attachment = (
        RigidAttachment(plant, points)
        if bushing is None
        else BushingAttachment(plant, points, **bushing)
    )
    builder.AddNamedSystem("attachment", held)
    if bushing is None:
        require_shared_loads(body, gears, points, nodes)
    parts = AddGearSystems(
        builder,
        plant,
        gears,
        bodies,
        runway,
        brakes,
        connect_plant=False,
        together=together,
    )
    _connect_attachment(builder, plant, airframe, held, parts.gear_forces)
    carrying, thrust = None, None
    if lift is None:
        builder.ExportInput(airframe.GetInputPort("external_load"), "external_load")
    elif not gravity > 0:
        raise ValueError(f"landing diagram: lift with gravity {gravity} m/s²")
    else:
        carrying, thrust = AddLift(builder, airframe, body, gears, lift, gravity)
    systems: dict[str, Any] = {
        "plant": plant,
        "airframe": airframe,
        "attachment": held,
    }
    systems |= parts.by_name
    if carrying is not None:
        systems["lift"] = carrying
    if thrust is not None:
        systems["reverse_thrust"] = thrust
    budget = None
    if energy_budget:
        others = [system for name, system in systems.items() if name != "plant"]
        budget = AddEnergyBudget(builder, plant, others)
        systems["energy_budget"] = budget
    loggers = _add_loggers(builder, systems, parts, bodies) if log else {}
    diagram = builder.Build()
    diagram.set_name("landing")
    return LandingDiagram(
        diagram=diagram,
        plant=plant,
        airframe=airframe,
        attachment=held,
        wheel_kinematics=parts.wheel_kinematics,
        gear_forces=parts.gear_forces,
        tires=parts.tires,
        shock_absorbers=parts.shock_absorbers,
        brakes=parts.brakes,
        pitch_dampers=parts.pitch_dampers,
        elastic_legs=parts.elastic_legs,
        bodies=bodies,
        lift=carrying,
        reverse_thrust=thrust,
        energy_budget=budget,
        loggers=loggers,
        body=body,
        gears=tuple(gears),
        runway=runway,
        gravity=gravity,
    )


def _default_height(body: ModalBody, gears: Sequence[LandingGear]) -> float:
    """Height of the center of gravity in a default context, m: tires are off an even
    runway by `_OFF_GROUND`.
    """
    lowest = min(
        center[2] - gear.tire_of(wheel).radius
        for gear in gears
        for wheel, center in wheel_centers(gear).items()
    )
    return float(body.p_BG[2] - lowest) + _OFF_GROUND


def _connect_attachment(
    builder: DiagramBuilder,
    plant: MultibodyPlant,
    airframe: FlexibleAirframe,
    held: Attachment,
    forces: Any,
) -> None:
    connect(builder, plant, "state", held, "plant_state")
    for port in ("pose", "velocity", "free_acceleration", "compliance"):
        connect(builder, airframe, f"node_{port}", held, f"node_{port}")
    connect(builder, airframe, "pose", held, "airframe_pose")
    connect(builder, held, "wrench_on_airframe", airframe, "attachment_wrench")
    connect(builder, forces, "all_generalized_force", held, "generalized_force")
    both = builder.AddNamedSystem("all_forces", Adder(2, plant.num_velocities()))
    for i, (system, port) in enumerate(
        ((forces, "all_generalized_force"), (held, "generalized_force_on_gear"))
    ):
        builder.Connect(system.GetOutputPort(port), both.get_input_port(i))
    builder.Connect(
        both.get_output_port(), plant.GetInputPort("applied_generalized_force")
    )


def _add_loggers(
    builder: DiagramBuilder,
    systems: dict[str, LeafSystem],
    parts: GearSystems,
    bodies: dict[str, GearBodies],
) -> dict[str, VectorLogSink]:
    ports = {}
    for name, system in systems.items():
        kind = next(kind for kind in _LOGGED if name.startswith(kind))
        for port in _LOGGED[kind]:
            ports[f"{name}.{port}"] = system.GetOutputPort(port)
    for kind, mounted, wanted in (
        ("tire", parts.tires, _OF_TIRES),
        ("shock_absorber", parts.shock_absorbers, _OF_ABSORBERS),
    ):
        for port in wanted:
            each = each_of(builder, mounted, port)
            ports |= {f"{kind}_{name}.{port}": one for name, one in each.items()}
    for gear in parts.shock_absorbers:
        port = parts.wheel_kinematics.GetOutputPort(f"strut_{gear}")
        ports[f"strut_{gear}.strut"] = port
    for gear in [g for g, b in bodies.items() if b.hinges]:
        port = systems["elastic_legs"].GetOutputPort(f"deflection_{gear}")
        ports[f"elastic_legs.deflection_{gear}"] = port
    loggers = {name: LogVectorOutput(port, builder) for name, port in ports.items()}
    for name, logger in loggers.items():
        logger.set_name("log " + name.replace(".", " "))
    return loggers

"""The systems around a plant that make its landing gears work.

plant.state ─▸ wheel_kinematics ─▸ tires, shock_absorbers, brake_*, pitch_damper_*
─▸ gear_forces ─▸ plant
plant.state ─▸ elastic_legs ─▸ gear_forces
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, cast

from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import DiagramBuilder
from pydrake.systems.primitives import Demultiplexer

from drake_landing.gears.bodies import GearBodies
from drake_landing.gears.data import BogieGear, LandingGear
from drake_landing.gears.leg_laws import elastic_leg, hinge_columns
from drake_landing.gears.mounted import MountedShockAbsorber, MountedTire
from drake_landing.gears.parameters import (
    bogie_pitch_parameters,
    brake_parameters,
    shock_absorber_parameters,
    tire_parameters,
)
from systems.gear.bogie_pitch import BogiePitch
from systems.gear.brake import Brake
from systems.gear.elastic_legs import ElasticLegs
from systems.gear.gear_forces import GearForces
from systems.gear.lever_strut import LeverStrut
from systems.gear.wheel_kinematics import WheelKinematics
from systems.runway.runway import Runway
from systems.shock_absorber.shock_absorber import ShockAbsorber
from systems.shock_absorber.side_load import SideLoad
from systems.tire.tire import Tire


@dataclass(frozen=True, kw_only=True)
class GearSystems:
    """What `AddGearSystems` added.

    Attributes:
        wheel_kinematics, gear_forces, tire, shock_absorber: one each.
        tires: by wheel.
        shock_absorbers: by gear.
        brakes: by wheel; of gears that have them.
        pitch_dampers: by gear; of bogies.
        elastic_legs: one for all legs that are elastic; None where all are rigid.
    """

    wheel_kinematics: Any = field(repr=False)
    gear_forces: Any = field(repr=False)
    tire: Any = field(repr=False)
    shock_absorber: Any = field(repr=False)
    tires: dict[str, MountedTire] = field(repr=False)
    shock_absorbers: dict[str, MountedShockAbsorber] = field(repr=False)
    brakes: dict[str, Any] = field(repr=False)
    pitch_dampers: dict[str, Any] = field(repr=False)
    elastic_legs: Any = field(default=None, repr=False)

    @property
    def by_name(self) -> dict[str, Any]:
        """All that store or dissipate energy, by the names in the diagram."""
        kinds = {"brake": self.brakes, "pitch_damper": self.pitch_dampers}
        found = {"tires": self.tire, "shock_absorbers": self.shock_absorber}
        found |= {f"{k}_{n}": s for k, group in kinds.items() for n, s in group.items()}
        return found | (
            {"elastic_legs": self.elastic_legs} if self.elastic_legs else {}
        )


def AddGearSystems(
    builder: DiagramBuilder,
    plant: MultibodyPlant,
    gears: Sequence[LandingGear],
    bodies: Mapping[str, GearBodies],
    runway: Runway | None = None,
    brakes: bool = False,
    connect_plant: bool = True,
) -> GearSystems:
    """Adds tyres, shock absorbers and what connects them to a plant.

    They are named `wheel_kinematics`, `gear_forces`, `tires`, `shock_absorbers`, for
    gears that have them `brake_<wheel>` and `pitch_damper_<gear>`, where bearings rub
    `side_load`, and for all gears that bend `elastic_legs`. One connection is left to
    the caller: the port `spatial_forces` of `gear_forces` belongs to the
    plant's `applied_spatial_force`, alone or joined with other forces.

    Args:
        builder: that already holds the plant.
        plant: finalised.
        gears: data of the gears.
        bodies: what AddLandingGear returned for each, by name.
        runway: default flat and dry.
        brakes: applied from the start, on gears that have them; by default none are.
        connect_plant: False leaves both inputs of the plant to the caller, who may
            then use the port `all_generalized_force`, which holds the tyres' forces.

    Raises:
        ValueError: a parameter is out of range.
    """
    wheels = {n: b for gear in gears for n, b in bodies[gear.name].wheels.items()}
    struts = {gear.name: bodies[gear.name].strut for gear in gears}
    spins = {
        name: joint
        for gear in gears
        if gear.brake and brakes
        for name, joint in bodies[gear.name].spins.items()
    }
    pitches = {g.name: p for g in gears if (p := bodies[g.name].pitch) is not None}
    kinematics = builder.AddNamedSystem(
        "wheel_kinematics", WheelKinematics(plant, wheels, struts, spins, pitches)
    )
    legs = _add_elastic_legs(builder, plant, gears, bodies)
    forces = builder.AddNamedSystem(
        "gear_forces",
        GearForces(
            plant, wheels, struts, spins, pitches, elastic_legs=legs is not None
        ),
    )
    laws = [shock_absorber_parameters(gear.shock_absorber) for gear in gears]
    tire = builder.AddNamedSystem("tires", cast(Any, Tire)(_tires(gears), runway))
    absorber = builder.AddNamedSystem("shock_absorbers", cast(Any, ShockAbsorber)(laws))
    absorbers = [MountedShockAbsorber(absorber, i) for i in range(len(gears))]
    systems = GearSystems(
        wheel_kinematics=kinematics,
        gear_forces=forces,
        tire=tire,
        shock_absorber=absorber,
        tires={name: MountedTire(tire, i) for i, name in enumerate(wheels)},
        shock_absorbers=dict(zip(struts, absorbers)),
        brakes={},
        pitch_dampers={},
        elastic_legs=legs,
    )
    _connect(builder, plant, "state", kinematics, "plant_state")
    _connect(builder, kinematics, "wheels", tire, "wheel")
    _connect(builder, tire, "wrench", forces, "wrench")
    _connect(builder, kinematics, "struts", absorber, "strut_state")
    _connect(builder, absorber, "force", forces, "strut_force")
    if brakes:
        _add_brakes(builder, gears, systems)
    _add_pitch_dampers(builder, gears, systems)
    if any(gear.shock_absorber.bearing_friction > 0 for gear in gears):
        _add_side_load(builder, gears, systems)
    for name, strut in struts.items():
        if isinstance(strut, LeverStrut):
            ratio = f"strut_ratio_{name}"
            _connect(builder, kinematics, ratio, forces, f"ratio_{name}")
    _connect(builder, kinematics, "wheel_jacobian", forces, "wheel_jacobian")
    if legs is not None:
        _connect(builder, legs, "generalized_force", forces, "elastic_legs")
    if connect_plant:
        applied = "applied_generalized_force"
        _connect(builder, forces, "generalized_force", plant, applied)
    return systems


def _add_elastic_legs(
    builder: DiagramBuilder,
    plant: MultibodyPlant,
    gears: Sequence[LandingGear],
    bodies: Mapping[str, GearBodies],
) -> Any:
    elastic = [gear for gear in gears if bodies[gear.name].hinges]
    if not elastic:
        return None
    laws = {gear.name: elastic_leg(plant, gear, bodies[gear.name]) for gear in elastic}
    columns = {gear.name: hinge_columns(bodies[gear.name]) for gear in elastic}
    legs = ElasticLegs(plant, laws, columns)
    builder.AddNamedSystem("elastic_legs", legs)
    _connect(builder, plant, "state", legs, "plant_state")
    return legs


def each_of(
    builder: DiagramBuilder, system: Any, port: str, names: Sequence[str], title: str
) -> dict[str, Any]:
    """Output ports of equal size for each name, cut from one of a system.

    Args:
        builder: that holds the system.
        system: e.g. `tires`.
        port: whose vector is of one after the other.
        names: in that order.
        title: name of what cuts.
    """
    whole = system.GetOutputPort(port)
    cut = Demultiplexer([whole.size() // len(names)] * len(names))
    builder.AddNamedSystem(title, cut)
    builder.Connect(whole, cut.get_input_port())
    return {name: cut.get_output_port(i) for i, name in enumerate(names)}


def _tires(gears: Sequence[LandingGear]) -> list[Any]:
    found = []
    for gear in gears:
        common = tire_parameters(gear.tyre)
        for wheel in gear.wheel_names:
            single = gear.tyres.get(wheel)
            found.append(common if single is None else tire_parameters(single))
    return found


def _add_brakes(
    builder: DiagramBuilder, gears: Sequence[LandingGear], systems: GearSystems
) -> None:
    kinematics, forces = systems.wheel_kinematics, systems.gear_forces
    contacts: dict[str, Any] = {}
    for gear in gears:
        if gear.brake is None:
            continue
        law = brake_parameters(gear.brake)
        for wheel in gear.wheel_names:
            brake = builder.AddNamedSystem(f"brake_{wheel}", cast(Any, Brake)(law))
            systems.brakes[wheel] = brake
            _connect(builder, kinematics, f"spin_{wheel}", brake, "wheel_spin")
            _connect(builder, brake, "torque", forces, f"brake_{wheel}")
            if law.anti_skid:
                contacts = contacts or each_of(
                    builder, systems.tire, "contact", list(systems.tires), "skids"
                )
                builder.Connect(contacts[wheel], brake.GetInputPort("contact"))


def _add_pitch_dampers(
    builder: DiagramBuilder, gears: Sequence[LandingGear], systems: GearSystems
) -> None:
    for gear in gears:
        if not isinstance(gear, BogieGear):
            continue
        law = bogie_pitch_parameters(gear.pitch_damper)
        damper = cast(Any, BogiePitch)(law)
        name = gear.name
        systems.pitch_dampers[name] = damper
        builder.AddNamedSystem(f"pitch_damper_{name}", damper)
        _connect(builder, systems.wheel_kinematics, f"pitch_{name}", damper, "pitch")
        _connect(builder, damper, "torque", systems.gear_forces, f"pitch_{name}")


def _add_side_load(
    builder: DiagramBuilder, gears: Sequence[LandingGear], systems: GearSystems
) -> None:
    kinematics, brakes = systems.wheel_kinematics, systems.brakes
    struts = [
        dict(zip(gear.wheel_names, gear.wheel_offsets * len(gear.axles)))
        for gear in gears
    ]
    side_load = cast(Any, SideLoad)(struts, list(brakes))
    builder.AddNamedSystem("side_load", side_load)
    _connect(builder, kinematics, "strut_axes", side_load, "strut_axes")
    _connect(builder, kinematics, "wheels", side_load, "wheels")
    _connect(builder, systems.tire, "wrench", side_load, "wrench")
    for wheel, brake in brakes.items():
        _connect(builder, brake, "torque", side_load, f"brake_{wheel}")
    _connect(builder, side_load, "side_load", systems.shock_absorber, "side_load")


def _connect(
    builder: DiagramBuilder, source: Any, output: str, target: Any, port: str
) -> None:
    builder.Connect(source.GetOutputPort(output), target.GetInputPort(port))

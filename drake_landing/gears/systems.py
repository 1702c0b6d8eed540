"""The systems around a plant that make its landing gears work.

plant.state ─▸ wheel_kinematics ─▸ tire_*, shock_absorber_*, brake_*, pitch_damper_*
─▸ gear_forces ─▸ plant
plant.state ─▸ elastic_legs ─▸ gear_forces
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, cast

from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import DiagramBuilder

from drake_landing.gears.bodies import GearBodies
from drake_landing.gears.landing_gear import BogieGear, LandingGear
from drake_landing.gears.leg_laws import elastic_leg, hinge_columns
from drake_landing.gears.mounted import (
    MountedShockAbsorber,
    MountedTire,
    each_of,
    feed,
    joined,
    systems_of,
)
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
    """Systems that `AddGearSystems` added.

    Attributes:
        wheel_kinematics, gear_forces: one each.
        tires: by wheel.
        shock_absorbers: by gear.
        brakes: by wheel; of gears that have them.
        pitch_dampers: by gear; of bogies.
        elastic_legs: one for all legs that are elastic; None where all are rigid.
    """

    wheel_kinematics: Any = field(repr=False)
    gear_forces: Any = field(repr=False)
    tires: dict[str, MountedTire] = field(repr=False)
    shock_absorbers: dict[str, MountedShockAbsorber] = field(repr=False)
    brakes: dict[str, Any] = field(repr=False)
    pitch_dampers: dict[str, Any] = field(repr=False)
    elastic_legs: Any = field(default=None, repr=False)

    @property
    def by_name(self) -> dict[str, Any]:
        """All that store or dissipate energy, by the names in the diagram."""
        kinds = {"brake": self.brakes, "pitch_damper": self.pitch_dampers}
        found = systems_of(self.tires) | systems_of(self.shock_absorbers)
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
    together: bool = False,
) -> GearSystems:
    """Adds tires, shock absorbers and what connects them to a plant.

    They are named `wheel_kinematics`, `gear_forces`, `tire_<wheel>`,
    `shock_absorber_<gear>`, for gears that have them `brake_<wheel>` and
    `pitch_damper_<gear>`, where bearings rub `side_load`, and for all gears that bend
    `elastic_legs`. One connection is left to
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
            then use the port `all_generalized_force`, which holds the tires' forces.
        together: one system `tires` and one `shock_absorbers` in place of one for each
            wheel and gear: the same laws with fewer calls from Drake into Python, of
            which a landing makes some ten thousand.

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
    tires = _add_tires(builder, gears, runway, together)
    absorbers = _add_shock_absorbers(builder, gears, together)
    systems = GearSystems(
        wheel_kinematics=kinematics,
        gear_forces=forces,
        tires=tires,
        shock_absorbers=absorbers,
        brakes={},
        pitch_dampers={},
        elastic_legs=legs,
    )
    connect(builder, plant, "state", kinematics, "plant_state")
    if together:
        feed(builder, kinematics.GetOutputPort("wheels"), tires, "wheel")
        feed(builder, kinematics.GetOutputPort("struts"), absorbers, "strut_state")
    else:
        for name, tire in tires.items():
            connect(builder, kinematics, f"wheel_{name}", tire.system, "wheel")
        for name, one in absorbers.items():
            connect(builder, kinematics, f"strut_{name}", one.system, "strut_state")
    wrenches = joined(builder, tires, "wrench")
    builder.Connect(wrenches, forces.GetInputPort("wrench"))
    builder.Connect(
        joined(builder, absorbers, "force"), forces.GetInputPort("strut_force")
    )
    if brakes:
        _add_brakes(builder, gears, systems)
    _add_pitch_dampers(builder, gears, systems)
    if any(gear.shock_absorber.bearing_friction > 0 for gear in gears):
        _add_side_load(builder, gears, systems, wrenches)
    for name, strut in struts.items():
        if isinstance(strut, LeverStrut):
            ratio = f"strut_ratio_{name}"
            connect(builder, kinematics, ratio, forces, f"ratio_{name}")
    connect(builder, kinematics, "wheel_jacobian", forces, "wheel_jacobian")
    if legs is not None:
        connect(builder, legs, "generalized_force", forces, "elastic_legs")
    if connect_plant:
        applied = "applied_generalized_force"
        connect(builder, forces, "generalized_force", plant, applied)
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
    connect(builder, plant, "state", legs, "plant_state")
    return legs


def _add_tires(
    builder: DiagramBuilder,
    gears: Sequence[LandingGear],
    runway: Runway | None,
    together: bool,
) -> dict[str, MountedTire]:
    laws = {
        wheel: tire_parameters(gear.tyres.get(wheel, gear.tyre))
        for gear in gears
        for wheel in gear.wheel_names
    }
    if together:
        all_ = cast(Any, Tire)(list(laws.values()), runway)
        builder.AddNamedSystem("tires", all_)
        return {name: MountedTire(all_, i) for i, name in enumerate(laws)}
    each = {name: cast(Any, Tire)(law, runway) for name, law in laws.items()}
    for name, tire in each.items():
        builder.AddNamedSystem(f"tire_{name}", tire)
    return {name: MountedTire(tire, 0) for name, tire in each.items()}


def _add_shock_absorbers(
    builder: DiagramBuilder, gears: Sequence[LandingGear], together: bool
) -> dict[str, MountedShockAbsorber]:
    laws = {g.name: shock_absorber_parameters(g.shock_absorber) for g in gears}
    if together:
        all_ = cast(Any, ShockAbsorber)(list(laws.values()))
        builder.AddNamedSystem("shock_absorbers", all_)
        return {name: MountedShockAbsorber(all_, i) for i, name in enumerate(laws)}
    each = {name: cast(Any, ShockAbsorber)(law) for name, law in laws.items()}
    for name, one in each.items():
        builder.AddNamedSystem(f"shock_absorber_{name}", one)
    return {name: MountedShockAbsorber(one, 0) for name, one in each.items()}


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
            connect(builder, kinematics, f"spin_{wheel}", brake, "wheel_spin")
            connect(builder, brake, "torque", forces, f"brake_{wheel}")
            if law.anti_skid:
                contacts = contacts or each_of(builder, systems.tires, "contact")
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
        connect(builder, systems.wheel_kinematics, f"pitch_{name}", damper, "pitch")
        connect(builder, damper, "torque", systems.gear_forces, f"pitch_{name}")


def _add_side_load(
    builder: DiagramBuilder,
    gears: Sequence[LandingGear],
    systems: GearSystems,
    wrenches: Any,
) -> None:
    kinematics, brakes = systems.wheel_kinematics, systems.brakes
    struts = [
        dict(zip(gear.wheel_names, gear.wheel_offsets * len(gear.axles)))
        for gear in gears
    ]
    side_load = cast(Any, SideLoad)(struts, list(brakes))
    builder.AddNamedSystem("side_load", side_load)
    connect(builder, kinematics, "strut_axes", side_load, "strut_axes")
    connect(builder, kinematics, "wheels", side_load, "wheels")
    builder.Connect(wrenches, side_load.GetInputPort("wrench"))
    for wheel, brake in brakes.items():
        connect(builder, brake, "torque", side_load, f"brake_{wheel}")
    across = side_load.GetOutputPort("side_load")
    feed(builder, across, systems.shock_absorbers, "side_load")


def connect(
    builder: DiagramBuilder, source: Any, output: str, target: Any, port: str
) -> None:
    """Connects ports by their names."""
    builder.Connect(source.GetOutputPort(output), target.GetInputPort(port))

"""The systems around a plant that make its landing gears work.

plant.state ─▸ wheel_kinematics ─▸ tire_*, shock_absorber_*, brake_*,
pitch_damper_* ─▸ gear_forces ─▸ plant
plant.state ─▸ elastic_legs ─▸ gear_forces
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, cast

from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import DiagramBuilder

from drake_landing.gears.bodies import GearBodies
from drake_landing.gears.data import BogieGear, LandingGear
from drake_landing.gears.leg_laws import elastic_leg, hinge_columns
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
        wheel_kinematics, gear_forces: one each.
        tires: by wheel.
        shock_absorbers: by gear.
        brakes: by wheel; of gears that have them.
        pitch_dampers: by gear; of bogies.
        elastic_legs: one for all legs that are elastic; None where all are rigid.
    """

    wheel_kinematics: Any = field(repr=False)
    gear_forces: Any = field(repr=False)
    tires: dict[str, Any] = field(repr=False)
    shock_absorbers: dict[str, Any] = field(repr=False)
    brakes: dict[str, Any] = field(repr=False)
    pitch_dampers: dict[str, Any] = field(repr=False)
    elastic_legs: Any = field(default=None, repr=False)

    @property
    def by_name(self) -> dict[str, Any]:
        """All that store or dissipate energy, by the names in the diagram."""
        kinds = {
            "tire": self.tires,
            "shock_absorber": self.shock_absorbers,
            "brake": self.brakes,
            "pitch_damper": self.pitch_dampers,
        }
        found = {f"{k}_{n}": s for k, group in kinds.items() for n, s in group.items()}
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

    They are named `wheel_kinematics`, `gear_forces`, `tire_<wheel>`,
    `shock_absorber_<gear>`, for gears that have them `brake_<wheel>` and
    `pitch_damper_<gear>`, where bearings rub `side_load_<gear>`, and for all gears that
    bend `elastic_legs`. One connection is
    left to the caller: the port `spatial_forces` of `gear_forces` belongs to the
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
    systems = GearSystems(
        wheel_kinematics=kinematics,
        gear_forces=forces,
        tires={},
        shock_absorbers={},
        brakes={},
        pitch_dampers={},
        elastic_legs=legs,
    )
    for gear in gears:
        _add_laws(builder, gear, runway, systems)
        if gear.brake and brakes:
            _add_brakes(builder, gear, systems)

    _connect(builder, plant, "state", kinematics, "plant_state")
    for gear in gears:
        _connect_gear(builder, gear, systems)
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


def _add_laws(
    builder: DiagramBuilder,
    gear: LandingGear,
    runway: Runway | None,
    systems: GearSystems,
) -> None:
    tire, absorber, pitch = (
        cast(Any, kind) for kind in (Tire, ShockAbsorber, BogiePitch)
    )
    common = tire_parameters(gear.tyre)
    for wheel in gear.wheel_names:
        single = gear.tyres.get(wheel)
        law = common if single is None else tire_parameters(single)
        systems.tires[wheel] = builder.AddNamedSystem(
            f"tire_{wheel}", tire(law, runway)
        )
    systems.shock_absorbers[gear.name] = builder.AddNamedSystem(
        f"shock_absorber_{gear.name}",
        absorber(shock_absorber_parameters(gear.shock_absorber)),
    )
    if isinstance(gear, BogieGear):
        systems.pitch_dampers[gear.name] = builder.AddNamedSystem(
            f"pitch_damper_{gear.name}",
            pitch(bogie_pitch_parameters(gear.pitch_damper)),
        )


def _add_brakes(
    builder: DiagramBuilder, gear: LandingGear, systems: GearSystems
) -> None:
    assert gear.brake is not None
    law = brake_parameters(gear.brake)
    for wheel in gear.wheel_names:
        brake = builder.AddNamedSystem(f"brake_{wheel}", cast(Any, Brake)(law))
        systems.brakes[wheel] = brake


def _connect_gear(
    builder: DiagramBuilder, gear: LandingGear, systems: GearSystems
) -> None:
    kinematics, forces = systems.wheel_kinematics, systems.gear_forces
    name, absorber = gear.name, systems.shock_absorbers[gear.name]
    for wheel in gear.wheel_names:
        tire = systems.tires[wheel]
        _connect(builder, kinematics, f"wheel_{wheel}", tire, "wheel")
        _connect(builder, tire, "wrench", forces, f"tire_{wheel}")
        brake = systems.brakes.get(wheel)
        if brake is not None:
            _connect(builder, kinematics, f"spin_{wheel}", brake, "wheel_spin")
            _connect(builder, brake, "torque", forces, f"brake_{wheel}")
            if brake.parameters.anti_skid:
                _connect(builder, tire, "contact", brake, "contact")
    _connect(builder, kinematics, f"strut_{name}", absorber, "strut_state")
    _connect(builder, absorber, "force", forces, f"strut_{name}")
    if name in systems.pitch_dampers:
        damper = systems.pitch_dampers[name]
        _connect(builder, kinematics, f"pitch_{name}", damper, "pitch")
        _connect(builder, damper, "torque", forces, f"pitch_{name}")
    if gear.shock_absorber.bearing_friction > 0:
        _add_side_load(
            builder, gear, kinematics, systems.tires, systems.brakes, absorber
        )


def _add_side_load(
    builder: DiagramBuilder,
    gear: LandingGear,
    kinematics: Any,
    tires: dict[str, Any],
    brakes: dict[str, Any],
    absorber: Any,
) -> None:
    offsets = gear.wheel_offsets * len(gear.axles)
    wheels = dict(zip(gear.wheel_names, offsets))
    side_load = SideLoad(wheels, [name for name in wheels if name in brakes])
    builder.AddNamedSystem(f"side_load_{gear.name}", side_load)
    _connect(builder, kinematics, f"strut_axis_{gear.name}", side_load, "strut_axis")
    for wheel in gear.wheel_names:
        _connect(builder, kinematics, f"wheel_{wheel}", side_load, f"wheel_{wheel}")
        _connect(builder, tires[wheel], "wrench", side_load, f"tire_{wheel}")
        if wheel in brakes:
            _connect(builder, brakes[wheel], "torque", side_load, f"brake_{wheel}")
    _connect(builder, side_load, "side_load", absorber, "side_load")


def _connect(
    builder: DiagramBuilder, source: Any, output: str, target: Any, port: str
) -> None:
    builder.Connect(source.GetOutputPort(output), target.GetInputPort(port))

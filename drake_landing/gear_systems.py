"""The systems around a plant that make its landing gears work.

plant.state ─▸ wheel_kinematics ─▸ tire_*, shock_absorber_* ─▸ gear_forces ─▸ plant
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, cast

from pydrake.multibody.plant import MultibodyPlant
from pydrake.systems.framework import DiagramBuilder

from drake_landing.gear import LandingGear
from drake_landing.gear_bodies import GearBodies
from drake_landing.gear_parameters import shock_absorber_parameters, tire_parameters
from systems.gear_forces import GearForces
from systems.runway import Runway
from systems.shock_absorber import ShockAbsorber
from systems.side_load import SideLoad
from systems.tire import Tire
from systems.wheel_kinematics import WheelKinematics


@dataclass(frozen=True, kw_only=True)
class GearSystems:
    """What `AddGearSystems` added.

    Attributes:
        wheel_kinematics, gear_forces: one each.
        tires: by wheel.
        shock_absorbers: by gear.
    """

    wheel_kinematics: WheelKinematics = field(repr=False)
    gear_forces: GearForces = field(repr=False)
    tires: dict[str, Any] = field(repr=False)
    shock_absorbers: dict[str, Any] = field(repr=False)


def AddGearSystems(
    builder: DiagramBuilder,
    plant: MultibodyPlant,
    gears: Sequence[LandingGear],
    bodies: Mapping[str, GearBodies],
    runway: Runway | None = None,
) -> GearSystems:
    """Adds tyres, shock absorbers and what connects them to a plant.

    They are named `wheel_kinematics`, `gear_forces`, `tire_<wheel>`,
    `shock_absorber_<gear>` and, where bearings rub, `side_load_<gear>`. One connection
    is left to the caller: the port `spatial_forces` of `gear_forces` belongs to the
    plant's `applied_spatial_force`, alone or joined with other forces.

    Args:
        builder: that already holds the plant.
        plant: finalised.
        gears: data of the gears.
        bodies: what AddLandingGear returned for each, by name.
        runway: default flat and dry.

    Raises:
        ValueError: a parameter is out of range.
    """
    wheels = {n: b for gear in gears for n, b in bodies[gear.name].wheels.items()}
    struts = {gear.name: bodies[gear.name].strut for gear in gears}
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

    _connect(builder, plant, "state", kinematics, "plant_state")
    for name, system in tires.items():
        _connect(builder, kinematics, f"wheel_{name}", system, "wheel")
        _connect(builder, system, "wrench", forces, f"tire_{name}")
    for gear in gears:
        system = absorbers[gear.name]
        _connect(builder, kinematics, f"strut_{gear.name}", system, "strut_state")
        _connect(builder, system, "force", forces, f"strut_{gear.name}")
        if gear.shock_absorber.bearing_friction > 0:
            _add_side_load(builder, gear, kinematics, tires, system)
    _connect(builder, forces, "generalized_force", plant, "applied_generalized_force")
    return GearSystems(
        wheel_kinematics=kinematics,
        gear_forces=forces,
        tires=tires,
        shock_absorbers=absorbers,
    )


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


def _connect(
    builder: DiagramBuilder, source: Any, output: str, target: Any, port: str
) -> None:
    builder.Connect(source.GetOutputPort(output), target.GetInputPort(port))

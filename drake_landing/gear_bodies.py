"""The rigid bodies and joints of landing gears, added to a MultibodyPlant.

A fitting (free, or joined to the world by the caller), a piston on a prismatic strut,
and wheels on revolute joints about the axle. All body frames are parallel to the
airframe frame B in the extended gear: the fitting's origin is the attachment point, the
piston's the middle of the axle, a wheel's its centre.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    PrismaticJoint,
    RevoluteJoint,
    RigidBody,
    RotationalInertia,
    SpatialInertia,
    UnitInertia,
)

from drake_landing.gear import LandingGear, RigidPart

Float64 = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class GearBodies:
    """What `AddLandingGear` added.

    Attributes:
        fitting: `<gear>_fitting`.
        piston: `<gear>_piston`, with the axle.
        wheels: wheel name to body `<wheel>_wheel`.
        strut: `<gear>_strut`; its translation is the stroke.
        spins: wheel name to joint `<wheel>_spin`, about the y axis.
    """

    fitting: RigidBody
    piston: RigidBody
    wheels: dict[str, RigidBody]
    strut: PrismaticJoint
    spins: dict[str, RevoluteJoint]


def strut_axis(gear: LandingGear) -> Float64:
    """(3,) direction in B along which the piston moves in compression: upward."""
    rake = math.radians(gear.rake_deg)
    return np.array([math.sin(rake), 0.0, math.cos(rake)])


def AddLandingGear(
    plant: MultibodyPlant, gear: LandingGear, p_BA: npt.ArrayLike
) -> GearBodies:
    """Adds one landing gear to a plant that is not yet finalised.

    Args:
        plant: the plant.
        gear: the data of the gear.
        p_BA: (3,) attachment point, origin of the fitting, in B, m.

    Returns:
        Bodies and joints. The fitting is left without a joint: finalising the plant
        frees it, unless the caller joins it to something first.
    """
    attachment = np.asarray(p_BA, dtype=float)
    axle = np.array(gear.axle)
    fitting = plant.AddRigidBody(
        f"{gear.name}_fitting", _inertia(gear.fitting, attachment)
    )
    piston = plant.AddRigidBody(f"{gear.name}_piston", _inertia(gear.piston, axle))
    strut = plant.AddJoint(
        PrismaticJoint(
            f"{gear.name}_strut",
            _offset(plant, f"{gear.name}_cylinder", fitting, axle - attachment),
            piston.body_frame(),
            strut_axis(gear),
        )
    )
    wheels, spins = {}, {}
    for name, offset in zip(gear.wheel_names, gear.wheel_offsets):
        wheels[name] = plant.AddRigidBody(f"{name}_wheel", _wheel_inertia(gear))
        spins[name] = plant.AddJoint(
            RevoluteJoint(
                f"{name}_spin",
                _offset(plant, f"{name}_axle", piston, np.array([0.0, offset, 0.0])),
                wheels[name].body_frame(),
                [0.0, 1.0, 0.0],
            )
        )
    return GearBodies(
        fitting=fitting, piston=piston, wheels=wheels, strut=strut, spins=spins
    )


def _offset(plant: MultibodyPlant, name: str, body: RigidBody, p: Float64):
    return plant.AddFrame(FixedOffsetFrame(name, body.body_frame(), RigidTransform(p)))


def _inertia(part: RigidPart, origin: Float64) -> SpatialInertia:
    return SpatialInertia.MakeFromCentralInertia(
        part.mass, np.array(part.cg) - origin, RotationalInertia(*part.inertia)
    )


def _wheel_inertia(gear: LandingGear) -> SpatialInertia:
    wheel = gear.wheel
    across, about = wheel.transverse / wheel.mass, wheel.spin_inertia / wheel.mass
    return SpatialInertia(wheel.mass, np.zeros(3), UnitInertia(across, about, across))

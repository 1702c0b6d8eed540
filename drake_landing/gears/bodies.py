"""The rigid bodies and joints of landing gears, added to a MultibodyPlant.

A fitting (free, or joined to the world by the caller), what moves against it by the
kind of gear, and wheels on revolute joints about their axle:

    telescopic  fitting =prismatic= piston =revolute= wheels
    levered     fitting =revolute= arm =revolute= wheels
    bogie       fitting =prismatic= piston =revolute= beam =revolute= wheels

An elastic leg puts hinges between the fitting and the rest, for bending fore and aft
and to the side, and for torsion (`leg_hinges`).

All body frames are parallel to the airframe frame B in the extended gear, but that all
below the fitting of a steered gear are turned by its angle: the fitting's origin is the
attachment point, that of an arm or beam its pivot, a piston's the middle of the axle or
the beam's pivot, a wheel's its center.
"""

import math
from dataclasses import dataclass, field
from functools import singledispatch
from typing import cast

import numpy as np
import numpy.typing as npt
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    Frame,
    PrismaticJoint,
    RevoluteJoint,
    RigidBody,
    SpatialInertia,
    UnitInertia,
)

from drake_landing.gears.landing_gear import (
    BogieGear,
    LandingGear,
    LeveredGear,
    RigidPart,
    TelescopicGear,
)
from drake_landing.gears.leg_hinges import (
    add_leg_hinges,
    hinge_lines,
    last_bending,
    part_inertia,
)
from systems.gear.lever_strut import LeverStrut
from systems.tools.rotations import exp

Float64 = npt.NDArray[np.float64]

_LATERAL = [0.0, 1.0, 0.0]


@dataclass(frozen=True, kw_only=True)
class GearBodies:
    """Bodies and joints that `AddLandingGear` added.

    Attributes:
        fitting: `<gear>_fitting`.
        parts: what moves against it, by the names of `LandingGear.moving_parts`:
            `<gear>_piston`, `<gear>_arm`, `<gear>_beam`; the last bears the wheels.
        wheels: wheel name to body `<wheel>_wheel`.
        strut: `<gear>_strut`, a joint whose translation is the stroke, or the shock
            absorber over the joint `<gear>_pivot` of an arm.
        spins: wheel name to joint `<wheel>_spin`, about the y axis of the wheel.
        pitch: joint `<gear>_pitch` of a bogie beam, else None.
        hinges: of an elastic leg, by the names of `leg_hinges.KINDS`.
    """

    fitting: RigidBody
    parts: dict[str, RigidBody]
    wheels: dict[str, RigidBody]
    strut: PrismaticJoint | LeverStrut
    spins: dict[str, RevoluteJoint]
    pitch: RevoluteJoint | None = None
    hinges: dict[str, RevoluteJoint] = field(default_factory=dict)

    @property
    def joints(self) -> dict[str, PrismaticJoint | RevoluteJoint]:
        """Joints that settle under load, not the spins: strut, pitch, hinges."""
        strut = self.strut
        joint = strut.joint if isinstance(strut, LeverStrut) else strut
        pitch = {} if self.pitch is None else {"pitch": self.pitch}
        return {"strut": joint, **pitch, **self.hinges}


@dataclass(frozen=True)
class _Moving:
    """The bodies between fitting and wheels; `p_BO` is the origin of the last."""

    parts: dict[str, RigidBody]
    strut: PrismaticJoint | LeverStrut
    p_BO: Float64
    pitch: RevoluteJoint | None = None


def strut_axis(gear: LandingGear) -> Float64:
    """(3,) direction in B along which the piston moves in compression: upward.

    For a levered gear the direction of its extended shock absorber.
    """
    if isinstance(gear, LeveredGear):
        ends = [_steered(gear, p) for p in (gear.absorber_upper, gear.absorber_lower)]
        span = ends[0] - ends[1]
        return span / np.sqrt(span @ span)
    return _raked_axis(gear)


def leg_axis(gear: LandingGear) -> Float64:
    """(3,) direction in B about which a leg twists and is steered: upward."""
    return _raked_axis(gear)  # of a levered gear the up axis


def leg_lines(gear: LandingGear, p_BA: Float64) -> dict[str, tuple[Float64, Float64]]:
    """Hinges of an elastic leg: place (3,) (m) and unit vector (3,) of each in B."""
    return hinge_lines(gear, p_BA, _center(gear), leg_axis(gear))


def tip_below_root(gear: LandingGear, p_BA: Float64) -> float | None:
    """How far the tip of an elastic leg lies below its lowest root along the strut, m.

    The tip is the axle, of a bogie the pivot; None where nothing bends.
    """
    tip = gear.pivot if isinstance(gear, BogieGear) else gear.axles[0]
    roots = [p for k, (p, _) in leg_lines(gear, p_BA).items() if k != "torsion"]
    axis = leg_axis(gear)
    return min((float((p - np.array(tip)) @ axis) for p in roots), default=None)


def cylinder_body(gear: LandingGear, p_BA: Float64) -> tuple[str, Float64]:
    """The body that bends above the stroke, by name, and its origin (3,) in B, m."""
    kind = last_bending(gear)
    if kind is None:
        return f"{gear.name}_fitting", p_BA
    return f"{gear.name}_below_{kind}", leg_lines(gear, p_BA)[kind][0]


def steering(gear: LandingGear) -> RotationMatrix:
    """Turn of all below the fitting; nose to starboard is clockwise from above."""
    angle = math.radians(gear.steering_deg)
    if angle == 0.0:
        return RotationMatrix()
    axis = leg_axis(gear)
    return RotationMatrix(exp(-angle * axis[None])[0])


def wheel_centers(gear: LandingGear) -> dict[str, Float64]:
    """Wheel name -> (3,) center in B (x aft, y starboard), gear extended, m."""
    places = [
        _steered(gear, np.array(axle) + offset * np.array(_LATERAL))
        for axle in gear.axles
        for offset in gear.wheel_offsets
    ]
    return dict(zip(gear.wheel_names, places))


def mass_points(gear: LandingGear) -> list[tuple[float, Float64]]:
    """Mass (kg) and center of gravity (3,) in B (m) of each body, gear extended."""
    points = [(part.mass, np.array(part.cg)) for part in gear.sprung_parts.values()]
    parts = gear.moving_parts.values()
    points += [(part.mass, _steered(gear, part.cg)) for part in parts]
    return points + [(gear.wheel.mass, p) for p in wheel_centers(gear).values()]


def _raked_axis(gear: LandingGear) -> Float64:
    rake = math.radians(gear.rake_deg) if hasattr(gear, "rake_deg") else 0.0
    return np.array([math.sin(rake), 0.0, math.cos(rake)])


def _center(gear: LandingGear) -> Float64:
    """(3,) in B what the gear is steered about: pivot, or middle of the axle."""
    if isinstance(gear, LeveredGear | BogieGear):
        return np.array(gear.pivot)
    return np.array(gear.axles[0])


def _steered(gear: LandingGear, p_B: npt.ArrayLike) -> Float64:
    """A point below the fitting, where the steering has turned it to."""
    center = _center(gear)
    return center + steering(gear).matrix() @ (np.asarray(p_B) - center)


def AddLandingGear(
    plant: MultibodyPlant, gear: LandingGear, p_BA: npt.ArrayLike
) -> GearBodies:
    """Adds one landing gear to a plant that is not yet finalised.

    Args:
        plant: the plant.
        gear: the data of the gear, B being x aft, y to starboard, z up.
        p_BA: (3,) attachment point, origin of the fitting, in B, m.

    Returns:
        Bodies and joints. The fitting is left without a joint: finalising the plant
        frees it, unless the caller joins it to something first.

    Raises:
        ValueError: the shock absorber of a levered gear cannot do its stroke, or
            shortens as the wheels go down.
    """
    attachment = np.asarray(p_BA, dtype=float)
    fitting = plant.AddRigidBody(
        f"{gear.name}_fitting", part_inertia(gear.fitting, attachment)
    )
    leg = add_leg_hinges(
        plant, gear, fitting, attachment, center=_center(gear), axis=leg_axis(gear)
    )
    moving = _add_moving(gear, plant, leg.body, leg.p_BO)
    carrier = list(moving.parts.values())[-1]
    wheels, spins = {}, {}
    straight = gear.model_copy(update={"steering_deg": 0.0})
    for name, center in wheel_centers(straight).items():
        wheels[name] = plant.AddRigidBody(f"{name}_wheel", _wheel_inertia(gear))
        spins[name] = plant.AddJoint(
            RevoluteJoint(
                f"{name}_spin",
                _offset(plant, f"{name}_axle", carrier, center - moving.p_BO),
                wheels[name].body_frame(),
                _LATERAL,
            )
        )
    return GearBodies(
        fitting=fitting,
        parts=moving.parts,
        wheels=wheels,
        strut=moving.strut,
        spins=spins,
        pitch=moving.pitch,
        hinges=leg.hinges,
    )


@singledispatch
def _add_moving(
    gear: LandingGear, plant: MultibodyPlant, fitting: RigidBody, p_BA: Float64
) -> _Moving:
    """What moves against the fitting, or the body below its hinges; p_BA its origin."""
    raise TypeError(f"landing gear {gear.name}: unknown kind {type(gear).__name__}")


@_add_moving.register
def _(
    gear: TelescopicGear, plant: MultibodyPlant, fitting: RigidBody, p_BA: Float64
) -> _Moving:
    axle = np.array(gear.axle)
    piston, strut = _add_piston(plant, gear, gear.piston, axle, fitting, p_BA)
    return _Moving({"piston": piston}, strut, axle)


@_add_moving.register
def _(
    gear: LeveredGear, plant: MultibodyPlant, fitting: RigidBody, p_BA: Float64
) -> _Moving:
    pivot = np.array(gear.pivot)
    arm = plant.AddRigidBody(f"{gear.name}_arm", part_inertia(gear.arm, pivot))
    joint = plant.AddJoint(
        RevoluteJoint(
            f"{gear.name}_pivot",
            _offset(plant, f"{gear.name}_hinge", fitting, pivot - p_BA, steering(gear)),
            arm.body_frame(),
            _LATERAL,
        )
    )
    ends = np.array([gear.absorber_upper, gear.absorber_lower]) - pivot
    try:
        strut = LeverStrut.over(joint, *ends)
        strut.geometry.require_stroke(gear.shock_absorber.stroke)
    except ValueError as error:
        raise ValueError(f"landing gear {gear.name}: {error}") from None
    # Turning by dθ about y lifts the axle by -(x_axle - x_pivot) dθ.
    if -(gear.axle[0] - pivot[0]) * strut.geometry.ratio(0.0) <= 0.0:
        raise ValueError(
            f"landing gear {gear.name}: the shock absorber gets longer as the wheel "
            "goes up; expected absorber_upper and absorber_lower such that it shortens"
        )
    return _Moving({"arm": arm}, strut, pivot)


@_add_moving.register
def _(
    gear: BogieGear, plant: MultibodyPlant, fitting: RigidBody, p_BA: Float64
) -> _Moving:
    pivot = np.array(gear.pivot)
    piston, strut = _add_piston(plant, gear, gear.piston, pivot, fitting, p_BA)
    beam = plant.AddRigidBody(f"{gear.name}_beam", part_inertia(gear.beam, pivot))
    pitch = plant.AddJoint(
        RevoluteJoint(
            f"{gear.name}_pitch", piston.body_frame(), beam.body_frame(), _LATERAL
        )
    )
    pitch.set_default_angle(math.radians(gear.pitch_damper.trim_deg))
    return _Moving({"piston": piston, "beam": beam}, strut, pivot, pitch=pitch)


def _add_piston(
    plant: MultibodyPlant,
    gear: LandingGear,
    part: RigidPart,
    p_BP: Float64,
    fitting: RigidBody,
    p_BA: Float64,
) -> tuple[RigidBody, PrismaticJoint]:
    piston = plant.AddRigidBody(f"{gear.name}_piston", part_inertia(part, p_BP))
    strut = plant.AddJoint(
        PrismaticJoint(
            f"{gear.name}_strut",
            _offset(
                plant, f"{gear.name}_cylinder", fitting, p_BP - p_BA, steering(gear)
            ),
            piston.body_frame(),
            _raked_axis(gear),  # turned about itself
        )
    )
    return piston, cast(PrismaticJoint, strut)


def _offset(
    plant: MultibodyPlant,
    name: str,
    body: RigidBody,
    p: Float64,
    R: RotationMatrix | None = None,
) -> Frame:
    X = RigidTransform(R or RotationMatrix(), p)
    return plant.AddFrame(FixedOffsetFrame(name, body.body_frame(), X))


def _wheel_inertia(gear: LandingGear) -> SpatialInertia:
    wheel = gear.wheel
    across, about = wheel.transverse / wheel.mass, wheel.spin_inertia / wheel.mass
    return SpatialInertia(wheel.mass, np.zeros(3), UnitInertia(across, about, across))

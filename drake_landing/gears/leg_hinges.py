"""The hinges of an elastic leg, in a plant: bodies between fitting and strut.

    fitting =fore_aft= . =lateral= . =torsion= what moves

Fore and aft turns about the axis to port (lower end aft > 0), lateral about the axis
aft and across the strut (lower end to starboard > 0), torsion about the strut axis, up.
The bodies between are massless but for the cylinder, where there is one, which is above
the torsion. The hinges of bending lie at the root, that of torsion on the strut axis.
All frames are parallel to B in the extended gear.
"""

from dataclasses import dataclass, field
from typing import cast

import numpy as np
import numpy.typing as npt
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    FixedOffsetFrame,
    RevoluteJoint,
    RigidBody,
    RotationalInertia,
    SpatialInertia,
)

from drake_landing.gears import leg_matrix
from drake_landing.gears.landing_gear import LandingGear, RigidPart
from drake_landing.gears.leg_beam import root_distance
from drake_landing.gears.legs import Leg

Float64 = npt.NDArray[np.float64]

KINDS = ("fore_aft", "lateral", "torsion")
_LATERAL = np.array([0.0, 1.0, 0.0])
# Stroke over the mechanical one where the hinge has the slope of a beam's axle.
_REFERENCE_STROKE = 0.5


@dataclass(frozen=True)
class LegHinges:
    """The hinges; `p_BO` is the origin in B of the body below them."""

    body: RigidBody
    p_BO: Float64
    hinges: dict[str, RevoluteJoint] = field(default_factory=dict)


def hinge_axis(kind: str, axis: Float64) -> Float64:
    """(3,) unit vector in B of a hinge; `axis` (3,) is the strut's, up."""
    if kind == "torsion":
        return axis
    return -_LATERAL if kind == "fore_aft" else np.cross(_LATERAL, axis)


def add_leg_hinges(
    plant: MultibodyPlant,
    gear: LandingGear,
    fitting: RigidBody,
    p_BA: Float64,
    *,
    center: Float64,
    axis: Float64,
) -> LegHinges:
    """Adds the hinges of a gear's leg; a rigid leg has none.

    Args:
        plant: not yet finalised.
        gear: its data.
        fitting: of the gear, origin at p_BA (3,), m.
        center: (3,) in B, axle or pivot, through which the strut axis passes.
        axis: (3,) in B, of the strut, up.
    """
    body, origin, hinges = fitting, p_BA, {}
    for kind, (place, about) in hinge_lines(gear, p_BA, center, axis).items():
        inertia = SpatialInertia.Zero()
        if gear.cylinder is not None and kind == last_bending(gear):
            inertia = part_inertia(gear.cylinder, place)
        lower = plant.AddRigidBody(f"{gear.name}_below_{kind}", inertia)
        X = RigidTransform(place - origin)
        frame = FixedOffsetFrame(f"{gear.name}_{kind}_root", body.body_frame(), X)
        joint = RevoluteJoint(
            f"{gear.name}_{kind}",
            plant.AddFrame(frame),
            lower.body_frame(),
            about,
        )
        hinges[kind] = cast(RevoluteJoint, plant.AddJoint(joint))
        body, origin = lower, place
    return LegHinges(body, origin, hinges)


def hinge_lines(
    gear: LandingGear, p_BA: Float64, center: Float64, axis: Float64
) -> dict[str, tuple[Float64, Float64]]:
    """Hinges of a gear's leg: place (3,) and unit vector (3,) in B; see above."""
    return {
        kind: (_root(gear, kind, p_BA, center, axis), hinge_axis(kind, axis))
        for kind in elastic_kinds(gear.leg)
    }


def last_bending(gear: LandingGear) -> str | None:
    """The hinge below which the cylinder hangs; None where no bending is elastic."""
    kinds = [kind for kind in elastic_kinds(gear.leg) if kind != "torsion"]
    return kinds[-1] if kinds else None


def part_inertia(part: RigidPart, p_BO: Float64) -> SpatialInertia:
    """Inertia of a part about a body's origin at p_BO (3,), along the axes of B."""
    return SpatialInertia.MakeFromCentralInertia(
        part.mass, np.array(part.cg) - p_BO, RotationalInertia(*part.inertia)
    )


def elastic_kinds(leg: Leg | None) -> tuple[str, ...]:
    """Kinds of elasticity (`KINDS`) that a leg has."""
    if leg is None:
        return ()
    if leg.reduced is not None:
        raise ValueError(
            "leg.reduced: its files have not been read yet, expected gears from "
            "drake_landing.reduced.legs.with_read_legs"
        )
    if leg.matrix is not None:
        return KINDS
    beam = KINDS[:2] if leg.beam is not None else ()
    return tuple(k for k in KINDS if k in beam or getattr(leg, k) is not None)


def _root(
    gear: LandingGear, kind: str, p_BA: Float64, center: Float64, axis: Float64
) -> Float64:
    """(3,) where a hinge lies in B."""
    leg = gear.leg
    assert leg is not None
    if kind == "torsion":
        return center + ((p_BA - center) @ axis) * axis
    if leg.beam is not None:
        stroke = _REFERENCE_STROKE * gear.shock_absorber.stroke
        above = stroke + root_distance(leg.beam, stroke, kind == "lateral")
        return center + above * axis
    if leg.matrix is not None:
        K, about = np.array(leg.matrix.stiffness), hinge_axis(kind, axis)
        return center + leg_matrix.root_distance(K, about, axis) * axis
    return p_BA if leg.root is None else np.array(leg.root)

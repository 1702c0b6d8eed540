"""Stiffness and damping of a leg's hinges over the stroke: from data and the plant.

With h the deflection of the axle across the strut per angle of the hinge, and I the
inertia about the hinge that swings (root clamped, shock absorber locked, wheels and
bogie beam free to turn, the other hinges locked):

    given                          K of the hinge
    stiffness k at the axle        k h²
    frequency f                    (2π f)² I, of f extended at every stroke
    beam, f deflection per force   h²/f
    matrix at the axle             see `leg_matrix`, the same at every stroke
    torsion                        as given, or (2π f)² I

Damping is 2 ζ √(K I). h and I are taken from the finished plant, so that there is one
description of the gear.
"""

import math
from typing import cast

import numpy as np
import numpy.typing as npt
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import JacobianWrtVariable, PrismaticJoint, RevoluteJoint
from pydrake.systems.framework import Context

from drake_landing.gears.bodies import AddLandingGear, GearBodies, leg_axis
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.leg_beam import deflection_per_force
from drake_landing.gears.leg_hinges import KINDS, hinge_axis
from drake_landing.gears.leg_matrix import hinge_stiffness
from drake_landing.gears.legs import Elastic, LegBeam, LegMatrix
from systems.gear.elastic_legs import ElasticLeg
from systems.gear.lever_strut import LeverStrut
from systems.tools.table import Table

Float64 = npt.NDArray[np.float64]
Law = Elastic | LegBeam | LegMatrix

# Positions of the strut at which K and C are tabled: linear between them.
_POSITIONS = 33


def elastic_leg(
    plant: MultibodyPlant, gear: LandingGear, bodies: GearBodies
) -> ElasticLeg:
    """The law of a leg that has hinges.

    Args:
        plant: finalised.
        gear, bodies: data, and what AddLandingGear returned for them.

    Raises:
        ValueError: the root of the leg lies at the height of the axle.
    """
    leg, kinds = gear.leg, tuple(bodies.hinges)
    assert leg is not None
    context = plant.CreateDefaultContext()
    end = _position(bodies, gear.shock_absorber.stroke)
    stiffness = np.zeros((_POSITIONS, len(kinds), len(kinds)))
    damping = np.zeros_like(stiffness)
    extended: dict[str, float] = {}
    if leg.matrix is not None:
        whole = _matrix_stiffness(plant, gear, bodies, context)
    for i, position in enumerate(np.linspace(0.0, end, _POSITIONS).tolist()):
        stroke = _set_position(bodies, context, position)
        for j, kind in enumerate(kinds):
            inertia = _swinging_inertia(plant, bodies, kind, context)
            extended.setdefault(kind, inertia)
            arm = 1.0 if kind == "torsion" else _arm(plant, gear, bodies, kind, context)
            law = cast(Law, getattr(leg, kind) or leg.beam or leg.matrix)
            if isinstance(law, LegMatrix):
                stiffness[i], k = whole, whole[j, j]
            elif isinstance(law, LegBeam):
                lateral = kind == "lateral"
                k = arm * arm / deflection_per_force(law, stroke, lateral)
            else:
                k = _stiffness(law, stroke, arm, inertia, extended[kind])
            stiffness[i, j, j] = k
            damping[i, j, j] = 2.0 * law.damping_ratio * math.sqrt(k * inertia)
    play = [
        leg.torsion.free_play_deg if leg.torsion and kind == "torsion" else 0.0
        for kind in kinds
    ]
    return ElasticLeg(
        hinges=tuple(bodies.hinges.values()),
        strut=_joint(bodies),
        start=0.0,
        end=end,
        stiffness=stiffness,
        damping=damping,
        free_play=np.radians(play),
    )


def leg_oscillators(gear: LandingGear, p_BA: Float64) -> dict[str, tuple[float, float]]:
    """Each motion of the extended leg by itself: hinge -> angular frequency, damping.

    Args:
        gear: any; a rigid leg has no motion.
        p_BA: (3,) where the airframe holds it, m.

    Returns:
        rad/s, and the ratio to critical damping.
    """
    if gear.leg is None:
        return {}
    plant = MultibodyPlant(0.0)
    bodies = AddLandingGear(plant, gear, p_BA)
    plant.Finalize()
    law, context = elastic_leg(plant, gear, bodies), plant.CreateDefaultContext()
    found = {}
    for j, kind in enumerate(bodies.hinges):
        inertia = _swinging_inertia(plant, bodies, kind, context)
        rate = math.sqrt(law.stiffness[0, j, j] / inertia)
        found[kind] = rate, law.damping[0, j, j] / (2.0 * rate * inertia)
    return found


def _matrix_stiffness(
    plant: MultibodyPlant, gear: LandingGear, bodies: GearBodies, context: Context
) -> Float64:
    """(3, 3) K of the hinges from the stiffness at the axle of the extended leg."""
    assert gear.leg is not None
    assert gear.leg.matrix is not None
    axis = leg_axis(gear)
    arms = [_arm(plant, gear, bodies, kind, context) for kind in KINDS[:2]]
    return hinge_stiffness(
        np.array(gear.leg.matrix.stiffness),
        np.array([hinge_axis(kind, axis) for kind in KINDS]),
        axis,
        np.array([*arms, 1.0]),
    )


def hinge_columns(bodies: GearBodies) -> list[int]:
    """Place of each hinge in (fore and aft, lateral, torsion)."""
    return [KINDS.index(kind) for kind in bodies.hinges]


def _stiffness(
    law: Elastic, stroke: float, arm: float, inertia: float, extended: float
) -> float:
    """K of a hinge, N m/rad."""
    if law.stiffness is not None:
        return law.stiffness * arm * arm
    if law.stiffness_table is not None:
        return _over(law.stiffness_table, stroke) * arm * arm
    if law.frequency is not None:
        return (2.0 * math.pi * law.frequency) ** 2 * extended
    assert law.frequency_table is not None  # the data's own validation
    return (2.0 * math.pi * _over(law.frequency_table, stroke)) ** 2 * inertia


def _over(table: list[tuple[float, float]], stroke: float) -> float:
    return Table(*map(tuple, zip(*table))).value(stroke)


def _joint(bodies: GearBodies) -> PrismaticJoint | RevoluteJoint:
    return bodies.joints["strut"]


def _position(bodies: GearBodies, stroke: float) -> float:
    strut = bodies.strut
    return strut.geometry.angle(stroke) if isinstance(strut, LeverStrut) else stroke


def _set_position(bodies: GearBodies, context: Context, position: float) -> float:
    """Moves the joint of the strut, and returns the stroke, m."""
    strut = bodies.strut
    if isinstance(strut, LeverStrut):
        strut.joint.set_angle(context, position)
        return strut.geometry.stroke(position)
    strut.set_translation(context, position)
    return position


def _swinging_inertia(
    plant: MultibodyPlant, bodies: GearBodies, kind: str, context: Context
) -> float:
    """About a hinge, what is free to turn left behind, kg m²."""
    free = [joint.velocity_start() for joint in bodies.spins.values()]
    free += [] if bodies.pitch is None else [bodies.pitch.velocity_start()]
    row = bodies.hinges[kind].velocity_start()
    mass = plant.CalcMassMatrix(context)
    coupling = mass[free, row]
    return mass[row, row] - coupling @ np.linalg.solve(
        mass[np.ix_(free, free)], coupling
    )


def _arm(
    plant: MultibodyPlant,
    gear: LandingGear,
    bodies: GearBodies,
    kind: str,
    context: Context,
) -> float:
    """Deflection of the axle in the direction of bending per angle of the hinge, m."""
    body = list(bodies.parts.values())[-1].body_frame()
    at = np.zeros(3)
    if "arm" in bodies.parts:
        at = np.array(gear.axles[0]) - np.array(gear.pivot)
    world = plant.world_frame()
    jacobian = plant.CalcJacobianTranslationalVelocity(
        context, JacobianWrtVariable.kV, body, at, world, world
    )
    axis = leg_axis(gear)
    across = np.cross(axis, hinge_axis(kind, axis))  # where the lower end goes
    arm = float(jacobian[:, bodies.hinges[kind].velocity_start()] @ across)
    if not arm > 0.0:
        raise ValueError(
            f"landing gear {gear.name}: leg.root lies {-arm:.4g} m below the axle, "
            "expected it above"
        )
    return arm

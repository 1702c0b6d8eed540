"""Book cases on the full model: what ground and inertia of a gear leave at its hold.

The aircraft is rigid for its motion: with the ground's loads F and the mass M of
airframe and gears, the acceleration is a = M⁻¹ F. A gear hands to the airframe what the
ground gives it less what its own mass takes, f = F_gear - M_gear a, and the airframe's
own inertia balances the sum of these: the acceleration of its inertia relief is a
again. Weight needs no loads of its own: where the ground carries the aircraft, a is
the 1 g that gravity would have been; where lift carries it, the state of 1 g is added.

A hold in six directions has one split of f; of more directions the one in which the
elastic airframe, and elastic stays, stay compatible with the rigid fitting.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from drake_landing.conditions.build import OnGround
from drake_landing.conditions.ground import BookCase
from drake_landing.conditions.masses import acceleration_under
from drake_landing.conditions.statics import resultant
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.parts.slices import balanced
from fem.arrays import Float64, Int64
from fem.model.structure import Structure


@dataclass(frozen=True, kw_only=True, eq=False)
class RigidBalance:
    """A book case on the rigid aircraft; A.

    Attributes:
        case: which.
        ground: (6,) all loads, about the center of gravity.
        center: (3,) center of gravity, m.
        acceleration: (6,) of it, and angular.
        factors: (3,) load factors of the ground: aft, to starboard, up, G.
        handed: gear -> (6,) load on the airframe, about the origin.
        error: force and moment that ground and all inertia leave, over the largest.
    """

    case: BookCase
    ground: Float64
    center: Float64
    acceleration: Float64
    factors: Float64
    handed: Mapping[str, Float64] = field(repr=False)
    error: float


def rigid_balance(state: OnGround, case: BookCase) -> RigidBalance:
    """Accelerations, and what each gear hands to the airframe."""
    posed = state.poses[case.pose]
    R, center = posed.R_AG, posed.whole.center
    force, moment = resultant(case.loads, posed.places)
    ground = np.r_[R @ force, R @ moment]
    acceleration = acceleration_under(posed.whole, ground)
    handed = {}
    for name, mass in posed.gears.items():
        own = [one for one in case.loads if one.gear == name]
        f, m = resultant(own, posed.places)
        load = np.r_[R @ f, R @ m] - mass.inertia_load(acceleration, center)
        load[3:] += np.cross(center, load[:3])
        handed[name] = load
    rest = state.airframe.inertia_load(acceleration, center)
    rest[3:] += np.cross(center, rest[:3])
    left = sum(handed.values()) - rest
    scale = np.maximum(np.abs(list(handed.values())).max(axis=0), 1e-30)
    size = np.r_[np.full(3, scale[:3].max()), np.full(3, scale[3:].max())]
    return RigidBalance(
        case=case,
        ground=ground,
        center=center,
        acceleration=acceleration,
        factors=R.T @ acceleration[:3] / state.aircraft.gravity,
        handed=handed,
        error=float(np.abs(left / size).max()),
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class Holds:
    """How the airframe holds its gears, and what it answers to loads there.

    Attributes:
        node_id: (k,) nodes.
        pattern: (6 k, h) from loads along the held directions to loads on the nodes, B.
        gear: (h,) gear of each direction.
        resultant: (6, h) of a unit load about the origin, B.
        compliance: (h,) of elastic stays, m/N.
        displacement, motion: (f, h) answers of the airframe by inertia relief.
    """

    node_id: Int64
    pattern: Float64
    gear: Sequence[str]
    resultant: Float64
    compliance: Float64
    displacement: Float64 = field(repr=False)
    motion: Float64 = field(repr=False)
    seen: Float64 = field(repr=False)  # (h, h) displacements along the directions

    def split(self, handed: Mapping[str, Float64]) -> Float64:
        """(h,) loads along the directions from what each gear hands over, (6,), B.

        Raises:
            ValueError: a gear's directions do not hold it.
        """
        found = np.zeros(len(self.gear))
        free = []  # self-balanced loads of each gear
        for name, load in handed.items():
            own = np.array([g == name for g in self.gear])
            held = self.resultant[:, own]
            part, _, rank, _ = np.linalg.lstsq(held, load, rcond=1e-10)
            if rank < 6:
                raise ValueError(
                    f"gears.{name}: held in {rank} independent directions, expected 6"
                )
            found[own] = part
            for null in np.linalg.svd(held)[2][6:]:
                whole = np.zeros(len(self.gear))
                whole[own] = null
                free.append(whole)
        if not free:
            return found
        N = np.array(free).T
        yielding = self.seen + np.diag(self.compliance)
        return (
            found
            - N
            @ np.linalg.lstsq(
                N.T @ yielding @ N, N.T @ (yielding @ found), rcond=1e-12
            )[0]
        )


def holds(structure: Structure, gears: Sequence[LandingGear]) -> Holds:
    """Solves the airframe under a unit load along every held direction.

    Args:
        structure: the full model, free.
        gears: in B.
    """
    nodes = np.unique([n for g in gears for n in g.attachments.values()])
    row = {int(n): 6 * i for i, n in enumerate(nodes)}
    columns, owner, compliance = [], [], []

    def add(gear: str, node: int, direction: Float64, soft: float = 0.0) -> None:
        column = np.zeros(6 * len(nodes))
        column[row[node] : row[node] + 6] = direction
        columns.append(column)
        owner.append(gear)
        compliance.append(soft)

    for gear in gears:
        count = 6 if gear.attachment == "rigid" else 3
        for direction in np.eye(6)[:count]:
            add(gear.name, gear.attachment_node, direction)
        for hold in gear.further_attachments:
            for vector in hold.directions:
                unit = np.array(vector, float) / np.linalg.norm(vector)
                soft = 1.0 / hold.stiffness if hold.stiffness else 0.0
                add(gear.name, hold.node, np.r_[unit, np.zeros(3)], soft)
    pattern = np.array(columns).T
    places = structure.points.xyz[structure.points.rows(nodes)]
    about = np.zeros((6, 6 * len(nodes)))
    for i, p in enumerate(places):
        block = np.eye(6)
        block[3:, :3] = [[0, -p[2], p[1]], [p[2], 0, -p[0]], [-p[1], p[0], 0]]
        about[:, 6 * i : 6 * i + 6] = block
    operator = structure.operator(nodes, frame="basic")
    answer = balanced(structure, np.asarray(operator.T @ pattern))
    return Holds(
        node_id=nodes.astype(np.int64),
        pattern=pattern,
        gear=owner,
        resultant=about @ pattern,
        compliance=np.array(compliance),
        displacement=answer.displacement,
        motion=answer.motion,
        seen=pattern.T @ (operator @ answer.displacement),
    )

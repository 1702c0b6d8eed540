"""`GroundAircraft` of a case: gears with their roles, loads and poses."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from drake_landing.case.conditions import Conditions
from drake_landing.conditions.ground import Gear, GroundAircraft, PoseName, Role
from drake_landing.conditions.masses import RigidMass
from drake_landing.conditions.peaks import Peak, Peaks, given_peak
from drake_landing.conditions.poses import Deflections, GearStand, Posed
from drake_landing.gears.landing_gear import Brake, LandingGear
from fem.arrays import Float64
from fem.errors import InputError, nearest
from systems.airframe.modal_body import ModalBody

_MIDDLE = 0.05  # m, nearer to the plane of symmetry a gear has no side


@dataclass(frozen=True, kw_only=True, eq=False)
class OnGround:
    """The aircraft as the rules see it, its airframe, its masses in the poses; A."""

    aircraft: GroundAircraft
    airframe: RigidMass
    poses: Mapping[PoseName, Posed] = field(repr=False)


def on_ground(
    body: ModalBody,
    gears: Sequence[LandingGear],
    R_AB: Float64,
    conditions: Conditions,
    peaks: Peaks | None = None,
) -> OnGround:
    """The aircraft on the ground.

    Args:
        body: of the airframe, A; its modes are not used.
        gears: in B.
        R_AB: (3, 3).
        conditions: of the case.
        peaks: of the landings; None: those that the case gives, or none.

    Raises:
        InputError: unknown gears in `conditions`, or the aircraft cannot stand.
    """
    _check_names(gears, conditions)
    stand = GearStand(body, gears, R_AB)
    rest, static, at_rest = stand.at_rest()
    peaks = _given(gears, conditions, peaks or Peaks())
    roles = {g.name: _role(g.name, rest, conditions) for g in gears}
    poses: dict[PoseName, Posed] = {"static": rest}
    level, down = (
        math.radians(pitch)
        for pitch in (conditions.level_pitch, conditions.tail_down_pitch)
    )
    largest = {g.name: _deflections(g, peaks.level, at_rest) for g in gears}
    for gear in gears:  # a nose gear has its own landing
        if roles[gear.name] == "nose":
            largest[gear.name] = _deflections(gear, peaks.all_wheels, at_rest)
    tail_down = {g.name: _deflections(g, peaks.tail_down, at_rest) for g in gears}
    poses["largest"] = stand.at(largest, level)
    every = {g.name: _deflections(g, peaks.all_wheels, at_rest) for g in gears}
    poses["all_wheels"] = stand.on_all_wheels(every)
    poses["reduced"] = stand.at({n: d.scaled(0.75) for n, d in largest.items()}, level)
    poses["tail_down"] = stand.at(tail_down, down)
    poses["extended"] = stand.at(stand.extended(), level)
    aircraft = GroundAircraft(
        mass=rest.whole.mass,
        design=conditions.weight,
        gears=tuple(
            _gear(
                gear,
                roles[gear.name],
                static[gear.name],
                float(np.mean(list(at_rest[gear.name].tire.values()))),
                peaks,
                stand,
            )
            for gear in gears
        ),
        poses={name: posed.places for name, posed in poses.items()},
        steering_torque=conditions.steering_torque,
        pitch_damping=conditions.pitch_damping,
        wing_area=conditions.wing_area,
        stall_speed=conditions.stall_speed,
    )
    return OnGround(aircraft=aircraft, airframe=stand.airframe, poses=poses)


def _check_names(gears: Sequence[LandingGear], conditions: Conditions) -> None:
    names = [gear.name for gear in gears]
    problems = [
        f"conditions.{field}.{name}: no gear has this name, expected one of "
        f"{', '.join(names)}{nearest(name, names)}"
        for field in ("vertical", "roles")
        for name in getattr(conditions, field)
        if name not in names
    ]
    if problems:
        raise InputError(problems)


def _role(name: str, rest: Posed, conditions: Conditions) -> Role:
    """Role of a gear: main off the middle, else by its place to the main gears."""
    places = rest.places
    x, y, _ = places[name].ground
    if name in conditions.roles:
        role = conditions.roles[name]
        if (role == "nose" and x > 0.0) or (role == "tail" and x < 0.0):
            raise InputError(
                f"conditions.roles.{name}: found {role}, but this gear is "
                f"{abs(x):.3g} m {'aft' if x > 0.0 else 'ahead'} of the center of "
                f"gravity, expected {'tail' if x > 0.0 else 'nose'} or main"
            )
        return role
    sides = [p.ground[0] for p in places.values() if abs(p.ground[1]) > _MIDDLE]
    if abs(y) > _MIDDLE or not sides:
        return "main"
    if x < min(sides) and x < 0.0 <= max(sides):
        return "nose"
    if x > max(sides) and min(sides) <= 0.0 < x:
        return "tail"
    return "main"


def _given(gears: Sequence[LandingGear], conditions: Conditions, peaks: Peaks) -> Peaks:
    """Loads that the case gives stand for all landings."""
    given = {
        g.name: given_peak(g, conditions.vertical[g.name])
        for g in gears
        if g.name in conditions.vertical
    }
    return Peaks(
        level={**peaks.level, **given},
        all_wheels={**peaks.all_wheels, **given},
        tail_down={**peaks.tail_down, **given},
    )


def _deflections(
    gear: LandingGear, peaks: Mapping[str, Peak], rest: Mapping[str, Deflections]
) -> Deflections:
    return peaks[gear.name].at if gear.name in peaks else rest[gear.name]


def _gear(
    gear: LandingGear,
    role: Role,
    static: float,
    flat: float,
    peaks: Peaks,
    stand: GearStand,
) -> Gear:
    level = peaks.all_wheels if role == "nose" else peaks.level
    peak = level.get(gear.name)
    every, down = peaks.all_wheels.get(gear.name), peaks.tail_down.get(gear.name)
    places = np.array(_wheel_places(gear))
    away = places - places.mean(axis=0)
    tire = gear.tire_of(gear.wheel_names[0])
    count = len(gear.wheel_names)
    return Gear(
        name=gear.name,
        role=role,
        static=static,
        largest=peak and peak.vertical,
        all_wheels=every and every.vertical,
        tail_down=down and down.vertical,
        time_to_peak=peak.time if peak and peak.time > 0.0 else None,
        brake_torque=count * _torque(gear.brake),
        radius=tire.radius - flat,
        spin_inertia=count * gear.wheel.spin_inertia,
        wheels=count,
        scrub=float(np.linalg.norm(away[:, :2], axis=1).mean()),
        unsprung=stand.unsprung(gear.name).mass,
    )


def _wheel_places(gear: LandingGear) -> list[tuple[float, float]]:
    """Wheels seen from above, fore and aft and across; all axles level."""
    along = [float(np.linalg.norm(np.subtract(a, gear.axles[0]))) for a in gear.axles]
    return [(x, y) for x in along for y in gear.wheel_offsets]


def _torque(brake: Brake | None) -> float:
    """The most that a brake gives, N m."""
    if brake is None:
        return 0.0
    if brake.torque is not None:
        return brake.torque
    return max(torque for _, torque in brake.torque_table or [(0.0, 0.0)])

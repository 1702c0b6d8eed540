"""CS-25 (14 CFR 25) ground handling 25.491 to 25.519 as static load cases.

No lift. Where the ground's reactions do not balance the aircraft, its inertia does.
"""

import math
from collections.abc import Iterator

import numpy as np

from drake_landing.conditions.ground import (
    BookCase,
    Gear,
    GearLoad,
    GroundAircraft,
    load,
)
from drake_landing.conditions.landing25 import SIDES
from drake_landing.conditions.statics import reactions
from fem.arrays import Float64

FRICTION = 0.8
POUND_FORCE = 4.4482216152605
BRAKED_FACTOR = {"landing": 1.2, "take_off": 1.0}
TURN = 0.5
REVERSED, REVERSED_TORQUE = 0.55, 1.2
STEERED_NOSE = 1.33
JACK, JACK_SIDE = 1.33, 0.33
TAXI = 1.7
TOW_MAIN, TOW_OBLIQUE, TOW_SWIVELLED = 0.75, 30.0, 0.5
FLAT = ((1, 2, 0.6, "one"), (2, 4, 0.5, "two"))


def at_rest(aircraft: GroundAircraft) -> dict[str, float]:
    """Vertical loads at rest, N."""
    return reactions(aircraft.gears, aircraft.poses["static"], aircraft.weight)


def taxi(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.491 by the discrete load of AMC 25.491: 1.7 times the loads at rest."""
    yield BookCase(
        paragraph="25.491",
        name="1.7 times the loads at rest",
        loads=tuple(
            load(g, "ground", vertical=TAXI * z)
            for g, z in _rest(aircraft, aircraft.gears)
        ),
        pose="static",
        note="discrete load of AMC 25.491; profiles: scenario.runway.profile",
    )


def braked_roll(aircraft: GroundAircraft, factor: float = 1.0) -> Iterator[BookCase]:
    """25.493(b): drag 0.8 of the vertical load, or what the brakes give.

    (1) on all gears without pitching acceleration, (2) on the main gears alone.
    """
    n = BRAKED_FACTOR[aircraft.design] * factor
    if aircraft.nose or aircraft.tail:
        loads = braked_reactions(aircraft, n * aircraft.weight)
        name = "all gears, no pitching" if aircraft.nose else "all gears"
        yield BookCase(
            paragraph="25.493(b)(1)",
            name=f"braked, {name}, n = {n:g}",
            loads=loads,
            pose="static",
        )
    rest = dict(_rest(aircraft, aircraft.mains))
    share = n * aircraft.weight / sum(rest.values())
    yield BookCase(
        paragraph="25.493(b)(2)",
        name=f"braked, main gears, n = {n:g}",
        loads=tuple(
            load(g, "ground", vertical=share * z, drag=braked_drag(g, share * z))
            for g, z in rest.items()
        ),
        pose="static",
    )


def sudden_braking(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.493(d), (e): brakes at once; the nose gear's load by the formula of (e).

    The main gears carry the rest of the weight, with the drag of the steady state; what
    does not balance accelerates the aircraft in pitch.
    """
    nose = aircraft.nose
    assert nose is not None
    steady = {one.gear: one for one in braked_reactions(aircraft, aircraft.weight)}
    down = sudden_nose_load(aircraft)
    mains = sum(steady[g.name].force[2] for g in aircraft.mains)
    share = (aircraft.weight - down) / mains
    loads = [load(nose, "ground", vertical=down)]
    loads += [
        load(
            gear,
            "ground",
            vertical=share * steady[gear.name].force[2],
            drag=steady[gear.name].force[0],
        )
        for gear in aircraft.mains
    ]
    yield BookCase(
        paragraph="25.493(e)",
        name="brakes at once",
        loads=tuple(loads),
        pose="static",
        note=f"f = {dynamic_factor(aircraft.pitch_damping):.3g}",
    )


def dynamic_factor(damping: float | None) -> float:
    """f of 25.493(e): 2.0, or by the damping ζ of pitching about the main wheels."""
    if damping is None:
        return 2.0
    return 1.0 + math.exp(-math.pi * damping / math.sqrt(1.0 - damping**2))


def sudden_nose_load(aircraft: GroundAircraft) -> float:
    """V_N = W/(A+B) [B + f µ A E/(A + B + µ E)] of 25.493(e), N."""
    assert aircraft.nose is not None
    places = aircraft.poses["static"]
    forward = -places[aircraft.nose.name].ground[0]
    behind, _, below = _middle(aircraft)
    height, mu = -below, FRICTION
    f = dynamic_factor(aircraft.pitch_damping)
    more = f * mu * forward * height / (forward + behind + mu * height)
    return aircraft.weight / (forward + behind) * (behind + more)


def braked_drag(gear: Gear, vertical: float) -> float:
    """0.8 of the vertical load, no more than the brakes give, none without, N."""
    if not gear.brake_torque:
        return 0.0
    return min(FRICTION * vertical, gear.brake_torque / gear.radius)


def braked_reactions(aircraft: GroundAircraft, weight: float) -> tuple[GearLoad, ...]:
    """All gears on the ground under brakes, in equilibrium in pitch."""
    limited: dict[str, float] = {}
    places = aircraft.poses["static"]
    while True:
        free = [g for g in aircraft.braked if g.name not in limited]
        found = reactions(
            aircraft.gears,
            places,
            weight,
            ratios={gear.name: (FRICTION, 0.0) for gear in free},
            further=[load(name, "ground", drag=d) for name, d in limited.items()],
        )
        over = [
            g for g in free if braked_drag(g, found[g.name]) < FRICTION * found[g.name]
        ]
        if not over:
            break
        limited |= {g.name: g.brake_torque / g.radius for g in over}
    drag = {g.name: FRICTION * found[g.name] for g in aircraft.braked} | limited
    return tuple(
        load(g, "ground", vertical=found[g.name], drag=drag.get(g.name, 0.0))
        for g in aircraft.gears
    )


def turning(aircraft: GroundAircraft, factor: float = 1.0) -> Iterator[BookCase]:
    """25.495: side loads of half the vertical load on every wheel, n = 1."""
    for sign, toward in SIDES:
        ratio = sign * TURN * factor
        z = reactions(
            aircraft.gears,
            aircraft.poses["static"],
            aircraft.weight,
            ratios={gear.name: (0.0, ratio) for gear in aircraft.gears},
        )
        lifted = [name for name, value in z.items() if value < 0.0]
        yield BookCase(
            paragraph="25.495",
            name=f"turn, load to {toward}",
            loads=tuple(
                load(g, "ground", vertical=z[g.name], side=ratio * z[g.name])
                for g in aircraft.gears
                if g.name not in lifted
            ),
            pose="static",
            note=f"{', '.join(lifted)} would lift: inertia takes the rest"
            * bool(lifted),
        )


def tail_wheel_yaw(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.497: the tail wheel's load at rest, and as much to the side."""
    tail = aircraft.tail
    assert tail is not None
    for sign, toward in SIDES:
        for at, how in (("axle", "swivelled 90°"), ("ground", "trailing, locked")):
            yield BookCase(
                paragraph="25.497",
                name=f"tail wheel {how}, load to {toward}",
                loads=tuple(
                    load(g, at, vertical=z, side=sign * z)
                    if g is tail
                    else load(g, "ground", vertical=z)
                    for g, z in _rest(aircraft, aircraft.gears)
                ),
                pose="static",
            )


def nose_yaw(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.499(a): 0.8 of the nose gear's load at rest to the side, at the ground."""
    for sign, toward in SIDES:
        yield BookCase(
            paragraph="25.499(a)",
            name=f"nose wheel yawed, load to {toward}",
            loads=tuple(
                load(
                    g,
                    "ground",
                    vertical=z,
                    side=sign * FRICTION * z * (g is aircraft.nose),
                )
                for g, z in _rest(aircraft, aircraft.gears)
            ),
            pose="static",
        )


def one_side_braked(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.499(b), (c): brakes of one side; the nose wheel holds the heading.

    Loads of the nose wheel from equilibrium, no side load factor at the centre of
    gravity: the main wheels take the opposite side load. Beyond 0.8 of the nose
    wheel's vertical load inertia takes the yawing moment.
    """
    nose, places = aircraft.nose, aircraft.poses["static"]
    assert nose is not None
    for sign, side in SIDES:
        braked = [g for g in aircraft.braked if aircraft.side(g) == sign]
        if not braked:
            continue
        z = reactions(
            aircraft.gears,
            places,
            aircraft.weight,
            ratios={gear.name: (FRICTION, 0.0) for gear in braked},
        )
        drag = {g.name: FRICTION * z[g.name] for g in braked}
        yaw = -sum(places[name].ground[1] * d for name, d in drag.items())
        base = _middle(aircraft)[0] - places[nose.name].ground[0]
        # Y at the nose and -Y at the main wheels turn by -Y (x_main - x_nose).
        wanted = yaw / base
        most = FRICTION * z[nose.name]
        given = float(np.clip(wanted, -most, most))
        mains = sum(z[g.name] for g in aircraft.mains)
        loads = [
            load(
                g,
                "ground",
                vertical=z[g.name],
                drag=drag.get(g.name, 0.0),
                side=given
                if g is nose
                else -given * z[g.name] / mains * (g.role == "main"),
            )
            for g in aircraft.gears
        ]
        capped = (
            f"nose side load limited to 0.8 of its vertical load, {most / 1e3:.4g} kN"
        )
        yield BookCase(
            paragraph="25.499(b)",
            name=f"brakes to {side} only",
            loads=tuple(loads),
            pose="static",
            note=capped * bool(abs(wanted) > most),
        )


def steering(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.499(e): the full steering torque, with 1.33 times the nose gear's load."""
    torque = aircraft.steering_torque
    assert torque is not None
    for sign, toward in SIDES:
        yield BookCase(
            paragraph="25.499(e)",
            name=f"steering torque, nose to {toward}",
            loads=tuple(
                load(g, "ground", vertical=STEERED_NOSE * z, turning=-sign * torque)
                if g is aircraft.nose
                else load(g, "ground", vertical=z)
                for g, z in _rest(aircraft, aircraft.gears)
            ),
            pose="static",
        )


def pivoting(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.503: one main gear's brakes locked, its wheels scrub about their middle.

    The torque 0.8 Z times the mean distance of the wheels from their middle is held by
    side loads of the nose (tail) gear and, opposite, of the locked gear.
    """
    places = aircraft.poses["static"]
    rest = dict(_rest(aircraft, aircraft.gears))
    steered = aircraft.nose or aircraft.tail
    for gear in aircraft.mains:
        if not gear.brake_torque:
            continue
        torque = FRICTION * rest[gear] * gear.scrub
        for sign, toward in SIDES:
            turn = sign * torque
            arm = 0.0
            if steered is not None:
                arm = places[steered.name].ground[0] - places[gear.name].ground[0]
            side = -turn / arm if arm else 0.0
            loads = []
            for g, z in rest.items():
                locked = g is gear
                y = side * (g is steered) - side * locked
                loads.append(
                    load(g, "ground", vertical=z, side=y, turning=turn * locked)
                )
            yield BookCase(
                paragraph="25.503",
                name=f"pivoting about {gear.name}, torque to {toward}",
                loads=tuple(loads),
                pose="static",
                note="one wheel: no torque but that of its footprint, left out"
                * (gear.scrub == 0.0),
            )


def reversed_braking(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.507: 0.55 of the vertical load forward at every braked wheel."""
    loads = []
    for g, z in _rest(aircraft, aircraft.gears):
        torque = REVERSED_TORQUE * g.brake_torque / g.radius
        loads.append(load(g, "ground", vertical=z, drag=-min(REVERSED * z, torque)))
    yield BookCase(
        paragraph="25.507", name="reversed braking", loads=tuple(loads), pose="static"
    )


def towing_load(weight: float) -> float:
    """F_TOW of the ramp weight, N: 0.3 W, (6 W + 450 000)/70, 0.15 W in pounds."""
    pounds = weight / POUND_FORCE
    if pounds < 30e3:
        return 0.3 * weight
    if pounds > 100e3:
        return 0.15 * weight
    return (6.0 * pounds + 450e3) / 70.0 * POUND_FORCE


def towing(
    aircraft: GroundAircraft, factor: float = 1.0, whole: float | None = None
) -> Iterator[BookCase]:
    """25.509: 0.75 F on each main gear, F or 0.5 F on the nose (tail) gear.

    The towing fitting is taken at the axle. Reacted (i) at the axle of the towed wheel,
    up to its vertical load, and by inertia, or (ii) by inertia alone; the side load of
    a main gear at its ground line. `whole` is F where another rule sets it.
    """
    tow = factor * (whole or towing_load(aircraft.weight))
    for degrees, toward in (
        (0.0, ""),
        (TOW_OBLIQUE, " starboard"),
        (-TOW_OBLIQUE, " port"),
    ):
        for pull, way in ((-1.0, "forward"), (1.0, "aft")):
            angle = f" at 30° to{toward}" if degrees else ""
            yield from _towed(
                aircraft,
                {gear.name: TOW_MAIN * tow for gear in aircraft.mains},
                pull,
                degrees,
                f"main gears, {way}{angle}",
            )
    for gear in aircraft.of("nose", "tail"):
        for pull, way in ((-1.0, "forward"), (1.0, "aft")):
            name = f"{gear.name}, {way}"
            yield from _towed(aircraft, {gear.name: tow}, pull, 0.0, name)
            for degrees in (45.0, -45.0):
                swivelled = f"{name}, wheel turned {degrees:+g}°"
                load_ = {gear.name: TOW_SWIVELLED * tow}
                yield from _towed(aircraft, load_, pull, degrees, swivelled)


def _towed(
    aircraft: GroundAircraft,
    pull: dict[str, float],
    sense: float,
    degrees: float,
    name: str,
) -> Iterator[BookCase]:
    """One direction of the tow, with both reactions."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    roles = {gear.name: gear.role for gear in aircraft.gears}
    rest = _rest(aircraft, aircraft.gears)
    for at_axle, how in ((True, "(i) held at the axle"), (False, "(ii) by inertia")):
        loads = [load(g, "ground", vertical=z) for g, z in rest]
        for g, z in rest:
            if g.name not in pull:
                continue
            force = sense * pull[g.name] * np.array([c, s, 0.0])
            loads.append(GearLoad(gear=g.name, at="axle", force=force))
            held = force.copy()
            if roles[g.name] == "main":
                loads.append(load(g, "ground", side=-force[1]))
                held[1] = 0.0
            size = float(np.linalg.norm(held))
            if at_axle and size > 0.0:
                held *= min(1.0, z / size)
                loads.append(GearLoad(gear=g.name, at="axle", force=-held))
        yield BookCase(
            paragraph="25.509",
            name=f"towed at {name}, {how}",
            loads=tuple(loads),
            pose="static",
        )


def flat_tire_handling(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.511(e), (f): side and drag factors up to 50 and 40 %, n = 1; tow 60, 50 %."""
    for flat, enough, tow, word in FLAT:
        if not any(gear.wheels >= enough for gear in aircraft.mains):
            continue
        cases = [*turning(aircraft, 0.5), *_less_drag(aircraft, flat)]
        for case in cases:
            yield _renamed(case, "25.511(e)", f"{word} flat: {case.title}")
        for case in towing(aircraft, tow):
            yield _renamed(case, "25.511(f)", f"{word} flat: {case.title}")


def _less_drag(aircraft: GroundAircraft, flat: int) -> Iterator[BookCase]:
    """Braked roll, n = 1: 40 % of the drag, no less than that of the inflated tires."""
    rest = dict(_rest(aircraft, aircraft.mains))
    share = aircraft.weight / sum(rest.values())
    kept = {g: max(0.4, 1.0 - flat / max(g.wheels, flat)) for g in rest}
    yield BookCase(
        paragraph="25.493(b)(2)",
        name="braked, main gears, n = 1",
        loads=tuple(
            load(
                g,
                "ground",
                vertical=share * z,
                drag=kept[g] * braked_drag(g, share * z),
            )
            for g, z in rest.items()
        ),
        pose="static",
    )


def jacking(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.519(b)(1): 1.33 of the load at rest at a gear, alone and with 0.33 aside."""
    ways = {
        "": (0.0, 0.0),
        ", aft": (1.0, 0.0),
        ", forward": (-1.0, 0.0),
        ", starboard": (0.0, 1.0),
        ", port": (0.0, -1.0),
    }
    rest = _rest(aircraft, aircraft.gears)
    for gear in aircraft.gears:
        for way, (x, y) in ways.items():
            yield BookCase(
                paragraph="25.519(b)(1)",
                name=f"jacked at {gear.name}{way}",
                loads=tuple(
                    load(
                        g,
                        "axle",
                        vertical=JACK * z,
                        drag=x * JACK_SIDE * z,
                        side=y * JACK_SIDE * z,
                    )
                    if g is gear
                    else load(g, "ground", vertical=z)
                    for g, z in rest
                ),
                pose="static",
            )


def _rest(
    aircraft: GroundAircraft, gears: tuple[Gear, ...]
) -> list[tuple[Gear, float]]:
    loads = at_rest(aircraft)
    return [(gear, loads[gear.name]) for gear in gears]


def _middle(aircraft: GroundAircraft) -> Float64:
    """(3,) of the main gears' ground points, by their loads at rest, G, m."""
    loads, places = at_rest(aircraft), aircraft.poses["static"]
    points = np.array([places[g.name].ground for g in aircraft.mains])
    return np.average(points, axis=0, weights=[loads[g.name] for g in aircraft.mains])


def _renamed(case: BookCase, paragraph: str, name: str) -> BookCase:
    return BookCase(
        paragraph=paragraph,
        name=name,
        loads=case.loads,
        pose=case.pose,
        lift=case.lift,
        note=case.note,
    )

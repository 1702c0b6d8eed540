"""CS-23 (14 CFR 23 before Amendment 64) ground loads as static load cases.

Landing: the factor n_g of the ground's reaction is that of a landing at
4.4 (W/S)^¼ ft/s, between 7 and 10, with lift of two thirds of the weight; no less than
23.473(g) asks for. n = n_g + L/W is that of the inertia.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from drake_landing.conditions.ground import (
    BookCase,
    Gear,
    GearLoad,
    GroundAircraft,
    load,
)
from drake_landing.conditions.landing25 import SIDES
from drake_landing.conditions.paragraph import largest
from drake_landing.conditions.rolling25 import (
    braked_drag,
    braked_reactions,
    brakes_note,
)
from drake_landing.conditions.statics import at_rest, reactions, resting
from drake_landing.conditions.towing25 import POUND_FORCE, towing
from drake_landing.conditions.turning25 import pivoting
from drake_landing.landing.lift import STANDARD_GRAVITY

FOOT = 0.3048
LIFT = 2.0 / 3.0
LEAST_N, LEAST_GROUND = 2.67, 2.0
SIDE_N, SIDE_INWARD, SIDE_OUTWARD = 1.33, 0.5, 0.33
BRAKED_N = 1.33
NOSE_Z, NOSE_AFT, NOSE_FORWARD, NOSE_SIDE = 2.25, 0.8, 0.4, 0.7
STEERED = 1.33
JACK, JACK_SIDE = 1.35, 0.4
TOW = 0.3
FLAT = 0.6


def sink_rate(mass: float, wing_area: float) -> float:
    """23.473(d): 4.4 (W/S)^¼ ft/s, lb and ft², between 7 and 10 ft/s; in m/s."""
    loading = mass * STANDARD_GRAVITY / POUND_FORCE / (wing_area / FOOT**2)
    return FOOT * min(max(4.4 * loading**0.25, 7.0), 10.0)


def ground_factor(aircraft: GroundAircraft) -> float:
    """n_g: largest vertical loads over the weight, no less than 23.473(g) asks for."""
    found = sum(largest(g) for g in aircraft.mains) / aircraft.weight
    return max(found, LEAST_GROUND, LEAST_N - LIFT)


def drag_factor(weight: float) -> float:
    """K of Appendix C: 0.25 up to 3000 lb, 0.33 from 6000 lb, linear between."""
    pounds = weight / POUND_FORCE
    return float(np.interp(pounds, (3000.0, 6000.0), (0.25, 0.33)))


def drag_ratio(aircraft: GroundAircraft) -> float:
    """Drag over vertical load, K n / (n - L/W)."""
    ground = ground_factor(aircraft)
    return drag_factor(aircraft.weight) * (ground + LIFT) / ground


def level(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.479 with the drag of Appendix C: main gears alone, and all gears."""
    total, ratio = ground_factor(aircraft) * aircraft.weight, drag_ratio(aircraft)
    yield BookCase(
        paragraph="23.479",
        name="level, nose wheel clear" if aircraft.nose else "level, main wheels",
        loads=tuple(
            load(g, "axle", vertical=z, drag=ratio * z)
            for g, z in _shared(aircraft, total).items()
        ),
        pose="largest",
        lift=LIFT,
    )
    if aircraft.nose is None:
        return
    ratios = {g.name: (ratio, 0.0) for g in aircraft.gears}
    places = aircraft.poses["all_wheels"]
    found = reactions(aircraft.gears, places, total, ratios=ratios, at="axle")
    yield BookCase(
        paragraph="23.479",
        name="level, all wheels, inclined reactions",
        loads=tuple(
            load(g, "axle", vertical=found[g.name], drag=ratio * found[g.name])
            for g in aircraft.gears
        ),
        pose="all_wheels",
        lift=LIFT,
    )


def spin_up(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """Appendix D: spin-up of the main wheels, and the same load forward."""
    total = ground_factor(aircraft) * aircraft.weight
    speed = aircraft.stall_speed
    assert speed is not None
    for sense, name in ((1.0, "spin-up"), (-1.0, "spring-back")):
        yield BookCase(
            paragraph="23.479(c)",
            name=f"{name} by Appendix D",
            loads=tuple(
                load(g, "axle", vertical=z, drag=sense * spin_up_load(g, z, speed))
                for g, z in _shared(aircraft, total).items()
            ),
            pose="largest",
            lift=LIFT,
        )


def spin_up_load(gear: Gear, vertical: float, stall_speed: float) -> float:
    """F_H of Appendix D, N: √(2 I V_H µ F_V / t) / r, no more than 0.8 F_V.

    V_H is 1.2 V_S0, t the time to the largest vertical load.
    """
    assert gear.time_to_peak is not None
    energy = 2.0 * gear.spin_inertia * 1.2 * stall_speed * 0.8 * vertical
    found = math.sqrt(energy / gear.time_to_peak) / gear.radius
    return min(found, 0.8 * vertical)


def tail_down(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.481: vertical loads alone; with a tail wheel on all three."""
    total = ground_factor(aircraft) * aircraft.weight
    shares = _shared(aircraft, total)
    if aircraft.tail is not None:
        found = reactions(aircraft.gears, aircraft.poses["tail_down"], total)
        shares = {g: found[g.name] for g in aircraft.gears}
    yield BookCase(
        paragraph="23.481",
        name="tail-down",
        loads=tuple(load(g, "axle", vertical=z) for g, z in shares.items()),
        pose="tail_down",
        lift=LIFT,
    )


def one_wheel(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.483: one main gear with its load of 23.479."""
    first = next(level(aircraft))
    for one in first.loads:
        yield BookCase(
            paragraph="23.483",
            name=f"one gear, {one.gear}",
            loads=(one,),
            pose="largest",
            lift=LIFT,
        )


def side(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.485: n = 1.33 shared equally; 0.5 W inward on one side, 0.33 W outward."""
    count = {s: sum(aircraft.side(g) == s for g in aircraft.mains) for s in (-1.0, 1.0)}
    for sign, toward in SIDES:
        loads = []
        for gear in aircraft.mains:
            at = aircraft.side(gear)
            share = {-sign: SIDE_INWARD, sign: SIDE_OUTWARD}.get(at, 0.0)
            y = sign * share * aircraft.weight / count.get(at, 1)
            z = SIDE_N * aircraft.weight / len(aircraft.mains)
            loads.append(load(gear, "ground", vertical=z, side=y))
        yield BookCase(
            paragraph="23.485",
            name=f"side load to {toward}",
            loads=tuple(loads),
            pose="static",
            note="no lift: the ground carries 1.33 W, inertia balances all of it",
        )


def braked_roll(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.493: n = 1.33, drag 0.8 of the vertical load or what the brakes give."""
    total = BRAKED_N * aircraft.weight
    loads = tuple(
        load(g, "ground", vertical=z, drag=braked_drag(g, z))
        for g, z in _shared(aircraft, total).items()
    )
    yield BookCase(
        paragraph="23.493",
        name="braked, main gears",
        loads=loads,
        pose="static",
        note=brakes_note(aircraft, loads),
    )
    if aircraft.nose:
        loads = braked_reactions(aircraft, total)
        yield BookCase(
            paragraph="23.493",
            name="braked, all gears",
            loads=loads,
            pose="static",
            note=brakes_note(aircraft, loads),
        )


def tail_wheel(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.497: an obstruction, 45° up and aft; the load at rest to the side."""
    tail = aircraft.tail
    assert tail is not None
    landing = next(tail_down(aircraft))
    reaction = next(one.force[2] for one in landing.loads if one.gear == tail.name)
    along = reaction / math.sqrt(2.0)
    yield BookCase(
        paragraph="23.497(a)",
        name="tail wheel, obstruction",
        loads=(load(tail, "axle", vertical=along, drag=along),),
        pose="tail_down",
        lift=LIFT,
    )
    rest = at_rest(aircraft)
    for sign, toward in SIDES:
        yield BookCase(
            paragraph="23.497(b)",
            name=f"tail wheel, load to {toward}",
            loads=tuple(
                load(g, "axle", vertical=rest[g.name], side=sign * rest[g.name])
                if g is tail
                else load(g, "ground", vertical=rest[g.name])
                for g in aircraft.gears
            ),
            pose="static",
        )


def nose_wheel(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.499: 2.25 times the load at rest, with 0.8 aft, 0.4 forward or 0.7 aside."""
    nose, rest = aircraft.nose, at_rest(aircraft)
    assert nose is not None
    z = NOSE_Z * rest[nose.name]
    ways = {
        "aft": load(nose, "axle", vertical=z, drag=NOSE_AFT * z),
        "forward": load(nose, "axle", vertical=z, drag=-NOSE_FORWARD * z),
        "starboard": load(nose, "ground", vertical=z, side=NOSE_SIDE * z),
        "port": load(nose, "ground", vertical=z, side=-NOSE_SIDE * z),
    }
    for toward, one in ways.items():
        yield BookCase(
            paragraph="23.499",
            name=f"nose wheel, load {toward}",
            loads=(one, *_others_at_rest(aircraft, nose)),
            pose="static",
        )


def steering(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.499(e): 1.33 times the steering torque and the load at rest."""
    nose, torque = aircraft.nose, aircraft.steering_torque
    assert nose is not None
    assert torque is not None
    z = STEERED * at_rest(aircraft)[nose.name]
    for sign, toward in SIDES:
        turned = load(nose, "ground", vertical=z, turning=-sign * STEERED * torque)
        yield BookCase(
            paragraph="23.499(e)",
            name=f"steering torque, nose to {toward}",
            loads=(turned, *_others_at_rest(aircraft, nose)),
            pose="static",
        )


def jacking(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.507: 1.35 of the load at rest at a gear, with 0.4 fore, aft and aside."""
    rest = at_rest(aircraft)
    for gear in aircraft.gears:
        z = rest[gear.name]
        for x in (0.0, 1.0, -1.0):
            for y in (0.0, 1.0, -1.0):
                words = {0.0: "", 1.0: ", aft", -1.0: ", forward"}[x]
                words += {0.0: "", 1.0: ", starboard", -1.0: ", port"}[y]
                one = load(
                    gear,
                    "axle",
                    vertical=JACK * z,
                    drag=JACK_SIDE * x * z,
                    side=JACK_SIDE * y * z,
                    what="jack",
                )
                yield BookCase(
                    paragraph="23.507",
                    name=f"jacked at {gear.name}{words}",
                    loads=(one, *_others_at_rest(aircraft, gear)),
                    pose="static",
                )


def towing23(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.509: as 25.509 with F = 0.3 W: 0.225 W at each main gear, 0.15 W at 45°."""
    for case in towing(aircraft, whole=TOW * aircraft.weight):
        yield replace(case, paragraph="23.509")


def pivoting23(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.511(a): as 25.503."""
    for case in pivoting(aircraft):
        yield replace(case, paragraph="23.511(a)")


def unequal_tires(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """23.511(b), (c): 60 to 40 % on twin wheels; one flat tire."""
    twins = {g.name: g.scrub for g in aircraft.mains if g.wheels == 2}
    landing = [*level(aircraft), *tail_down(aircraft), *one_wheel(aircraft)]
    for case in landing:
        for sign, toward in SIDES:
            loads = []
            for one in case.loads:
                arm = np.array([0.0, sign * 0.2 * twins.get(one.gear, 0.0), 0.0])
                moment = one.moment + np.cross(arm, one.force)
                loads.append(
                    GearLoad(gear=one.gear, at=one.at, force=one.force, moment=moment)
                )
            name = f"60 % on {toward} wheels: {case.title}"
            yield replace(case, paragraph="23.511(b)", name=name, loads=tuple(loads))
    several = {g.name for g in aircraft.mains if g.wheels > 1}
    handling = [*side(aircraft)]
    handling += braked_roll(aircraft) if aircraft.braked else []
    for case in (*landing, *handling):
        factor = np.full(3, FLAT)
        if case in handling:
            factor[2] = 1.0
        loads = tuple(
            GearLoad(
                gear=one.gear,
                at=one.at,
                force=one.force * (factor if one.gear in several else 1.0),
            )
            for one in case.loads
        )
        yield replace(
            case, paragraph="23.511(c)", name=f"one flat: {case.title}", loads=loads
        )


def _shared(aircraft: GroundAircraft, total: float) -> dict[Gear, float]:
    """A load over the main gears, as at rest."""
    rest = at_rest(aircraft)
    whole = sum(rest[g.name] for g in aircraft.mains)
    return {g: total * rest[g.name] / whole for g in aircraft.mains}


def _others_at_rest(aircraft: GroundAircraft, one: Gear) -> list[GearLoad]:
    return [load(g, "ground", vertical=z) for g, z in resting(aircraft) if g is not one]

"""CS-25 (14 CFR 25) taxi and braking, 25.491, 25.493 and 25.507, as static load cases.

No lift. Where the ground's reactions do not balance the aircraft, its inertia does.
"""

import math
from collections.abc import Iterator, Mapping, Sequence

from drake_landing.conditions.ground import (
    BookCase,
    Gear,
    GearLoad,
    GroundAircraft,
    load,
)
from drake_landing.conditions.statics import middle_of_mains, reactions, resting

FRICTION = 0.8
BRAKED_FACTOR = {"landing": 1.2, "take_off": 1.0}
REVERSED, REVERSED_TORQUE = 0.55, 1.2
TAXI = 1.7


def taxi(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.491 by the discrete load of AMC 25.491: 1.7 times the loads at rest."""
    yield BookCase(
        paragraph="25.491",
        name="1.7 times the loads at rest",
        loads=tuple(
            load(g, "ground", vertical=TAXI * z)
            for g, z in resting(aircraft, aircraft.gears)
        ),
        pose="static",
        note="discrete load of AMC 25.491; profiles: scenario.runway.profile",
    )


def braked_roll(
    aircraft: GroundAircraft, kept: Mapping[str, float] = {}
) -> Iterator[BookCase]:
    """25.493(b): drag 0.8 of the vertical load, or what the brakes give.

    (1) on all gears without pitching acceleration, (2) on the main gears alone.

    Args:
        aircraft: with brakes on a main gear.
        kept: gear -> share of that drag (25.511(e)); others have all of it.
    """
    n = BRAKED_FACTOR[aircraft.design]
    if aircraft.nose or aircraft.tail:
        loads = braked_reactions(aircraft, n * aircraft.weight, kept)
        note = brakes_note(aircraft, loads, kept=kept)
        name = "all gears, no pitching" if aircraft.nose else "all gears"
        yield BookCase(
            paragraph="25.493(b)(1)",
            name=f"braked, {name}, n = {n:g}",
            loads=loads,
            pose="static",
            note=note,
        )
    rest = dict(resting(aircraft, aircraft.mains))
    share = n * aircraft.weight / sum(rest.values())
    loads = tuple(
        load(
            g,
            "ground",
            vertical=share * z,
            drag=kept.get(g.name, 1.0) * braked_drag(g, share * z),
        )
        for g, z in rest.items()
    )
    yield BookCase(
        paragraph="25.493(b)(2)",
        name=f"braked, main gears, n = {n:g}",
        loads=loads,
        pose="static",
        note=brakes_note(aircraft, loads, kept=kept),
    )


def sudden_braking(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.493(d), (e): brakes at once; the nose gear's load by the formula of (e).

    The main gears carry the rest of the weight, with the drag of the steady state; what
    does not balance accelerates the aircraft in pitch.
    """
    nose = aircraft.nose
    assert nose is not None
    braked = braked_reactions(aircraft, aircraft.weight)
    steady = {one.gear: one for one in braked}
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
    notes = (
        f"f = {dynamic_factor(aircraft.pitch_damping):.3g}",
        f"drag of the steady braked roll, {drag_shares(loads)}: the nose gear's "
        "increment relieves the main gears",
        brakes_note(aircraft, braked),
    )
    yield BookCase(
        paragraph="25.493(e)",
        name="brakes at once",
        loads=tuple(loads),
        pose="static",
        note="; ".join(filter(None, notes)),
    )


def drag_shares(loads: Sequence[GearLoad]) -> str:
    """Drag over vertical load of the gears that have drag, in words."""
    shares: dict[str, list[str]] = {}
    for one in loads:
        drag, _, vertical = one.force
        if drag:
            shares.setdefault(f"{abs(drag) / vertical:.2f}", []).append(one.gear)
    return ", ".join(
        f"{share} of the vertical load ({', '.join(gears)})"
        for share, gears in shares.items()
    )


def brakes_note(
    aircraft: GroundAircraft,
    loads: Sequence[GearLoad],
    *,
    wanted: float = FRICTION,
    factor: float = 1.0,
    kept: Mapping[str, float] = {},
) -> str:
    """Which drags the brakes limit to less than the share that the rule asks for.

    Args:
        aircraft: whose brakes.
        loads: of the braked case.
        wanted: drag over vertical load where brakes suffice.
        factor: of the torque.
        kept: gear -> share of either that it keeps.
    """
    torque = {g.name: factor * g.brake_torque / g.radius for g in aircraft.braked}
    limited = [
        one
        for one in loads
        if one.gear in torque and torque[one.gear] < wanted * one.force[2] * (1 - 1e-9)
    ]
    if not limited:
        return ""
    most = (
        f"{factor:g} times the brakes' torque"
        if factor != 1.0
        else "the brakes' torque"
    )
    plain = {f"{wanted * kept.get(one.gear, 1.0):.3g}" for one in limited}
    return (
        f"drag limited by {most}, {drag_shares(limited)} instead of "
        f"{' and '.join(sorted(plain))}"
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
    behind, _, below = middle_of_mains(aircraft)
    height, mu = -below, FRICTION
    f = dynamic_factor(aircraft.pitch_damping)
    more = f * mu * forward * height / (forward + behind + mu * height)
    return aircraft.weight / (forward + behind) * (behind + more)


def braked_drag(gear: Gear, vertical: float) -> float:
    """0.8 of the vertical load, no more than the brakes give, none without, N."""
    if not gear.brake_torque:
        return 0.0
    return min(FRICTION * vertical, gear.brake_torque / gear.radius)


def braked_reactions(
    aircraft: GroundAircraft, weight: float, kept: Mapping[str, float] = {}
) -> tuple[GearLoad, ...]:
    """All gears on the ground under brakes, in equilibrium in pitch.

    Args:
        aircraft: with brakes on a main gear.
        weight: that the gears carry, N.
        kept: gear -> share of the drag that friction or brakes give.
    """
    limited: dict[str, float] = {}
    ratio = {g.name: FRICTION * kept.get(g.name, 1.0) for g in aircraft.braked}
    places = aircraft.poses["static"]
    while True:
        free = [g for g in aircraft.braked if g.name not in limited]
        found = reactions(
            aircraft.gears,
            places,
            weight,
            ratios={gear.name: (ratio[gear.name], 0.0) for gear in free},
            further=[load(name, "ground", drag=d) for name, d in limited.items()],
        )
        over = [
            g for g in free if braked_drag(g, found[g.name]) < FRICTION * found[g.name]
        ]
        if not over:
            break
        limited |= {
            g.name: kept.get(g.name, 1.0) * g.brake_torque / g.radius for g in over
        }
    drag = {name: share * found[name] for name, share in ratio.items()} | limited
    return tuple(
        load(g, "ground", vertical=found[g.name], drag=drag.get(g.name, 0.0))
        for g in aircraft.gears
    )


def reversed_braking(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.507: 0.55 of the vertical load forward at every braked wheel."""
    loads = []
    for g, z in resting(aircraft, aircraft.gears):
        torque = REVERSED_TORQUE * g.brake_torque / g.radius
        loads.append(load(g, "ground", vertical=z, drag=-min(REVERSED * z, torque)))
    yield BookCase(
        paragraph="25.507",
        name="reversed braking",
        loads=tuple(loads),
        pose="static",
        note=brakes_note(aircraft, loads, wanted=REVERSED, factor=REVERSED_TORQUE),
    )

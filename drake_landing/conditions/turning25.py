"""CS-25 (14 CFR 25) turning, yaw and pivoting, 25.495 to 25.503, as static load cases.

No lift. Where the ground's reactions do not balance the aircraft, its inertia does.
"""

from collections.abc import Iterator

import numpy as np

from drake_landing.conditions.ground import BookCase, GroundAircraft, load
from drake_landing.conditions.landing25 import SIDES
from drake_landing.conditions.rolling25 import FRICTION
from drake_landing.conditions.statics import middle_of_mains, reactions, resting

TURN = 0.5
STEERED_NOSE = 1.33


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
                    for g, z in resting(aircraft, aircraft.gears)
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
                for g, z in resting(aircraft, aircraft.gears)
            ),
            pose="static",
        )


def one_side_braked(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.499(b), (c): brakes of one side; the nose wheel holds the heading.

    Loads of the nose wheel from equilibrium, no side load factor at the center of
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
        base = middle_of_mains(aircraft)[0] - places[nose.name].ground[0]
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
                for g, z in resting(aircraft, aircraft.gears)
            ),
            pose="static",
        )


def pivoting(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.503: one main gear's brakes locked, its wheels scrub about their middle.

    The torque 0.8 Z times the mean distance of the wheels from their middle is held by
    side loads of the nose (tail) gear and, opposite, of the locked gear.
    """
    places = aircraft.poses["static"]
    rest = dict(resting(aircraft, aircraft.gears))
    steered = aircraft.nose or aircraft.tail
    for gear in aircraft.mains:
        if not gear.brake_torque:
            continue
        torque = FRICTION * rest[gear] * gear.scrub
        for sign, toward in SIDES:
            turn = -sign * torque  # about up: positive turns the nose to port
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
                name=f"pivoting about {gear.name}, torque turns nose to {toward}",
                loads=tuple(loads),
                pose="static",
                note="one wheel: no torque but that of its footprint, left out"
                * (gear.scrub == 0.0),
            )

"""CS-25 (14 CFR 25) towing and jacking, 25.509 and 25.519, as static load cases."""

import math
from collections.abc import Iterator

import numpy as np

from drake_landing.conditions.ground import BookCase, GearLoad, GroundAircraft, load
from drake_landing.conditions.statics import resting

POUND_FORCE = 4.4482216152605
JACK, JACK_SIDE = 1.33, 0.33
TOW_MAIN, TOW_OBLIQUE, TOW_SWIVELLED = 0.75, 30.0, 0.5


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
    for degrees in (0.0, TOW_OBLIQUE, -TOW_OBLIQUE):
        for pull, way in ((-1.0, "forward"), (1.0, "aft")):
            toward = "starboard" if pull * degrees > 0.0 else "port"
            angle = f" at 30° to {toward}" * bool(degrees)
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
    rest = resting(aircraft, aircraft.gears)
    for at_axle, how in ((True, "(i) held at the axle"), (False, "(ii) by inertia")):
        loads = [load(g, "ground", vertical=z) for g, z in rest]
        for g, z in rest:
            if g.name not in pull:
                continue
            force = sense * pull[g.name] * np.array([c, s, 0.0])
            loads.append(GearLoad(gear=g.name, at="axle", force=force, what="tow"))
            held = force.copy()
            if roles[g.name] == "main":
                what = "ground against the tow's side"
                if force[1] != 0.0:
                    loads.append(load(g, "ground", side=-force[1], what=what))
                held[1] = 0.0
            size = float(np.linalg.norm(held))
            if at_axle and size > 0.0:
                held *= min(1.0, z / size)
                what = "axle against the tow"
                loads.append(GearLoad(gear=g.name, at="axle", force=-held, what=what))
        yield BookCase(
            paragraph="25.509",
            name=f"towed at {name}, {how}",
            loads=tuple(loads),
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
    rest = resting(aircraft, aircraft.gears)
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
                        what="jack",
                    )
                    if g is gear
                    else load(g, "ground", vertical=z)
                    for g, z in rest
                ),
                pose="static",
            )

"""CS-25 (14 CFR 25) landing conditions 25.479 to 25.487 as static load cases.

Lift balances the weight; what the ground adds is balanced by inertia. The largest
vertical loads are those of a landing at the sink rate of the design weight.
"""

from collections.abc import Iterator
from dataclasses import replace

from drake_landing.conditions.ground import (
    BookCase,
    Gear,
    GearLoad,
    GroundAircraft,
    PoseName,
    load,
)
from drake_landing.conditions.paragraph import largest

LEVEL_DRAG = 0.25
DRIFT_SHARE, DRIFT_DRAG, DRIFT_SIDE = 0.75, 0.40, 0.25
SIDE_SHARE, INWARD, OUTWARD = 0.5, 0.8, 0.6
REBOUND = 20.0
SIDES = ((1.0, "starboard"), (-1.0, "port"))


def level_drag(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.479(d)(1): the largest vertical load with a quarter of it aft, at the axle."""

    def one(
        gears: tuple[Gear, ...], name: str, of: str, pose: PoseName = "largest"
    ) -> BookCase:
        return BookCase(
            paragraph="25.479(d)(1)",
            name=name,
            loads=tuple(
                load(g, "axle", vertical=z, drag=LEVEL_DRAG * z)
                for g in gears
                for z in [largest(g, of=of)]
            ),
            pose=pose,
            lift=1.0,
        )

    yield one(aircraft.mains, "level, main gears", "largest")
    if aircraft.nose and all(g.all_wheels for g in (aircraft.nose, *aircraft.mains)):
        touching = (aircraft.nose, *aircraft.mains)
        yield one(touching, "level, all gears", "all_wheels", "all_wheels")


def drift(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.479(d)(2): 75 % of the largest vertical load, of that 40 % aft, 25 % aside."""
    for sign, toward in SIDES:
        yield BookCase(
            paragraph="25.479(d)(2)",
            name=f"drift, load to {toward}",
            loads=tuple(
                load(
                    gear,
                    "ground",
                    vertical=z,
                    drag=DRIFT_DRAG * z,
                    side=sign * DRIFT_SIDE * z,
                )
                for gear in aircraft.mains
                for z in [DRIFT_SHARE * largest(gear)]
            ),
            pose="reduced",
            lift=1.0,
        )


def tail_down(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.481: the largest vertical load in the tail-down attitude, no drag added."""
    yield BookCase(
        paragraph="25.481",
        name="tail-down, vertical peak",
        loads=tuple(
            load(gear, "axle", vertical=largest(gear, of="tail_down"))
            for gear in aircraft.mains
        ),
        pose="tail_down",
        lift=1.0,
        note="drag of spin-up and spring-back: preset tail_down",
    )


def one_gear(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.483: one main gear with its load of 25.479(d)(1), the other has none."""
    for gear in aircraft.mains:
        z = largest(gear)
        yield BookCase(
            paragraph="25.483",
            name=f"one gear, {gear.name}",
            loads=(load(gear, "axle", vertical=z, drag=LEVEL_DRAG * z),),
            pose="largest",
            lift=1.0,
        )


def side(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.485: half the vertical load; of that 0.8 inward, and 0.6 outward, at once."""
    for sign, toward in SIDES:
        loads: list[GearLoad] = []
        for gear in aircraft.mains:
            z, at = SIDE_SHARE * largest(gear), aircraft.side(gear)
            # A load to starboard points inward on a port gear.
            ratio = {-sign: INWARD, sign: OUTWARD}.get(at, 0.5 * (INWARD + OUTWARD))
            loads.append(load(gear, "ground", vertical=z, side=sign * ratio * z))
        yield BookCase(
            paragraph="25.485",
            name=f"side load to {toward}",
            loads=tuple(loads),
            pose="static",
            lift=1.0,
            note="the rule names no deflections: those at rest",
        )


def rebound(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.487(b): 20 g on what is unsprung, in the direction in which it extends."""
    groups = {"main gears": aircraft.mains, "nose gear": aircraft.of("nose")}
    groups["tail gear"] = aircraft.of("tail")
    for name, gears in groups.items():
        if not gears:
            continue
        places = aircraft.poses["extended"]
        yield BookCase(
            paragraph="25.487(b)",
            name=f"rebound, {name}",
            loads=tuple(
                GearLoad(
                    gear=g.name,
                    at="unsprung",
                    force=REBOUND
                    * g.unsprung
                    * aircraft.gravity
                    * places[g.name].extension,
                    what="20 g on the unsprung parts",
                )
                for g in gears
            ),
            pose="extended",
            lift=1.0,
        )


def flat_tire_landing(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.511(d): 60 % of the gear's load with one flat tire, 50 % with two.

    Of 25.485 the vertical load stays whole. The load stays in the middle of the gear,
    whose shift 25.511(a)(2) lets go.
    """
    for flat, factor in ((1, 0.6), (2, 0.5)):
        enough = 2 if flat == 1 else 4
        if not any(gear.wheels >= enough for gear in aircraft.mains):
            continue
        for case in (*level_drag(aircraft), *one_gear(aircraft)):
            yield _flat(case, aircraft, flat, factor, enough)
        for case in side(aircraft):
            yield _flat(case, aircraft, flat, factor, enough, whole=True)


def _flat(
    case: BookCase,
    aircraft: GroundAircraft,
    flat: int,
    factor: float,
    enough: int,
    *,
    whole: bool = False,
) -> BookCase:
    """A case with flat tires on every main gear that has `enough` wheels."""
    less = {g.name for g in aircraft.mains if g.wheels >= enough}
    loads = []
    for one in case.loads:
        force = one.force * (factor if one.gear in less else 1.0)
        if whole:  # 100 % of the vertical load
            force[2] = one.force[2]
        loads.append(replace(one, force=force))
    return replace(
        case,
        paragraph="25.511(d)",
        name=f"{'one' if flat == 1 else 'two'} flat: {case.title}",
        loads=tuple(loads),
    )

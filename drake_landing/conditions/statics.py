"""Reactions of the ground from equilibrium: which vertical loads balance the aircraft.

Every vertical reaction Z may bring drag and side loads in proportion to it. With the
weight n W at the center of gravity, the sum of the vertical loads, the pitching and the
rolling moment vanish; of more than three gears the loads deviate least from those at
rest (least squares of the deviation over the root of the load at rest).
"""

from collections.abc import Mapping, Sequence

import numpy as np

from drake_landing.conditions.ground import (
    At,
    Gear,
    GearLoad,
    GearPlace,
    GroundAircraft,
)
from fem.arrays import Float64


def reactions(
    gears: Sequence[Gear],
    places: Mapping[str, GearPlace],
    weight: float,
    *,
    ratios: Mapping[str, tuple[float, float]] | None = None,
    at: At = "ground",
    further: Sequence[GearLoad] = (),
) -> dict[str, float]:
    """Vertical load on each gear, N.

    Args:
        gears: that touch the ground.
        places: of all.
        weight: n W, N.
        ratios: gear -> drag and side load over its vertical load; others have none.
        at: where drag and side act.
        further: loads that act besides.

    Raises:
        ValueError: no such loads are in equilibrium.
    """
    ratios = ratios or {}
    columns = []
    for gear in gears:
        drag, side = ratios.get(gear.name, (0.0, 0.0))
        force = np.array([drag, side, 1.0])
        moment = np.cross(point(places[gear.name], at), force)
        columns.append([1.0, moment[0], moment[1]])
    wanted = np.array([weight, 0.0, 0.0])
    for one in further:
        moment = np.cross(point(places[one.gear], one.at), one.force) + one.moment
        wanted -= [one.force[2], moment[0], moment[1]]
    rows = np.array(columns).T
    rest = np.array([max(gear.static, 1e-3 * weight) for gear in gears])
    root = np.sqrt(rest)
    change = np.linalg.lstsq(rows * root, wanted - rows @ rest, rcond=1e-9)[0]
    found = rest + root * change
    size = np.abs(rows).max(axis=1) * abs(weight)
    if np.any(np.abs(rows @ found - wanted) > 1e-6 * size):
        raise ValueError("no vertical loads of these gears balance the aircraft")
    return {gear.name: float(z) for gear, z in zip(gears, found)}


def at_rest(aircraft: GroundAircraft) -> dict[str, float]:
    """Vertical loads at rest, N."""
    return reactions(aircraft.gears, aircraft.poses["static"], aircraft.weight)


def resting(
    aircraft: GroundAircraft, gears: Sequence[Gear] | None = None
) -> list[tuple[Gear, float]]:
    """Gears, all by default, with their vertical loads at rest, N."""
    loads = at_rest(aircraft)
    return [(g, loads[g.name]) for g in (aircraft.gears if gears is None else gears)]


def middle_of_mains(aircraft: GroundAircraft) -> Float64:
    """(3,) of the main gears' ground points, by their loads at rest, G, m."""
    loads, places = at_rest(aircraft), aircraft.poses["static"]
    points = np.array([places[g.name].ground for g in aircraft.mains])
    return np.average(points, axis=0, weights=[loads[g.name] for g in aircraft.mains])


def point(place: GearPlace, at: At) -> Float64:
    """(3,) where a load acts, G, relative to the center of gravity, m."""
    return {"ground": place.ground, "axle": place.axle, "unsprung": place.unsprung}[at]


def resultant(
    loads: Sequence[GearLoad], places: Mapping[str, GearPlace]
) -> tuple[Float64, Float64]:
    """(3,) force and (3,) moment about the center of gravity, G."""
    force, moment = np.zeros(3), np.zeros(3)
    for one in loads:
        force += one.force
        moment += one.moment + np.cross(point(places[one.gear], one.at), one.force)
    return force, moment

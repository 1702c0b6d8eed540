"""Steady flight at 1 g of a user's deck: lift, and the gears that hang on the airframe.

The load is balanced by the airframe's own inertia (`parts.slices.balanced`), so weight
is not part of it; the gears, which are no part of the deck, pull at their attachments.
"""

import numpy as np

from drake_landing.airframe.mass_cases import loaded
from drake_landing.case.steady import Steady
from drake_landing.gears.bodies import mass_points
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.lift import STANDARD_GRAVITY
from fem.arrays import Float64
from fem.deck.extra_loads import loads_of_file
from fem.deck.reader import read_deck
from fem.deck.units import units_of
from fem.errors import InputError
from fem.loads.static import static_load
from fem.model.structure import Structure
from systems.airframe.distributed_load import trimmed_shares

_OFF = 0.02  # of the weight, beyond which a load set is no steady flight at 1 g


def steady_flight(
    structure: Structure,
    gears: tuple[LandingGear, ...],
    given: Steady,
    R_AB: Float64,
    units: str = "SI",
) -> Float64:
    """(f, 1) loads, N and N m.

    Args:
        structure: the full model.
        gears: in B.
        given: of the case.
        R_AB: (3, 3).
        units: of the deck and of a file of loads.

    Raises:
        InputError: an unknown grid or load set, nodes that do not surround the center
            of gravity, or a load set that does not carry the weight.
    """
    whole, up = loaded(structure, gears), R_AB[2]
    weight = whole.mass * STANDARD_GRAVITY
    hanging = _gear_pull(structure, gears, up)
    if given.load is not None or given.file is not None:
        lift = _given_loads(structure, given, units)
        load = np.asarray(structure.load(lift[:, None]))
        force = structure.rigid_body[:, :3].T @ load[:, 0]
        if abs(force @ up / weight - 1.0) > _OFF:
            what = f"load set {given.load} carries" if given.load else "it carries"
            raise InputError(
                f"airframe.steady.{'file' if given.file else 'load'}: {what} "
                f"{force @ up / 1e3:.4g} kN, expected the weight with gears, "
                f"{weight / 1e3:.4g} kN, to 2 %"
            )
        return load + hanging
    known = set(structure.points.grid_id.tolist())
    if unknown := [n for n in given.nodes if n not in known]:
        raise InputError(f"airframe.steady.nodes: the deck has no grid {unknown[0]}")
    places = structure.points.xyz[structure.points.rows(list(given.nodes))] @ R_AB.T
    try:
        shares = trimmed_shares(places, R_AB @ whole.center, given.shares)
    except ValueError as error:
        raise InputError(f"airframe.steady.nodes: {error}") from None
    operator = structure.operator(list(given.nodes), (1, 2, 3), frame="basic")
    forces = weight * np.outer(shares, up).ravel()
    return np.asarray(operator.T @ forces)[:, None] + hanging


def _given_loads(structure: Structure, given: Steady, units: str) -> Float64:
    """(g,) loads of a file or of a set of the deck, N and N m.

    Raises:
        InputError: no such set, or a file that holds something else.
    """
    of = units_of(units)
    grids = 6 * len(structure.points.grid_id)
    to_si = np.ones(structure.points.size)
    to_si[:grids] = np.tile([*[of.force] * 3, *[of.moment] * 3], grids // 6)
    if given.file is None:
        deck, points, mass = structure.deck, structure.points, structure.matrices.mass
        if units != "SI":  # the deck in SI has no loads
            raw = Structure.from_deck(read_deck(deck.path, ignore=deck.ignored))
            deck, points, mass = raw.deck, raw.points, raw.matrices.mass
        assert given.load is not None
        return to_si * static_load(deck, points, given.load, mass)
    deck, sid = loads_of_file(structure.deck, given.file, given.load)
    return to_si * static_load(deck, structure.points, sid)


def _gear_pull(
    structure: Structure, gears: tuple[LandingGear, ...], up: Float64
) -> Float64:
    """(f, 1) weight of the gears at their first attachments, with its moment."""
    nodes = [gear.attachment_node for gear in gears]
    places = structure.points.xyz[structure.points.rows(nodes)]
    loads = np.zeros((len(nodes), 6))
    for row, gear, place in zip(loads, gears, places):
        for mass, p in mass_points(gear):
            force = -mass * STANDARD_GRAVITY * up
            row += np.r_[force, np.cross(np.asarray(p) - place, force)]
    operator = structure.operator(nodes, frame="basic")
    return np.asarray(operator.T @ loads.ravel())[:, None]

"""Where landing gears stand: on which grids, round which center, how they touch down.

All in the axes A: x aft, y to starboard, z up.
"""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from drake_landing.gears.bodies import mass_points, wheel_centers
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.landing.initial_state import attitude
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

_OFF_CENTER = 0.3  # m, from where on a side is a side
_PITCH = np.radians([-25.0, 35.0])  # in which a pitch is looked for
_SHELLS = frozenset({"CQUAD4", "CTRIA3", "CQUADR", "CTRIAR", "CQUAD8", "CTRIA6"})


def place_remarks(
    gears: Sequence[LandingGear],
    places: Mapping[str, Float64],
    mass: float,
    p_AG: npt.ArrayLike,
) -> list[str]:
    """Gears on one grid, wheels on the other side, a center of gravity outside them.

    Args:
        gears: in A.
        places: name of each gear -> (3,) its attachment node in A, m.
        mass, p_AG: of the airframe, kg, (3,) m.
    """
    return [
        *_shared(gears),
        *_across(gears, places),
        *_outside(gears, mass, np.asarray(p_AG, dtype=float)),
    ]


def _shared(gears: Sequence[LandingGear]) -> Iterator[str]:
    for i, gear in enumerate(gears):
        others = [
            g.name for g in gears[:i] if g.attachment_node == gear.attachment_node
        ]
        if others:
            yield (
                f"gears.{gear.name}.attachment_node: grid {gear.attachment_node} is "
                f"that of {', '.join(others)} too: their loads act at one point"
            )


def _across(
    gears: Sequence[LandingGear], places: Mapping[str, Float64]
) -> Iterator[str]:
    for gear in gears:
        node, axle = places[gear.name][1], float(np.mean([a[1] for a in gear.axles]))
        if node * axle < 0.0 and min(abs(node), abs(axle)) > _OFF_CENTER:
            yield (
                f"gears.{gear.name}.attachment_node: grid {gear.attachment_node} lies "
                f"{abs(node):.3g} m to {_side(node)} of the deck's center plane, the "
                f"axle {abs(axle):.3g} m to {_side(axle)}"
            )


def _side(y: float) -> str:
    return "starboard" if y > 0.0 else "port"


def _outside(gears: Sequence[LandingGear], mass: float, p_AG: Float64) -> Iterator[str]:
    """The center of gravity of the whole ahead of, behind or beside all wheels."""
    items = [(mass, p_AG), *(item for gear in gears for item in mass_points(gear))]
    whole = np.array([m for m, _ in items])
    center = whole @ np.array([p for _, p in items]) / whole.sum()
    wheels = np.array([p for gear in gears for p in wheel_centers(gear).values()])
    for axis, before, after in ((0, "ahead of", "behind"), (1, "to port", "starboard")):
        low, high = wheels[:, axis].min(), wheels[:, axis].max()
        away = max(low - center[axis], center[axis] - high)
        if away <= 1e-3:
            continue
        where = before if center[axis] < low else after
        side = f"{where} all wheels" if axis == 0 else f"{where} of all wheels"
        yield (
            f"gears: the center of gravity of the whole aircraft lies {away:.3g} m "
            f"{side}: it cannot stand on them"
        )


def shell_attachments(structure: Structure, nodes: Mapping[int, str]) -> list[str]:
    """Attachment nodes that nothing but shells hold.

    Args:
        structure: with the nodes.
        nodes: attachment grid -> field of the case.
    """
    points = structure.points
    rows = {int(n): 6 * int(points.rows([n])[0]) for n in nodes}
    held: dict[int, set[str]] = {n: set() for n in nodes}
    for block in structure.blocks:
        there = np.unique(block.dof)
        for node, row in rows.items():
            if np.isin(row, there):
                held[node].add(block.card)
    free = structure.elimination.T
    remarks = []
    for node, cards in held.items():
        depends = free[rows[node]].nnz != 1  # on others, by a rigid element
        if cards and cards <= _SHELLS and not depends:
            remarks.append(
                f"{nodes[node]}: grid {node} belongs to shells only "
                f"({', '.join(sorted(cards))}): the stress beside it is that of a "
                "point load and grows as the mesh is refined; spread the load by RBE2, "
                "RBE3 or a fitting"
            )
    return remarks


def clearances(gears: Sequence[LandingGear], R_WB: Float64) -> dict[str, float]:
    """Height of each gear's lowest wheel over the lowest of all, extended, m."""
    heights = {
        gear.name: min(
            float(R_WB[2] @ p) - _reach(gear.tire_of(wheel).radius, R_WB)
            for wheel, p in wheel_centers(gear).items()
        )
        for gear in gears
    }
    lowest = min(heights.values())
    return {name: height - lowest for name, height in heights.items()}


def _reach(radius: float, R_WB: Float64) -> float:
    """How far a tire reaches below its center; a tilted wheel reaches less."""
    return radius * float(np.sqrt(max(1.0 - R_WB[2, 1] ** 2, 0.0)))


def pitch_of_all(gears: Sequence[LandingGear]) -> float | None:
    """Pitch (rad, nose up) at which foremost and aftmost gear touch at once.

    Without roll, struts extended. None: one station only, or no such pitch.
    """
    x = [float(np.mean([axle[0] for axle in gear.axles])) for gear in gears]
    ends = [gears[int(np.argmin(x))], gears[int(np.argmax(x))]]
    if max(x) - min(x) < _OFF_CENTER:
        return None

    def lower(pitch: float) -> float:
        found = clearances(ends, attitude(0.0, pitch, 0.0))
        return found[ends[0].name] - found[ends[1].name]

    low, high = (lower(pitch) for pitch in _PITCH)
    if low * high > 0.0:
        return None
    return float(brentq(lower, *_PITCH))

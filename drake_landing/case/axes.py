"""From the deck's axes B to the axes A of the multibody model and back.

A is x aft, y to starboard, z up, with the origin of B. For the reference aircraft both
are the same. A turn between them is a signed permutation, hence exact.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from drake_landing.case.deck_frame import Axes
from drake_landing.gears import leg_matrix
from drake_landing.gears.landing_gear import LandingGear, RigidPart
from drake_landing.gears.legs import Leg

Float64 = npt.NDArray[np.float64]


def rotation_AB(axes: Axes) -> Float64:
    """(3, 3) R_AB: components in A of a vector given in B."""
    aft, up = -_unit(axes.forward), _unit(axes.up)
    return np.stack([aft, np.cross(up, aft), up])


def axis_words(R_AB: Float64) -> dict[str, str]:
    """Where the axes of B point: `{"x": "aft", "y": "starboard", "z": "up"}`."""
    ways = (("aft", "forward"), ("starboard", "port"), ("up", "down"))
    found = {}
    for name, column in zip("xyz", R_AB.T):
        at = int(np.abs(column).argmax())
        found[name] = ways[at][int(column[at] < 0.0)]
    return found


def deck_axes(R_AB: Float64) -> str:
    """`x aft, y starboard, z up`: the axes of B in words."""
    return ", ".join(f"{name} {way}" for name, way in axis_words(R_AB).items())


def moment_words(R_AB: Float64) -> str:
    """What positive moments about the axes of B turn, by the right hand."""
    turns = (
        ("the starboard side up", "the port side up"),
        ("the nose up", "the nose down"),
        ("the nose to port", "the nose to starboard"),
    )
    said = []
    for name, column in zip("xyz", R_AB.T):
        at = int(np.abs(column).argmax())
        said.append(f"M{name} {turns[at][int(column[at] < 0.0)]}")
    return ", ".join(said)


def vertical_axis(R_AB: Float64) -> str:
    """The axis of B that is vertical in level attitude: x, y or z."""
    return "xyz"[int(np.abs(R_AB[2]).argmax())]


def gear_in_A(gear: LandingGear, R_AB: Float64) -> LandingGear:
    """A gear whose positions, directions and inertias are given in B, in A."""
    places = {name: _turned(R_AB, getattr(gear, name)) for name in gear.positions}
    parts = gear.sprung_parts | gear.moving_parts
    turned: dict[str, Any] = {n: _part_in_A(part, R_AB) for n, part in parts.items()}
    further = tuple(
        hold.model_copy(update={"directions": _turned(R_AB, hold.directions)})
        for hold in gear.further_attachments
    )
    if gear.leg is not None:
        turned["leg"] = _leg_in_A(gear.leg, R_AB)
    return gear.model_copy(update={**places, **turned, "further_attachments": further})


def _leg_in_A(leg: Leg, R_AB: Float64) -> Leg:
    changes: dict[str, Any] = {}
    if leg.root is not None:
        changes["root"] = _turned(R_AB, leg.root)
    if leg.matrix is not None:
        K = leg_matrix.turned(np.array(leg.matrix.stiffness), R_AB)
        rows = tuple(map(tuple, K.tolist()))
        changes["matrix"] = leg.matrix.model_copy(update={"stiffness": rows})
    return leg.model_copy(update=changes)


def _unit(axis: str) -> Float64:
    unit = np.zeros(3)
    unit["xyz".index(axis[-1])] = -1.0 if axis.startswith("-") else 1.0
    return unit


def _turned(R_AB: Float64, vectors: Any) -> Any:
    """One vector, or a tuple of them, as tuples."""
    turned = np.asarray(vectors, dtype=float) @ R_AB.T
    if turned.ndim == 1:
        return tuple(turned.tolist())
    return tuple(tuple(vector) for vector in turned.tolist())


def _part_in_A(part: RigidPart, R_AB: Float64) -> RigidPart:
    return part.model_copy(
        update={
            "cg": _turned(R_AB, part.cg),
            "inertia": _turned(np.abs(R_AB), part.inertia),
        }
    )

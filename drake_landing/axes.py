"""From the deck's axes B to the axes A of the multibody model and back.

A is x aft, y to starboard, z up, with the origin of B. For the reference aircraft both
are the same. A turn between them is a signed permutation, hence exact.
"""

import numpy as np
import numpy.typing as npt

from drake_landing.case import Axes
from drake_landing.gear import LandingGear, RigidPart, Vector3

Float64 = npt.NDArray[np.float64]


def rotation_AB(axes: Axes) -> Float64:
    """(3, 3) R_AB: components in A of a vector given in B."""
    aft, up = -_unit(axes.forward), _unit(axes.up)
    return np.stack([aft, np.cross(up, aft), up])


def gear_in_A(gear: LandingGear, R_AB: Float64) -> LandingGear:
    """A gear whose positions and inertias are given in B, in A."""
    return gear.model_copy(
        update={
            "axle": _turned(R_AB, gear.axle),
            "fitting": _part_in_A(gear.fitting, R_AB),
            "piston": _part_in_A(gear.piston, R_AB),
        }
    )


def _unit(axis: str) -> Float64:
    unit = np.zeros(3)
    unit["xyz".index(axis[-1])] = -1.0 if axis.startswith("-") else 1.0
    return unit


def _turned(R_AB: Float64, vector: Vector3) -> Vector3:
    x, y, z = (R_AB @ np.array(vector)).tolist()
    return (x, y, z)


def _part_in_A(part: RigidPart, R_AB: Float64) -> RigidPart:
    return part.model_copy(
        update={
            "cg": _turned(R_AB, part.cg),
            "inertia": _turned(np.abs(R_AB), part.inertia),
        }
    )

"""Masses at points, for all who add up those of gears and airframe."""

from collections.abc import Sequence

import numpy as np

from fem.arrays import Float64


def mass_center(points: Sequence[tuple[float, Float64]]) -> tuple[float, Float64]:
    """Mass (kg) and center of gravity (3,) of masses at points."""
    mass = sum(m for m, _ in points)
    return float(mass), np.sum([m * p for m, p in points], axis=0) / mass

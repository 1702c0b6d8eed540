"""Convex hulls of two section loads at once: which instants, and which cases.

Points are scaled by their ranges first: shear in N and bending in N m differ by orders.
Where all points lie on a line there is no area, and the hull is its two ends. A smooth
history has hundreds of points on its hull: those are kept that are extreme in one of
`DIRECTIONS` directions, which holds the hull within 0.12 % of its size.
"""

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from fem.arrays import Float64, Int64

DIRECTIONS = 64
_ANGLES = 2.0 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
_DIRECTIONS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES)])
_FLAT = 1e-9  # of the range: no extent of its own


def hull_rows(points: Float64) -> Int64:
    """Rows of points (n, 2) on their convex hull, counterclockwise.

    Args:
        points: two loads at n instants or in n cases; rows that are not finite are
            passed over.

    Returns:
        (h,) rows; empty where there is no point.
    """
    points = np.asarray(points, float)
    usable = np.flatnonzero(np.isfinite(points).all(axis=1))
    if len(usable) == 0:
        return usable
    p = points[usable]
    low, high = p.min(axis=0), p.max(axis=0)
    size = high - low
    flat = size <= _FLAT * np.maximum(np.abs(high), np.abs(low))
    if flat.all():
        return usable[:1]
    scaled = (p - low) / np.where(flat, 1.0, size)
    if not flat.any() and len(p) > 2:
        reached = np.unique((_DIRECTIONS @ scaled.T).argmax(axis=1))
        try:
            return usable[reached[ConvexHull(scaled[reached]).vertices]]
        except QhullError:  # all on one line
            pass
    along = scaled @ _direction(scaled)
    return usable[np.unique([along.argmin(), along.argmax()])]


def _direction(p: Float64) -> Float64:
    """(2,) along which points spread most."""
    return np.linalg.svd(p - p.mean(axis=0), full_matrices=False)[2][0]

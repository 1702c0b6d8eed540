"""Frames: rings of bars inside the skin, offset to the frames' neutral axis."""

import numpy as np

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.geometry import Float64

FRAMES = "fuselage frames"


def add_frames(hull: Hull) -> None:
    """Writes all frames, interrupted where openings leave no skin."""
    for row, number in enumerate(hull.rows.frame):
        if number >= 0:
            _frame(hull, row, hull.rows.names[number])


def _frame(hull: Hull, row: int, name: str) -> None:
    profile, depth = _kind(name)
    inward = -_normals(hull.lines.p[row])
    pid = hull.halves.profile(profile)
    for line in np.flatnonzero(_segments(hull, row)):
        radial = inward[line] + inward[line + 1]
        radial /= np.linalg.norm(radial)
        hull.halves.bar(
            FRAMES,
            pid,
            hull.at(row, line),
            hull.at(row, line + 1),
            radial,
            radial * depth / 2,
        )


def _kind(name: str) -> tuple[str, float]:
    """Profile and depth of a frame."""
    data = facts("fuselage_shell")["frames"]
    if name in data["main"]:
        return "main_frame", data["main_depth"]
    if name in data["heavy"]:
        return "heavy_frame", data["heavy_depth"]
    return "frame", data["depth"]


def _segments(hull: Hull, row: int) -> np.ndarray:
    """(n,) where the frame stands: where there is skin before or behind it."""
    before = hull.present[max(row - 1, 0)]
    behind = hull.present[min(row, len(hull.present) - 1)]
    ends = hull.ids[row, :-1, 0] * hull.ids[row, 1:, 0] > 0
    main = facts("fuselage_shell")["frames"]["main"]
    if hull.rows.names[hull.rows.frame[row]] in main:
        return ends
    return (before | behind) & ends


def _normals(p: Float64) -> Float64:
    """(n, 3) outward normals of an elliptic section in its plane."""
    half = p[:, 1].max()
    middle, high = (p[0, 2] + p[-1, 2]) / 2, (p[0, 2] - p[-1, 2]) / 2
    normal = np.stack([0 * p[:, 0], p[:, 1] / half**2, (p[:, 2] - middle) / high**2], 1)
    return normal / np.linalg.norm(normal, axis=1)[:, None]

"""Frames: rings of bars on grids of their own along the frames' neutral axis.

Each grid of a frame follows the skin's grid outside of it rigidly.
"""

import numpy as np

from drake_landing.aircraft.facts import facts
from drake_landing.aircraft.fuselage.hull import Hull
from drake_landing.aircraft.geometry import Float64, Int64

FRAMES = "fuselage frames"
Rings = dict[int, Int64]


def add_frames(hull: Hull) -> Rings:
    """Writes all frames.

    Returns:
        Row of a frame -> (n + 1, 2) twins of its grids, 0 where it is interrupted.
    """
    return {
        row: _frame(hull, row, hull.rows.names[number])
        for row, number in enumerate(hull.rows.frame)
        if number >= 0
    }


def _frame(hull: Hull, row: int, name: str) -> Int64:
    halves = hull.halves
    profile, depth = _kind(name)
    segments = _segments(hull, row)
    used = np.zeros(hull.lines.count + 1, bool)
    used[:-1] |= segments
    used[1:] |= segments
    inward = -_normals(hull.lines.p[row])
    ring = np.zeros((len(used), 2), np.int64)
    ring[used] = halves.grids(FRAMES, (hull.lines.p[row] + inward * depth / 2)[used])
    for line in np.flatnonzero(used):
        halves.follow(FRAMES, hull.at(row, line), ring[line])
    pid = halves.profile(profile)
    for line in np.flatnonzero(segments):
        radial = inward[line] + inward[line + 1]
        halves.bar(
            FRAMES, pid, ring[line], ring[line + 1], radial / np.linalg.norm(radial)
        )
    return ring


def _kind(name: str) -> tuple[str, float]:
    """Profile and depth of a frame."""
    data = facts("fuselage_shell")["frames"]
    if name in data["main"]:
        return "main_frame", data["main_depth"]
    if name in data["tail"]:
        return "tail_frame", data["depth"]
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

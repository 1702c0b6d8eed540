"""Pressure bulkheads: the flat one behind the nose, the dome before the tail cone.

Each is meshed as a square amid rings, so that all its elements are quadrilaterals of
about the same size; its rim is the skin's row of grids.
"""

from dataclasses import dataclass

import numpy as np

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage.hull import Hull
from drake_landing.reference.d150.geometry import Float64, Int64

_SIDE, _CORNER = 0.50, 0.62  # size of the inner square over the section's


@dataclass(frozen=True, kw_only=True)
class Disc:
    """Grids of a bulkhead's starboard half.

    Attributes:
        rings: (k + 1, n + 1, 2) twins from the skin inward to the square's outline.
        core: (q + 1, 2 q + 1, 2) twins of the square from the center plane outward,
            from the top down; its outline is the last ring.
    """

    rings: Int64
    core: Int64


def add_bulkheads(hull: Hull) -> dict[str, Disc]:
    """Writes the `forward` and the `aft` bulkhead."""
    return {name: _bulkhead(hull, name) for name in ("forward", "aft")}


def _bulkhead(hull: Hull, name: str) -> Disc:
    halves, every = hull.halves, facts("fuselage_shell")["bulkheads"]
    data = every[name]
    part = f"fuselage {name} bulkhead"
    row = hull.rows.at(data["frame"])
    disc = _disc(hull, part, row, every["rings"], data["dome_radius"])
    pid = halves.sheet(part, data["thickness"], data["bending"])
    halves.patch(part, pid, disc.rings)
    halves.patch(part, pid, disc.core)
    stiffener = halves.profile("bulkhead_stiffener")
    kinds = every["stiffeners"]
    for line in _stiffeners(
        disc, kinds[f"{name}_vertical"], kinds[f"{name}_horizontal"]
    ):
        halves.chain(part, stiffener, line, (1.0, 0.0, 0.0))
    return disc


def _disc(hull: Hull, part: str, row: int, count: int, dome_radius: float) -> Disc:
    rim = hull.lines.p[row]
    n = hull.lines.count
    if n % 4:
        raise ValueError(f"{n} elements from crown to keel, expected a multiple of 4")
    q = n // 4
    center = (rim[0] + rim[-1]) / 2 * (1.0, 0.0, 1.0)
    outline = center + _square(rim - center)
    core = _transfinite(outline, q)
    share = np.linspace(0.0, 1.0, count + 1)[1:-1, None, None]
    between = rim + share * (outline - rim)
    for p in (core, between):
        p[..., 0] += _bulge(p, rim, center, dome_radius)
    core_ids = hull.halves.grids(part, core)
    path = [core_ids[a, 0] for a in range(q)]
    path += [core_ids[q, b] for b in range(2 * q)]
    path += [core_ids[a, 2 * q] for a in range(q, -1, -1)]
    rings = [
        hull.ids[row][None],
        hull.halves.grids(part, between),
        np.array(path)[None],
    ]
    return Disc(rings=np.concatenate(rings), core=core_ids)


def _square(arm: Float64) -> Float64:
    """Arms (n + 1, 3) to the inner square's outline, from those to the rim."""
    n = len(arm) - 1
    knots = np.arange(0, n + 1, n // 4)
    share = np.where(np.arange(5) % 2, _CORNER, _SIDE)
    at = share[:, None] * arm[knots]
    columns = [np.interp(np.arange(n + 1), knots, column) for column in at.T]
    return np.stack(columns, axis=1)


def _transfinite(outline: Float64, q: int) -> Float64:
    """(q + 1, 2 q + 1, 3) grid whose top, side and bottom are the outline."""
    top, side, bottom = outline[: q + 1], outline[q : 3 * q + 1], outline[3 * q :][::-1]
    u = np.linspace(0.0, 1.0, q + 1)[:, None, None]
    v = np.linspace(0.0, 1.0, 2 * q + 1)[None, :, None]
    inner = top[0] + v[0] * (bottom[0] - top[0])  # the center line
    edges = (1 - v) * top[:, None] + v * bottom[:, None]
    sides = (1 - u) * inner[None] + u * side[None]
    corners = (
        (1 - u) * (1 - v) * top[0]
        + (1 - u) * v * bottom[0]
        + u * (1 - v) * top[-1]
        + u * v * bottom[-1]
    )
    return edges + sides - corners


def _bulge(p: Float64, rim: Float64, center: Float64, radius: float) -> Float64:
    """Aftward height of a spherical dome over its rim; a flat one has radius 0."""
    if not radius:
        return np.zeros(p.shape[:-1])
    half, high = rim[:, 1].max(), (rim[0, 2] - rim[-1, 2]) / 2
    share = ((p[..., 1]) / half) ** 2 + ((p[..., 2] - center[2]) / high) ** 2
    edge = (half + high) / 2
    return np.sqrt(radius**2 - edge**2 * share) - np.sqrt(radius**2 - edge**2)


def _stiffeners(disc: Disc, vertical: int, horizontal: int) -> list[list[Int64]]:
    """Lines from rim to rim.

    Args:
        disc: the bulkhead.
        vertical: on each side of the center line, where there is one more.
        horizontal: their number.
    """
    q, n = disc.core.shape[0] - 1, disc.rings.shape[1] - 1
    lines = []
    for a in np.linspace(0, q, vertical + 2).round().astype(int)[:-1]:
        top, bottom = disc.rings[:-1, a], disc.rings[:-1, n - a][::-1]
        lines.append([*top, *disc.core[a], *bottom])
    for b in np.linspace(0, 2 * q, horizontal + 2).round().astype(int)[1:-1]:
        lines.append([*disc.core[:, b], *disc.rings[:-1, q + b][::-1]])
    return lines

"""Shape of surface and solid elements: worst values, and shapes that cannot be solved.

Measures and limits are those of Nastran's GEOMCHECK: a skew angle is the smallest one
between the lines that join opposite midsides (90 deg is best), warp is the height of
the corners over the mean plane by half the mean diagonal, taper the largest deviation
of a corner triangle from half the area, the Jacobian ratio the least determinant over
the mean one. Elements beyond a limit work, less exactly; impossible ones are refused by
their readers (`bad_facets`, `fem.elements.solids.solid_reader.check_jacobian`).
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.elements.block import ElementBlock
from fem.elements.shells.shell_geometry import facet
from fem.elements.solids.isoparametric import jacobians

# (measure, limit, True where small values are bad)
_QUAD = {
    "aspect": (100.0, False),
    "skew": (30.0, True),
    "taper": (0.5, False),
    "warp": (0.05, False),
    "angle_min": (30.0, True),
    "angle_max": (150.0, False),
}
_TRIA = {"aspect": (100.0, False), "skew": (10.0, True), "angle_max": (160.0, False)}
_SOLID = {"aspect": (100.0, False), "jacobian": (0.0, True)}


@dataclass(frozen=True, kw_only=True)
class Measure:
    """One measure of one element type.

    Attributes:
        card, name: "CQUAD4", "warp".
        id: (e,) elements.
        value: (e,).
        limit: GEOMCHECK's default.
        small_is_bad: values below the limit are beyond it, else those above.
    """

    card: str
    name: str
    id: Int64
    value: Float64
    limit: float
    small_is_bad: bool

    @property
    def worst(self) -> int:
        """Position of the worst element."""
        return int(
            np.argmin(self.value) if self.small_is_bad else np.argmax(self.value)
        )

    @property
    def beyond(self) -> int:
        """Number of elements beyond the limit."""
        out = self.value < self.limit if self.small_is_bad else self.value > self.limit
        return int(out.sum())


def quality_table(blocks: Iterable[ElementBlock]) -> pd.DataFrame:
    """Worst value of each measure per card.

    Returns:
        Columns card, measure, elements, worst, id (of the worst), limit, beyond.
    """
    groups: dict[tuple[str, str], list[Measure]] = {}
    for measure in measures(blocks):
        groups.setdefault((measure.card, measure.name), []).append(measure)
    rows = []
    for (card, name), parts in groups.items():
        joined = Measure(
            card=card,
            name=name,
            id=np.concatenate([p.id for p in parts]),
            value=np.concatenate([p.value for p in parts]),
            limit=parts[0].limit,
            small_is_bad=parts[0].small_is_bad,
        )
        at = joined.worst
        rows.append(
            (
                *(card, name, len(joined.id), joined.value[at], joined.id[at]),
                *(joined.limit, joined.beyond),
            )
        )
    names = ["card", "measure", "elements", "worst", "id", "limit", "beyond"]
    return pd.DataFrame(rows, columns=names)


def quality_notices(blocks: Iterable[ElementBlock]) -> list[str]:
    """One line for each measure with elements beyond its limit."""
    found = quality_table(blocks)
    return [
        f"{row.beyond} of {row.elements} {row.card}: {row.measure} beyond "
        f"{row.limit:g}, worst {row.worst:.4g} at element {row.id}"
        for row in found[found["beyond"] > 0].itertuples()
    ]


def measures(blocks: Iterable[ElementBlock]) -> Iterator[Measure]:
    """All measures of all blocks that have a shape."""
    for block in blocks:
        corners = getattr(block, "corners", None)
        nodes = getattr(block, "nodes", None)
        if corners is not None:
            values = (
                quad_measures(corners)
                if corners.shape[1] == 4
                else tria_measures(corners)
            )
            limits = _QUAD if corners.shape[1] == 4 else _TRIA
        elif nodes is not None:
            values, limits = solid_measures(block), _SOLID
        else:
            continue
        for name, value in values.items():
            limit, small = limits[name]
            yield Measure(
                card=block.card,
                name=name,
                id=block.id,
                value=value,
                limit=limit,
                small_is_bad=small,
            )


def _angle(a: Float64, b: Float64) -> Float64:
    """Degrees between vectors (..., k)."""
    dot = np.sum(a * b, axis=-1)
    length = np.linalg.norm(a, axis=-1) * np.linalg.norm(b, axis=-1)
    return np.degrees(
        np.arccos(np.clip(dot / np.where(length, length, 1.0), -1.0, 1.0))
    )


def _interior(corners: Float64) -> Float64:
    """(e, n) interior angles, degrees."""
    ahead = np.roll(corners, -1, axis=1) - corners
    back = np.roll(corners, 1, axis=1) - corners
    return _angle(ahead, back)


def _aspect(edges: Float64) -> Float64:
    """(e,) longest over shortest of edges (e, k, 3)."""
    length = np.linalg.norm(edges, axis=2)
    shortest = length.min(axis=1)
    return length.max(axis=1) / np.where(shortest, shortest, np.finfo(float).tiny)


def quad_measures(corners: Float64) -> dict[str, Float64]:
    """aspect, skew (deg), taper, warp, angle_min, angle_max (deg) of (e, 4, 3)."""
    edges = np.roll(corners, -1, axis=1) - corners
    middle = corners + 0.5 * edges
    between = _angle(middle[:, 1] - middle[:, 3], middle[:, 2] - middle[:, 0])
    corner_area = 0.5 * np.linalg.norm(
        np.cross(edges, np.roll(edges, 1, axis=1)), axis=2
    )
    mean = corner_area.mean(axis=1)
    flat = facet(corners)
    diagonals = np.linalg.norm(corners[:, 2:] - corners[:, :2], axis=2).mean(axis=1)
    angles = _interior(corners)
    return {
        "aspect": _aspect(edges),
        "skew": np.minimum(between, 180.0 - between),
        "taper": np.abs(corner_area / mean[:, None] - 1.0).max(axis=1),
        "warp": np.abs(flat.warp) / (0.5 * diagonals),
        "angle_min": angles.min(axis=1),
        "angle_max": angles.max(axis=1),
    }


def tria_measures(corners: Float64) -> dict[str, Float64]:
    """aspect, skew (smallest angle, deg), angle_max (deg) of (e, 3, 3)."""
    angles = _interior(corners)
    return {
        "aspect": _aspect(np.roll(corners, -1, axis=1) - corners),
        "skew": angles.min(axis=1),
        "angle_max": angles.max(axis=1),
    }


def solid_measures(block) -> dict[str, Float64]:
    """aspect of the bounding distances of corners, Jacobian ratio."""
    shape = block.shape
    corner = block.nodes[:, : shape.corners]
    i, j = np.triu_indices(shape.corners, 1)
    value = np.linalg.det(jacobians(block.nodes, shape.derivatives(shape.checked)))
    return {
        "aspect": _aspect(corner[:, i] - corner[:, j]),
        "jacobian": value.min(axis=1) / value.mean(axis=1),
    }

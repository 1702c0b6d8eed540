"""Cross-sections of PBARL and PBEAML: dimensions to section constants.

Types and dimensions are those of Nastran's guide, group MSCBML0. Coordinates (y, z)
have y up (axis 1 of the element) and z to the right (axis 2) in the figures of the
guide. Stress points C, D, E, F go round the section from its upper right corner.
Shear factors and torsion constants are those of `shear_factors.py` where it has them.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from fem.arrays import Float64
from fem.cross_sections.analysis import SectionConstants, analyse
from fem.cross_sections.shapes import DIMENSIONS, SHAPES, Box
from fem.cross_sections.shear_factors import ROUND, library_values
from fem.errors import nearest


@dataclass(frozen=True, kw_only=True)
class Section:
    """A cross-section.

    Attributes:
        constants: area, inertias, torsion, shear, centroid and shear center.
        stress_points: (4, 2) y, z of C, D, E, F relative to the centroid.
    """

    constants: SectionConstants
    stress_points: Float64


def section(kind: str, dimensions: Sequence[float]) -> Section:
    """Section of a type (ROD, TUBE, TUBE2, BAR, BOX, I, T, L, CHAN, ...).

    Raises:
        ValueError: unknown type, wrong number of dimensions or impossible ones.
    """
    if kind not in DIMENSIONS:
        raise ValueError(
            f"section type '{kind}' is not known, expected one of "
            f"{', '.join(DIMENSIONS)}{nearest(kind, list(DIMENSIONS))}"
        )
    if len(dimensions) != DIMENSIONS[kind]:
        raise ValueError(
            f"section {kind}: {len(dimensions)} dimensions, expected {DIMENSIONS[kind]}"
        )
    return _section(kind, tuple(float(d) for d in dimensions))


@lru_cache(maxsize=4096)
def _section(kind: str, dims: tuple[float, ...]) -> Section:
    shape = analysed(kind, dims)
    known = library_values(kind, dims, shape.constants.area)
    if known is None:
        return shape
    k1, k2, j = known
    j = shape.constants.j if j is None else j
    return replace(shape, constants=replace(shape.constants, k1=k1, k2=k2, j=j))


def analysed(kind: str, dims: tuple[float, ...]) -> Section:
    """Section of a type by finite elements alone (round ones in closed form).

    Raises:
        ValueError: impossible dimensions.
    """
    if kind in ROUND:
        return _round(kind, dims)
    if kind == "HEXA":
        return _hexagon(*dims)
    boxes, points = SHAPES[kind](*dims)
    if any(not (b[1] > b[0] and b[3] > b[2]) for b in boxes):
        raise ValueError(
            f"section {kind}: dimensions {', '.join(f'{d:g}' for d in dims)} leave a "
            "wall without thickness or length"
        )
    constants = analyse(_cells(boxes))
    return Section(
        constants=constants, stress_points=np.array(points) - constants.centroid
    )


def _round(kind: str, dims: tuple[float, ...]) -> Section:
    """ROD (radius), TUBE (outer, inner radius), TUBE2 (outer radius, thickness)."""
    outer = dims[0]
    inner = {"ROD": 0.0, "TUBE": dims[-1], "TUBE2": outer - dims[-1]}[kind]
    if not 0.0 <= inner < outer:
        raise ValueError(
            f"section {kind}: inner radius {inner:g}, expected from 0 to {outer:g}"
        )
    area = math.pi * (outer**2 - inner**2)
    inertia = math.pi * (outer**4 - inner**4) / 4.0
    constants = SectionConstants(
        area=area,
        i1=inertia,
        i2=inertia,
        i12=0.0,
        j=2.0 * inertia,
        k1=ROUND[kind],
        k2=ROUND[kind],
        centroid=np.zeros(2),
        shear_center=np.zeros(2),
    )
    points = outer * np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    return Section(constants=constants, stress_points=points)


def _hexagon(tip: float, width: float, height: float) -> Section:
    """HEXA: DIM1 width of a tip, DIM2 whole width, DIM3 height."""
    if not (tip > 0 and height > 0 and width > 2 * tip):
        raise ValueError("section HEXA: expected DIM2 > 2 DIM1 > 0 and DIM3 > 0")
    y, z, b = height / 2, width / 2, width / 2 - tip
    corners = [[-y, b], [0, z], [y, b], [y, -b], [0, -z], [-y, -b]]
    lower_left, upper_left = [-y, -b], [y, -b]
    lower_right, upper_right = [-y, b], [y, b]
    blocks = [
        [lower_left, lower_right, upper_right, upper_left],
        [lower_right, [0, z], [0, z], upper_right],
        [upper_left, [0, -z], [0, -z], lower_left],
    ]
    quads = np.concatenate([_divide(np.array(b, float), 8, 8) for b in blocks])
    constants = analyse(quads)
    points = np.array([corners[2], corners[0], corners[5], corners[3]])
    return Section(constants=constants, stress_points=points)


def _divide(block: Float64, n: int, m: int) -> Float64:
    """A quadrilateral (4, 2) in n by m quadrilaterals (n m, 4, 2)."""
    s, t = np.linspace(0, 1, n + 1), np.linspace(0, 1, m + 1)
    a, b, c, d = block
    s_, t_ = s[:, None, None], t[None, :, None]
    grid = (1 - s_) * ((1 - t_) * a + t_ * d) + s_ * ((1 - t_) * b + t_ * c)
    quads = [grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]]
    return np.stack(quads, axis=2).reshape(-1, 4, 2)


def _cells(boxes: Sequence[Box]) -> Float64:
    """Quadrilaterals (e, 4, 2) that fill the union of boxes."""
    table = np.array(boxes)
    y, z = _ticks(table[:, :2].ravel()), _ticks(table[:, 2:].ravel())
    middle_y, middle_z = (y[1:] + y[:-1]) / 2, (z[1:] + z[:-1]) / 2
    inside = np.zeros((len(middle_y), len(middle_z)), dtype=bool)
    for y0, y1, z0, z1 in boxes:
        inside |= np.outer(
            (middle_y > y0) & (middle_y < y1), (middle_z > z0) & (middle_z < z1)
        )
    i, j = np.nonzero(inside)
    corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
    return np.stack([np.stack([y[a], z[b]], axis=-1) for a, b in corners], axis=1)


def _ticks(edges: Float64) -> Float64:
    """Grid lines through all edges; long walls are cut finer near their ends."""
    edges = np.unique(edges)
    edges = edges[np.concatenate([[True], np.diff(edges) > 1e-9 * np.ptp(edges)])]
    lengths = np.diff(edges)
    counts = np.clip(np.rint(3 * np.sqrt(lengths / lengths.min())), _FEWEST, 12)
    if len(lengths) == 1:
        counts = np.array([16])
    return np.concatenate(
        [*(_cut(*e) for e in zip(edges[:-1], edges[1:], counts)), edges[-1:]]
    )


# Cells across a wall.
_FEWEST = 4


def _cut(start: float, end: float, count: float) -> Float64:
    """Grid lines from start to before end."""
    s = np.arange(count) / count
    if count > _FEWEST:
        s = 0.5 * (1.0 - np.cos(np.pi * s))
    return start + (end - start) * s

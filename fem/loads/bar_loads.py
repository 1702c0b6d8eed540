"""PLOAD1: distributed and concentrated loads on CBAR and CBEAM (CBEND: `bend_loads`).

The load is brought to the ends of the element with the interpolation of a uniform
Timoshenko beam (Przemieniecki, Theory of Matrix Structural Analysis, section 5.6):
these are the end forces of a beam clamped at both ends, reversed. A tapered beam takes
the mean of its section. Pin flags release end forces, which go where the stiffness of
the element carries them; offsets turn forces into moments at the grids.

Blank fields: X1, P1 and P2 are zero, SCALE has no default. With X2 blank, or equal to
X1, P1 is a concentrated load at X1. With X2 beyond X1 the load runs linearly from P1 at
X1 to P2 at X2; a blank P2 lets it fall to zero there, as in MSC Nastran's results. LEPR
and FRPR: intensities per projected length, of loads along basic axes.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.references import table, where
from fem.elements.lines.bar import Bar, read_cbar
from fem.elements.lines.beam import Beam, BeamSection
from fem.elements.lines.beam_reader import read_cbeam
from fem.errors import InputError, Problems
from fem.geometry.points import Points
from fem.loads.bend_loads import loads_of_bends
from fem.loads.element_loads import ElementLoads, below_each_other

if TYPE_CHECKING:
    from fem.deck.deck import Deck


TYPES = tuple(f"{q}{a}{e}" for q in "FM" for a in "XYZ" for e in ("", "E"))
SCALES = ("LE", "FR", "LEPR", "FRPR")
# Cubic interpolation times a linear load: degree four.
_GAUSS = np.polynomial.legendre.leggauss(3)


@dataclass(frozen=True, kw_only=True)
class _Lines:
    """Loaded elements, one row per load card."""

    dof: Int64
    length: Float64
    axes: Float64
    map: Float64
    shear: Float64
    stiffness: Float64
    released: npt.NDArray[np.bool_]


def bar_loads(
    deck: "Deck", points: Points, rows: pd.DataFrame
) -> tuple[Int64, Float64]:
    """Rows of the g-set (n,) and forces and moments (n,) of PLOAD1 cards.

    Raises:
        InputError: unknown types or scales, positions outside the element.
    """
    loads = loads_of_bars(deck, points, rows)
    return loads.dof.ravel(), loads.value.ravel()


def loads_of_bars(deck: "Deck", points: Points, rows: pd.DataFrame) -> ElementLoads:
    """PLOAD1 cards as loads of their elements at the grids.

    Raises:
        InputError: as `bar_loads`.
    """
    _check(rows)
    bent = rows["eid"].isin(table(deck, "CBEND")["eid"]).to_numpy(bool)
    if bent.all():
        return loads_of_bends(deck, points, rows)
    if bent.any():
        parts = loads_of_bends, loads_of_bars
        chosen = rows[bent], rows[~bent]
        return below_each_other([f(deck, points, r) for f, r in zip(parts, chosen)])
    lines = _lines(deck, points, rows["eid"].to_numpy(np.int64))
    start, end = _positions(rows, lines.length)
    direction = _directions(rows, lines)
    intensity = _intensities(rows, lines, direction)
    ends = _at_ends(rows, lines, start, end, intensity, direction)
    ends = _without_released(lines, ends)
    basic = np.einsum("eij,ei->ej", lines.map, ends)
    at = lines.dof[:, [0, 6]] // 6
    turned = np.einsum(
        "ekji,ekhj->ekhi", points.rotation[at], basic.reshape(-1, 2, 2, 3)
    )
    return ElementLoads(
        id=rows["eid"].to_numpy(np.int64),
        dof=lines.dof,
        value=turned.reshape(-1, 12, 1),
    )


def _check(rows: pd.DataFrame) -> None:
    problems = Problems()
    for column, known in (("type", TYPES), ("scale", SCALES)):
        for _, row in rows[~rows[column].isin(known)].iterrows():
            problems.append(
                f"{where('PLOAD1', row)}: {column.upper()} {row[column]}, expected "
                f"one of {', '.join(known)}"
            )
    problems.report()


def _lines(deck: "Deck", points: Points, eids: Int64) -> _Lines:
    """Geometry and stiffness of the elements with these ids (n,)."""
    parts = []
    for block in (*read_cbar(deck, points), *read_cbeam(deck, points)):
        keep = np.flatnonzero(np.isin(block.id, eids))
        if len(keep):
            parts.append((block.id[keep], _of_block(block, keep)))
    ids = np.concatenate([part[0] for part in parts])
    order = np.argsort(ids, kind="stable")
    at = order[np.searchsorted(ids[order], eids)]
    names = _Lines.__dataclass_fields__
    return _Lines(
        **{
            name: np.concatenate([getattr(part[1], name) for part in parts])[at]
            for name in names
        }
    )


def _of_block(block: Bar | Beam, keep: Int64) -> _Lines:
    section, material = block.section, block.material
    if isinstance(section, BeamSection):
        values = {k: v.mean(axis=1) for k, v in section.values.items()}
    else:
        values = {k: getattr(section, k) for k in ("a", "i1", "i2", "i12")}
    length = block.geometry.length
    shear = np.zeros((len(length), 2))
    plain = values["i12"] == 0.0
    for plane, factor in enumerate((section.k1, section.k2)):
        stiff = factor * values["a"] * material.g * length**2
        bending = 12.0 * material.e * values[f"i{plane + 1}"]
        usable = plain & (stiff != 0.0)
        np.divide(bending, stiff, out=shear[:, plane], where=usable)
    return _Lines(
        dof=block.grid_dof[keep],
        length=length[keep],
        axes=block.geometry.R_BE[keep],
        map=block.geometry.grid_to_end()[keep],
        shear=shear[keep],
        stiffness=block.end_stiffness[keep, :12, :12],
        released=block.released[keep, :12],
    )


def _positions(rows: pd.DataFrame, length: Float64) -> tuple[Float64, Float64]:
    """Fractions of the length where loads begin and end; equal: a concentrated load."""
    start = rows["x1"].to_numpy(np.float64)
    end = rows["x2"].fillna(rows["x1"]).to_numpy(np.float64)
    lengths = rows["scale"].str.startswith("LE").to_numpy()
    start, end = (np.where(lengths, x / length, x) for x in (start, end))
    slack = 1e-6  # positions along an element are given with few digits
    wrong = (start < -slack) | (end > 1.0 + slack) | (end < start)
    if wrong.any():
        raise InputError(
            f"{where('PLOAD1', row)}: X1 {row['x1']:g}, X2 {row['x2']:g} must ascend "
            "and lie on the element"
            for _, row in rows[wrong].iterrows()
        )
    within = np.clip(np.stack([start, end]), 0.0, 1.0)
    return within[0], within[1]


def _directions(rows: pd.DataFrame, lines: _Lines) -> Float64:
    """(n, 3) unit vectors of the loads in element axes."""
    axis = np.array(["XYZ".index(kind[1]) for kind in rows["type"]])
    local = np.eye(3)[axis]
    basic = np.einsum("eji,ej->ei", lines.axes, local)
    in_element = rows["type"].str.endswith("E").to_numpy()
    return np.where(in_element[:, None], local, basic)


def _intensities(rows: pd.DataFrame, lines: _Lines, direction: Float64) -> Float64:
    """(n, 2) load at both positions; per true length where given per projected one."""
    p1, p2 = (rows[p].fillna(0.0).to_numpy(np.float64) for p in ("p1", "p2"))
    projected = rows["scale"].str.endswith("PR").to_numpy()
    across = np.sqrt(np.maximum(0.0, 1.0 - direction[:, 0] ** 2))
    scale = np.where(projected, across, 1.0)
    return np.stack([p1 * scale, p2 * scale], axis=1)


def _at_ends(
    rows: pd.DataFrame,
    lines: _Lines,
    start: Float64,
    end: Float64,
    intensity: Float64,
    direction: Float64,
) -> Float64:
    """(n, 12) equivalent forces at the ends, element axes."""
    moment = rows["type"].str.startswith("M").to_numpy()
    point = end == start
    total = np.zeros((len(rows), 12))
    for x, weight in zip(*_GAUSS):
        s = 0.5 * (1.0 + x)
        at = start + s * (end - start)
        size = (1.0 - s) * intensity[:, 0] + s * intensity[:, 1]
        size = size * 0.5 * weight * (end - start) * lines.length
        size = np.where(point, intensity[:, 0] * 0.5 * weight, size)
        forms = np.where(
            moment[:, None, None],
            _rotations(at, lines.length, lines.shear),
            _displacements(at, lines.length, lines.shear),
        )
        total += size[:, None] * np.einsum("ek,ekj->ej", direction, forms)
    return total


def _displacements(x: Float64, length: Float64, shear: Float64) -> Float64:
    """(n, 3, 12) displacements at x (fraction) from the end freedoms."""
    forms = np.zeros((len(x), 3, 12))
    forms[:, 0, 0], forms[:, 0, 6] = 1.0 - x, x
    for plane, (u, r, sign) in enumerate(((1, 5, 1.0), (2, 4, -1.0))):
        phi = shear[:, plane]
        c = 1.0 / (1.0 + phi)
        forms[:, u, u] = c * (1 - 3 * x**2 + 2 * x**3 + phi * (1 - x))
        forms[:, u, u + 6] = c * (3 * x**2 - 2 * x**3 + phi * x)
        bow = 0.5 * phi * (x - x**2)
        forms[:, u, r] = sign * c * length * (x - 2 * x**2 + x**3 + bow)
        forms[:, u, r + 6] = sign * c * length * (x**3 - x**2 - bow)
    return forms


def _rotations(x: Float64, length: Float64, shear: Float64) -> Float64:
    """(n, 3, 12) rotations at x (fraction) from the end freedoms."""
    forms = np.zeros((len(x), 3, 12))
    forms[:, 0, 3], forms[:, 0, 9] = 1.0 - x, x
    for plane, (u, r, sign) in enumerate(((1, 5, 1.0), (2, 4, -1.0))):
        phi = shear[:, plane]
        c = 1.0 / (1.0 + phi)
        slope = 6.0 * c * (x**2 - x) / length
        forms[:, r - 3, u], forms[:, r - 3, u + 6] = sign * slope, -sign * slope
        forms[:, r - 3, r] = c * (1 - 4 * x + 3 * x**2 + phi * (1 - x))
        forms[:, r - 3, r + 6] = c * (3 * x**2 - 2 * x + phi * x)
    return forms


def _without_released(lines: _Lines, ends: Float64) -> Float64:
    """End forces after pinned freedoms have let go of theirs."""
    ends = ends.copy()
    for row in np.flatnonzero(lines.released.any(axis=1)):
        free = lines.released[row]
        k = lines.stiffness[row]
        # Released mechanisms carry nothing: least squares leaves them alone.
        motion = np.linalg.lstsq(k[np.ix_(free, free)], ends[row, free], rcond=1e-12)[0]
        ends[row] -= k[:, free] @ motion
        ends[row, free] = 0.0
    return ends

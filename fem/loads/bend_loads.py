"""PLOAD1 on CBEND: loads along the whole arc, per length of it.

The components of the load in the axes of the section at both ends (r away from the
center, s along the arc, z) run linearly from one to the other: a load along a basic
axis is so turned on its way, as in NX Nastran (pyNastran models, tst1d3; loads at the
grid to 2e-5). Loads at the grids are the end forces of the clamped arc, reversed.

Element axes (FXE, FYE, FZE) are r, s and z.
"""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.references import where
from fem.elements.lines.bend import Bends, read_cbend, section_forces
from fem.errors import Problems
from fem.geometry.points import Points
from fem.loads.element_loads import ElementLoads

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_GAUSS, _WEIGHT = np.polynomial.legendre.leggauss(12)
_WHOLE = 1e-6  # slack of positions, which are given with few digits


def loads_of_bends(deck: "Deck", points: Points, rows: pd.DataFrame) -> ElementLoads:
    """PLOAD1 cards on CBEND as loads of their elements at the grids.

    Raises:
        InputError: loads on parts of an element, at a place, or per projected length.
    """
    (block,) = read_cbend(deck, points)
    eids = rows["eid"].to_numpy(np.int64)
    bends = block.take(np.searchsorted(block.id, eids))
    _check(rows, bends)
    basic = at_grids(bends, _ends(rows, bends))
    at = bends.dof[:, [0, 6]] // 6
    turned = np.einsum(
        "ekji,ekhj->ekhi", points.rotation[at], basic.reshape(-1, 2, 2, 3)
    )
    return ElementLoads(id=eids, dof=bends.dof, value=turned.reshape(-1, 12, 1))


def _check(rows: pd.DataFrame, bends: Bends) -> None:
    length = bends.arc.radius * bends.arc.angle
    problems = Problems()
    for (_, row), whole in zip(rows.iterrows(), length):
        unit = whole if row["scale"] == "LE" else 1.0
        end = row["x1"] if np.isnan(row["x2"]) else row["x2"]
        if row["scale"] not in ("LE", "FR"):
            expected = f"SCALE {row['scale']}, expected LE or FR"
        elif abs(row["x1"]) > _WHOLE * unit or abs(end - unit) > _WHOLE * unit:
            expected = f"X1 {row['x1']:g}, X2 {end:g}, expected 0 and {unit:.7g}"
        else:
            continue
        problems.append(
            f"{where('PLOAD1', row)}: {expected}: CBEND {row['eid']} takes loads along "
            "its whole length only, as in Nastran"
        )
    problems.report()


def _ends(rows: pd.DataFrame, bends: Bends) -> Float64:
    """(n, 2, 6) force r, s, z and moments per length at both ends."""
    axes = bends.arc.axes(np.array([0.0, 1.0]))
    found = np.zeros((len(rows), 2, 6))
    for k, (_, row) in enumerate(rows.iterrows()):
        unit = np.eye(3)["XYZ".index(row["type"][1])]
        own = (unit, unit) if row["type"].endswith("E") else axes[k] @ unit
        first = 0 if row["type"].startswith("F") else 3
        for end, p in enumerate(("p1", "p2")):
            size = 0.0 if np.isnan(row[p]) else float(row[p])
            found[k, end, first : first + 3] = size * np.asarray(own[end])
    return found


def at_grids(bends: Bends, ends: Float64) -> Float64:
    """(e, 12) loads at the grids, basic axes, of loads along arcs.

    Args:
        bends: the elements.
        ends: (e, 2, 6) per length at A and B, axes of the sections there.
    """
    arc, b = bends.arc, bends.ends[:, 1]
    length = arc.radius * arc.angle
    flexible = np.zeros((len(b), 6, 6))
    yielding = np.zeros((len(b), 6))
    for x, weight in zip(0.5 * (1.0 + _GAUSS), 0.5 * _WEIGHT):
        axes = arc.axes(np.array([x]))
        through = section_forces(axes, arc.places(axes), b)[:, 0]
        beyond = _resultant(bends, ends, x, arc.places(axes)[:, 0])
        own = np.einsum("eij,ehj->ehi", axes[:, 0], beyond.reshape(-1, 2, 3))
        bent = (
            weight * length[:, None, None] * through.swapaxes(1, 2) @ bends.compliance
        )
        flexible += bent @ through
        yielding += np.einsum("eij,ej->ei", bent, own.reshape(-1, 6))
    at_b = np.linalg.solve(flexible, yielding[..., None])[..., 0]
    whole = _resultant(bends, ends, 0.0, bends.ends[:, 0])
    at_a = whole - at_b
    at_a[:, 3:] -= np.cross(b - bends.ends[:, 0], at_b[:, :3])
    return np.concatenate([at_a, at_b], axis=1)


def _resultant(bends: Bends, ends: Float64, start: float, about: Float64) -> Float64:
    """(e, 6) force and moment about a point of the loads from a share of the arc on."""
    arc = bends.arc
    share = start + (1.0 - start) * 0.5 * (1.0 + _GAUSS)
    axes = arc.axes(share)
    local = (1.0 - share)[:, None] * ends[:, :1] + share[:, None] * ends[:, 1:]
    basic = np.einsum("eqij,eqhi->eqhj", axes, local.reshape(*local.shape[:2], 2, 3))
    weight = 0.5 * _WEIGHT * (1.0 - start)
    basic = basic * (arc.radius * arc.angle)[:, None, None, None]
    basic = basic * weight[:, None, None]
    lever = arc.places(axes) - about[:, None]
    moment = basic[:, :, 1] + np.cross(lever, basic[:, :, 0])
    return np.concatenate([basic[:, :, 0].sum(axis=1), moment.sum(axis=1)], axis=1)

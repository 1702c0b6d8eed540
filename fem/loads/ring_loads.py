"""PLOADX and PLOADX1: tractions on sides of CTRIAX6, of the whole circumference.

Linear between the corners. PLOADX acts to the left of the way from its first to its
third grid, x to the right and z upwards: into an element whose grids go round
counter-clockwise. PLOADX1 acts along the inward normal of the straight line between
its corners, turned by THETA counter-clockwise.
"""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.references import table, where
from fem.errors import InputError, Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def ploadx(deck: "Deck", points: Points, rows: pd.DataFrame) -> tuple[Int64, Float64]:
    """Rows of the g-set and values of PLOADX cards.

    Raises:
        InputError: grids off the x-z plane.
    """
    found = []
    for _, row in rows.iterrows():
        section = _section(points, "PLOADX", row, [row["g1"], row["g3"]])
        x, z = section[1] - section[0]
        along = np.array([-z, x]) / np.hypot(x, z)
        grids = (int(row["g1"]), int(row["g2"]), int(row["g3"]))
        traction = (float(row["p1"]), float(row["p3"]))
        found.append(_side(points, grids, traction, along))
    return _together(found)


def ploadx1(deck: "Deck", points: Points, rows: pd.DataFrame) -> tuple[Int64, Float64]:
    """Rows of the g-set and values of PLOADX1 cards.

    Raises:
        InputError: grids that are no corners of a side of the element.
    """
    elements = table(deck, "CTRIAX6").set_index("eid", drop=False)
    found, problems = [], Problems()
    for _, row in rows.iterrows():
        element = elements.loc[int(row["eid"])]
        ring = [int(element[f"g{k}"]) for k in range(1, 7)]
        ends = int(row["ga"]), int(row["gb"])
        side = next(
            (k for k in (0, 2, 4) if {ring[k], ring[(k + 2) % 6]} == {*ends}), None
        )
        if side is None:
            problems.append(
                f"{where('PLOADX1', row)}: GA {ends[0]} and GB {ends[1]} are no side "
                f"of CTRIAX6 {row['eid']}; its corners are {ring[0]}, {ring[2]} and "
                f"{ring[4]}"
            )
            continue
        a, b, other = _section(points, "PLOADX1", row, [*ends, ring[(side + 4) % 6]])
        x, z = b - a
        inward = np.array([-z, x]) / np.hypot(x, z)
        inward *= np.sign(inward @ (other - a))
        angle = np.radians(float(row["theta"]))
        c, s = np.cos(angle), np.sin(angle)
        along = np.array([[c, -s], [s, c]]) @ inward
        pa = float(row["pa"])
        pb = pa if np.isnan(row["pb"]) else float(row["pb"])
        grids = (ends[0], ring[side + 1], ends[1])
        found.append(_side(points, grids, (pa, pb), along))
    problems.report()
    return _together(found)


def _section(points: Points, card: str, row: pd.Series, grids: list) -> Float64:
    """(n, 2) x and z of grids.

    Raises:
        InputError: two of them are at one place.
    """
    section = points.xyz[points.rows(np.array(grids, np.int64))][:, [0, 2]]
    if np.allclose(section[0], section[1]):
        raise InputError(f"{where(card, row)}: its corners are at one place")
    return section


def _side(
    points: Points,
    grids: tuple[int, int, int],
    traction: tuple[float, float],
    along: Float64,
) -> tuple[Int64, Float64]:
    """Rows and values of a traction along a direction (x, z) on one side.

    Args:
        points: the grids.
        grids: corner, mid-side or 0, corner.
        traction: at the corners, force per area.
        along: (2,) unit vector.
    """
    there = np.array([grid > 0 for grid in grids])
    at = points.rows(np.array(grids)[there])
    section = points.xyz[at][:, [0, 2]]
    x, weight = np.polynomial.legendre.leggauss(5)
    if there[1]:
        value = np.stack(
            [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)], axis=1
        )
        slope = np.stack([x - 0.5, -2.0 * x, x + 0.5], axis=1)
    else:
        value = np.stack([0.5 * (1.0 - x), 0.5 * (1.0 + x)], axis=1)
        slope = np.tile([-0.5, 0.5], (len(x), 1))
    radius = (value @ section)[:, 0]
    length = np.linalg.norm(slope @ section, axis=1)
    size = 0.5 * (traction[0] * (1.0 - x) + traction[1] * (1.0 + x))
    share = value.T @ (weight * 2.0 * np.pi * radius * length * size)
    basic = np.zeros((len(at), 3))
    basic[:, 0], basic[:, 2] = share * along[0], share * along[1]
    own = np.einsum("gba,gb->ga", points.rotation[at], basic)
    dof = 6 * at[:, None] + np.arange(3)
    return dof.ravel(), own.ravel()


def _together(parts: list[tuple[Int64, Float64]]) -> tuple[Int64, Float64]:
    dof = np.concatenate([np.zeros(0, np.int64), *(d for d, _ in parts)])
    return dof, np.concatenate([np.zeros(0), *(v for _, v in parts)])

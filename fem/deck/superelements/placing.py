"""Where SELOC places a superelement: three of its points on three of the main ones."""

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.deck.deck import Deck
from fem.geometry.coordinates import resolve


def _places(deck: Deck) -> pd.DataFrame:
    """Grids and POINTs, which serve as places."""
    columns = ["id", "cp", "x1", "x2", "x3", "cd"]
    points = deck.cards["POINT"].assign(cd=0)
    grids = deck.cards["GRID"]
    if points.empty:
        return grids
    both = [grids[columns], points[columns]]
    return pd.DataFrame(pd.concat(both, ignore_index=True))


def part_frame(
    deck: Deck, part: Deck, number: int, problems: list[str]
) -> tuple[Float64, Float64] | None:
    """Axes (3, 3) and origin (3,) of the part's basic frame in the main one."""
    rows = deck.cards["SELOC"]
    rows = rows[rows["seid"] == number]
    if rows.empty:
        return None
    row = rows.iloc[0]
    name = f"{row['file']}:{row['line']}: SELOC {number}"
    found = []
    for own, which in ((part, "pa"), (deck, "pb")):
        ids = [int(row[f"{which}{k}"]) for k in (1, 2, 3)]
        grid = _places(own)
        absent = [str(i) for i in ids if i not in set(grid["id"])]
        if absent:
            where = "the superelement" if own is part else "the main bulk data"
            problems.append(f"{name}: grid {', '.join(absent)} is not in {where}")
            return None
        _, xyz = resolve(own.cards["CORD"], grid)
        found.append(xyz[[grid["id"].tolist().index(i) for i in ids]])
    (first, own), (second, main) = ((_triad(xyz), xyz) for xyz in found)
    sides = [np.linalg.norm(np.roll(x, 1, axis=0) - x, axis=1) for x in (own, main)]
    if np.isnan(first).any() or np.isnan(second).any():
        problems.append(f"{name}: its three points lie on a line")
        return None
    if np.abs(sides[0] - sides[1]).max() > 1e-3 * sides[0].max():
        problems.append(
            f"{name}: its points are {sides[0].tolist()} apart in the superelement and "
            f"{sides[1].tolist()} in the main bulk data, expected the same triangle"
        )
    axes = second @ first.T
    return axes, main[0] - axes @ own[0]


def _triad(xyz: Float64) -> Float64:
    """(3, 3) axes as columns: x from the first point to the second, y to the third."""
    x, v = xyz[1] - xyz[0], xyz[2] - xyz[0]
    z = np.cross(x, v)
    if np.linalg.norm(z) < 1e-9 * np.linalg.norm(x) * np.linalg.norm(v):
        return np.full((3, 3), np.nan)
    x, z = x / np.linalg.norm(x), z / np.linalg.norm(z)
    return np.stack([x, np.cross(z, x), z], axis=1)

"""Grids GA and GB of connectors follow the surfaces that they pierce.

They carry no freedoms of their own: mass and loads that are put on them act on the
shell. Grids that something else uses, or that are constrained, stay as they are.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.constraints.equations import Equations, dense_equations
from fem.deck.records import TABLES
from fem.deck.references import column, refer, table
from fem.elements.connectors.feet import Foot
from fem.elements.connectors.piercing import place_connectors
from fem.elements.connectors.reader import CONNECTORS
from fem.geometry.points import Points
from fem.geometry.rigid_motion import rigid_motion

if TYPE_CHECKING:
    from fem.deck.deck import Deck

# Cards that may name a grid that follows.
_HARMLESS = {"CFAST", "CWELD", "CONM1", "CONM2", "PLOTEL", "CORD", "SET1"}


def read_feet(deck: "Deck", points: Points) -> list[Equations]:
    """Equations of all grids of connectors that nothing else uses.

    Raises:
        InputError: as the reader of the elements does.
    """
    equations: list[Equations] = []
    done = _used(deck) if any(len(table(deck, name)) for name in CONNECTORS) else set()
    for card, (rows_of, kind) in CONNECTORS.items():
        rows = rows_of(deck)
        if not (rows[["ga", "gb"]] > 0).any(axis=None):
            continue
        diameter = column(refer(rows, card, "pid", table(deck, kind), kind), "d")
        placed = place_connectors(deck, points, rows, card, diameter)
        for eid, grid, foot in _feet(rows, placed.feet):
            at = int(points.rows(grid))
            if grid in done or points.ps[at].any() or 6 * at in foot.dof:
                continue
            done.add(grid)
            equations.append(_follows(points, at, foot, f"{card} {eid}"))
    return equations


def _feet(
    rows: pd.DataFrame, feet: list[tuple[Foot, Foot]]
) -> Iterator[tuple[int, int, Foot]]:
    """Connector, grid and foot where the card has a grid for it."""
    for eid, ga, gb, pair in zip(rows["eid"], rows["ga"], rows["gb"], feet):
        for grid, foot in zip((ga, gb), pair):
            if grid:
                yield int(eid), int(grid), foot


def _used(deck: "Deck") -> set[int]:
    """Grids that cards other than connectors, masses and loads name."""
    found: list[Int64] = [np.zeros(0, np.int64)]
    for name, card in TABLES.items():
        rows = table(deck, name)
        if rows.empty or card.load or name in _HARMLESS:
            continue
        for item in card.columns.values():
            if {"GRID", "POINT"} & set(item.targets):
                found += [np.ravel(value).astype(np.int64) for value in rows[item.name]]
    return set(np.concatenate(found).tolist())


def _follows(points: Points, at: int, foot: Foot, source: str) -> Equations:
    """The six freedoms of a grid by those of a foot; all in displacement frames."""
    lever = points.xyz[[at]] - foot.place
    body = rigid_motion(lever, points.rotation[[at]])[0]
    triples = foot.dof.reshape(-1, 3)
    turn = points.rotation[triples[:, 0] // 6]
    motion: Float64 = (body @ foot.motion).reshape(6, -1, 3)
    matrix = np.einsum("ikj,kjl->ikl", motion, turn).reshape(6, -1)
    return dense_equations(6 * at + np.arange(6), foot.dof, matrix, source)

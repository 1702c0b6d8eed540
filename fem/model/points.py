"""Grid and scalar points of a deck."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Int64
from fem.errors import InputError
from fem.geometry.coordinates import resolve
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_FARTHEST = 1e30  # of a coordinate; volumes times volumes stay within double precision


def read_points(deck: Deck) -> Points:
    """Points of a deck.

    Raises:
        InputError: coordinate systems that cannot be placed, grids beyond all bounds.
    """
    grid = deck.cards["GRID"].sort_values("id", kind="stable")
    frames, xyz = resolve(deck.cards["CORD"], grid)
    undefined = sorted(set(grid["cd"].tolist()) - set(frames) - {-1})
    if undefined:
        raise InputError(
            f"GRID {grid['id'][grid['cd'] == cid].tolist()[:5]}: coordinate "
            f"system CD {cid} is not defined"
            for cid in undefined
        )
    far = ~(np.abs(xyz) < _FARTHEST).all(axis=1)  # NaN counts, too
    if far.any():
        raise InputError(
            f"GRID {grid_id}: found ({', '.join(f'{x:g}' for x in at)}) in basic "
            f"coordinates, expected no more than {_FARTHEST:g}"
            for grid_id, at in zip(grid["id"][far].tolist()[:5], xyz[far])
        )
    cd = grid["cd"].to_numpy(np.int64)
    digits = grid["ps"].to_numpy(dtype=str)
    return Points(
        grid_id=grid["id"].to_numpy(np.int64),
        xyz=xyz,
        # CD -1 marks a fluid point; it has no displacement axes of its own.
        rotation=frames.triads(np.where(cd < 0, 0, cd), xyz),
        ps=np.stack([np.char.find(digits, c) >= 0 for c in "123456"], axis=-1)
        if len(grid)
        else np.zeros((0, 6), bool),
        spoint_id=np.union1d(_ids(deck, "SPOINT"), _ids(deck, "EPOINT")),
        extra_id=_ids(deck, "EPOINT"),
        frames=frames,
    )


def _ids(deck: Deck, card: str) -> Int64:
    return np.unique(deck.cards[card]["id"].to_numpy(np.int64))


def axis_notices(deck: Deck, points: Points) -> list[str]:
    """Grids on the z axis of their displacement system, where r and theta are not."""
    grid = deck.cards["GRID"].sort_values("id", kind="stable")
    cd = grid["cd"].to_numpy(np.int64)
    notices = []
    for cid in np.unique(cd[cd > 0]).tolist():
        own = cd == cid
        there = points.grid_id[own][points.frames[cid].on_axis(points.xyz[own])]
        notices += [
            f"GRID {grid_id}: on the z axis of its displacement system CD {cid}, where "
            "r and theta have no direction: its components are along the x and y axes "
            "of that system"
            for grid_id in there.tolist()
        ]
    return notices

"""Grids of the elements of a card table, as its record says where they stand."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.deck.records import Topology, topologies


def grids_of(rows: pd.DataFrame, topology: Topology) -> Int64:
    """(e, n) grid ids of elements, 0 for those that are not there.

    Args:
        rows: of the table of their card.
        topology: of that card.
    """
    if topology.grids != ("nodes",):
        return rows[list(topology.grids)].to_numpy(np.int64)
    nodes = [np.asarray(own, dtype=np.int64) for own in rows["nodes"]]
    widest = max(map(len, nodes), default=topology.corners)
    found = np.zeros((len(nodes), widest), np.int64)
    for row, own in zip(found, nodes):
        row[: len(own)] = own
    return found


def corners_of(
    tables: Mapping[str, pd.DataFrame], *kinds: str
) -> dict[str, tuple[pd.DataFrame, Int64]]:
    """Rows and (e, c) corners of the elements of some kinds, by card.

    Those at the ground or at scalar points (0, or no grid) are among them.
    """
    return {
        card: (tables[card], grids_of(tables[card], shape)[:, : shape.corners])
        for card, shape in topologies(*kinds).items()
        if card in tables and len(tables[card])
    }

"""Solids whose base goes round the other way: their grids in the order of the rest.

MSC and NX Nastran take them, as their results show (prisms, bricks and tetrahedra of
pyNastran's and of Vega's decks); a face under pressure is named by grids, so that
nothing else changes. Solids whose own axes count (PCOMPS, CORDM = -1) are left.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.errors import InputError
from fem.geometry.coordinates import resolve


@dataclass(frozen=True, kw_only=True)
class _Turn:
    """Another order of the grids.

    Attributes:
        base: corners that go round the base.
        top: the others.
        order: of the grids, corners first, then mid-sides.
        said: that of the corners in words.
    """

    base: tuple[int, ...]
    top: tuple[int, ...]
    order: tuple[int, ...]
    said: str

    @property
    def corners(self) -> int:
        """Number of corners."""
        return len(self.base) + len(self.top)

    def reordered(self, nodes: Int64) -> Int64:
        """Grids of a solid in the other order; 0 for a mid-side that is not there."""
        count = len(self.order) if len(nodes) > self.corners else self.corners
        padded = np.zeros(count, np.int64)
        padded[: len(nodes)] = nodes
        return padded[list(self.order[:count])]

    def backwards(self, p: Float64) -> Float64:
        """(e,) whether the base of solids with corners p (e, n, 3) goes round away."""
        base = p[:, self.base]
        edge = base - base[:, :1]
        normal = np.cross(edge[:, 1:-1], edge[:, 2:]).sum(axis=1)
        height = p[:, self.top].mean(axis=1) - base.mean(axis=1)
        return np.einsum("ea,ea->e", normal, height) < 0.0


_TURNS = {
    "CTETRA": _Turn(
        base=(0, 1, 2),
        top=(3,),
        order=(0, 2, 1, 3, 6, 5, 4, 7, 9, 8),
        said="G1, G3, G2, G4",
    ),
    "CPYRAM": _Turn(
        base=(0, 1, 2, 3),
        top=(4,),
        order=(0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10),
        said="G1, G4, G3, G2, G5",
    ),
    "CPENTA": _Turn(
        base=(0, 1, 2),
        top=(3, 4, 5),
        order=(0, 2, 1, 3, 5, 4, 8, 7, 6, 9, 11, 10, 14, 13, 12),
        said="G1, G3, G2, G4, G6, G5",
    ),
    "CHEXA": _Turn(
        base=(0, 1, 2, 3),
        top=(4, 5, 6, 7),
        order=(0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 12, 15, 14, 13, 19, 18, 17, 16),
        said="G1, G4, G3, G2, G5, G8, G7, G6",
    ),
}


def turn_solids(tables: Mapping[str, pd.DataFrame], notices: list[str]) -> None:
    """Reorder them in the tables; what was done is appended.

    Solids with grids that are not there are left to the checks that follow.
    """
    grid = tables["GRID"].sort_values("id", kind="stable")
    if grid.empty or all(tables[card].empty for card in _TURNS):
        return
    try:
        _, xyz = resolve(tables["CORD"], grid)
    except InputError:
        return
    ids = grid["id"].to_numpy(np.int64)
    psolid = tables["PSOLID"]
    free = psolid.loc[psolid["cordm"] != -1, "pid"].to_numpy(np.int64)
    for card, turn in _TURNS.items():
        table = tables[card]
        if table.empty:
            continue
        turned = _turned(table, turn, ids, xyz, free)
        for k in turned.tolist():
            table.at[k, "nodes"] = turn.reordered(np.asarray(table["nodes"].iat[k]))
        if len(turned):
            shown = ", ".join(map(str, table["eid"].iloc[turned[:8]]))
            more = ", ..." if len(turned) > 8 else ""
            notices.append(
                f"{card} {shown}{more}: the base goes round away from the rest; taken "
                f"as {turn.said}, as Nastran does"
            )


def _turned(
    table: pd.DataFrame, turn: _Turn, ids: Int64, xyz: Float64, free: Int64
) -> Int64:
    """Rows of the table that go round the other way; grids ids (g,) at xyz (g, 3)."""
    corners = np.array(
        [np.asarray(n, np.int64)[: turn.corners] for n in table["nodes"]]
    )
    at = np.minimum(np.searchsorted(ids, corners), len(ids) - 1)
    known = (ids[at] == corners).all(axis=1) & np.isin(table["pid"], free)
    return np.flatnonzero(known)[turn.backwards(xyz[at[known]])]

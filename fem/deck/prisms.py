"""CPENTA whose base goes round the other way: their grids in the order of the rest.

MSC Nastran takes them, as its results show (pyNastran models, randvar2, cqrcc128a and
d200obus, one prism); a face under pressure is named by grids, so that nothing else
changes.
"""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.errors import InputError
from fem.geometry.coordinates import resolve

# Corners, and mid-sides of the base, the heights and the top.
_MIRRORED = np.array([0, 2, 1, 3, 5, 4, 8, 7, 6, 9, 11, 10, 14, 13, 12])


def turn_prisms(tables: Mapping[str, pd.DataFrame], notices: list[str]) -> None:
    """Reorder them in the table; what was done is appended.

    Prisms with grids that are not there are left to the checks that follow.
    """
    table = tables["CPENTA"]
    if table.empty:
        return
    grid = tables["GRID"].sort_values("id", kind="stable")
    ids = grid["id"].to_numpy(np.int64)
    try:
        _, xyz = resolve(tables["CORD"], grid)
    except InputError:
        return
    corners = np.array([np.asarray(n, np.int64)[:6] for n in table["nodes"]])
    at = np.minimum(np.searchsorted(ids, corners), max(len(ids) - 1, 0))
    known = (ids[at] == corners).all(axis=1) if len(ids) else np.zeros(len(table), bool)
    p = xyz[at[known]]
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    height = p[:, 3:].sum(axis=1) - p[:, :3].sum(axis=1)
    turned = np.flatnonzero(known)[np.einsum("ea,ea->e", normal, height) < 0.0]
    for k in turned.tolist():
        nodes: Int64 = np.asarray(table["nodes"].iat[k], np.int64)
        table.at[k, "nodes"] = nodes[_MIRRORED[len(nodes) > _MIRRORED]]
    if len(turned):
        shown = ", ".join(map(str, table["eid"].iloc[turned[:8]]))
        more = ", ..." if len(turned) > 8 else ""
        notices.append(
            f"CPENTA {shown}{more}: G1, G2, G3 go round away from G4, G5, G6; taken as "
            "G1, G3, G2, G4, G6, G5, as MSC Nastran does"
        )

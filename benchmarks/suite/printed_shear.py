"""Shear forces of CQUAD8 and CTRIA6 as Nastran prints them, put into equilibrium.

Nastran prints a sixth of the shear forces of CTRIA6 (a single triangle, clamped along a
leg and loaded by 1 at its tip, has 0.333 at its center where 2.0 balances the load);
those of CQUAD8 at the corners have a third of what varies linearly over the element and
a ninth of the product. Both are sums over points of integration that lack their norm.
"""

from dataclasses import replace

import numpy as np

from benchmarks.suite.tables import Name, Table

_TIPS = np.array([[0, 0], [-1, -1], [1, -1], [1, 1], [-1, 1.0]])
_FIELDS = np.stack([np.ones(5), *_TIPS.T, _TIPS.prod(axis=1)], axis=1)
# Center and corners from what is printed there.
_FACTORS = {
    "force of CQUAD8": _FIELDS
    @ np.diag([1.0, 3.0, 3.0, 9.0])
    @ np.linalg.pinv(_FIELDS),
    "force of CTRIA6": 6.0 * np.eye(4),
}


def balanced(tables: dict[Name, Table]) -> dict[Name, Table]:
    """Tables of Nastran's with shear forces that are in equilibrium."""
    return {
        name: _balanced(table, _FACTORS[name[0]]) if name[0] in _FACTORS else table
        for name, table in tables.items()
    }


def _balanced(table: Table, factors: np.ndarray) -> Table:
    count, shears = len(factors), [table.columns.index(name) for name in ("tx", "ty")]
    if len(table.owner) % count:
        return table
    values = table.values.copy()
    each = values.reshape(len(values), -1, count, values.shape[2])
    each[..., shears] = np.einsum("pq,teqc->tepc", factors, each[..., shears])
    return replace(table, values=values)

"""GENEL: a stiffness or flexibility matrix between freedoms, with its rigid motion."""

from typing import Any

import numpy as np

from fem.deck.text.fields import Fields
from fem.deck.text.values import Malformed

Rows = list[dict[str, Any]]

_WORDS = ("UD", "K", "Z", "S")


def genel(f: Fields) -> Rows:
    """One row: freedoms UI and UD, the stiffness k (m, m), S (m, n) or (0, 0)."""
    starts = {"UI": 3}
    for index in range(9, len(f), 8):
        if f.text(index) in _WORDS:
            starts[f.text(index)] = index + 1
    ui = _freedoms(f, starts, "UI", 3)
    ud = _freedoms(f, starts, "UD", starts.get("UD", 0) + 1) if "UD" in starts else []
    if not ui:
        raise Malformed("field UI1 is blank, expected a grid or scalar point")
    form = next((word for word in "KZ" if word in starts), "")
    if not form:
        raise Malformed("expected K or Z at the beginning of a line, before its matrix")
    m, n = len(ui), len(ud)
    matrix = np.zeros((m, m))
    # The lower triangle, column by column.
    column, row = np.triu_indices(m)
    matrix[row, column] = f.reals(starts[form], len(row), form, 0.0)
    matrix = matrix + matrix.T - np.diag(np.diag(matrix))
    if form == "Z":
        if np.linalg.matrix_rank(matrix) < m:
            raise Malformed("the flexibility Z is singular, expected one with inverse")
        matrix = np.linalg.inv(matrix)
    s = np.zeros((0, 0))
    if "S" in starts:
        s = np.array(f.reals(starts["S"], m * n, "S", 0.0)).reshape(m, n)
    grids, comps = (np.array(column, dtype=np.int64) for column in zip(*ui, *ud))
    row = {"eid": f.integer(1, "EID"), "grids": grids, "comps": comps}
    return [{**row, "k": matrix, "s": s}]


def _freedoms(
    f: Fields, starts: dict[str, int], name: str, start: int
) -> list[tuple[int, int]]:
    """(point, component) pairs from a field to the next word."""
    end = min((i - 1 for i in starts.values() if i > start), default=len(f))
    found = []
    for k in range(start, end, 2):
        # A line has four pairs; the first line of each list has three after two fields.
        if f.text(k):
            c = f.components(k + 1, f"{name} component", "0")
            if len(c) > 1:
                raise Malformed(f"field {name}: found '{c}', expected one component")
            found.append((f.integer(k, name), int(c)))
    return found

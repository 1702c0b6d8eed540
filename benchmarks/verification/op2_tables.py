"""Element results of commercial OP2 files, arranged as our tables have them."""

import logging
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.verification.row import LINES, SURFACES, Row
from benchmarks.verification.runner import Results

# Columns of pyNastran's arrays that our tables print; None: all of them.
_BAR_STRESS = [0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13]
_COLUMNS: dict[str, list[int] | None] = {
    "force/crod": None,
    "force/cbar": None,
    "force/cbeam": [1, 2, 3, 4, 5, 6, 7],
    "force/cquad4": None,
    "force/ctria3": None,
    "stress/crod": [0, 2],
    "stress/cbar": _BAR_STRESS,
    "stress/cbeam": [0, 1, 2, 3, 4, 5],
    "stress/ctube": [0, 2],
    "stress/celas3": None,
    "stress/cquad4": None,
    "stress/ctria3": None,
    "stress/cquad4_composite": None,
    "stress/ctria3_composite": None,
    "stress/chexa": None,
    "stress/cpenta": None,
    "stress/ctetra": None,
    "strain/crod": [0, 2],
    "strain/cbar": _BAR_STRESS,
    "strain/cbeam": [0, 1, 2, 3, 4, 5],
    "strain/ctube": [0, 2],
    "strain/cquad4": None,
    "strain/ctria3": None,
    "strain/cquad4_composite": None,
    "strain/ctria3_composite": None,
    "strain/chexa": None,
    "strain/cpenta": None,
    "strain/ctetra": None,
}
_LINE_CARDS = ("crod", "cbar", "cbeam", "ctube", "celas3")


def read_op2(path: Path) -> Any:
    """pyNastran's model of an OP2 file."""
    from pyNastran.op2.op2 import OP2

    logging.disable(logging.WARNING)
    try:
        model = OP2(debug=None)
        model.read_op2(str(path))
    finally:
        logging.disable(logging.NOTSET)
    return model


def first_times(table: Any) -> np.ndarray:
    """Positions of the times of a table, each once: some files hold them twice."""
    return np.unique(table._times, return_index=True)[1]


def element_rows(
    case: str,
    results: Results,
    name: str,
    op2: Any,
    subcase: int,
    source: str,
    *,
    sign: np.ndarray | None = None,
) -> list[Row]:
    """One row for each table that the file and our results have in common.

    Args:
        case: name of the case.
        results: ours.
        name: group of our results, "static/1".
        op2: theirs.
        subcase: its id there.
        source: the solver.
        sign: (t,) of our modes; then only what is linear, the forces, is compared.
    """
    rows = []
    for key, columns in _COLUMNS.items():
        kind, card = key.split("/")
        table = getattr(getattr(op2.op2_results, kind), f"{card}_{kind}", {})
        ours = f"{name}/element_{kind}/{card.upper()}"
        if subcase not in table or f"{ours}/id" not in results:
            continue
        if sign is not None and kind != "force":
            continue
        theirs = _by_element(table[subcase], results[f"{ours}/id"], columns, card)
        values = results[f"{ours}/value"]
        values = values.reshape(len(theirs), *values.shape[-2:])
        if sign is not None:
            values = sign[:, None, None] * values
        target = LINES if card in _LINE_CARDS else SURFACES
        title = f"{kind} of {card.upper().replace('_', ' ')}"
        rows.append(_compare(case, title, values, theirs, source, target))
    return rows


def _by_element(
    table: Any, ids: np.ndarray, columns: list[int] | None, card: str
) -> np.ndarray:
    """(t, e, c) results of elements, rows of one element side by side."""
    owner = getattr(table, "element_node", None)
    if owner is None:
        owner = getattr(table, "element_layer", None)
    owner = table.element if owner is None else owner[:, 0]
    data = table.data[first_times(table)].astype(float)
    if card == "cbar" and table.get_headers()[0] == "station":
        return _from_stations(data)[:, None]
    data = data if columns is None else data[..., columns]
    parts = []
    for element in ids:
        values = data[:, owner == element]
        if card == "cbeam":  # the stations between are not printed by us
            values = values[:, [0, -1]]
        parts.append(values.reshape(len(values), -1))
    widest = max(part.shape[1] for part in parts)
    padded = [
        np.pad(p, ((0, 0), (0, widest - p.shape[1])), constant_values=np.nan)
        for p in parts
    ]
    return np.stack(padded, axis=1)


def _from_stations(data: np.ndarray) -> np.ndarray:
    """(t, 8) forces of one CBAR from those at its stations (t, s, 7), the ends."""
    first, last = data[:, 0], data[:, -1]
    return np.concatenate([first[:, 1:3], last[:, 1:3], first[:, 3:]], axis=1)


def _compare(
    case: str,
    title: str,
    ours: np.ndarray,
    theirs: np.ndarray,
    source: str,
    target: float,
) -> Row:
    """Largest difference over the peak of its column.

    The scale of a column is at least a hundredth of the table's peak: below lies the
    noise of single precision. Where the file has corners and we the center (or the
    other way round), the center, which comes first, is compared.
    """
    width = min(ours.shape[-1], theirs.shape[-1])
    a, b = ours[..., :width], theirs[..., :width]
    known = np.isfinite(b) & np.isfinite(a)
    a, b = np.where(known, a, 0.0), np.where(known, b, 0.0)
    peaks = np.abs(b).max(axis=(0, 1))
    scale = np.maximum(peaks, 1e-2 * peaks.max())
    difference = np.abs(a - b) / scale
    # Directions of principal axes jump by a half turn: not compared.
    turning = _angle_columns(title, width)
    difference[..., turning] = 0.0
    at = np.unravel_index(int(np.argmax(difference)), difference.shape)
    return Row(
        case=case,
        quantity=f"{title}, {b.shape[1]} elements, {width} columns; the worst",
        ours=float(a[at]),
        theirs=float(b[at]),
        difference=float(difference[at]),
        target=target,
        source=source,
    )


def _angle_columns(title: str, width: int) -> list[int]:
    if title.startswith("force") or not ("CQUAD4" in title or "CTRIA3" in title):
        return []
    period, first = (9, 5) if "COMPOSITE" in title else (8, 4)
    return list(range(first, width, period))

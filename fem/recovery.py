"""Element forces and stresses from displacements, as sparse operators.

Each result table (forces of CBAR, stresses of CQUAD4 ...) is one sparse matrix on the
g-set for its linear quantities, followed by what is not linear (von Mises, principal
values). A transient multiplies by the operator only; nothing is done per element.
"""

from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.assembly import triples_rotation, turn_columns
from fem.deck.case_control import Selection
from fem.elements.block import ElementBlock, Recovery
from fem.points import Points

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Kind = Literal["force", "stress"]


@dataclass(frozen=True, kw_only=True)
class ElementTable:
    """Results of all chosen elements of one card.

    Attributes:
        table: Nastran's name, "CBAR".
        columns: names of the printed columns.
        id: (e,) element ids, ascending.
        operator: (r, g) sparse, linear quantities of all parts below each other.
        parts: recoveries of the blocks, in the order of the rows.
        order: (e,) positions of `id` in the parts put together.
    """

    table: str
    columns: tuple[str, ...]
    id: Int64
    operator: sp.csr_matrix
    parts: tuple[Recovery, ...]
    order: npt.NDArray[np.intp]

    def evaluate(self, linear: Float64) -> Float64:
        """Printed columns (..., e, c) from linear quantities (..., r)."""
        values, start = [], 0
        for part in self.parts:
            elements, quantities, _ = part.matrix.shape
            stop = start + elements * quantities
            flat = linear[..., start:stop]
            shaped = flat.reshape(*linear.shape[:-1], elements, quantities)
            values.append(part.derive(shaped))
            start = stop
        return np.concatenate(values, axis=-2)[..., self.order, :]

    def of(self, displacement: Float64) -> Float64:
        """Results (e, c) of displacements (g,), or (k, e, c) of (g, k)."""
        return self.evaluate((self.operator @ displacement).T)


def element_tables(
    points: Points,
    blocks: Iterable[ElementBlock],
    kind: Kind,
    selection: Selection = "ALL",
) -> list[ElementTable]:
    """Tables of the chosen elements that have results of a kind.

    Args:
        points: numbering and displacement frames.
        blocks: the elements.
        kind: "force" or "stress".
        selection: "ALL", "NONE" or element ids.
    """
    groups: dict[tuple[str, tuple[str, ...]], list[tuple[Recovery, sp.csr_matrix]]] = {}
    if selection == "NONE":
        return []
    for block in blocks:
        recovery = block.forces() if kind == "force" else block.stresses()
        if recovery is None:
            continue
        dof = block.dof
        if selection != "ALL":
            keep = np.isin(recovery.id, np.fromiter(selection, np.int64))
            recovery, dof = _chosen(recovery, keep), dof[keep]
        if not len(recovery.id):
            continue
        operator = _operator(points, block.frame, dof, recovery.matrix)
        key = (recovery.table, recovery.columns)
        groups.setdefault(key, []).append((recovery, operator))
    return [_table(name, columns, parts) for (name, columns), parts in groups.items()]


def _table(
    name: str,
    columns: tuple[str, ...],
    parts: list[tuple[Recovery, sp.csr_matrix]],
) -> ElementTable:
    ids = np.concatenate([recovery.id for recovery, _ in parts])
    order = np.argsort(ids, kind="stable")
    return ElementTable(
        table=name,
        columns=columns,
        id=ids[order],
        operator=sp.csr_matrix(sp.vstack([operator for _, operator in parts])),
        parts=tuple(recovery for recovery, _ in parts),
        order=order,
    )


def _chosen(recovery: Recovery, keep: npt.NDArray[np.bool_]) -> Recovery:
    """A recovery with some of its elements; arrays of elements are cut alike."""
    changes: dict[str, object] = {}
    for field in fields(recovery):
        value = getattr(recovery, field.name)
        if isinstance(value, np.ndarray) and value.shape[:1] == keep.shape:
            changes[field.name] = value[keep]
    return replace(recovery, **changes)


def _operator(points: Points, frame: str, dof: Int64, matrix: Float64) -> sp.csr_matrix:
    """(e c, g) rows of element matrices (e, c, n) on the displacement frames."""
    if frame == "basic":
        turn = triples_rotation(points, dof)
        if turn is not None:
            matrix = turn_columns(matrix, turn)
    e, c, _ = matrix.shape
    row = np.broadcast_to(np.arange(e * c).reshape(e, c, 1), matrix.shape)
    column = np.broadcast_to(dof[:, None, :], matrix.shape)
    keep = (matrix != 0.0) & (column >= 0)
    return sp.csr_matrix(
        (matrix[keep], (row[keep], column[keep])), shape=(e * c, points.size)
    )

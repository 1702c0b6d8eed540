"""Element forces and stresses from displacements, as sparse operators.

Each result table (forces of CBAR, stresses of CQUAD4 ...) is one sparse matrix on the
g-set for its linear quantities, followed by what is not linear (von Mises, principal
values). A transient multiplies by the operator only; nothing is done per element.
Dampers add a second matrix, on velocities; loads on elements between their grids
(PLOAD1) add columns that their factors multiply.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.sparse_products import shape_of
from fem.arrays import Float64, Int64
from fem.deck.control.case_sets import Selection
from fem.elements.block import CENTER, Detail, ElementBlock, Kind, Recovery
from fem.elements.lines.beam_stations import StationRecovery
from fem.geometry.points import Points
from fem.loads.element_loads import ElementLoads
from fem.loads.thermal import FreeMotions
from fem.model.assembly import triples_rotation, turn_columns

Complex128 = npt.NDArray[np.complex128]

# Elements that are evaluated at once: histories of their results fit into a cache.
_PIECE = 256


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
        rate: (r, g) what velocities add, None: nothing.
        loss: (r, g) the imaginary part of `operator` in harmonic motion, None: none.
        of_loads: (r, k) what loads on elements add per unit of their k factors, None:
            nothing.
    """

    table: str
    columns: tuple[str, ...]
    id: Int64
    operator: sp.csr_matrix
    parts: tuple[Recovery, ...]
    order: npt.NDArray[np.intp]
    rate: sp.csr_matrix | None = None
    loss: sp.csr_matrix | None = None
    of_loads: Float64 | None = None

    def evaluate(self, linear: Float64) -> Float64:
        """Printed columns (..., e, c) from linear quantities (..., r)."""
        lead = linear.shape[:-1]
        values = np.empty((*lead, len(self.id), len(self.columns)))
        for piece in self.pieces:
            values[..., piece.place, :] = piece.evaluate(linear)
        return values

    @cached_property
    def pieces(self) -> tuple["TablePiece", ...]:
        """The table in groups of elements, the results of which fit into caches."""
        place = np.empty_like(self.order)
        place[self.order] = np.arange(len(self.order))
        pieces, row, first = [], 0, 0
        for part in self.parts:
            elements, quantities, _ = part.matrix.shape
            for start in range(0, elements, _PIECE):
                stop = min(start + _PIECE, elements)
                pieces.append(
                    TablePiece(
                        recovery=_cut(part, slice(start, stop)),
                        rows=slice(row + start * quantities, row + stop * quantities),
                        place=place[first + start : first + stop],
                    )
                )
            row, first = row + elements * quantities, first + elements
        return tuple(pieces)

    def harmonic(self, u: Complex128, rate: Complex128) -> Complex128:
        """(f, r) linear quantities of displacements u (f, g); rate (f, 1): i omega."""
        linear = (self.operator @ u.T).T
        if self.rate is not None:
            linear = linear + (self.rate @ (rate * u).T).T
        if self.loss is not None:
            linear = linear + 1j * (self.loss @ u.T).T
        return np.asarray(linear, np.complex128)

    def of(self, displacement: Float64) -> Float64:
        """Results (e, c) of displacements (g,), or (t, e, c) of (g, t), at rest.

        Loads on elements count with the factor one.
        """
        linear = (self.operator @ displacement).T
        if self.of_loads is not None:
            linear = linear + self.of_loads.sum(axis=1)
        return self.evaluate(linear)


@dataclass(frozen=True, kw_only=True)
class TablePiece:
    """Some elements of a table.

    Attributes:
        recovery: theirs.
        rows: their linear quantities among those of the table.
        place: (n,) their positions in the table's `id`.
    """

    recovery: Recovery
    rows: slice
    place: npt.NDArray[np.intp]

    def evaluate(self, linear: Float64) -> Float64:
        """Printed columns (..., n, c) from linear quantities (..., r) of the table."""
        own = linear[..., self.rows]
        shape = (len(self.place), self.recovery.matrix.shape[1])
        return self.recovery.derive(own.reshape(*linear.shape[:-1], *shape))


@dataclass(frozen=True, kw_only=True)
class _Part:
    """Results of one block within a table."""

    recovery: Recovery
    operator: sp.csr_matrix
    rate: sp.csr_matrix | None
    loss: sp.csr_matrix | None
    of_loads: Float64 | None


def element_tables(
    points: Points,
    blocks: Iterable[ElementBlock],
    kind: Kind,
    selection: Selection = "ALL",
    *,
    detail: Detail = CENTER,
    loads: ElementLoads | None = None,
    moving: bool = False,
    free: FreeMotions | None = None,
) -> list[ElementTable]:
    """Tables of the chosen elements that have results of a kind.

    Args:
        points: numbering and displacement frames.
        blocks: the elements.
        kind: "force", "stress", "strain" or "failure".
        selection: "ALL", "NONE" or element ids.
        detail: corners, fibres.
        loads: loads on elements between their grids.
        moving: velocities are known; without, dampers have no results.
        free: what elements do that nothing hinders, which costs no force and no
            stress; strains are those of all displacements (from memory: Nastran's).
    """
    groups: dict[tuple[str, tuple[str, ...]], list[_Part]] = {}
    if selection == "NONE":
        return []
    for block in blocks:
        recovery = block.recovery(kind, detail)
        if recovery is None or not (moving or np.any(recovery.matrix)):
            continue
        keep = np.full(len(recovery.id), True)
        if selection != "ALL":
            keep = np.isin(recovery.id, np.fromiter(selection, np.int64))
            recovery = _cut(recovery, keep)
        if not len(recovery.id):
            continue
        key = (recovery.table, recovery.columns)
        motion = None if free is None or kind == "strain" else free.of(block)
        relief = None
        if free is not None and motion is not None:
            relief = -np.einsum("ecn,en->ec", recovery.matrix, motion[keep])
            recovery, relief = recovery.heated(relief, free.heat_of(block)[keep])
        part = _part(points, block, kind, detail, recovery, keep, loads, moving)
        if relief is not None:
            part = replace(part, of_loads=_beside(part.of_loads, relief))
        groups.setdefault(key, []).append(part)
    return [_table(name, columns, parts) for (name, columns), parts in groups.items()]


def loaded_bar_tables(
    points: Points,
    blocks: Iterable[ElementBlock],
    selection: Selection,
    loads: ElementLoads | None,
    free: FreeMotions | None = None,
) -> list[ElementTable]:
    """Forces at both ends of the chosen CBAR elements that loads act upon (PLOAD1)."""
    if loads is None or selection == "NONE":
        return []
    loaded = frozenset(loads.id.tolist())
    return element_tables(
        points,
        [block for block in blocks if block.card == "CBAR"],
        "force",
        loaded if selection == "ALL" else loaded & selection,
        detail=Detail(ends=True),
        loads=loads,
        free=free,
    )


def station_tables(
    points: Points,
    blocks: Iterable[ElementBlock],
    kind: Kind,
    selection: Selection,
    loads: ElementLoads | None,
    free: FreeMotions | None = None,
) -> list[ElementTable]:
    """Results of the chosen CBEAM elements at stations between their ends.

    Elements under loads between their grids are left out: what these do up to a station
    is not known here.
    """
    if selection == "NONE":
        return []
    detail = Detail(stations=True)
    beams = [block for block in blocks if block.card == "CBEAM"]
    found: set[int] = set()
    for block in beams:
        recovery = block.recovery(kind, detail)
        if isinstance(recovery, StationRecovery):
            found.update(recovery.id[~np.isnan(recovery.x).all(axis=1)].tolist())
    if loads is not None:
        found -= set(loads.id.tolist())
    chosen = frozenset(found if selection == "ALL" else found & selection)
    return element_tables(points, beams, kind, chosen, detail=detail, free=free)


def _part(
    points: Points,
    block: ElementBlock,
    kind: Kind,
    detail: Detail,
    recovery: Recovery,
    keep: npt.NDArray[np.bool_],
    loads: ElementLoads | None,
    moving: bool,
) -> _Part:
    dof = block.dof[keep]
    rate = loss = None
    if moving and recovery.loss is not None and np.any(recovery.loss):
        loss = _operator(points, block.frame, dof, recovery.loss)
    if moving and recovery.rate is not None and np.any(recovery.rate):
        rate = _operator(points, block.frame, dof, recovery.rate)
    return _Part(
        recovery=recovery,
        operator=_operator(points, block.frame, dof, recovery.matrix),
        rate=rate,
        loss=loss,
        of_loads=None
        if loads is None
        else _of_loads(points, block, kind, detail, recovery.id, loads),
    )


def _of_loads(
    points: Points,
    block: ElementBlock,
    kind: Kind,
    detail: Detail,
    ids: Int64,
    loads: ElementLoads,
) -> Float64 | None:
    """(e c, k) what loads on elements of a block take from its linear results."""
    matrix = block.of_nodal_forces(kind, detail)
    at = np.flatnonzero(np.isin(loads.id, ids) & np.isin(loads.id, block.id))
    if matrix is None or not len(at):
        return None
    own = np.searchsorted(block.id, loads.id[at])
    same = (block.grid_dof[own] == loads.dof[at]).all(axis=1)
    at, own = at[same], own[same]
    chosen, turn = matrix[own], triples_rotation(points, loads.dof[at])
    if turn is not None:
        chosen = turn_columns(chosen, turn)
    result = np.zeros((len(ids), matrix.shape[1], loads.patterns))
    row = np.searchsorted(ids, loads.id[at])
    np.add.at(result, row, -np.einsum("ecj,ejk->eck", chosen, loads.value[at]))
    return result.reshape(-1, loads.patterns)


def _beside(of_loads: Float64 | None, more: Float64) -> Float64:
    """(e c, k + 1) what loads add, with one more load (e, c)."""
    column = more.reshape(-1, 1)
    return column if of_loads is None else np.hstack([of_loads, column])


def _table(name: str, columns: tuple[str, ...], parts: Sequence[_Part]) -> ElementTable:
    ids = np.concatenate([part.recovery.id for part in parts])
    order = np.argsort(ids, kind="stable")
    return ElementTable(
        table=name,
        columns=columns,
        id=ids[order],
        operator=sp.csr_matrix(sp.vstack([part.operator for part in parts])),
        parts=tuple(part.recovery for part in parts),
        order=order,
        rate=_stacked([part.rate for part in parts], parts),
        loss=_stacked([part.loss for part in parts], parts),
        of_loads=_below([part.of_loads for part in parts], parts),
    )


def _rows(part: _Part) -> int:
    return len(part.operator.indptr) - 1


def _stacked(
    matrices: Sequence[sp.csr_matrix | None], parts: Sequence[_Part]
) -> sp.csr_matrix | None:
    """Matrices below each other, zero where there is none; None: there are none."""
    if all(matrix is None for matrix in matrices):
        return None
    given = [
        sp.csr_matrix((_rows(part), shape_of(part.operator)[1]))
        if matrix is None
        else matrix
        for matrix, part in zip(matrices, parts)
    ]
    return sp.csr_matrix(sp.vstack(given))


def _below(arrays: Sequence[Float64 | None], parts: Sequence[_Part]) -> Float64 | None:
    """As `_stacked` for arrays."""
    widths = [array.shape[1] for array in arrays if array is not None]
    if not widths:
        return None
    widest = max(widths)
    given = [np.zeros((_rows(p), 0)) if a is None else a for a, p in zip(arrays, parts)]
    return np.concatenate(
        [np.pad(array, ((0, 0), (0, widest - array.shape[1]))) for array in given]
    )


def _cut(recovery: Recovery, keep: npt.NDArray[np.bool_] | slice) -> Recovery:
    """A recovery with some of its elements; arrays of elements are cut alike."""
    changes: dict[str, object] = {}
    for field in fields(recovery):
        value = getattr(recovery, field.name)
        if isinstance(value, np.ndarray) and value.shape[:1] == recovery.id.shape:
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

"""Grid point force balance and strain energy of elements.

The balance lists, for every grid, the forces of each element on it, the applied load
and the forces of constraint; their sum is the unbalanced rest (in dynamics: inertia
and damping). Forces of elements on the grid are -K_e u_e, in the displacement frame of
the grid; loads on elements between grids stand with the applied loads, as Nastran has
it.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Bool, Float64, Int64
from fem.constraints.elimination import Elimination
from fem.elements.block import ElementBlock
from fem.geometry.points import Points, grid_freedoms
from fem.loads.thermal import FreeMotions
from fem.model.assembly import to_displacement, triples_rotation, turn_columns

APPLIED, SPC, MPC, TOTAL = "APP-LOAD", "F-OF-SPC", "F-OF-MPC", "*TOTALS*"


@dataclass(frozen=True, kw_only=True)
class GridBalance:
    """Rows of a table of grid point forces, sorted by grid; elements come first.

    Attributes:
        grid_id: (n,) grid of each row.
        element_id: (n,) element, 0 for loads, constraints and totals.
        source: (n,) card of the element, or APP-LOAD, F-OF-SPC, F-OF-MPC, *TOTALS*.
        at: (n,) position of the grid in the model.
        elements: (6 n, g) sparse, -K_e in the rows of elements.
    """

    grid_id: Int64
    element_id: Int64
    source: npt.NDArray[np.str_]
    at: Int64
    elements: sp.csr_matrix

    def table(
        self, of_elements: Float64, load: Float64, spc: Float64, mpc: Float64
    ) -> Float64:
        """Forces in all rows.

        Args:
            of_elements: (k, 6 n) `elements` times displacements.
            load, spc, mpc: (k, 6 grids) of the grids of the model.

        Returns:
            (k, n, 6) along T1 T2 T3 R1 R2 R3 of the grids.
        """
        count = len(self.at)
        force = of_elements.reshape(len(of_elements), count, 6).copy()
        for source, values in ((APPLIED, load), (SPC, spc), (MPC, mpc)):
            rows = np.flatnonzero(self.source == source)
            force[:, rows] = values.reshape(len(values), -1, 6)[:, self.at[rows]]
        totals = np.flatnonzero(self.source == TOTAL)
        # Each grid's rows end with its total.
        first = np.concatenate([[0], totals[:-1] + 1]) if len(totals) else totals
        if len(totals):
            force[:, totals] = np.add.reduceat(force, first, axis=1)
        return force


def grid_balance(
    points: Points,
    blocks: Iterable[ElementBlock],
    *,
    loaded: Bool,
    spc: Bool,
    mpc: Bool,
    wanted: Int64 | None = None,
) -> GridBalance:
    """Rows of the balance.

    Args:
        points, blocks: the model.
        loaded, spc, mpc: (grids,) which grids get rows of applied loads and of forces
            of constraint.
        wanted: grids of the table; None: all.
    """
    count = len(points.grid_id)
    chosen = np.full(count, True)
    if wanted is not None:
        chosen = np.isin(points.grid_id, wanted)
    at: list[Int64] = []
    element: list[Int64] = []
    names: list[str] = []
    sizes: list[int] = []
    operators: list[sp.csr_matrix] = []
    for block in blocks:
        part = _of_block(points, block, chosen)
        if part is not None:
            at.append(part[0])
            element.append(part[1])
            operators.append(part[2])
            names.append(block.card)
            sizes.append(len(part[0]))
    for name, mask in ((APPLIED, loaded), (SPC, spc), (MPC, mpc), (TOTAL, chosen)):
        rows = np.flatnonzero(mask & chosen)
        at.append(rows)
        element.append(np.zeros_like(rows))
        names.append(name)
        sizes.append(len(rows))
        operators.append(sp.csr_matrix((6 * len(rows), points.size)))
    grid = np.concatenate(at)
    ids = np.concatenate(element)
    kind = np.repeat(np.arange(len(names)), sizes)
    order = np.lexsort((ids, kind, grid))
    rows = grid_freedoms(order)
    return GridBalance(
        grid_id=points.grid_id[grid[order]],
        element_id=ids[order],
        source=np.array(names)[kind[order]],
        at=grid[order],
        elements=sp.csr_matrix(sp.vstack(operators, format="csr")[rows]),
    )


def grids_of(points: Points, values: Float64) -> Bool:
    """(grids,) where values (g,) or (g, k) are not zero."""
    rows = values[: 6 * len(points.grid_id)].reshape(len(points.grid_id), -1)
    return np.any(rows != 0.0, axis=1)


def constrained_grids(points: Points, elimination: Elimination) -> tuple[Bool, Bool]:
    """(grids,) with single-point constraints, and with rigid elements or MPC."""
    single, multi = np.zeros((2, points.size))
    single[elimination.s] = 1.0
    multi[elimination.m] = 1.0
    multi[np.unique(elimination.dependence.indices)] = 1.0
    return grids_of(points, single), grids_of(points, multi)


def _of_block(
    points: Points, block: ElementBlock, chosen: Bool
) -> tuple[Int64, Int64, sp.csr_matrix] | None:
    """Grid positions, elements and operator (6 n, g) of a block on its grids."""
    stiffness = block.stiffness()
    if stiffness is None:
        return None
    if block.frame == "basic":
        stiffness = to_displacement(points, block.dof, stiffness)
    dof = block.dof
    grids = 6 * len(points.grid_id)
    on_grid = (dof >= 0) & (dof < grids)
    on_grid[on_grid] = chosen[dof[on_grid] // 6]
    element = np.broadcast_to(np.arange(len(block.id))[:, None], dof.shape)
    # One group of six rows for each pair of element and grid.
    pairs = np.stack([element[on_grid], dof[on_grid] // 6], axis=1)
    pair, index = np.unique(pairs, axis=0, return_inverse=True)
    rows = np.full(dof.shape, -1)
    rows[on_grid] = 6 * index.reshape(-1) + dof[on_grid] % 6
    keep = (rows[:, :, None] >= 0) & (dof[:, None, :] >= 0) & (stiffness != 0.0)
    row = np.broadcast_to(rows[:, :, None], keep.shape)[keep]
    column = np.broadcast_to(dof[:, None, :], keep.shape)[keep]
    operator = sp.csr_matrix(
        (-stiffness[keep], (row, column)), shape=(6 * len(pair), points.size)
    )
    return pair[:, 1], block.id[pair[:, 0]], operator


def strain_energy(
    points: Points,
    blocks: Iterable[ElementBlock],
    displacement: Float64,
    free: FreeMotions | None = None,
) -> dict[str, tuple[Int64, Float64]]:
    """Strain energy ½ u_eᵀ K_e u_e of every element.

    Args:
        points, blocks: the model.
        displacement: (g,), or (g, k) for k modes or subcases.
        free: what elements do that nothing hinders, without energy.

    Returns:
        By card: ids (e,), values (e,) or (k, e).
    """
    parts: dict[str, list[tuple[Int64, Float64]]] = {}
    for block in blocks:
        stiffness = block.stiffness()
        if stiffness is None:
            continue
        if block.frame == "basic":
            stiffness = to_displacement(points, block.dof, stiffness)
        moving = displacement.reshape(len(displacement), -1)[block.dof]
        u = np.where((block.dof >= 0)[:, :, None], moving, 0.0)
        motion = None if free is None else free.of(block)
        if motion is not None:
            turn = triples_rotation(points, block.dof)
            row = motion[:, None]
            own = row if turn is None else turn_columns(row, turn)
            u = u - own.transpose(0, 2, 1)
        energy = 0.5 * np.einsum("eik,eik->ke", u, stiffness @ u)
        energy = energy[0] if displacement.ndim == 1 else energy
        parts.setdefault(block.card, []).append((block.id, energy))
    result = {}
    for card, pieces in parts.items():
        ids = np.concatenate([i for i, _ in pieces])
        values = np.concatenate([e for _, e in pieces], axis=-1)
        order = np.argsort(ids, kind="stable")
        result[card] = ids[order], values[..., order]
    return result

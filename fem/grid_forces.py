"""Grid point force balance and strain energy of elements, for one displacement vector.

The balance lists, for every grid, the forces of each element on it, the applied load
and the forces of constraint; their sum is the unbalanced rest. Forces of elements on
the grid are -K_e u_e, in the displacement frame of the grid, as Nastran prints them.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.assembly import to_displacement
from fem.elements.block import ElementBlock
from fem.points import Points

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

APPLIED, SPC, MPC, TOTAL = "APP-LOAD", "F-OF-SPC", "F-OF-MPC", "*TOTALS*"


@dataclass(frozen=True, kw_only=True)
class GridForces:
    """Table of the balance, sorted by grid; contributions of elements come first.

    Attributes:
        grid_id: (n,) grid of each row.
        element_id: (n,) element, 0 for loads, constraints and totals.
        source: (n,) card of the element, or APP-LOAD, F-OF-SPC, F-OF-MPC, *TOTALS*.
        force: (n, 6) along T1 T2 T3 R1 R2 R3 of the grid.
    """

    grid_id: Int64
    element_id: Int64
    source: npt.NDArray[np.str_]
    force: Float64


def grid_forces(
    points: Points,
    blocks: Iterable[ElementBlock],
    displacement: Float64,
    *,
    load: Float64,
    spc_force: Float64,
    mpc_force: Float64,
    wanted: Int64 | None = None,
) -> GridForces:
    """Balance of forces at grids.

    Args:
        points, blocks: the model.
        displacement, load, spc_force, mpc_force: (g,).
        wanted: grids of the table; None: all.
    """
    columns: list[tuple[Int64, Int64, str, Float64]] = []
    total = np.zeros((len(points.grid_id), 6))
    for block in blocks:
        part = _of_block(points, block, displacement)
        if part is None:
            continue
        at, element, force = part
        np.add.at(total, at, force)
        columns.append((at, element, block.card, force))
    for source, vector in ((APPLIED, load), (SPC, spc_force), (MPC, mpc_force)):
        force = vector[: 6 * len(points.grid_id)].reshape(-1, 6)
        at = np.flatnonzero(np.any(force != 0.0, axis=1))
        total[at] += force[at]
        columns.append((at, np.zeros_like(at), source, force[at]))
    every = np.arange(len(total))
    columns.append((every, np.zeros_like(every), TOTAL, total))
    return _sorted(points, columns, wanted)


def _of_block(
    points: Points, block: ElementBlock, displacement: Float64
) -> tuple[Int64, Int64, Float64] | None:
    """Grid positions, elements and forces (n, 6) of a block on its grids."""
    forces = _nodal(points, block, displacement)
    if forces is None:
        return None
    grids = 6 * len(points.grid_id)
    on_grid = (block.dof >= 0) & (block.dof < grids)
    element = np.broadcast_to(np.arange(len(block.id))[:, None], block.dof.shape)
    dof, element, values = block.dof[on_grid], element[on_grid], forces[on_grid]
    # One row for each pair of element and grid.
    pair, row = np.unique(
        np.stack([element, dof // 6], axis=1), axis=0, return_inverse=True
    )
    table = np.zeros((len(pair), 6))
    np.add.at(table, (row.reshape(-1), dof % 6), values)
    return pair[:, 1], block.id[pair[:, 0]], table


def _nodal(
    points: Points, block: ElementBlock, displacement: Float64
) -> Float64 | None:
    """(e, n) forces -K_e u_e of elements on their freedoms, displacement frames."""
    stiffness = block.stiffness()
    if stiffness is None:
        return None
    if block.frame == "basic":
        stiffness = to_displacement(points, block.dof, stiffness)
    u = np.where(block.dof >= 0, displacement[block.dof], 0.0)
    return -np.einsum("eij,ej->ei", stiffness, u)


def _sorted(
    points: Points,
    columns: list[tuple[Int64, Int64, str, Float64]],
    wanted: Int64 | None,
) -> GridForces:
    grid = np.concatenate([points.grid_id[at] for at, _, _, _ in columns])
    element = np.concatenate([ids for _, ids, _, _ in columns])
    source = np.concatenate([np.full(len(at), name) for at, _, name, _ in columns])
    force = np.concatenate([values for _, _, _, values in columns])
    kind = np.concatenate(
        [np.full(len(at), i) for i, (at, _, _, _) in enumerate(columns)]
    )
    order = np.lexsort((element, kind, grid))
    if wanted is not None:
        order = order[np.isin(grid[order], wanted)]
    return GridForces(
        grid_id=grid[order],
        element_id=element[order],
        source=source[order],
        force=force[order],
    )


def strain_energy(
    points: Points, blocks: Iterable[ElementBlock], displacement: Float64
) -> dict[str, tuple[Int64, Float64]]:
    """Strain energy ½ u_eᵀ K_e u_e of every element, by card: ids (e,), values (e,)."""
    parts: dict[str, list[tuple[Int64, Float64]]] = {}
    for block in blocks:
        forces = _nodal(points, block, displacement)
        if forces is None:
            continue
        u = np.where(block.dof >= 0, displacement[block.dof], 0.0)
        energy = -0.5 * np.einsum("ei,ei->e", u, forces)
        parts.setdefault(block.card, []).append((block.id, energy))
    result = {}
    for card, pieces in parts.items():
        ids = np.concatenate([i for i, _ in pieces])
        values = np.concatenate([e for _, e in pieces])
        order = np.argsort(ids, kind="stable")
        result[card] = ids[order], values[order]
    return result

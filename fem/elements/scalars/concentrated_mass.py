"""CONM1 and CONM2: the mass matrix of a rigid body at a grid."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64
from fem.deck.references import column, table
from fem.elements.dense import DenseBlock
from fem.elements.lines.line_geometry import congruence, skew
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class PointMasses(DenseBlock):
    """All CONM1 or CONM2 elements; matrix: (e, 6, 6) at the grid, basic axes."""

    matrix: Float64

    def mass(self, *, coupled: bool) -> Float64:
        """(e, 6, 6) about the grid, its offset included."""
        return self.matrix


def rigid_mass(mass: Float64, offset: Float64, inertia: Float64) -> Float64:
    """(e, 6, 6) mass matrices of rigid bodies about points.

    Args:
        mass: (e,).
        offset: (e, 3) center of gravity from the point.
        inertia: (e, 3, 3) tensor about the center of gravity, same axes.
    """
    matrix = np.zeros((len(mass), 6, 6))
    lever = skew(offset)
    m = mass[:, None, None]
    matrix[:, :3, :3] = m * np.eye(3)
    matrix[:, :3, 3:] = -m * lever
    matrix[:, 3:, :3] = m * lever
    matrix[:, 3:, 3:] = inertia - m * (lever @ lever)
    return matrix


def inertia_tensor(moments: Float64) -> Float64:
    """(e, 3, 3) from I11 I21 I22 I31 I32 I33 (e, 6); products ∫ x y dm are positive."""
    tensor = np.empty((len(moments), 3, 3))
    for k, (i, j) in enumerate(((0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2))):
        sign = 1.0 if i == j else -1.0
        tensor[:, i, j] = tensor[:, j, i] = sign * moments[:, k]
    return tensor


def read_conm2(deck: "Deck", points: Points) -> list[PointMasses]:
    """The CONM2 block of a deck, or none.

    With CID -1 the coordinates are those of the center of gravity in the basic frame.

    Raises:
        InputError: undefined grids or coordinate systems.
    """
    rows = table(deck, "CONM2").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    at = points.rows(rows["g"].to_numpy(np.int64))
    cid = rows["cid"].to_numpy(np.int64)
    axes = points.frames.triads(np.maximum(cid, 0), points.xyz[at])
    x = np.stack([column(rows, f"x{i}") for i in (1, 2, 3)], axis=1)
    offset = np.where(
        (cid == -1)[:, None], x - points.xyz[at], np.einsum("eij,ej->ei", axes, x)
    )
    names = ("i11", "i21", "i22", "i31", "i32", "i33")
    tensor = inertia_tensor(np.stack([column(rows, n) for n in names], axis=1))
    basic = axes @ tensor @ axes.transpose(0, 2, 1)
    return [
        PointMasses(
            card="CONM2",
            id=rows["eid"].to_numpy(np.int64),
            dof=6 * at[:, None] + np.arange(6),
            matrix=rigid_mass(column(rows, "m"), offset, basic),
        )
    ]


def read_conm1(deck: "Deck", points: Points) -> list[PointMasses]:
    """The CONM1 block of a deck, or none.

    Raises:
        InputError: undefined grids or coordinate systems.
    """
    rows = table(deck, "CONM1").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    at = points.rows(rows["g"].to_numpy(np.int64))
    axes = points.frames.triads(rows["cid"].to_numpy(np.int64), points.xyz[at])
    given = np.stack([np.asarray(m, float) for m in rows["ms"]])
    to_cid = np.zeros((len(rows), 6, 6))
    to_cid[:, :3, :3] = to_cid[:, 3:, 3:] = axes.transpose(0, 2, 1)
    return [
        PointMasses(
            card="CONM1",
            id=rows["eid"].to_numpy(np.int64),
            dof=6 * at[:, None] + np.arange(6),
            matrix=congruence(to_cid, given),
        )
    ]

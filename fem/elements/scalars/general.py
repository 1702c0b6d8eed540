"""GENEL: f_i = K (u_i - S u_d), f_d = -S^T f_i.

S carries the motion of the freedoms UD to UI; where the card has none, UD are six
freedoms that fix a rigid body and S is its motion. Stiffness on the freedoms of the
displacement frames.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Float64, Int64
from fem.deck.references import table, where
from fem.elements.dense import DenseBlock
from fem.elements.lines.line_geometry import skew
from fem.errors import InputError, Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class General(DenseBlock):
    """GENEL elements with one number of freedoms; matrix: (e, n, n)."""

    matrix: Float64

    def stiffness(self) -> Float64:
        """(e, n, n) as the card gives it."""
        return self.matrix


def read_genel(deck: "Deck", points: Points) -> list[General]:
    """The GENEL elements of a deck, a block for each number of freedoms.

    Raises:
        InputError: undefined freedoms, UD that do not fix a rigid body.
    """
    rows = table(deck, "GENEL").sort_values("eid", ignore_index=True)
    found: dict[int, list[tuple[int, Int64, Float64]]] = {}
    problems = Problems()
    for _, row in rows.iterrows():
        grids, comps = np.asarray(row["grids"]), np.asarray(row["comps"])
        with problems.gathered(where("GENEL", row)):
            matrix = _stiffness(points, grids, comps, row["k"], np.asarray(row["s"]))
            dof = points.dof(grids, comps)
            found.setdefault(len(grids), []).append((int(row["eid"]), dof, matrix))
    problems.report()
    return [
        General(
            card="GENEL",
            id=np.array([eid for eid, _, _ in part], dtype=np.int64),
            dof=np.stack([dof for _, dof, _ in part]),
            frame="displacement",
            matrix=np.stack([matrix for _, _, matrix in part]),
        )
        for _, part in sorted(found.items())
    ]


def _stiffness(
    points: Points, grids: Int64, comps: Int64, k: Float64, s: Float64
) -> Float64:
    """(m + n, m + n) of UI, then UD."""
    m = len(k)
    if len(grids) == m:
        return k
    if not s.size:
        s = _rigid(points, grids, comps, m)
    relative = np.hstack([np.eye(m), -s])
    return relative.T @ k @ relative


def _rigid(points: Points, grids: Int64, comps: Int64, m: int) -> Float64:
    """(m, 6) motion of UI with the rigid body that UD fix.

    Raises:
        InputError: UD do not fix it.
    """
    if (comps < 1).any():
        raise InputError("scalar points move with no rigid body, expected S")
    at = points.rows(grids)
    axis = points.rotation[at][np.arange(len(at)), :, (comps - 1) % 3]
    lever = points.xyz[at] - points.xyz[at[m]]
    translation, turning = np.eye(3)[None], -skew(lever)
    linear = (comps <= 3)[:, None, None]
    motion = np.concatenate(
        [
            np.where(linear, translation, np.zeros((3, 3))),
            np.where(linear, turning, translation),
        ],
        axis=2,
    )
    motion = np.einsum("ek,ekj->ej", axis, motion)
    size = np.linalg.norm(lever, axis=1).max() or 1.0
    scaled = motion * np.repeat([1.0, 1.0 / size], 3)
    if len(at) != m + 6 or np.linalg.cond(scaled[m:]) > 1e10:
        raise InputError(
            f"{len(at) - m} freedoms UD that do not fix a rigid body, expected six "
            "that do, or S"
        )
    return scaled[:m] @ np.linalg.inv(scaled[m:])

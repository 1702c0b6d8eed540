"""AUTOSPC: freedoms without stiffness at their own grid.

For each grid the 3x3 diagonal blocks of translations and of rotations of the reduced
stiffness are examined along their principal directions. A direction whose stiffness is
below EPZERO times the largest of its block is singular; the component nearest to it is
constrained, as Nastran does. This finds the drilling freedom of shells in any frame,
and trusses' rotations, but no mechanism of several grids.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.constraints.elimination import Elimination
from fem.geometry.points import Points

EPZERO = 1e-8
# Arm, as share of the coordinates, that only their rounding gives a force.
_ROUNDING = 1e-13


@dataclass(frozen=True, kw_only=True)
class Singularities:
    """Freedoms without stiffness.

    Attributes:
        dof: (n,) rows of the g-set, ascending.
        ratio: (n,) stiffness over the largest of the block, 0 for no stiffness at all.
    """

    dof: npt.NDArray[np.int64]
    ratio: npt.NDArray[np.float64]

    def lines(self, points: Points) -> list[str]:
        """One line of text per freedom."""
        return [
            f"{points.label(int(d))}: stiffness ratio {r:.3g}"
            for d, r in zip(self.dof, self.ratio)
        ]

    def summary(self, points: Points, *, most: int = 8) -> str:
        """ "8 freedoms without stiffness: grid 4 R1 R3, grid 5 R1, ..."."""
        shown = grouped([points.label(int(d)) for d in self.dof], most)
        count = len(self.dof)
        weak = self.ratio[self.ratio > 0.0]
        soft = f" (stiffness ratio up to {weak.max():.2g})" if len(weak) else ""
        plural = "freedom" if count == 1 else "freedoms"
        return f"{count} {plural} without stiffness{soft}: {shown}"


def grouped(names: Sequence[str], most: int) -> str:
    """ "grid 4 T1 T2, grid 5 T1" from labels of single freedoms.

    Args:
        names: labels such as "grid 4 T1" or "scalar point 7".
        most: points that are listed.
    """
    points: dict[str, list[str]] = {}
    for name in names:
        head, _, component = name.rpartition(" ")
        if head in ("", "scalar point"):
            points[name] = []
        else:
            points.setdefault(head, []).append(component)
    shown = [" ".join([point, *parts]) for point, parts in points.items()]
    more = f", ... ({len(shown)} points)" if len(shown) > most else ""
    return ", ".join(shown[:most]) + more


def find_singularities(
    reduced: sp.spmatrix,
    elimination: Elimination,
    points: Points,
    *,
    epzero: float = EPZERO,
) -> Singularities:
    """Singular freedoms among the free ones.

    Args:
        reduced: (f, f) stiffness, `elimination.reduce(K)`.
        elimination: whose f-set it belongs to.
        points: for the numbering.
        epzero: ratio below which a direction counts as singular (PARAM EPZERO).
    """
    f = elimination.f
    grids = 6 * len(points.grid_id)
    blocks, present = _diagonal_blocks(reduced.tocoo(), f, grids)
    _clear_rounding(blocks, np.abs(points.xyz).max(initial=0.0))
    dof, ratio = _weak_components(blocks, present, epzero)
    scalar = f >= grids
    diagonal = reduced.diagonal()
    loose = f[scalar & (diagonal == 0.0)]
    dof = np.concatenate([dof, loose])
    ratio = np.concatenate([ratio, np.zeros(len(loose))])
    order = np.argsort(dof)
    return Singularities(dof=dof[order], ratio=ratio[order])


def _diagonal_blocks(
    reduced: sp.coo_matrix, f: npt.NDArray[np.int64], grids: int
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.bool_]]:
    """(b, 3, 3) diagonal blocks of all grids, and (b, 3) which components are free."""
    row, column = f[reduced.row], f[reduced.col]
    near = (row // 3 == column // 3) & (row < grids)
    blocks = np.zeros((grids // 3, 3, 3))
    np.add.at(
        blocks, (row[near] // 3, row[near] % 3, column[near] % 3), reduced.data[near]
    )
    present = np.zeros((grids // 3, 3), bool)
    present.reshape(-1)[f[f < grids]] = True
    return blocks, present


def _clear_rounding(blocks: npt.NDArray[np.float64], extent: float) -> None:
    """No stiffness of rotations (b, 3, 3) that is only rounding.

    A force along a line through a grid has an arm of rounding about it, whose square
    times the stiffness of the force would count as stiffness of the rotation.
    """
    forces, moments = blocks[0::2], blocks[1::2]
    stiffest = np.abs(forces).max(initial=0.0)
    largest = np.abs(moments).max(axis=(1, 2), initial=0.0)
    moments[largest <= stiffest * (_ROUNDING * extent) ** 2] = 0.0


def _weak_components(
    blocks: npt.NDArray[np.float64],
    present: npt.NDArray[np.bool_],
    epzero: float,
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.float64]]:
    """Rows of the g-set and ratios; one component for each weak direction."""
    absent = np.where(present, 0.0, _largest_diagonal(blocks)[:, None])
    values, vectors = np.linalg.eigh(blocks + absent[:, :, None] * np.eye(3))
    largest = np.abs(values).max(axis=1, initial=0.0)
    ratio = np.abs(values) / np.where(largest > 0.0, largest, 1.0)[:, None]
    found: list[npt.NDArray[np.int64]] = []
    ratios: list[npt.NDArray[np.float64]] = []
    for k in range(3):
        at = np.flatnonzero(ratio[:, k] < epzero)
        share = np.where(present[at], np.abs(vectors[at, :, k]), 0.0)
        component = share.argmax(axis=1)
        pivot = vectors[at, component, k]
        # The other weak directions of a grid must not need the same component.
        for j in range(k + 1, 3):
            factor = vectors[at, component, j] / pivot
            vectors[at, :, j] -= factor[:, None] * vectors[at, :, k]
        found.append(3 * at + component)
        ratios.append(ratio[at, k])
    return np.concatenate(found), np.concatenate(ratios)


def _largest_diagonal(
    blocks: npt.NDArray[np.float64],
) -> npt.NDArray[np.float64]:
    """(b,) a stiffness for constrained components; 1 where a block has none."""
    largest = np.einsum("bii->bi", blocks).max(axis=1, initial=0.0)
    return np.where(largest > 0.0, largest, 1.0)

"""Grid and scalar points: positions, displacement frames, numbering of the g-set.

The g-set has six rows per grid in ascending grid id (T1 T2 T3 R1 R2 R3 along the axes
of the grid's displacement frame CD), then one row per scalar point in ascending id.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.arrays import Bool, Float64, Int64
from fem.errors import InputError
from fem.geometry.coordinates import Frames

COMPONENTS = ("T1", "T2", "T3", "R1", "R2", "R3")


@dataclass(frozen=True, kw_only=True)
class Points:
    """Grids and scalar points of a model.

    Attributes:
        grid_id: (g,) ascending.
        xyz: (g, 3) positions in the basic frame.
        rotation: (g, 3, 3) R_BD, columns are the displacement axes in the basic frame.
        ps: (g, 6) True where GRID PS constrains the freedom for good.
        spoint_id: (s,) ascending; extra points among them.
        extra_id: (e,) ascending, extra points (EPOINT): they take part in dynamic
            solutions alone, with what is given for them directly.
        frames: coordinate systems of the deck.
    """

    grid_id: Int64
    xyz: Float64
    rotation: Float64
    ps: Bool
    spoint_id: Int64
    extra_id: Int64 = field(default_factory=lambda: np.zeros(0, np.int64))
    frames: Frames = field(default_factory=lambda: Frames({}), repr=False)

    @property
    def size(self) -> int:
        """Number of rows of the g-set."""
        return 6 * len(self.grid_id) + len(self.spoint_id)

    @property
    def extra_dof(self) -> Int64:
        """(e,) rows of the extra points."""
        return 6 * len(self.grid_id) + np.searchsorted(self.spoint_id, self.extra_id)

    def rows(self, ids: npt.ArrayLike) -> Int64:
        """Positions of grids in `grid_id`, of the shape of `ids`.

        Raises:
            InputError: ids that are no grids, all of them.
        """
        ids = np.asarray(ids, dtype=np.int64)
        at = np.searchsorted(self.grid_id, ids)
        found = np.zeros(ids.shape, bool)
        inside = at < len(self.grid_id)
        found[inside] = self.grid_id[at[inside]] == ids[inside]
        if not found.all():
            absent = np.unique(ids[~found]).tolist()
            raise InputError(f"grids {_some(absent)} are not defined")
        return at

    def dof(self, ids: npt.ArrayLike, components: npt.ArrayLike) -> Int64:
        """Rows of the g-set, of the broadcast shape of both arguments.

        Args:
            ids: grid or scalar point ids; 0 stands for ground and gives row -1.
            components: 1 to 6 for grids, 0 or 1 for scalar points.

        Raises:
            InputError: unknown ids, or a component that the point does not have.
        """
        ids, components = np.broadcast_arrays(
            np.asarray(ids, np.int64), np.asarray(components, np.int64)
        )
        dof = np.full(ids.shape, -1, dtype=np.int64)
        scalar = np.isin(ids, self.spoint_id)
        at_grid = ~scalar & (ids != 0)
        dof[at_grid] = 6 * self.rows(ids[at_grid]) + components[at_grid] - 1
        dof[scalar] = 6 * len(self.grid_id) + np.searchsorted(
            self.spoint_id, ids[scalar]
        )
        bad = (at_grid & ((components < 1) | (components > 6))) | (
            scalar & (components > 1)
        )
        if bad.any():
            raise InputError(
                f"point {i} has no component {c}; expected "
                + ("0" if i in self.spoint_id else "1 to 6")
                for i, c in dict.fromkeys(
                    zip(ids[bad].tolist(), components[bad].tolist())
                )
            )
        return dof

    def label(self, dof: int) -> str:
        """Name of a row: "grid 12 T3", "scalar point 91" or "extra point 92"."""
        grid, component = divmod(int(dof), 6)
        if grid < len(self.grid_id):
            return f"grid {self.grid_id[grid]} {COMPONENTS[component]}"
        point = self.spoint_id[int(dof) - 6 * len(self.grid_id)]
        return f"{'extra' if point in self.extra_id else 'scalar'} point {point}"

    def basic_rotation(self) -> sp.csr_matrix:
        """(g-set, g-set) R with u_basic = R u_g, block-diagonal, 1 at scalar points."""
        return self._basic_rotation

    @cached_property
    def _basic_rotation(self) -> sp.csr_matrix:
        turned = 6 * len(self.grid_id)
        blocks = sp.bsr_matrix(
            (
                np.repeat(self.rotation, 2, axis=0),
                np.arange(turned // 3),
                np.arange(turned // 3 + 1),
            ),
            shape=(turned, turned),
        )
        plain = sp.identity(len(self.spoint_id))
        matrix = sp.block_diag([blocks, plain]) if len(self.spoint_id) else blocks
        matrix = sp.csr_matrix(matrix)
        matrix.eliminate_zeros()
        return matrix


def grid_freedoms(at: Int64, count: int = 6) -> Int64:
    """(..., n * count) rows of the g-set of grids by their place among all grids.

    Args:
        at: (..., n) see `Points.rows`.
        count: the first so many components of each: 3 for translations alone.
    """
    return (6 * at[..., None] + np.arange(count)).reshape(*at.shape[:-1], -1)


def _some(ids: list[int], most: int = 10) -> str:
    """The first ids of a list, and how many there are."""
    shown = ", ".join(map(str, ids[:most]))
    return f"{shown} ... ({len(ids)} in all)" if len(ids) > most else shown

"""A reduced airframe: matrices on interface grids and generalised coordinates.

Rows stand in the order of the grids, for each the components that it keeps, in the
basic frame; generalised coordinates, which no grid owns, come last. Components that are
no rows follow these: `recovery` gives their motion.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from fem.geometry.rigid_motion import rigid_motion
from fem.matrix_files.named import NamedMatrix

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


@dataclass(frozen=True, kw_only=True)
class ReducedModel:
    """A reduced structure with a + q freedoms.

    Attributes:
        grid_id: (g,) ascending.
        p: (g, 3) positions, basic frame, m.
        kept: (g, 6) which components are freedoms; the others follow.
        stiffness, mass, damping: (a + q, a + q), basic axes.
        recovery: (r, a + q) motion of the r components that follow, see `following`.
        interior_hz: (q,) frequencies of fixed-interface modes where they are known.
        source: where it comes from.
        notices: what the user should know.
    """

    grid_id: Int64
    p: Float64
    kept: npt.NDArray[np.bool_]
    stiffness: Float64
    mass: Float64
    damping: Float64
    recovery: Float64
    interior_hz: Float64
    source: str
    notices: tuple[str, ...] = ()

    @property
    def size(self) -> int:
        """Number of freedoms."""
        return len(self.stiffness)

    @property
    def a_size(self) -> int:
        """Number of freedoms at grids."""
        return int(self.kept.sum())

    @property
    def followers(self) -> Int64:
        """Grids without freedoms of their own."""
        return self.grid_id[~self.kept.any(axis=1)]

    @property
    def following(self) -> Int64:
        """(r, 2) grid and component of what is no freedom, in order."""
        grid, component = np.nonzero(~self.kept)
        return np.column_stack([self.grid_id[grid], component + 1])

    @cached_property
    def generalised_id(self) -> Int64:
        """(q,) scalar point ids of the generalised coordinates."""
        first = int(10 ** np.ceil(np.log10(self.grid_id.max() + 1)))
        return first + 1 + np.arange(self.size - self.a_size)

    @property
    def labels(self) -> Int64:
        """(a + q, 2) point and component of each row; component 0: generalised."""
        grid, component = np.nonzero(self.kept)
        at_grids = np.column_stack([self.grid_id[grid], component + 1])
        rest = self.generalised_id
        return np.concatenate([at_grids, np.column_stack([rest, 0 * rest])])

    def rigid_body(self, about: npt.ArrayLike = (0.0, 0.0, 0.0)) -> Float64:
        """(a + q, 6) unit rigid motions about a point, basic axes."""
        motion = rigid_motion(self.p - np.asarray(about, float))
        return np.concatenate(
            [motion[self.kept], np.zeros((self.size - self.a_size, 6))]
        )

    def matrices(self) -> list[NamedMatrix]:
        """KRED, MRED, BRED and, where components follow, RRED."""
        labels = self.labels
        square = [
            NamedMatrix(name=name, values=values, rows=labels, columns=labels)
            for name, values in (
                ("KRED", self.stiffness),
                ("MRED", self.mass),
                ("BRED", self.damping),
            )
        ]
        if not len(self.following):
            return square
        recovery = NamedMatrix(
            name="RRED", values=self.recovery, rows=self.following, columns=labels
        )
        return [*square, recovery]

"""A bench for structure that is its own mirror image: two halves at one stroke.

A twin is a pair (starboard id, port id) of grids; on the center plane both are the same
grid. Everything is written for the starboard half and mirrored; what lies in the center
plane is written once.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import MIRROR, Float64, Int64
from drake_landing.reference.d150.model import ModelBuilder

_ON_PLANE = 1e-7
_SPACE = 20000  # ids of a component's half


class Halves:
    """Writes mirrored structure onto a `ModelBuilder`.

    Args:
        model: the bench.
        first_id: grids are numbered from here, components in blocks.

    Attributes:
        model: the bench.
    """

    def __init__(self, model: ModelBuilder, first_id: int) -> None:
        self.model = model
        self._first = first_id
        self._next: dict[str, list[int]] = {}
        self._at: dict[tuple[float, ...], Int64] = {}

    def shared(self, part: str, p: Float64) -> Int64:
        """Like `grids`, but takes the twins that stand at a position already."""
        twins = []
        for x in p:
            found = self._at.get(_key(x))
            twins.append(self.grids(part, x[None])[0] if found is None else found)
        return np.array(twins)

    def grids(self, part: str, p: Float64) -> Int64:
        """Writes grids of the starboard half and their mirror images.

        Args:
            part: section.
            p: (..., 3) positions with y >= 0, m.

        Returns:
            (..., 2) twins.
        """
        flat = np.asarray(p, float).reshape(-1, 3)
        if part not in self._next:
            start = self._first + 2 * _SPACE * len(self._next)
            self._next[part] = [start, start + _SPACE]
        ids = np.zeros((len(flat), 2), np.int64)
        middle = np.abs(flat[:, 1]) < _ON_PLANE
        for side, rows in ((0, np.ones(len(flat), bool)), (1, ~middle)):
            start = self._next[part][side]
            ids[rows, side] = np.arange(start, start + rows.sum())
            self._next[part][side] += int(rows.sum())
        ids[middle, 1] = ids[middle, 0]
        straight = np.where(middle[:, None], flat * (1.0, 0.0, 1.0), flat)
        self.model.grids(part, ids[:, 0].tolist(), straight)
        self.model.grids(part, ids[~middle, 1].tolist(), (straight * MIRROR)[~middle])
        self._at.update(zip(map(_key, straight), ids))
        return ids.reshape(*np.shape(p)[:-1], 2)

    def position(self, twin: Int64) -> Float64:
        """(3,) position of the starboard grid of a twin."""
        return self.model.position[int(twin[0])]

    def positions(self, twins: Int64) -> Float64:
        """(..., 3) positions of the starboard grids of twins (..., 2)."""
        flat = [self.model.position[int(i)] for i in twins[..., 0].ravel()]
        return np.array(flat).reshape(*twins.shape[:-1], 3)

    def shell(self, part: str, pid: int, corners: Sequence[Int64]) -> None:
        """A quadrilateral or triangle; corners that coincide are merged.

        The mirror image keeps the normal on its side and material axis 1 along the same
        edge: corners 1 2 3 4 become 2 1 4 3.
        """
        quad = np.array(corners)
        right = list(dict.fromkeys(quad[:, 0].tolist()))
        order = [1, 0, 3, 2] if len(quad) == 4 else [1, 0, 2]
        left = list(dict.fromkeys(quad[order, 1].tolist()))
        self.model.shell(part, pid, right)
        if set(left) != set(right):
            self.model.shell(part, pid, left)

    def patch(self, part: str, pid: int, grid: Int64) -> None:
        """Quadrilaterals of twins (n, m, 2); their side 1-2 is along the first axis."""
        for i in range(grid.shape[0] - 1):
            for j in range(grid.shape[1] - 1):
                corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                self.shell(part, pid, [grid[c] for c in corners])

    def bar(
        self,
        part: str,
        pid: int,
        a: Int64,
        b: Int64,
        orientation: Float64 | Sequence[float],
        shift: Float64 | None = None,
        pins: int | None = None,
    ) -> None:
        """A bar and its mirror image, see `ModelBuilder.bar`."""
        vector = np.asarray(orientation, float)
        self.model.bar(part, pid, int(a[0]), int(b[0]), vector, shift, pins)
        if (a[0], b[0]) != (a[1], b[1]):
            other = None if shift is None else shift * MIRROR
            left = (int(a[1]), int(b[1]))
            self.model.bar(part, pid, *left, vector * MIRROR, other, pins)

    def strut(self, part: str, a: Int64, b: Int64) -> None:
        """A floor strut, hinged at both ends."""
        aft = (1.0, 0.0, 0.0)
        self.bar(part, self.profile("floor_strut"), a, b, aft, pins=56)

    def chain(
        self,
        part: str,
        pid: int,
        twins: Int64 | Sequence[Int64],
        orientation: Float64 | Sequence[float],
    ) -> None:
        """Bars along a line of twins."""
        for a, b in pairwise(twins):
            self.bar(part, pid, a, b, orientation)

    def follow(self, part: str, leader: Int64, follower: Int64) -> None:
        """RBE2: the follower moves rigidly with the leader, all six freedoms."""
        for side in (0, 1):
            if side == 1 and follower[0] == follower[1]:
                continue
            self.model.rigid(part, int(leader[side]), "123456", [int(follower[side])])
            self.hold(int(follower[side]))

    def hold(self, grid: int) -> None:
        """Notes that a grid is dependent in all freedoms."""
        self.model.dependent.update((grid, c) for c in range(1, 7))

    def held(self, grid: int) -> bool:
        """Whether a grid depends on others."""
        return (grid, 4) in self.model.dependent

    def profile(self, name: str) -> int:
        """Bar property of a profile of `profiles.csv`."""
        rows = table("profiles")
        row = rows[rows.profile == name].iloc[0]
        material = facts("materials")[row.material]["id"]
        values = (row.area, row.i_high, row.i_low, row.j)
        half = (float(row.half_high), float(row.half_low))
        return self.model.bar_property(
            f"fuselage {name}", material, *map(float, values), half
        )

    def sheet(self, name: str, thickness: float, bending: float = 1.0) -> int:
        """Shell property of a sheet of al2024."""
        material = facts("materials")["al2024"]["id"]
        return self.model.shell_property(name, material, thickness, bending)


def _key(p: Float64) -> tuple[float, ...]:
    """A position to 0.1 mm."""
    return tuple((np.round(p, 4) + 0.0).tolist())

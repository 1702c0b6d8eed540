"""Grids of the fuselage joined to the wing box where the two meet.

Each moves with the four corners of the wing's element next to it (RBE3): short fittings
along spars and covers, which carry the loads without stiffening the box.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from drake_landing.reference.d150.fuselage.halves import Halves
from drake_landing.reference.d150.geometry import Float64, Int64
from drake_landing.reference.d150.shell_mesh import BoxMesh


@dataclass(frozen=True, kw_only=True)
class _Face:
    """Elements of a face of the box: corners (e, 4) right and left, middles (e, 3)."""

    right: Int64
    left: Int64
    middle: Float64


class Fit:
    """Joins grids to the center wing box.

    Args:
        halves: the bench.
        meshes: with `wing_right` and `wing_left`.
    """

    def __init__(self, halves: Halves, meshes: Mapping[str, BoxMesh]) -> None:
        right, left = meshes["wing_right"], meshes["wing_left"]
        self._halves = halves
        self._faces = {
            name: _face(right, left, at)
            for name, at in (
                ("upper", np.s_[:, :, -1]),
                ("lower", np.s_[:, :, 0]),
                ("front", np.s_[:, 0]),
                ("rear", np.s_[:, -1]),
            )
        }
        self._box = right

    def edges(self, face: str) -> tuple[float, float]:
        """z of the top and bottom edge of the `front` or `rear` web, m."""
        column = self._box.p[0, 0 if face == "front" else -1]
        return float(column[-1, 2]), float(column[0, 2])

    def height(self, face: str, x: float) -> float:
        """z of the `upper` or `lower` cover on the center plane at x, m."""
        line = self._box.p[0, :, -1 if face == "upper" else 0]
        return float(np.interp(x, line[:, 0], line[:, 2]))

    def to_face(self, part: str, twin: Int64, face: str) -> None:
        """Makes a twin follow the element of the face next to it, if it is free."""
        halves, where = self._halves, self._faces[face]
        if halves.held(int(twin[0])):
            return
        distance = np.linalg.norm(where.middle - halves.position(twin), axis=1)
        k = int(np.argmin(distance.round(9)))
        corners = {0: where.right[k], 1: where.left[k]}
        if twin[0] == twin[1]:
            corners = {0: np.concatenate([where.right[k], where.left[k]])}
        for side, grids in corners.items():
            around = list(dict.fromkeys(map(int, grids)))
            halves.model.average(part, int(twin[side]), around)
            halves.hold(int(twin[side]))


def _face(right: BoxMesh, left: BoxMesh, at: tuple) -> _Face:
    """The elements between the center plane and the side-of-body rib."""
    end = int(right.ribs[np.searchsorted(right.stations.rib[right.ribs], 3)]) + 1
    ids = [_quads(mesh.ids[:end][at]) for mesh in (right, left)]
    p = right.p[:end][at]
    middle = (p[:-1, :-1] + p[1:, :-1] + p[1:, 1:] + p[:-1, 1:]) / 4
    return _Face(right=ids[0], left=ids[1], middle=middle.reshape(-1, 3))


def _quads(grid: Int64) -> Int64:
    a, b = grid[:-1, :-1].ravel(), grid[1:, :-1].ravel()
    c, d = grid[1:, 1:].ravel(), grid[:-1, 1:].ravel()
    return np.stack([a, b, c, d], axis=1)

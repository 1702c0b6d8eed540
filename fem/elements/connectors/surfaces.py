"""The shells of a deck as surfaces: which element lies closest to a point, and where.

Elements count with their corners, as bilinear surfaces X = Σ N_i(ξ, η) x_i; triangles
have their third corner twice, which keeps linear fields exact.
"""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.spatial import KDTree

from fem.arrays import Float64, Int64
from fem.deck.records import topologies
from fem.deck.references import table
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_XI = np.array([-1.0, 1.0, 1.0, -1.0])
_ETA = np.array([-1.0, -1.0, 1.0, 1.0])
_STEPS, _FAR = 8, 3.0  # of Newton, and where they end
_NEAR = (16, 128)  # elements that are looked at first, and if these do not settle it


def shapes(natural: Float64) -> Float64:
    """(..., 4) bilinear shape functions at (..., 2)."""
    xi, eta = natural[..., :1], natural[..., 1:]
    return 0.25 * (1.0 + xi * _XI) * (1.0 + eta * _ETA)


def slopes(natural: Float64) -> Float64:
    """(..., 2, 4) their derivatives by ξ and η."""
    xi, eta = natural[..., :1], natural[..., 1:]
    by_xi, by_eta = _XI * (1.0 + eta * _ETA), _ETA * (1.0 + xi * _XI)
    return 0.25 * np.stack([by_xi, by_eta], axis=-2)


@dataclass(frozen=True, kw_only=True)
class Spots:
    """Points of surfaces closest to given ones.

    Attributes:
        element: (p,) positions among the surfaces, -1: none is there.
        natural: (p, 2) ξ, η.
        place: (p, 3) basic.
        beside: (p,) how far the given point lies beside the element, along it.
    """

    element: Int64
    natural: Float64
    place: Float64
    beside: Float64

    @classmethod
    def nowhere(cls, count: int) -> "Spots":
        """So many that lie on no element."""
        return cls(
            element=np.full(count, -1),
            natural=np.zeros((count, 2)),
            place=np.full((count, 3), np.nan),
            beside=np.zeros(count),
        )

    def put(self, rows: Int64, other: "Spots") -> None:
        """Replace some of them."""
        for item in fields(self):
            getattr(self, item.name)[rows] = getattr(other, item.name)

    def of(self, rows: slice) -> "Spots":
        """Some of them."""
        return Spots(**{f.name: getattr(self, f.name)[rows] for f in fields(self)})


@dataclass(frozen=True, kw_only=True)
class Surfaces:
    """All plates and shells of a deck.

    Attributes:
        id, pid: (n,) of elements, ascending, and of their properties.
        at: (n, 4) rows of the corners among the grids; triangles repeat the third.
        corners: (n, 4, 3) basic.
    """

    id: Int64
    pid: Int64
    at: Int64
    corners: Float64

    @cached_property
    def _centers(self) -> Float64:
        return self.corners.mean(axis=1)

    @cached_property
    def _radius(self) -> Float64:
        """(n,) spheres about the centers that hold the elements."""
        arms = self.corners - self._centers[:, None]
        return np.linalg.norm(arms, axis=2).max(axis=1)

    @cached_property
    def normals(self) -> Float64:
        """(n, 3) of the elements."""
        return normals(self.corners)

    def of_property(self, pid: int) -> Int64:
        """Positions of the elements with a property."""
        return np.flatnonzero(self.pid == pid)

    def around(self, elements: Int64) -> Int64:
        """(p, k) positions of elements (p,) and of all that share a grid with them.

        Where there are less than k, the element itself fills the row.
        """
        count = len(self.id)
        row = np.repeat(np.arange(count), 4)
        has = sp.csr_matrix((np.ones(4 * count), (row, self.at.ravel())))
        near = sp.csr_matrix(has[elements] @ has.T)
        widest = int(np.diff(near.indptr).max(initial=1))
        found = np.repeat(elements[:, None], widest, axis=1)
        for k, (start, stop) in enumerate(zip(near.indptr, near.indptr[1:])):
            found[k, : stop - start] = near.indices[start:stop]
        return np.hstack([elements[:, None], found])

    def closest(self, points: Float64, among: Int64) -> Spots:
        """Closest spots to points (p, 3) on any of the elements (k,)."""
        found = Spots.nowhere(len(points))
        if not len(among) or not len(points):
            return found
        tree = KDTree(self._centers[among])
        largest = self._radius[among].max()
        left = np.arange(len(points))
        for near in (*_NEAR, len(among)):
            k = min(near, len(among))
            distance, which = tree.query(points[left], k=k)
            candidates = among[np.reshape(which, (len(left), k))]
            part = self.closest_of(points[left], candidates)
            found.put(left, part)
            gap = np.linalg.norm(part.place - points[left], axis=1)
            beyond = np.reshape(distance, (len(left), k))[:, -1] - largest
            left = left[(gap > beyond) & (k < len(among))]
            if not len(left):
                break
        return found

    def closest_of(self, points: Float64, candidates: Int64) -> Spots:
        """Closest spots to points (p, 3) on one of their own candidates (p, k)."""
        corners = self.corners[candidates]
        natural, place = natural_of(points[:, None], corners)
        gap = np.linalg.norm(place - points[:, None], axis=2)
        # Of elements that share an edge the first takes the points on it.
        first = np.argmax(gap <= gap.min(axis=1, keepdims=True) * (1.0 + 1e-9), axis=1)
        row = np.arange(len(points))
        return Spots(
            element=candidates[row, first],
            natural=natural[row, first],
            place=place[row, first],
            beside=_beside(points - place[row, first], corners[row, first]),
        )


def natural_of(points: Float64, corners: Float64) -> tuple[Float64, Float64]:
    """ξ, η (..., 2) of the closest spots on elements, and these (..., 3).

    Newton's steps to the foot of the normal (Gauss); where it lies outside, the closest
    spot of the edges, which are straight.
    """
    natural = np.zeros((*corners.shape[:-2], 2))
    for _ in range(_STEPS):
        rest = points - np.einsum("...i,...ij->...j", shapes(natural), corners)
        tangent = slopes(natural) @ corners
        square = tangent @ tangent.swapaxes(-1, -2)
        size = np.trace(square, axis1=-2, axis2=-1)[..., None, None]
        wanted = np.einsum("...aj,...j->...a", tangent, rest)[..., None]
        step = np.linalg.solve(square + 1e-12 * size * np.eye(2), wanted)[..., 0]
        natural = np.clip(natural + step, -_FAR, _FAR)
    outside = (np.abs(natural) > 1.0).any(axis=-1)
    natural = np.where(outside[..., None], _on_edges(points, corners), natural)
    return natural, np.einsum("...i,...ij->...j", shapes(natural), corners)


def _on_edges(points: Float64, corners: Float64) -> Float64:
    """ξ, η (..., 2) of the closest spots on the four edges."""
    edge = np.roll(corners, -1, axis=-2) - corners
    from_start = points[..., None, :] - corners
    square = np.sum(edge * edge, axis=-1)
    along = np.sum(from_start * edge, axis=-1) / np.where(square > 0.0, square, 1.0)
    along = np.clip(along, 0.0, 1.0)
    gap = np.linalg.norm(from_start - along[..., None] * edge, axis=-1)
    best = gap.argmin(axis=-1)
    share = np.take_along_axis(along, best[..., None], axis=-1)
    corner = np.stack([_XI, _ETA], axis=1)
    after = np.roll(corner, -1, axis=0)
    return (1.0 - share) * corner[best] + share * after[best]


def _beside(rest: Float64, corners: Float64) -> Float64:
    """(p,) part of the distance that lies along the surface."""
    across = np.einsum("pj,pj->p", rest, normals(corners))
    return np.sqrt(np.maximum(np.sum(rest**2, axis=1) - across**2, 0.0))


def normals(corners: Float64) -> Float64:
    """(..., 3) unit normals of surfaces (..., 4, 3), from their diagonals."""
    one, other = (corners[..., k + 2, :] - corners[..., k, :] for k in (0, 1))
    across = np.cross(one, other)
    return across / np.linalg.norm(across, axis=-1, keepdims=True)


def read_surfaces(deck: "Deck", points: Points) -> Surfaces:
    """Plates and shells of a deck."""
    ids, pids, grids = [np.zeros(0, int)], [np.zeros(0, int)], [np.zeros((0, 4), int)]
    for name, topology in topologies("surface").items():
        rows = table(deck, name)
        if rows.empty or "pid" not in rows:
            continue
        ids.append(rows["eid"].to_numpy(np.int64))
        pids.append(rows["pid"].to_numpy(np.int64))
        own = rows[list(topology.grids[: topology.corners])].to_numpy(np.int64)
        grids.append(own if topology.corners == 4 else own[:, [0, 1, 2, 2]])
    eid = np.concatenate(ids)
    order = np.argsort(eid, kind="stable")
    at = points.rows(np.concatenate(grids)[order])
    return Surfaces(
        id=eid[order],
        pid=np.concatenate(pids)[order],
        at=at,
        corners=points.xyz[at],
    )

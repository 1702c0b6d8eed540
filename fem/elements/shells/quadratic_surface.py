"""Surfaces with mid-sides: shape functions, samples of strain, base vectors.

Natural coordinates run from -1 to 1 in quadrilaterals, from 0 to 1 in triangles.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import unit

_G, _H = 1.0 / np.sqrt(3.0), np.sqrt(0.6)
Powers = tuple[tuple[int, int], ...]


def monomials(powers: Powers, p: Float64) -> Float64:
    """(q, m) products of powers of the natural coordinates (q, 2)."""
    return np.stack([p[:, 0] ** i * p[:, 1] ** j for i, j in powers], axis=1)


def fitted(powers: Powers, samples: Float64, at: Float64) -> Float64:
    """(q, s) values at points (q, 2) from samples (s, 2), as many as powers."""
    return monomials(powers, at) @ np.linalg.inv(monomials(powers, samples))


def _slopes(powers: Powers, p: Float64) -> Float64:
    """(q, 2, m) derivatives of the monomials."""
    parts = []
    for k in (0, 1):
        lower = [
            (i - (k == 0), j - (k == 1)) if (i, j)[k] else (0, 0) for i, j in powers
        ]
        factor = np.array([own[k] for own in powers], float)
        parts.append(factor * monomials(tuple(lower), p))
    return np.stack(parts, axis=1)


@dataclass(frozen=True)
class Surface:
    """Natural coordinates of an element with corners and mid-sides.

    Attributes:
        nodes: (n, 2) natural coordinates, the corners first.
        powers: of the interpolation of displacements.
        linear: of that of the thickness, from the corners.
        points, weights: (q, 2), (q,) rule of integration.
        strains: per component 11, 22, 12 samples (s, 2) and powers.
        edges: (m, 2) points where shear is taken, towards: (m, 2) natural directions.
        sides: (m,) edge that each lies on, -1: none.
        means: (s, m) samples of shear from these.
        shears: powers of both components of shear, and turning: powers m of fields
        (s m, -r m); together as many as samples.
        bubble: powers of rotations that vanish on the edges, with coefficients.
        stress: (g, 2) points of which printed results are extrapolated by `printed`.
        even: element axes lie evenly about both tangents.
        whole: (w, 2) nodes of the interpolation where mid-sides are left out, and
        follow: (w, n) how all of these follow those that are there; None: all are.
        straight: edges without their mid-side.
    """

    nodes: Float64
    powers: Powers
    linear: Powers
    points: Float64
    weights: Float64
    strains: tuple[tuple[Float64, Powers], ...]
    edges: Float64
    towards: Float64
    sides: tuple[int, ...]
    means: Float64
    shears: tuple[Powers, Powers]
    stress: Float64
    printed: Powers
    even: bool
    turning: Powers = ()
    bubble: tuple[tuple[float, tuple[int, int]], ...] = ()
    whole: Float64 | None = None
    follow: Float64 | None = None
    straight: frozenset[int] = frozenset()

    def without(self, present: Sequence[bool]) -> "Surface":
        """The surface without some of its mid-sides: their edges stay straight.

        Where rotations turn linearly along an edge that cannot bend only the mean of
        its shear is meant, else it locks (Bathe and Dvorkin's tying at the middle).

        Args:
            present: for each mid-side, whether it is there.
        """
        count = self.corners
        kept = [*range(count), *(count + np.flatnonzero(present))]
        follow = np.eye(len(self.nodes))
        for k in np.flatnonzero(~np.asarray(present, bool)):
            follow[count + k] = 0.0
            follow[count + k, [k, (k + 1) % count]] = 0.5
        return replace(
            self,
            nodes=self.nodes[kept],
            whole=self.nodes,
            follow=follow[:, kept],
            **self._without_bubble,
            straight=frozenset(np.flatnonzero(~np.asarray(present, bool)).tolist()),
        )

    @property
    def _without_bubble(self) -> dict[str, object]:
        """Samples along the edges only: the mean inside is met by the bubble alone.

        A triangle with fewer rotations on its edges would lock with both.
        """
        if not self.bubble:
            return {}
        kept = np.flatnonzero(np.asarray(self.sides) >= 0)
        return {
            "edges": self.edges[kept],
            "towards": self.towards[kept],
            "sides": tuple(np.asarray(self.sides)[kept].tolist()),
            "means": np.eye(len(kept)),
            "turning": (),
            "bubble": (),
        }

    @property
    def corners(self) -> int:
        """Number of corners."""
        return len(self.linear)

    @cached_property
    def results(self) -> Float64:
        """(1 + c, 2) the center and the corners."""
        own = self.nodes[: self.corners]
        return np.concatenate([own.mean(axis=0)[None], own])

    def values(self, p: Float64) -> Float64:
        """(q, n) shape functions."""
        return monomials(self.powers, p) @ self._coefficients

    def slopes(self, p: Float64) -> Float64:
        """(q, 2, n) their derivatives."""
        return _slopes(self.powers, p) @ self._coefficients

    @cached_property
    def _coefficients(self) -> Float64:
        """(m, n) of the shape functions."""
        whole = self.nodes if self.whole is None else self.whole
        inverse = np.linalg.inv(monomials(self.powers, whole))
        return inverse if self.follow is None else inverse @ self.follow

    def of_corners(self, p: Float64) -> Float64:
        """(q, c) linear shape functions of the corners."""
        return fitted(self.linear, self.nodes[: self.corners], p)

    def bubble_values(self, p: Float64) -> Float64:
        """(q,) the rotation inside, one at the middle."""
        factors, powers = zip(*self.bubble)
        return monomials(powers, p) @ np.array(factors)

    def bubble_slopes(self, p: Float64) -> Float64:
        """(q, 2) derivatives of `bubble_values`."""
        factors, powers = zip(*self.bubble)
        return _slopes(powers, p) @ np.array(factors)

    def projection(self, p: Float64) -> Float64:
        """(q, k) values at points of the nearest linear field to values at `points`."""
        own = monomials(self.linear, self.points)
        weighted = own.T * self.weights
        return monomials(self.linear, p) @ np.linalg.solve(weighted @ own, weighted)

    def _shear_fields(self, p: Float64) -> Float64:
        """(q, 2, s) fields of covariant shear."""
        first, second = (monomials(own, p) for own in self.shears)
        turn = monomials(self.turning, p) if self.turning else np.zeros((len(p), 0))
        rows = [
            [first, np.zeros_like(second), p[:, 1:] * turn],
            [np.zeros_like(first), second, -p[:, :1] * turn],
        ]
        return np.stack([np.concatenate(row, axis=1) for row in rows], axis=1)

    def shear_fit(self, p: Float64) -> Float64:
        """(q, 2, s) covariant shear from its samples along the edges and inside."""
        there = np.einsum("qk,qks->qs", self.towards, self._shear_fields(self.edges))
        same = np.equal.outer(self.sides, self.sides)
        whole = ~np.isin(self.sides, list(self.straight))
        same[whole] = np.eye(len(same))[whole]
        samples = self.means @ (same / same.sum(axis=1, keepdims=True))
        return self._shear_fields(p) @ np.linalg.inv(self.means @ there) @ samples


def _products(first: int, second: int) -> Powers:
    return tuple((i, j) for i in range(first + 1) for j in range(second + 1))


def _grid(first: tuple[float, ...], second: tuple[float, ...]) -> Float64:
    return np.array([(r, s) for r in first for s in second])


_TWO, _THREE = (-_G, _G), (-_H, 0.0, _H)
_TIP = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]])
_P1: Powers = ((0, 0), (1, 0), (0, 1))
_FOUR_AND_MEAN = np.eye(5, 6)
_FOUR_AND_MEAN[4, 4:] = 0.5
_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0
QUAD8 = Surface(
    nodes=np.concatenate([_TIP, 0.5 * (_TIP + np.roll(_TIP, -1, axis=0))]),
    powers=(*_P1, (2, 0), (1, 1), (0, 2), (2, 1), (1, 2)),
    linear=_products(1, 1),
    points=_grid(_THREE, _THREE),
    weights=np.outer(_WEIGHTS, _WEIGHTS).ravel(),
    strains=(
        (_grid(_TWO, _THREE), _products(1, 2)),
        (_grid(_THREE, _TWO), _products(2, 1)),
        (_grid(_TWO, _TWO), _products(1, 1)),
    ),
    edges=np.concatenate(
        [_grid((-1.0, 1.0, 0.0), _TWO)[:, ::-1], _grid((-1.0, 1.0, 0.0), _TWO)]
    ),
    towards=np.repeat([[1.0, 0.0], [0.0, 1.0]], 6, axis=0),
    sides=(0, 0, 2, 2, -1, -1, 3, 3, 1, 1, -1, -1),
    means=np.kron(np.eye(2), _FOUR_AND_MEAN),
    shears=((*_products(1, 1), (0, 2)), (*_products(1, 1), (2, 0))),
    stress=_grid(_TWO, _TWO),
    printed=_products(1, 1),
    even=True,
)
_TRI = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
_ALONG = np.roll(_TRI, -1, axis=0) - _TRI
_INNER = np.array([[1.0, 1.0], [4.0, 1.0], [1.0, 4.0]]) / 6.0
# Degree four, six points (Strang and Fix).
_A, _B = 0.445948490915965, 0.091576213509771
_SIX = np.array([(a, b) for t in (_A, _B) for a, b in
                 ((t, t), (1 - 2 * t, t), (t, 1 - 2 * t))])  # fmt: skip
_SIX_WEIGHTS = np.repeat([0.223381589678011, 0.109951743655322], 3)
_EDGES_AND_MEANS = np.zeros((8, 18))
_EDGES_AND_MEANS[:6, :6] = np.eye(6)
_EDGES_AND_MEANS[6, 6:12] = _EDGES_AND_MEANS[7, 12:] = _SIX_WEIGHTS
TRIA6 = Surface(
    nodes=np.concatenate([_TRI, _TRI + 0.5 * _ALONG]),
    powers=(*_P1, (2, 0), (1, 1), (0, 2)),
    linear=_P1,
    points=_SIX,
    weights=0.5 * _SIX_WEIGHTS,
    strains=((_INNER, _P1),) * 3,
    edges=np.concatenate(
        [*(_TRI + 0.5 * (1 - g) * _ALONG for g in (_G, -_G)), _SIX, _SIX]
    ),
    towards=np.concatenate([_ALONG, _ALONG, np.repeat(np.eye(2), 6, axis=0)]),
    sides=(0, 1, 2, 0, 1, 2, *[-1] * 12),
    means=_EDGES_AND_MEANS,
    shears=(_P1, _P1),
    turning=((1, 0), (0, 1)),
    bubble=((27.0, (1, 1)), (-27.0, (2, 1)), (-27.0, (1, 2))),
    stress=_INNER,
    printed=_P1,
    even=False,
)


@dataclass(frozen=True)
class Base:
    """The surface at points (e, q).

    Attributes:
        a: (e, q, 2, 3) tangents.
        normal: (e, q, 3) unit normal.
        axes: (e, q, 2, 3) element axes x and y.
    """

    a: Float64
    normal: Float64
    axes: Float64

    @property
    def area(self) -> Float64:
        """(e, q) area per natural area."""
        return np.linalg.norm(np.cross(self.a[..., 0, :], self.a[..., 1, :]), axis=-1)

    @property
    def gradient(self) -> Float64:
        """(e, q, 2, 2) d natural_k / d x_i at [i, k]."""
        return np.linalg.inv(np.einsum("eqki,eqai->eqka", self.a, self.axes))


def base(surface: Surface, x: Float64, p: Float64) -> Base:
    """Tangents, normal and axes at natural points (q, 2) of nodes (e, n, 3)."""
    a = surface.slopes(p) @ x[:, None]
    normal = unit(np.cross(a[..., 0, :], a[..., 1, :]))
    first = unit(a[..., 0, :])
    if surface.even:
        middle = unit(first + unit(a[..., 1, :]))
        first = unit(middle - np.cross(normal, middle))
    return Base(a, normal, np.stack([first, np.cross(normal, first)], axis=-2))


def cartesian(gradient: Float64) -> Float64:
    """(..., 3, 3) strains xx yy xy (engineering) from covariant 11 22 2x12."""
    x, y = gradient[..., 0, :], gradient[..., 1, :]
    rows = [
        [x[..., 0] ** 2, x[..., 1] ** 2, x[..., 0] * x[..., 1]],
        [y[..., 0] ** 2, y[..., 1] ** 2, y[..., 0] * y[..., 1]],
        [
            2.0 * x[..., 0] * y[..., 0],
            2.0 * x[..., 1] * y[..., 1],
            x[..., 0] * y[..., 1] + x[..., 1] * y[..., 0],
        ],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def turned(source: Base, target: Base) -> Float64:
    """(e, p, g, 8, 8) strains at points g to the axes at points p, as if on a plane."""
    x = np.einsum("epj,egij->epgi", target.axes[..., 0, :], source.axes)
    c, s = np.moveaxis(unit(x), -1, 0)
    matrix = np.zeros((*c.shape, 8, 8))
    gradient = np.stack([np.stack([c, s], -1), np.stack([-s, c], -1)], axis=-2)
    plane = cartesian(gradient)
    matrix[..., :3, :3] = matrix[..., 3:6, 3:6] = plane
    matrix[..., 6:, 6:] = gradient
    return matrix

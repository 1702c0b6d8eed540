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
        points, weights: (q, 2), (q,) rule of integration of masses.
        rule, shares: (r, 2), (r,) that of the stiffness.
        reduced: (g, 2) points between which strains are filtered, none for triangles.
        printed: powers of shear fields and of results over the element.
        shears: (k, s, 2) points where shear is taken: of both natural directions, or
            of the direction across each side; as many as `printed` has.
        even: element axes lie evenly about both tangents.
        whole: nodes of the interpolation with the mid-sides that are left out, and
            follow: (w, n) how all of these follow those that are there; None: all are.
        straight: edges without their mid-side.
    """

    nodes: Float64
    powers: Powers
    linear: Powers
    points: Float64
    weights: Float64
    rule: Float64
    shares: Float64
    reduced: Float64
    printed: Powers
    shears: Float64
    even: bool
    whole: Float64 | None = None
    follow: Float64 | None = None
    straight: frozenset[int] = frozenset()

    def without(self, present: Sequence[bool]) -> "Surface":
        """The surface without some of its mid-sides: their edges stay straight.

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
            straight=frozenset(np.flatnonzero(~np.asarray(present, bool)).tolist()),
        )

    @cached_property
    def complete(self) -> "Surface":
        """The surface for strains: all mid-sides, and the middle of quadrilaterals."""
        nodes = self.nodes if self.whole is None else self.whole
        powers = self.powers
        if self.even:
            nodes, powers = np.vstack([nodes, np.zeros((1, 2))]), (*powers, (2, 2))
        own = replace(self, nodes=nodes, powers=powers, whole=None, follow=None)
        return replace(own, straight=frozenset())

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

    def spread(self, p: Float64) -> Float64:
        """(p, r) values at points of the nearest `printed` field to those of `rule`."""
        return monomials(self.printed, p) @ np.linalg.pinv(
            monomials(self.printed, self.rule)
        )


def _products(first: int, second: int) -> Powers:
    return tuple((i, j) for i in range(first + 1) for j in range(second + 1))


def _grid(first: tuple[float, ...], second: tuple[float, ...]) -> Float64:
    return np.array([(r, s) for r in first for s in second])


_TWO, _THREE = (-_G, _G), (-_H, 0.0, _H)
_TIP = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]])
_P1: Powers = ((0, 0), (1, 0), (0, 1))
_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0
QUAD8 = Surface(
    nodes=np.concatenate([_TIP, 0.5 * (_TIP + np.roll(_TIP, -1, axis=0))]),
    powers=(*_P1, (2, 0), (1, 1), (0, 2), (2, 1), (1, 2)),
    linear=_products(1, 1),
    points=_grid(_THREE, _THREE),
    weights=np.outer(_WEIGHTS, _WEIGHTS).ravel(),
    rule=_grid(_THREE, _THREE),
    shares=np.outer(_WEIGHTS, _WEIGHTS).ravel(),
    reduced=_grid(_TWO, _TWO),
    printed=_products(1, 1),
    shears=np.stack([_grid(_TWO, _TWO)] * 2),
    even=True,
)
_TRI = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
_INNER = np.array([[1.0, 1.0], [4.0, 1.0], [1.0, 4.0]]) / 6.0
# Degree four, six points (Strang and Fix).
_A, _B = 0.445948490915965, 0.091576213509771
_SIX = np.array([(a, b) for t in (_A, _B) for a, b in
                 ((t, t), (1 - 2 * t, t), (t, 1 - 2 * t))])  # fmt: skip
_SIX_WEIGHTS = np.repeat([0.223381589678011, 0.109951743655322], 3)


def _towards_corners() -> Float64:
    """(3, 3, 2) points on two lines along a side, at Gauss's distances from it.

    Seen from corner k: one point on the line beside it, two on the line beside the
    side opposite, half of a Gauss interval of that side to both hands.
    """
    near, far = 0.5 * (1.0 + _G), 0.5 * (1.0 - _G)
    points = np.zeros((3, 3, 3))
    for k in range(3):
        others = [(k + 1) % 3, (k + 2) % 3]
        points[k, 0, k], points[k, 0, others] = near, 0.5 * far
        points[k, 1:, k] = far
        side = np.array([0.5 * (near - _G), 0.5 * (near + _G)])
        points[k, 1, others], points[k, 2, others] = side, side[::-1]
    return points[..., 1:]


TRIA6 = Surface(
    nodes=np.concatenate([_TRI, 0.5 * (_TRI + np.roll(_TRI, -1, axis=0))]),
    powers=(*_P1, (2, 0), (1, 1), (0, 2)),
    linear=_P1,
    points=_SIX,
    weights=0.5 * _SIX_WEIGHTS,
    rule=_INNER,
    shares=np.full(3, 1.0 / 6.0),
    reduced=np.zeros((0, 2)),
    printed=_P1,
    shears=_towards_corners(),
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

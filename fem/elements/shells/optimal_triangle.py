"""Felippa's optimal membrane triangle with drilling freedoms (OPT).

C. A. Felippa, A study of optimal membrane triangles with drilling freedoms, Computer
Methods in Applied Mechanics and Engineering 192, 2003. Freedoms u v theta of each
corner, theta the rotation of the membrane about its normal.

    K = A L^T E L + (3/4) b_0 T^T K_theta T

The first part has uniform strains L u (Bergan and Felippa 1985, a_b = 3/2); T takes
from theta the rotation that these know, and K_theta is the energy of the strains that
what is left bends the triangle with. With the published b_1 ... b_9 and
b_0 = (1 - 4 nu^2) / 2 a rectangle of two triangles bends in its plane exactly, whatever
its sides. (The parameters are from memory of the paper; that property and the patch
test hold for no others, and the tests demand them.)
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64

_ALPHA = 1.5
_BETA = np.array([1.0, 2.0, 1.0, 0.0, 1.0, -1.0, -1.0, -1.0, -2.0])
# Which of the nine stand in Q1, Q2, Q3; rows: sides 1-2, 2-3, 3-1.
_Q = np.array(
    [
        [[1, 2, 3], [4, 5, 6], [7, 8, 9]],
        [[9, 7, 8], [3, 1, 2], [6, 4, 5]],
        [[5, 6, 4], [8, 9, 7], [2, 3, 1]],
    ]
)
_LEAST = 0.01  # of b_0: keeps theta from floating


@dataclass(frozen=True, kw_only=True)
class OptimalTriangle:
    """Triangles (e, 3, 2) in their plane.

    Attributes:
        xy: (e, 3, 2) corners, counter-clockwise.
    """

    xy: Float64

    @property
    def area(self) -> Float64:
        """(e,)."""
        first, second = self.xy[:, 1] - self.xy[:, 0], self.xy[:, 2] - self.xy[:, 0]
        return 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])

    def mean_strain(self) -> Float64:
        """(e, 3, 9) uniform strains xx yy xy from u v theta of the corners."""
        xy, twice = self.xy, 2.0 * self.area
        operator = np.zeros((len(xy), 3, 3, 3))
        for i in range(3):
            back, ahead = xy[:, i - 1] - xy[:, i], xy[:, (i + 1) % 3] - xy[:, i]
            across = xy[:, i - 1] - xy[:, (i + 1) % 3]
            (x, y), (a, b), (c, d) = across.T, ahead.T, back.T
            operator[:, 0, i, 0] = operator[:, 2, i, 1] = -y
            operator[:, 1, i, 1] = operator[:, 2, i, 0] = x
            operator[:, 0, i, 2] = _ALPHA / 6.0 * (d * d - b * b)
            operator[:, 1, i, 2] = _ALPHA / 6.0 * (c * c - a * a)
            operator[:, 2, i, 2] = _ALPHA / 3.0 * (a * b - c * d)
        return operator.reshape(-1, 3, 9) / twice[:, None, None]

    def higher(self, membrane: Float64) -> Float64:
        """(e, 9, 9) stiffness of what bends the triangle in its plane.

        Args:
            membrane: (e, 3, 3) forces per width from strains.
        """
        xy, area = self.xy, self.area
        side = np.roll(xy, -1, axis=1) - xy
        square = (side**2).sum(axis=2)
        natural = _natural(side, square)
        energy = natural.transpose(0, 2, 1) @ membrane @ natural
        at = np.array([_BETA[q - 1] for q in _Q])
        at = (2.0 / 3.0) * area[:, None, None, None] * at / square[:, None, :, None]
        middle = 0.5 * (at + np.roll(at, -1, axis=1))
        turning = area[:, None, None] * np.einsum(
            "eqia,eij,eqjb->eab", middle, energy, middle, optimize=True
        )
        theta = self._excess()
        weight = 0.75 * _higher_share(membrane)
        return weight[:, None, None] * (theta.transpose(0, 2, 1) @ turning @ theta)

    def _excess(self) -> Float64:
        """(e, 3, 9) theta of each corner less the rotation of the uniform strain."""
        opposite = np.roll(self.xy, -2, axis=1) - np.roll(self.xy, -1, axis=1)
        operator = np.zeros((len(opposite), 3, 3, 3))
        operator[..., :2] = (opposite / (4.0 * self.area)[:, None, None])[:, None]
        operator[:, np.arange(3), np.arange(3), 2] = 1.0
        return operator.reshape(-1, 3, 9)


def _natural(side: Float64, square: Float64) -> Float64:
    """(e, 3, 3) strains xx yy xy from those along the three sides."""
    normals = np.linalg.inv(
        np.stack(
            [side[..., 0] ** 2, side[..., 1] ** 2, side[..., 0] * side[..., 1]], axis=2
        )
    )
    return normals * square[:, None, :]


def _higher_share(membrane: Float64) -> Float64:
    """(e,) b_0; of laminates by the Poisson's ratio of their mean over all directions.

    A sheet that has no stiffness yet takes part: 1/2.
    """
    a11, a22, a12, a66 = (
        membrane[:, i, j] for i, j in ((0, 0), (1, 1), (0, 1), (2, 2))
    )
    along = 3.0 * (a11 + a22) + 2.0 * a12 + 4.0 * a66
    across = a11 + a22 + 6.0 * a12 - 4.0 * a66
    ratio = across / np.where(along > 0.0, along, 1.0)
    return np.maximum(0.5 * (1.0 - 4.0 * ratio**2), _LEAST)

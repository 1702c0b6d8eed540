"""Axes of solids: turning of stresses and strains, and the element's own axes."""

import numpy as np

from fem.arrays import Float64

_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))


def stress_rotation(axes: Float64, *, strain: bool = False) -> Float64:
    """(e, 6, 6) components along rows of `axes` from basic ones, xx yy zz xy yz zx.

    Engineering shear strains take the factor 2 on the other side of the diagonal.
    """
    matrix = np.empty((len(axes), 6, 6))
    for row, (i, j) in enumerate(_PAIRS):
        for col, (a, b) in enumerate(_PAIRS):
            value = axes[:, i, a] * axes[:, j, b]
            if a != b:
                value = value + axes[:, i, b] * axes[:, j, a]
            if strain and (a != b) != (i != j):
                value = value * (0.5 if a != b else 2.0)
            matrix[:, row, col] = value
    return matrix


def nearest_axes(directions: Float64, ideal: Float64) -> Float64:
    """(e, 3, 3) orthogonal axes, as rows, nearest to the directions of an element.

    Args:
        directions: (e, k, 3) of an element, basic; their lengths do not matter.
        ideal: (k, 3) where they point, in the axes, if nothing is distorted.
    """
    unit = directions / np.linalg.norm(directions, axis=2, keepdims=True)
    left, _, right = np.linalg.svd(np.einsum("ka,eki->eai", ideal, unit))
    return left @ right


def hexa_axes(jacobian: Float64) -> Float64:
    """Axes nearest to the natural directions, the rows of the Jacobian (e, 3, 3)."""
    return nearest_axes(jacobian, np.eye(3))


# Sides of an equilateral triangle, each turned by 120 degrees, and the height.
_PRISM = np.array(
    [[1.0, 0, 0], [-0.5, np.sqrt(0.75), 0], [-0.5, -np.sqrt(0.75), 0], [0, 0, 1.0]]
)


def penta_axes(jacobian: Float64) -> Float64:
    """Axes that favour no side of the triangle: nearest to an equilateral one.

    On a right-angled isosceles triangle x lies 15 degrees off its first side, as the
    shear stresses show that NX 2019.2 prints.
    """
    r, s, height = (jacobian[:, k] for k in range(3))
    return nearest_axes(np.stack([r, s - r, -s, height], axis=1), _PRISM)

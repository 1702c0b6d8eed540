"""Differential stiffness of beams: what their internal forces add to the stiffness.

The section forces N, Vy, Vz, T, My, Mz of the reference axis (that of the grids or of
the shear centers) do work on the quadratic parts of the strains and, at the ends, of
the displacements y, z away from the axis. With the rotations p = (theta, py, pz), the
slopes v', w' and the polar radius r of the section this is

    1/2 int N (v'^2 + w'^2 + r^2 theta'^2) dx
    - int (Mz theta)' w' + (My theta)' v' dx + int u' ((Mz pz)' + (My py)') dx
    + 1/2 int T (pz py' - py pz') dx
    + 1/2 [My theta pz - Mz theta py] from end A to end B,

with constant u'. Moments are linear along the element. A rigid rotation turns all
forces of the ends with the element (test). Displacements are those of a beam with its
shear flexibility, so that N meets Engesser's column; not modelled are the terms of
sections without symmetry (integrals of y r^2).

References: Timoshenko and Gere, Theory of Elastic Stability, 1961, chapters 1, 2 and 6;
McGuire, Gallagher, Ziemian, Matrix Structural Analysis, 2000, chapter 9; the terms of
the ends make moments semitangential (Argyris 1979), derived here.
"""

import numpy as np

from fem.arrays import Float64

_X, _W = np.polynomial.legendre.leggauss(3)
_X, _W = 0.5 * (_X + 1.0), 0.5 * _W


def line_differential(
    length: Float64, force: Float64, shear_ratio: Float64, polar: Float64
) -> Float64:
    """(e, 12, 12) at the ends, element axes.

    Args:
        length: (e,).
        force: (e, 12) forces and moments upon the ends, element axes.
        shear_ratio: (e, 2) 12 E I / (G A_s L^2) of planes 1 (x-y) and 2 (x-z).
        polar: (e,) square of the polar radius about the reference axis.
    """
    matrix = np.zeros((len(length), 12, 12))
    axial, torque = (0.5 * (force[:, 6 + k] - force[:, k]) for k in (0, 3))
    first, second = -force[:, 3:6], force[:, 9:12]  # section moments T My Mz
    stretch = _rows(length, {0: -1.0 / length, 6: 1.0 / length})
    for x, w in zip(_X, _W):
        weight = w * length
        v1, pz, pz1 = _bent(length, shear_ratio[:, 0], x, (1, 5, 7, 11), 1.0)
        w1, py, py1 = _bent(length, shear_ratio[:, 1], x, (2, 4, 8, 10), -1.0)
        theta = _rows(length, {3: 1.0 - x, 9: x})
        twist = _rows(length, {3: -1.0 / length, 9: 1.0 / length})
        my, mz = ((1.0 - x) * first + x * second).T[1:]
        my1, mz1 = ((second - first) / length[:, None]).T[1:]
        for factor, a, b in (
            (0.5 * axial, v1, v1),
            (0.5 * axial, w1, w1),
            (0.5 * axial * polar, twist, twist),
            (-mz1, theta, w1),
            (-mz, twist, w1),
            (-my1, theta, v1),
            (-my, twist, v1),
            (mz1, stretch, pz),
            (mz, stretch, pz1),
            (my1, stretch, py),
            (my, stretch, py1),
            (0.5 * torque, pz, py1),
            (-0.5 * torque, py, pz1),
        ):
            matrix += (weight * factor)[:, None, None] * _both(a, b)
    for end, moment, sign in ((3, first, -0.5), (9, second, 0.5)):
        part = sign * moment
        matrix[:, end, end + 2] += part[:, 1]
        matrix[:, end + 2, end] += part[:, 1]
        matrix[:, end, end + 1] -= part[:, 2]
        matrix[:, end + 1, end] -= part[:, 2]
    return matrix


def _both(a: Float64, b: Float64) -> Float64:
    """(e, n, n) second derivative of the product of two linear forms."""
    product = a[:, :, None] * b[:, None, :]
    return product + product.transpose(0, 2, 1)


def _rows(length: Float64, entries: dict[int, Float64 | float]) -> Float64:
    rows = np.zeros((len(length), 12))
    for column, value in entries.items():
        rows[:, column] = value
    return rows


def _bent(
    length: Float64,
    ratio: Float64,
    x: float,
    columns: tuple[int, int, int, int],
    sign: float,
) -> tuple[Float64, Float64, Float64]:
    """(e, 12) slope of the deflection, rotation and its derivative at x of the length.

    Args:
        length, ratio: (e,); see `line_differential`.
        x: fraction of the length.
        columns: deflection and rotation at A, at B.
        sign: 1 where a positive rotation is a positive slope.
    """
    share = 1.0 / (1.0 + ratio)
    a, turn_a, b, turn_b = columns
    slope = 6.0 * (x * x - x) - ratio
    moved = slope * share / length
    own_a = (1.0 - 4.0 * x + 3.0 * x * x + 0.5 * ratio * (1.0 - 2.0 * x)) * share
    own_b = (3.0 * x * x - 2.0 * x + 0.5 * ratio * (2.0 * x - 1.0)) * share
    deflection = _rows(
        length, {a: moved, turn_a: sign * own_a, b: -moved, turn_b: sign * own_b}
    )
    turned = sign * 6.0 * (x * x - x) * share / length
    rotation = _rows(
        length,
        {
            a: turned,
            turn_a: (1.0 - 4.0 * x + 3.0 * x * x + ratio * (1.0 - x)) * share,
            b: -turned,
            turn_b: (3.0 * x * x - 2.0 * x + ratio * x) * share,
        },
    )
    curved = sign * 6.0 * (2.0 * x - 1.0) * share / length**2
    curvature = _rows(
        length,
        {
            a: curved,
            turn_a: (6.0 * x - 4.0 - ratio) * share / length,
            b: -curved,
            turn_b: (6.0 * x - 2.0 + ratio) * share / length,
        },
    )
    return deflection, rotation, curvature


def shear_ratio(bending: Float64, shear: Float64, length: Float64) -> Float64:
    """(e, 2) 12 E I / (G A_s L^2); zero where shear is rigid (A_s zero)."""
    return over(12.0 * bending, shear * (length**2)[:, None])


def over(a: Float64, b: Float64) -> Float64:
    """(e,) a / b, zero where b is."""
    return np.divide(a, b, out=np.zeros_like(a), where=b != 0.0)

"""Mass matrices of straight beams at the shear centers, element axes.

Nastran's conventions:

- lumped: half of the mass to each end, translations only, for CBAR; CBEAM adds the
  torsional inertia ρ(I1 + I2) + NSI about the element axis;
- coupled: cubic lateral shapes without rotary inertia, linear along the axis and in
  torsion. For CBAR (and CROD) the axial part is the mean of lumped and linear (175/420
  and 35/420), which halves the frequency error of either, and there is no torsion; with
  the system cell BARMASS CBAR has the mass of CBEAM.

Masses may lie off the shear center, structural mass at the neutral axis: on the
straight line between points that follow the ends like rigid arms, and the shapes are
those of this line. So does commercial Nastran: ten lowest frequencies of cantilevers
with taper, offsets, neutral axes and non-structural mass off the shear center come out
to 3e-8 (results in TACS's comparison of beams, which ran with BARMASS).
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.elements.lines.line_geometry import congruence


@dataclass(frozen=True, kw_only=True)
class LineMass:
    """Mass per length at q integration points of e beams.

    Attributes:
        x: (e, q) positions as fraction of the length.
        weight: (e, q) integration weights, sum 1.
        mass: (e, q) per length.
        y, z: (e, 2) its place from the shear center at both ends, linear between them.
        torsion: (e, q) moment of inertia per length about the line of the masses.
    """

    x: Float64
    weight: Float64
    mass: Float64
    y: Float64
    z: Float64
    torsion: Float64


def lumped_mass(length: Float64, line: LineMass) -> Float64:
    """(e, 12, 12) lumped at the ends such that total mass and its center are kept."""
    shapes = (1.0 - line.x, line.x)
    matrix = np.zeros((len(length), 12, 12))
    for k, shape in zip((0, 6), shapes):
        share = shape * line.weight * length[:, None]
        end = _rigid_mass(line, share)
        matrix[:, k : k + 6, k : k + 6] = end
    return matrix


def coupled_mass(
    length: Float64, line: LineMass, *, axial_mean: bool = False
) -> Float64:
    """(e, 12, 12) consistent mass of the line of masses, carried to the shear centers.

    Args:
        length: (e,).
        line: the masses.
        axial_mean: the axial part is the mean of consistent and lumped.
    """
    matrix = np.zeros((len(length), 12, 12))
    for q in range(line.x.shape[1]):
        move = _interpolation(line.x[:, q], length)
        share = (line.weight[:, q] * length)[:, None, None]
        m = np.zeros((len(length), 4))
        m[:, :3], m[:, 3] = line.mass[:, q, None], line.torsion[:, q]
        matrix += share * (move.transpose(0, 2, 1) @ (m[:, :, None] * move))
    if axial_mean:
        ends = np.array([0, 6])
        matrix[:, ends[:, None], ends] += 0.5 * _lumped_less_consistent(length, line)
    return congruence(_arms(line), matrix)


def _lumped_less_consistent(length: Float64, line: LineMass) -> Float64:
    """(e, 2, 2) difference of the axial masses, lumped minus consistent."""
    shapes = np.stack([1.0 - line.x, line.x], axis=1)
    step = line.mass * line.weight * length[:, None]
    consistent = np.einsum("eq,eiq,ejq->eij", step, shapes, shapes)
    lumped = np.einsum("eq,eiq,ij->eij", step, shapes, np.eye(2))
    return lumped - consistent


def _rigid_mass(line: LineMass, share: Float64) -> Float64:
    """(e, 6, 6) about an end of `share` (e, q) of length moved to the end's plane."""
    y_of, z_of = _between(line.y, line.x), _between(line.z, line.x)
    m = np.einsum("eq,eq->e", share, line.mass)
    y = np.einsum("eq,eq,eq->e", share, line.mass, y_of)
    z = np.einsum("eq,eq,eq->e", share, line.mass, z_of)
    yy = np.einsum("eq,eq,eq->e", share, line.mass, y_of**2)
    zz = np.einsum("eq,eq,eq->e", share, line.mass, z_of**2)
    yz = np.einsum("eq,eq,eq->e", share, line.mass, y_of * z_of)
    matrix = np.zeros((len(m), 6, 6))
    for i in range(3):
        matrix[:, i, i] = m
    for i, j, value in ((0, 4, z), (0, 5, -y), (1, 3, -z), (2, 3, y), (4, 5, -yz)):
        matrix[:, i, j] = matrix[:, j, i] = value
    matrix[:, 3, 3] = yy + zz + np.einsum("eq,eq->e", share, line.torsion)
    matrix[:, 4, 4] = zz
    matrix[:, 5, 5] = yy
    return matrix


def _between(ends: Float64, x: Float64) -> Float64:
    """(e, q) values at x, linear between those (e, 2) of the ends."""
    return (1.0 - x) * ends[:, :1] + x * ends[:, 1:]


def _interpolation(x: Float64, length: Float64) -> Float64:
    """(e, 4, 12) translations and θx at x: linear u and θx, cubic v and w."""
    move = np.zeros((len(x), 4, 12))
    move[:, 0, 0] = move[:, 3, 3] = 1.0 - x
    move[:, 0, 6] = move[:, 3, 9] = x
    value = (1 - 3 * x**2 + 2 * x**3, x - 2 * x**2 + x**3)
    value_b = (3 * x**2 - 2 * x**3, -(x**2) + x**3)
    for at, v in ((0, value), (6, value_b)):
        move[:, 1, at + 1], move[:, 1, at + 5] = v[0], v[1] * length
        move[:, 2, at + 2], move[:, 2, at + 4] = v[0], -v[1] * length
    return move


def _arms(line: LineMass) -> Float64:
    """(e, 12, 12) motion of the ends of the line of masses from the shear centers'."""
    matrix = np.tile(np.eye(12), (len(line.y), 1, 1))
    for end, k in ((0, 0), (1, 6)):
        y, z = line.y[:, end], line.z[:, end]
        matrix[:, k, k + 4], matrix[:, k, k + 5] = z, -y
        matrix[:, k + 1, k + 3], matrix[:, k + 2, k + 3] = -z, y
    return matrix

"""Mass matrices of straight beams at the shear centres, element axes.

Nastran's conventions:

- lumped: half of the mass to each end, translations only, for CBAR; CBEAM adds the
  torsional inertia ρ(I1 + I2) + NSI about the element axis;
- coupled: cubic lateral shapes without rotary inertia; axially the mean of lumped and
  linear (175/420 and 35/420), which halves the frequency error of either.

Masses may lie off the shear centre, structural mass at the neutral axis; the products
that this causes are kept, so that rigid motion gives the exact mass and first moments.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64


@dataclass(frozen=True, kw_only=True)
class LineMass:
    """Mass per length at q integration points of e beams.

    Attributes:
        x: (e, q) positions as fraction of the length.
        weight: (e, q) integration weights, sum 1.
        mass: (e, q) per length.
        y, z: (e, q) its position from the shear centre.
        torsion: (e, q) moment of inertia per length about the line of the masses.
    """

    x: Float64
    weight: Float64
    mass: Float64
    y: Float64
    z: Float64
    torsion: Float64


def lumped_mass(length: Float64, line: LineMass) -> Float64:
    """(e, 12, 12) lumped at the ends such that total mass and its centre are kept."""
    shapes = (1.0 - line.x, line.x)
    matrix = np.zeros((len(length), 12, 12))
    for k, shape in zip((0, 6), shapes):
        share = shape * line.weight * length[:, None]
        end = _rigid_mass(line, share)
        matrix[:, k : k + 6, k : k + 6] = end
    return matrix


def coupled_mass(length: Float64, line: LineMass) -> Float64:
    """(e, 12, 12) consistent mass, axially the mean of consistent and lumped."""
    matrix = np.zeros((len(length), 12, 12))
    for q in range(line.x.shape[1]):
        move = _interpolation(line.x[:, q], length)
        share = (line.weight[:, q] * length)[:, None, None]
        at_mass = _to_mass(line.y[:, q], line.z[:, q]) @ move
        m = np.zeros((len(length), 4))
        m[:, :3], m[:, 3] = line.mass[:, q, None], line.torsion[:, q]
        matrix += share * (at_mass.transpose(0, 2, 1) @ (m[:, :, None] * at_mass))
    # Only the motion along the axis itself, without that of offset masses.
    ends = np.array([0, 6])
    matrix[:, ends[:, None], ends] += 0.5 * _lumped_less_consistent(length, line)
    return matrix


def _lumped_less_consistent(length: Float64, line: LineMass) -> Float64:
    """(e, 2, 2) difference of the axial masses, lumped minus consistent."""
    shapes = np.stack([1.0 - line.x, line.x], axis=1)
    step = line.mass * line.weight * length[:, None]
    consistent = np.einsum("eq,eiq,ejq->eij", step, shapes, shapes)
    lumped = np.einsum("eq,eiq,ij->eij", step, shapes, np.eye(2))
    return lumped - consistent


def _rigid_mass(line: LineMass, share: Float64) -> Float64:
    """(e, 6, 6) about an end of `share` (e, q) of length moved to the end's plane."""
    m = np.einsum("eq,eq->e", share, line.mass)
    y = np.einsum("eq,eq,eq->e", share, line.mass, line.y)
    z = np.einsum("eq,eq,eq->e", share, line.mass, line.z)
    yy = np.einsum("eq,eq,eq->e", share, line.mass, line.y**2)
    zz = np.einsum("eq,eq,eq->e", share, line.mass, line.z**2)
    yz = np.einsum("eq,eq,eq->e", share, line.mass, line.y * line.z)
    matrix = np.zeros((len(m), 6, 6))
    for i in range(3):
        matrix[:, i, i] = m
    for i, j, value in ((0, 4, z), (0, 5, -y), (1, 3, -z), (2, 3, y), (4, 5, -yz)):
        matrix[:, i, j] = matrix[:, j, i] = value
    matrix[:, 3, 3] = yy + zz + np.einsum("eq,eq->e", share, line.torsion)
    matrix[:, 4, 4] = zz
    matrix[:, 5, 5] = yy
    return matrix


def _interpolation(x: Float64, length: Float64) -> Float64:
    """(e, 6, 12) motion of the shear centre at x: linear u and θx, cubic v and w."""
    move = np.zeros((len(x), 6, 12))
    move[:, 0, 0] = move[:, 3, 3] = 1.0 - x
    move[:, 0, 6] = move[:, 3, 9] = x
    value = (1 - 3 * x**2 + 2 * x**3, x - 2 * x**2 + x**3)
    value_b = (3 * x**2 - 2 * x**3, -(x**2) + x**3)
    slope = (-6 * x + 6 * x**2, 1 - 4 * x + 3 * x**2)
    slope_b = (6 * x - 6 * x**2, -2 * x + 3 * x**2)
    for at, v, s in ((0, value, slope), (6, value_b, slope_b)):
        move[:, 1, at + 1], move[:, 1, at + 5] = v[0], v[1] * length
        move[:, 2, at + 2], move[:, 2, at + 4] = v[0], -v[1] * length
        move[:, 5, at + 1], move[:, 5, at + 5] = s[0] / length, s[1]
        move[:, 4, at + 2], move[:, 4, at + 4] = -s[0] / length, s[1]
    return move


def _to_mass(y: Float64, z: Float64) -> Float64:
    """(e, 4, 6) translations at (y, z) and θx from the motion of the shear centre."""
    matrix = np.tile(np.eye(4, 6), (len(y), 1, 1))
    matrix[:, 0, 4], matrix[:, 0, 5] = z, -y
    matrix[:, 1, 3], matrix[:, 2, 3] = -z, y
    return matrix

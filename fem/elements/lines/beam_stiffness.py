"""Stiffness of straight beams by integration of the section flexibility.

The section forces of an unloaded beam follow from the six end forces at B by
equilibrium alone, so its flexibility as a cantilever clamped at A is exact for any
variation of the section along the axis:

    F = ∫ H(x)ᵀ C(x) H(x) dx,   K = Φᵀ F⁻¹ Φ,

with H from end forces to section forces, C the section compliance (axial, two shears,
torsion, bending with product of inertia) and Φ the motion of B relative to a rigid
motion of A (Przemieniecki, Theory of Matrix Structural Analysis, 1968, sections 5.6
and 8.1). For a prismatic beam this is the Timoshenko element in closed form.

Axes: x along the shear centers from A to B, plane 1 is x-y. Section forces are N, Vy,
Vz, T, My, Mz; axial force and bending act at the neutral axis, at (y, z) from the
shear center.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64


@dataclass(frozen=True, kw_only=True)
class SectionCompliance:
    """Sections at q integration points of e beams.

    Attributes:
        x: (e, q) positions as fraction of the length.
        weight: (e, q) integration weights, sum 1.
        ea, gj: (e, q) axial and torsional stiffness.
        ei1, ei2, ei12: (e, q) bending stiffness of plane 1 (∫ E y²), plane 2 (∫ E z²),
            product (∫ E y z).
        gay, gaz: (e, q) shear stiffness, infinity for none of its flexibility.
        y, z: (e, q) neutral axis from the shear center.
        y_b, z_b: (e,) the same at end B.
    """

    x: Float64
    weight: Float64
    ea: Float64
    gj: Float64
    ei1: Float64
    ei2: Float64
    ei12: Float64
    gay: Float64
    gaz: Float64
    y: Float64
    z: Float64
    y_b: Float64
    z_b: Float64


def beam_stiffness(length: Float64, section: SectionCompliance) -> Float64:
    """(e, 12, 12) stiffness at the shear centers of both ends in element axes.

    A stiffness that is zero anywhere along a beam releases what it would carry.

    Args:
        length: (e,).
        section: sections of the same e beams.
    """
    flexibility = _end_flexibility(length, section)
    at_neutral = _invert_live(flexibility, _dead_forces(section))
    to_neutral = np.tile(np.eye(6), (len(length), 1, 1))
    to_neutral[:, 0, 4] = section.z_b
    to_neutral[:, 0, 5] = -section.y_b
    relative = to_neutral @ relative_motion(length)
    return relative.transpose(0, 2, 1) @ at_neutral @ relative


def relative_motion(length: Float64) -> Float64:
    """(e, 6, 12) motion of B relative to the rigid motion of A, element axes."""
    phi = np.zeros((len(length), 6, 12))
    phi[:, range(6), range(6)] = -1.0
    phi[:, range(6), range(6, 12)] = 1.0
    phi[:, 1, 5] = -length
    phi[:, 2, 4] = length
    return phi


def _end_flexibility(length: Float64, section: SectionCompliance) -> Float64:
    """(e, 6, 6) flexibility for forces at the neutral axis of end B."""
    total = np.zeros((len(length), 6, 6))
    for q in range(section.x.shape[1]):
        rest = length * (1.0 - section.x[:, q])
        force = np.tile(np.eye(6), (len(length), 1, 1))
        force[:, 4, 2] = -rest
        force[:, 5, 1] = rest
        force[:, 4, 0] = section.z_b - section.z[:, q]
        force[:, 5, 0] = section.y[:, q] - section.y_b
        step = (section.weight[:, q] * length)[:, None, None]
        compliance = _compliance(section, q)
        total += step * (force.transpose(0, 2, 1) @ compliance @ force)
    return total


def _compliance(section: SectionCompliance, q: int) -> Float64:
    """(e, 6, 6) strains per section force; what is released counts as rigid here."""
    matrix = np.zeros((section.x.shape[0], 6, 6))
    for k, stiffness in enumerate((section.ea, section.gay, section.gaz, section.gj)):
        matrix[:, k, k] = _reciprocal(stiffness[:, q])
    i1, i2, i12 = section.ei1[:, q], section.ei2[:, q], section.ei12[:, q]
    coupled = i12 != 0.0
    determinant = np.where(coupled, i1 * i2 - i12**2, 1.0)
    matrix[:, 4, 4] = np.where(coupled, i1 / determinant, _reciprocal(i2))
    matrix[:, 5, 5] = np.where(coupled, i2 / determinant, _reciprocal(i1))
    matrix[:, 4, 5] = matrix[:, 5, 4] = np.where(coupled, i12 / determinant, 0.0)
    return matrix


def _dead_forces(section: SectionCompliance) -> npt.NDArray[np.bool_]:
    """(e, 6) end forces that the beam cannot carry."""
    dead = np.zeros((section.x.shape[0], 6), bool)
    dead[:, 0] = np.any(section.ea == 0.0, axis=1)
    dead[:, 3] = np.any(section.gj == 0.0, axis=1)
    plane_1 = np.any(section.ei1 == 0.0, axis=1) | np.any(section.gay == 0.0, axis=1)
    plane_2 = np.any(section.ei2 == 0.0, axis=1) | np.any(section.gaz == 0.0, axis=1)
    dead[:, 1] = dead[:, 5] = plane_1
    dead[:, 2] = dead[:, 4] = plane_2
    return dead


def _invert_live(flexibility: Float64, dead: npt.NDArray[np.bool_]) -> Float64:
    """Inverse of the live part, zero rows and columns for the dead one."""
    live = ~(dead[:, :, None] | dead[:, None, :])
    matrix = np.where(live, flexibility, 0.0)
    diagonal = np.einsum("eii->ei", matrix)
    # A live force without any flexibility belongs to a beam of zero length.
    diagonal[diagonal == 0.0] = 1.0
    scale = 1.0 / np.sqrt(diagonal)
    scaling = scale[:, :, None] * scale[:, None, :]
    inverse = np.linalg.inv(matrix * scaling) * scaling
    return np.where(live, 0.5 * (inverse + inverse.transpose(0, 2, 1)), 0.0)


def _reciprocal(values: Float64) -> Float64:
    return np.divide(1.0, values, out=np.zeros_like(values), where=values != 0.0)

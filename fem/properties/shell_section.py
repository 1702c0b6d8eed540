"""Constitutive matrices of shell elements in element axes.

Resultants N = A e + B k, M = B e + D k of membrane strains e and curvatures k, where
the strain at height z above the reference surface is e + z k; transverse shear forces
Q from shear strains by the inverse of a flexibility. (Nastran prints -M.)
"""

from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class ShellSection:
    """Arrays over elements, units of the deck.

    Attributes:
        membrane, coupling, bending: (e, 3, 3) A, B, D in element axes.
        shear_flexibility: (e, 2, 2) per unit of transverse shear force; zero: rigid.
        thickness: (e,) mean thickness.
        taper: (e, n) thickness at the corners over the mean one; None: constant.
        inertia: (e,) moment of inertia per width, for stresses (12 I / T^3 included).
        fibre: (e, 2) heights Z1 and Z2 of the printed stresses.
        density: (e,) structural mass per area.
        nonstructural: (e,) non-structural mass per area.
        mass_height: (e,) height of the structural mass above the reference surface.
        ge: (e,) structural damping coefficient.
    """

    membrane: Float64
    coupling: Float64
    bending: Float64
    shear_flexibility: Float64
    thickness: Float64
    taper: Float64 | None
    inertia: Float64
    fibre: Float64
    density: Float64
    nonstructural: Float64
    mass_height: Float64
    ge: Float64

    def take(self, which: slice | Int64) -> "ShellSection":
        """The section of some elements."""
        chosen = {k: (None if v is None else v[which]) for k, v in vars(self).items()}
        return replace(self, **chosen)


def strain_rotation(angle: Float64) -> Float64:
    """(..., 3, 3) R: e' = R e in axes turned by `angle` (rad) about z."""
    c, s = np.cos(angle), np.sin(angle)
    rows = [
        [c * c, s * s, c * s],
        [s * s, c * c, -c * s],
        [-2.0 * c * s, 2.0 * c * s, c * c - s * s],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def vector_rotation(angle: Float64) -> Float64:
    """(..., 2, 2) r: v' = r v in axes turned by `angle` (rad)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)], axis=-2)


def turned_stiffness(stiffness: Float64, angle: Float64) -> Float64:
    """(..., 3, 3) in element axes of a matrix in material axes at `angle` to them."""
    r = strain_rotation(angle)
    return np.swapaxes(r, -1, -2) @ stiffness @ r


def turned_flexibility(flexibility: Float64, angle: Float64) -> Float64:
    """(..., 2, 2) shear flexibility in element axes from material axes at `angle`."""
    r = vector_rotation(angle)
    return np.swapaxes(r, -1, -2) @ flexibility @ r


def line_strain(direction: Float64) -> Float64:
    """(..., 3) strain xx yy xy of a unit stretch along `direction` (..., 2)."""
    c, s = np.moveaxis(direction, -1, 0)
    return np.stack([c * c, s * s, 2.0 * c * s], axis=-1)


def bending_along(section: ShellSection, direction: Float64) -> Float64:
    """(e, k) bending stiffness per width along unit vectors (e, k, 2).

    That of a strip about its own neutral surface: D_l - B_l^2 / A_l, the direct
    stiffnesses along l. A laminate's reference surface does not matter, and the
    stiffness is the one of its transverse shear (cylindrical bending).
    """
    strain = line_strain(direction)
    a, b, d = (
        np.einsum("eki,eij,ekj->ek", strain, part, strain)
        for part in (section.membrane, section.coupling, section.bending)
    )
    there = a > 0.0
    return d - np.where(there, b * b / np.where(there, a, 1.0), 0.0)


def section_flexibility(section: ShellSection) -> Float64:
    """(e, 6, 6), see `plate_flexibility`."""
    return plate_flexibility(section.membrane, section.coupling, section.bending)


def plate_flexibility(a: Float64, b: Float64, d: Float64) -> Float64:
    """(e, 6, 6) pseudo-inverse of [A B; B D], scaled to be independent of units.

    Args:
        a, b, d: (e, 3, 3); an absent one is zero, and gives no strain.
    """
    joined = np.concatenate(
        [np.concatenate([a, b], axis=2), np.concatenate([b, d], axis=2)], axis=1
    )
    scale = np.sqrt(np.einsum("eii->ei", joined))
    scale = np.where(scale > 0.0, scale, 1.0)
    both = scale[:, :, None] * scale[:, None, :]
    return np.linalg.pinv(joined / both, hermitian=True, rcond=1e-12) / both

"""Transverse shear of CQUAD8 and CTRIA6: assumed strains, residual flexibility.

Quadrilaterals take both components at 2 x 2 points and vary bilinearly between them.
Triangles take, for each side, the component across it (along the height from the
opposite corner) at three points between which it varies linearly; of the three
components, one too many, the strain is the nearest (least squares, equal weights).

The field is a sum of orthogonal modes over the area, 1, r, s and r s in rectangles,
each with the section's shear flexibility and a residual flexibility of its own: bending
that the element cannot follow counts as shear (MacNeal). In rectangles the strain along
a side l, that varies along l or not and across it (side w) or not, has

    1 / (48 D / l^2 + c D / w^2),   c = 4800 (uniform), 1600 (across), 480 (both),

and l^2 / (38.4 D) where it varies along l alone; 48 is exact for a deflection x^4, the
others are springs side by side as in CQUAD4. Triangles have 0.03 A / D in all modes.

All of this was found in MSC Nastran's grid point forces and printed moments of a unit
square and a half square (thick, and thinner, with and without mid-sides, single
precision) and gives two rectangles without shear flexibility their 53 printed figures
to 1e-7. Elements of other shapes were not at hand: of quadrilaterals l and w are the
lengths of the middle lines, along which the flexibilities act, D that of bending along
them; of triangles D is the mean of all directions, and the area their measure (28
triangles of many shapes deflect within 0.14 % of MSC's then, not with other measures).
MSC prints other shear forces than these, which are in equilibrium: of triangles a
sixth, of quadrilaterals with a third of what is linear and a ninth of r s.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.curved_strain import covariant_shear
from fem.elements.shells.quadratic_surface import (
    Base,
    Powers,
    Surface,
    base,
    monomials,
    turned,
)
from fem.elements.shells.shell_geometry import unit
from fem.properties.shell_section import ShellSection, bending_along

# By what the strain along a side varies with: along the side, across it.
_OWN = {(0, 0): 48.0, (1, 0): 38.4, (0, 1): 48.0, (1, 1): 48.0}
_TWIST = {(0, 0): 4800.0, (1, 0): 0.0, (0, 1): 1600.0, (1, 1): 480.0}
_OF_TRIANGLE = 0.03


@dataclass(frozen=True)
class ShearModes:
    """Orthonormal modes of the shear strain over elements, axes of the center.

    Attributes:
        powers: of the monomials.
        inverse: (e, m, m) modes from monomials.
        strain: (e, m, 2, 6 n) amplitudes.
    """

    powers: Powers
    inverse: Float64
    strain: Float64

    def values(self, p: Float64) -> Float64:
        """(e, p, m) of the modes at natural points."""
        return np.einsum("ecm,pm->epc", self.inverse, monomials(self.powers, p))


def shear_modes(surface: Surface, x: Float64, d: Float64) -> ShearModes:
    """The assumed shear of elements of nodes x (e, n, 3) with normals d."""
    center = base(surface, x, surface.results[:1])
    take = _of_quadrilaterals if surface.even else _of_triangles
    field = take(surface, x, d, center)
    at = surface.reduced if surface.even else surface.rule
    share = np.full(len(at), surface.shares.sum() / len(at)) * base(surface, x, at).area
    value = monomials(surface.printed, at)
    gram = np.einsum("eg,gm,gk->emk", share, value, value)
    lower = np.linalg.cholesky(gram)
    strain = np.einsum("ecm,ecsn->emsn", lower, field)
    return ShearModes(surface.printed, np.linalg.inv(lower), strain)


def _shear_at(
    surface: Surface, x: Float64, d: Float64, p: Float64, center: Base
) -> Float64:
    """(e, q, 2, 6 n) shear at points in the axes of the center."""
    at = base(surface, x, p)
    turn = turned(at, center)[:, 0, :, 6:, 6:]
    return turn @ at.gradient @ covariant_shear(surface, x, d, p)


def _of_quadrilaterals(
    surface: Surface, x: Float64, d: Float64, center: Base
) -> Float64:
    """(e, m, 2, 6 n) coefficients of the monomials."""
    p = surface.shears[0]
    inverse = np.linalg.inv(monomials(surface.printed, p))
    return np.einsum("cg,egsn->ecsn", inverse, _shear_at(surface, x, d, p, center))


def _of_triangles(surface: Surface, x: Float64, d: Float64, center: Base) -> Float64:
    """(e, m, 2, 6 n) coefficients of the monomials."""
    of_r, of_s = np.moveaxis(center.gradient[:, 0], -1, 0)
    heights = unit(np.stack([-of_r - of_s, of_r, of_s], axis=1))
    parts = []
    for height, p in zip(heights.swapaxes(0, 1), surface.shears):
        inverse = np.linalg.inv(monomials(surface.printed, p))
        strain = _shear_at(surface, x, d, p, center)
        parts.append(np.einsum("cg,egsn,es->ecn", inverse, strain, height))
    nearest = np.linalg.inv(heights.swapaxes(1, 2) @ heights)
    outward = nearest @ heights.swapaxes(1, 2)
    return np.einsum("esk,kecn->ecsn", outward, np.array(parts))


def mode_flexibility(
    surface: Surface, x: Float64, section: ShellSection, area: Float64
) -> Float64:
    """(e, m, 2, 2) of shear and of residual bending, axes of the center.

    Args:
        surface, x: as of `shear_modes`.
        section: at the center.
        area: (e,).
    """
    modes = len(surface.printed)
    total = np.repeat(section.shear_flexibility[:, None], modes, axis=1)
    if not surface.even:
        d = section.bending
        mean = 3.0 * (d[:, 0, 0] + d[:, 1, 1]) + 2.0 * d[:, 0, 1] + 4.0 * d[:, 2, 2]
        own = _OF_TRIANGLE * area / np.where(mean > 0.0, mean / 8.0, np.inf)
        return total + own[:, None, None, None] * np.eye(2)
    center = base(surface, x, surface.results[:1])
    lines = np.einsum("eki,eai->eka", center.a[:, 0], center.axes[:, 0])
    length = 2.0 * np.linalg.norm(lines, axis=2)
    towards = unit(lines)
    stiff = bending_along(section, towards)
    # A section without bending stiffness along a line is as good as cut there.
    least = 1e-9 * np.einsum("eii->e", section.bending)[:, None]
    stiff = np.maximum(stiff, least)
    for k in (0, 1):
        spread = towards[:, k, :, None] * towards[:, k, None, :]
        for mode, powers in enumerate(surface.printed):
            along = powers if k == 0 else powers[::-1]
            spring = _OWN[along] / length[:, k] ** 2
            spring = spring + _TWIST[along] / length[:, 1 - k] ** 2
            own = 1.0 / np.where(stiff[:, k] > 0.0, stiff[:, k] * spring, np.inf)
            total[:, mode] += own[:, None, None] * spread
    return total

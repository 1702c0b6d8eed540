"""Membrane with true drilling freedoms: CTRIAR and CQUADR.

The triangle is Felippa's (`optimal_triangle`); the quadrilateral is the mean of the two
pairs of triangles that its diagonals cut it into, so that it has no preferred diagonal,
passes the patch test on any shape and bends in its plane exactly as a rectangle.
Bending is that of CQUAD4 and CTRIA3. A laminate's coupling acts between the mean
strains and the mean curvatures, which both parts know exactly: the sum of all energies
stays positive.
"""

from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.optimal_triangle import OptimalTriangle
from fem.elements.shells.shell_geometry import Facet, centre_gradient
from fem.elements.shells.shell_hybrid import (
    InPlane,
    in_plane,
    plane_strain_operator,
    scatter,
)
from fem.properties.shell_section import ShellSection

# Corners of the triangles, and the weight of each.
_CUTS = {
    3: (((0, 1, 2),), 1.0),
    4: (((0, 1, 2), (0, 2, 3), (1, 2, 3), (1, 3, 0)), 0.5),
}
_UVR = np.array([0, 1, 5])  # u, v, rz of a corner


@dataclass(frozen=True, kw_only=True)
class DrillingInPlane:
    """Membrane and bending in flat local freedoms.

    Attributes:
        plate: bending; its membrane only gives how N varies from the centre to the
            corners.
        membrane: (e, 6 n, 6 n) stiffness of membrane and coupling.
        mean: (e, 6, 6 n) what the mean strains give: N, and M by coupling.
    """

    plate: InPlane
    membrane: Float64
    mean: Float64

    def stiffness(self) -> Float64:
        """(e, 6 n, 6 n) in flat local freedoms."""
        return self.plate.stiffness() + self.membrane

    def resultant(self, *, corner: bool) -> Float64:
        """(e, p, 6, 6 n) N and M from flat local freedoms; p 1, or all points."""
        found = self.plate.resultant(corner=corner)
        found[:, :, :3] -= found[:, :1, :3].copy()
        return found + self.mean[:, None]


def drilling_in_plane(shape: Facet, section: ShellSection) -> DrillingInPlane:
    """Membrane with drilling, and bending, of triangles or quadrilaterals."""
    n, area = shape.corners, shape.area[:, None, None]
    uncoupled = replace(section, coupling=np.zeros_like(section.coupling))
    plate = in_plane(shape, uncoupled)
    plate.reduced[:, : 2 * n, : 2 * n] = 0.0
    membrane, force, strain = _membrane(shape, section)
    gradient = plane_strain_operator(centre_gradient(shape))
    curvature = scatter(np.concatenate([np.zeros_like(gradient), gradient], axis=2))
    coupling = section.coupling
    cross = area * (strain.transpose(0, 2, 1) @ coupling @ curvature)
    moment = coupling @ strain
    return DrillingInPlane(
        plate=plate,
        membrane=membrane + cross + cross.transpose(0, 2, 1),
        mean=np.concatenate([force + coupling @ curvature, moment], axis=1),
    )


def _membrane(shape: Facet, section: ShellSection) -> tuple[Float64, Float64, Float64]:
    """Stiffness (e, 6 n, 6 n), mean N and mean strains (e, 3, 6 n) of the triangles."""
    triangles, weight = _CUTS[shape.corners]
    e, size = len(shape.xy), 6 * shape.corners
    stiffness = np.zeros((e, size, size))
    force, mean = np.zeros((e, 3, size)), np.zeros((e, 3, size))
    for corners in triangles:
        part = OptimalTriangle(xy=shape.xy[:, corners])
        at = (6 * np.array(corners)[:, None] + _UVR).ravel()
        sheet = section.membrane
        if section.taper is not None:
            share = section.taper[:, corners].mean(axis=1)
            sheet = share[:, None, None] * sheet
        strain = part.mean_strain()
        area = weight * part.area[:, None, None]
        own = area * (strain.transpose(0, 2, 1) @ sheet @ strain)
        stiffness[:, at[:, None], at] += own + weight * part.higher(sheet)
        force[:, :, at] += area * (sheet @ strain)
        mean[:, :, at] += area * strain
    whole = shape.area[:, None, None]
    return stiffness, force / whole, mean / whole

"""Membrane with true drilling freedoms: CTRIAR and CQUADR.

Displacements with vertex rotations and assumed stresses (`allman`). The membrane passes
the patch test on any shape; a rectangular CQUADR bends in its plane exactly, a CTRIAR
does as the mesh gets fine. Bending is that of CQUAD4 and CTRIA3, but that what bends
linearly along one direction of a quadrilateral has no curvature across (grid point
forces of MSC Nastran, single precision); transverse shear: `shell_shear`. A laminate's
coupling acts between the mean strains and the mean curvatures, which both parts know
exactly: the sum of all energies stays positive.
"""

from dataclasses import dataclass, replace

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.allman import AllmanFields, allman_fields
from fem.elements.shells.shell_geometry import Facet, center_gradient
from fem.elements.shells.shell_hybrid import (
    InPlane,
    in_plane,
    plane_strain_operator,
    scatter,
)
from fem.properties.shell_section import ShellSection

_UVR = np.array([0, 1, 5])  # u, v, rz of a corner


@dataclass(frozen=True, kw_only=True)
class DrillingInPlane:
    """Membrane and bending in flat local freedoms.

    Attributes:
        plate: bending.
        membrane: (e, 6 n, 6 n) stiffness of membrane and coupling.
        force: (e, p, 3, 6 n) N at the center and the corners.
        moment: (e, 3, 6 n) M by coupling with the mean strains.
    """

    plate: InPlane
    membrane: Float64
    force: Float64
    moment: Float64

    def stiffness(self) -> Float64:
        """(e, 6 n, 6 n) in flat local freedoms."""
        return self.plate.stiffness() + self.membrane

    def resultant(self, *, corner: bool) -> Float64:
        """(e, p, 6, 6 n) N and M from flat local freedoms; p 1, or all points."""
        found = self.plate.resultant(corner=corner)
        found[:, :, :3] = self.force[:, : found.shape[1]]
        found[:, :, 3:] += self.moment[:, None]
        return found


def drilling_in_plane(shape: Facet, section: ShellSection) -> DrillingInPlane:
    """Membrane with drilling, and bending, of triangles or quadrilaterals."""
    n, area = shape.corners, shape.area[:, None, None]
    uncoupled = replace(section, coupling=np.zeros_like(section.coupling))
    plate = in_plane(shape, uncoupled, free_across=False)
    plate.reduced[:, : 2 * n, : 2 * n] = 0.0
    membrane, force, strain = _membrane(shape, section)
    gradient = plane_strain_operator(center_gradient(shape))
    curvature = scatter(np.concatenate([np.zeros_like(gradient), gradient], axis=2))
    coupling = section.coupling
    cross = area * (strain.transpose(0, 2, 1) @ coupling @ curvature)
    return DrillingInPlane(
        plate=plate,
        membrane=membrane + cross + cross.transpose(0, 2, 1),
        force=force + (coupling @ curvature)[:, None],
        moment=coupling @ strain,
    )


def _membrane(shape: Facet, section: ShellSection) -> tuple[Float64, Float64, Float64]:
    """Stiffness (e, 6 n, 6 n), N (e, p, 3, 6 n), mean strains (e, 3, 6 n)."""
    fields = allman_fields(shape)
    sheet = section.membrane
    if section.taper is not None:
        sheet = section.taper.mean(axis=1)[:, None, None] * sheet
    work = np.einsum("eq,eqsb,eqsn->ebn", fields.weight, fields.stress, fields.strain)
    amplitude = np.linalg.solve(_flexibility(fields, sheet), work)
    stiffness = work.transpose(0, 2, 1) @ amplitude
    stiffness += sheet[:, 2:, 2:] * (fields.ties.transpose(0, 2, 1) @ fields.ties)
    exists = (np.einsum("eii->e", sheet) > 0.0)[:, None, None]
    mean = work[:, :3] / shape.area[:, None, None]
    force = fields.at @ amplitude[:, None] * exists[:, None]
    return (
        _spread(_spread(stiffness * exists).transpose(0, 2, 1)),
        np.stack([_spread(force[:, p]) for p in range(force.shape[1])], axis=1),
        _spread(mean),
    )


def _flexibility(fields: AllmanFields, sheet: Float64) -> Float64:
    """(e, 5, 5) of the amplitudes, finite without stiffness in a direction, too."""
    size = np.einsum("eii->e", sheet)[:, None, None]
    floor = np.where(size > 0.0, 1e-9 * size, 1.0) * np.eye(3)
    weak = np.linalg.eigvalsh(sheet)[:, :1, None] < 1e-9 * size
    compliance = np.linalg.inv(np.where(weak | (size == 0.0), sheet + floor, sheet))
    stress = fields.stress
    energy = stress.transpose(0, 1, 3, 2) @ compliance[:, None] @ stress
    return (fields.weight[..., None, None] * energy).sum(axis=1)


def _spread(operator: Float64) -> Float64:
    """(e, m, 6 n) from (e, m, 3 n) of u v theta of the corners."""
    e, m, width = operator.shape
    full = np.zeros((e, m, width // 3, 6))
    full[..., _UVR] = operator.reshape(e, m, -1, 3)
    return full.reshape(e, m, 2 * width)

"""Mass of shells: translations at the height of the mass above the grids.

Lumped: each corner takes the integral of its shape function; coupled: the consistent
matrix of linear shape functions (PARAM COUPMASS). Mass away from the grids (ZOFFS,
laminates that are not centered) couples translations with rotations, so that the center
of gravity is right.
"""

import numpy as np

from fem.arrays import Float64
from fem.elements.shells.shell_geometry import Facet
from fem.properties.shell_section import ShellSection

_G = 1.0 / np.sqrt(3.0)
_GAUSS = np.array([[-_G, -_G], [_G, -_G], [_G, _G], [-_G, _G]])
_SIGNS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def shape_products(shape: Facet) -> Float64:
    """(e, n, n) integrals of products of linear shape functions over the flat area."""
    if shape.corners == 3:
        unit = (np.ones((3, 3)) + np.eye(3)) / 12.0
        return shape.area[:, None, None] * unit
    factor = 1.0 + _GAUSS[:, None, :] * _SIGNS
    value = 0.25 * factor[..., 0] * factor[..., 1]
    slope = 0.25 * _SIGNS * factor[..., ::-1]
    jacobian = np.linalg.det(slope.transpose(0, 2, 1) @ shape.xy[:, None])
    return np.einsum("eq,qi,qj->eij", jacobian, value, value)


def shell_mass(
    shape: Facet, section: ShellSection, offset: Float64, *, coupled: bool
) -> Float64:
    """(e, 6 n, 6 n) mass matrix of the grid freedoms in basic axes.

    Args:
        shape: geometry.
        section: masses per area and the height of the structural mass.
        offset: (e,) height of the reference surface above the grids.
        coupled: consistent instead of lumped.
    """
    products = shape_products(shape)
    if not coupled:
        lumped = products.sum(axis=2)
        products = lumped[:, :, None] * np.eye(shape.corners)
    height = offset + section.mass_height
    structural, other = section.density, section.nonstructural
    moments = (
        structural + other,
        structural * height + other * offset,
        structural * height**2 + other * offset**2,
    )
    normal = shape.axes[:, 2]
    # theta x (h n) = h S theta with S = -[n]x.
    spin = np.cross(np.eye(3), normal[:, None, :]).transpose(0, 2, 1)
    unit = np.zeros((len(normal), 2, 3, 2, 3))
    first, second = moments[1][:, None, None], moments[2][:, None, None]
    unit[:, 0, :, 0] = moments[0][:, None, None] * np.eye(3)
    unit[:, 0, :, 1] = first * spin
    unit[:, 1, :, 0] = first * spin.transpose(0, 2, 1)
    unit[:, 1, :, 1] = second * (spin.transpose(0, 2, 1) @ spin)
    per_node = unit.reshape(-1, 1, 6, 1, 6)
    matrix = products[:, :, None, :, None] * per_node
    size = 6 * shape.corners
    return matrix.reshape(-1, size, size)

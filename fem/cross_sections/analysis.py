"""Area, torsion and shear properties of a solid or thin-walled cross-section.

The section is cut into nine-node quadrilaterals. Torsion is Saint-Venant's warping
problem, shear the Poisson problem of a bar bent by a transverse force with
Poisson's ratio 0; the shear center is Trefftz's. See W. D. Pilkey, Analysis and Design
of Elastic Beams, chapters 5 and 6.

Coordinates (y, z): y along axis 1 of the element, z along axis 2.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from fem.arrays import Float64, Int64


@dataclass(frozen=True, kw_only=True)
class SectionConstants:
    """Constants of a cross-section about its centroid.

    Attributes:
        area: A.
        i1: integral of y^2, bending in plane 1.
        i2: integral of z^2, bending in plane 2.
        i12: integral of y z.
        j: Saint-Venant torsion constant.
        k1, k2: shear factors, shear stiffness K A G in planes 1 and 2.
        centroid: (2,) y, z in the coordinates of the mesh.
        shear_center: (2,) y, z relative to the centroid.
    """

    area: float
    i1: float
    i2: float
    i12: float
    j: float
    k1: float
    k2: float
    centroid: Float64
    shear_center: Float64


def analyse(quads: Float64) -> SectionConstants:
    """Constants of a section given by quadrilaterals (e, 4, 2) in one sense of turn."""
    nodes, elements = _quadratic_mesh(quads)
    shape, gradient, weight = _at_gauss_points(nodes[elements])
    points = np.einsum("gn,enk->egk", shape, nodes[elements])
    area = weight.sum()
    centroid = np.einsum("eg,egk->k", weight, points) / area
    y, z = np.moveaxis(points - centroid, -1, 0)
    i1, i2, i12 = ((weight * f).sum() for f in (y * y, z * z, y * z))
    # A symmetric section has no product of inertia, not one of rounding errors.
    i12 = 0.0 if abs(i12) < 1e-12 * (i1 + i2) else i12

    stiffness = np.einsum("eg,egnk,egmk->enm", weight, gradient, gradient)
    solve = _Poisson(elements, stiffness, len(nodes))
    twist = np.einsum("eg,egn->en", weight * z, gradient[..., 0])
    twist -= np.einsum("eg,egn->en", weight * y, gradient[..., 1])
    warping, energy = solve(twist)
    omega = np.einsum("gn,en->eg", shape, warping[elements])
    omega -= (weight * omega).sum() / area
    moments = np.array([(weight * omega * y).sum(), (weight * omega * z).sum()])
    z_s, y_s = np.linalg.solve([[i1, -i12], [i12, -i2]], moments)
    shear_center = np.array([y_s, z_s])
    shear_center[abs(shear_center) < 1e-9 * np.sqrt((i1 + i2) / area)] = 0.0

    determinant = i1 * i2 - i12 * i12
    factors = []
    for load in ((i2 * y - i12 * z), (i1 * z - i12 * y)):
        source = np.einsum("eg,gn->en", weight * load / determinant, shape)
        factors.append(1.0 / (area * solve(source)[1]))
    return SectionConstants(
        area=float(area),
        i1=float(i1),
        i2=float(i2),
        i12=float(i12),
        j=float(i1 + i2 - energy),
        k1=float(factors[0]),
        k2=float(factors[1]),
        centroid=centroid,
        shear_center=shear_center,
    )


class _Poisson:
    """Neumann problems with one factorisation; the constant is fixed at one node."""

    def __init__(self, elements: Int64, stiffness: Float64, size: int) -> None:
        self._elements, self._size = elements, size
        rows = np.repeat(elements, elements.shape[1], axis=1)
        columns = np.tile(elements, (1, elements.shape[1]))
        matrix = sp.csc_matrix(
            (stiffness.ravel(), (rows.ravel(), columns.ravel())), shape=(size, size)
        )
        self._factor = splu(matrix[1:, 1:])

    def __call__(self, loads: Float64) -> tuple[Float64, float]:
        """Nodal solution (n,) for element loads (e, 9), and its energy u·f."""
        right = np.zeros(self._size)
        np.add.at(right, self._elements, loads)
        solution = np.zeros(self._size)
        solution[1:] = self._factor.solve(right[1:])
        return solution, float(solution @ right)


# Corners of the reference square, then the nine nodes as products of -1, 0, 1.
_CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=float)
_NODES = np.array([[a, b] for a in (-1, 0, 1) for b in (-1, 0, 1)], dtype=float)


def _bilinear(at: Float64) -> Float64:
    """(p, 4) bilinear shape functions at (p, 2)."""
    return np.prod(1.0 + at[:, None, :] * _CORNERS, axis=-1) / 4.0


def _quadratic_mesh(quads: Float64) -> tuple[Float64, Int64]:
    """Nodes (n, 2), merged where they coincide, and elements (e, 9)."""
    points = np.einsum("pc,eck->epk", _bilinear(_NODES), quads)
    size = np.ptp(quads.reshape(-1, 2), axis=0).max()
    keys = np.round(points.reshape(-1, 2) / (1e-9 * size)).astype(np.int64)
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    elements = inverse.reshape(len(quads), 9)
    return points.reshape(-1, 2)[first], elements


def _at_gauss_points(nodes: Float64) -> tuple[Float64, Float64, Float64]:
    """Shape functions (9, 9), gradients (e, 9, 9, 2), weights with Jacobian (e, 9)."""
    root = np.sqrt(0.6)
    x = np.array([-root, 0.0, root])
    w = np.array([5.0, 8.0, 5.0]) / 9.0
    # Lagrange polynomials through -1, 0, 1 and their derivatives, (point, node).
    value = np.stack([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2], axis=1)
    slope = np.stack([x - 0.5, -2 * x, x + 0.5], axis=1)

    def product(a: Float64, b: Float64) -> Float64:
        return np.einsum("ik,jl->ijkl", a, b).reshape(9, 9)

    shape = product(value, value)
    local = np.stack([product(slope, value), product(value, slope)], axis=-1)
    jacobian = np.einsum("gnk,enl->egkl", local, nodes)
    weight = np.abs(np.linalg.det(jacobian)) * np.outer(w, w).ravel()
    gradient = np.einsum("gnk,eglk->egnl", local, np.linalg.inv(jacobian))
    return shape, gradient, weight

"""Differential stiffness of solids: stresses on the rotations of their material.

With the rotation W = (grad u - grad u^T) / 2 the work is 1/2 int s_ij W_ki W_kj dV:
products with the strains themselves are small beside it and left out, as in Nastran
(see `shell_preload` for figures).
"""

import numpy as np

from fem.arrays import Float64
from fem.elements.solids.isoparametric import (
    Derivatives,
    Rule,
    hex8,
    jacobians,
    penta6,
    pyram5,
    tetra4,
)

# Shape functions of the corners: with them stresses vary inside.
_LINEAR = {4: tetra4, 5: pyram5, 6: penta6, 8: hex8}


def solid_differential(
    nodes: Float64, stress: Float64, corners: int, rule: Rule, derivatives: Derivatives
) -> Float64:
    """(e, 3 n, 3 n) of the work of stresses, basic axes.

    Args:
        nodes: (e, n, 3) in the basic frame.
        stress: (e, p, 6) xx yy zz xy yz zx at the center, then at the corners.
        corners: number of corners.
        rule: quadrature.
        derivatives: of the shape functions.
    """
    slope = derivatives(rule.points)
    jacobian = jacobians(nodes, slope)
    gradient = np.linalg.inv(jacobian) @ slope
    weight = rule.weights * np.linalg.det(jacobian)
    if stress.shape[1] > corners:
        inside = _LINEAR[corners](rule.points) @ stress[:, 1 : corners + 1]
    else:
        inside = np.broadcast_to(stress[:, :1], (*weight.shape, 6))
    xx, yy, zz, xy, yz, zx = np.moveaxis(weight[..., None] * inside, -1, 0)
    rows = ((xx, xy, zx), (xy, yy, yz), (zx, yz, zz))
    weighted = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    e, q, _, n = gradient.shape
    whole = gradient[:, :, None, :, :, None] * np.eye(3)[:, None, None, :]
    # [k, j] of (u_k,j - u_j,k) / 2 from the displacements of the nodes
    turned = 0.5 * (whole - whole.swapaxes(2, 3)).reshape(e, q, 3, 3, 3 * n)
    work = weighted[:, :, None] @ turned
    flat = (e, q * 9, 3 * n)
    return turned.reshape(flat).swapaxes(1, 2) @ work.reshape(flat)

"""What internal forces add to the stiffness: parts that elements have in common.

An element under internal forces resists, or helps, what turns it. Its differential
stiffness is the second derivative of the work that the forces do on the parts of the
strains (and of the displacements behind rigid arms) that are quadratic in the
displacements. Rotations of grids are rotation vectors: a moment m that turns with its
element by phi changes by phi x m / 2 (semitangential; Argyris, Comp. Meth. Appl. Mech.
Eng. 20, 1979). Moments that balance at a grid leave no trace of that choice.
"""

import numpy as np

from fem.arrays import Float64


def turning_arm(force: Float64, arm: Float64) -> Float64:
    """(..., 3, 3) stiffness against rotations of a rigid arm with a force at its tip.

    The tip moves by theta x w + theta x (theta x w) / 2; the force f works on the
    second part.

    Args:
        force: (..., 3) upon the element, at the tip.
        arm: (..., 3) w from the grid to the tip.
    """
    product = force[..., :, None] * arm[..., None, :]
    along = np.einsum("...i,...i->...", force, arm)
    symmetric = 0.5 * (product + product.swapaxes(-1, -2))
    return symmetric - along[..., None, None] * np.eye(3)


def tension_across(axis: Float64, per_length: Float64) -> Float64:
    """(e, 6, 6) of bars under tension: translations of both ends, across the axis.

    Args:
        axis: (e, 3) unit vectors.
        per_length: (e,) axial force over length.
    """
    across = np.eye(3) - axis[:, :, None] * axis[:, None, :]
    part = per_length[:, None, None] * across
    return np.concatenate(
        [np.concatenate([part, -part], 2), np.concatenate([-part, part], 2)], 1
    )


def of_gradients(gradient: Float64, weighted: Float64) -> Float64:
    """(e, n, n) sum over points of weighted stress times products of gradients.

    Args:
        gradient: (e, q, d, n) of the shape functions.
        weighted: (e, q, d, d) stress or force per length, symmetric, times weight.
    """
    e, q, d, n = gradient.shape
    flat = gradient.reshape(e, q * d, n)
    return flat.swapaxes(1, 2) @ (weighted @ gradient).reshape(e, q * d, n)


def symmetric_plane(xx_yy_xy: Float64) -> Float64:
    """(..., 2, 2) from (..., 3)."""
    xx, yy, xy = np.moveaxis(xx_yy_xy, -1, 0)
    return np.stack([np.stack([xx, xy], -1), np.stack([xy, yy], -1)], -2)

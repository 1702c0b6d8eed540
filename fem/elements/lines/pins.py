"""Pin flags: freedoms of an element that are not connected to its grid.

A released freedom carries no force; it is condensed out of the stiffness, and out of a
coupled mass with the same deformation pattern (Guyan).
"""

import numpy as np

from fem.arrays import Bool, Float64


def pin_flags(texts: list[str]) -> Bool:
    """(e, 6) released components from texts of digits ("456", "")."""
    flags = np.zeros((len(texts), 6), bool)
    for row, text in enumerate(texts):
        for digit in text:
            if digit in "123456":
                flags[row, int(digit) - 1] = True
    return flags


def condense(stiffness: Float64, released: Bool) -> tuple[Float64, Float64]:
    """Stiffness without the released freedoms, whose rows become zero.

    Args:
        stiffness: (e, n, n).
        released: (e, n).

    Returns:
        The new stiffness, and (e, n, n) how all freedoms follow those that stay
        (Guyan), which carries a coupled mass along: followᵀ m follow.
    """
    k, size = stiffness.copy(), stiffness.shape[1]
    total = np.tile(np.eye(size), (len(stiffness), 1, 1))
    whole = np.einsum("eii->ei", stiffness)
    for i in np.flatnonzero(released.any(axis=0)):
        at = np.flatnonzero(released[:, i])
        pivot = k[at, i, i]
        # A mechanism (a bar released in torsion at both ends) leaves rounding only.
        stiff = pivot > 1e-12 * whole[at, i]
        row = np.where(stiff[:, None], k[at, i, :], 0.0)
        ratio = row / np.where(stiff, pivot, 1.0)[:, None]
        k[at] -= row[:, :, None] * ratio[:, None, :]
        k[at, i, :] = 0.0
        k[at, :, i] = 0.0
        follow = np.tile(np.eye(size), (len(at), 1, 1))
        follow[:, i, :] = -ratio
        follow[:, i, i] = 0.0
        total[at] = total[at] @ follow
    return k, total

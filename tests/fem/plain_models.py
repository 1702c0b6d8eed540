"""Small matrices that tests of the solutions share; no deck, no elements."""

import numpy as np
import scipy.sparse as sp


def beam(elements: int, *, clamped: bool, length: float = 1.0):
    """Plane Euler-Bernoulli beam with EI = 1, mass 1 per length: K, coupled M.

    Freedoms: deflection and slope of each node; the first node's are removed where it
    is clamped.
    """
    h = length / elements
    k = np.array(
        [
            [12, 6 * h, -12, 6 * h],
            [6 * h, 4 * h * h, -6 * h, 2 * h * h],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, 2 * h * h, -6 * h, 4 * h * h],
        ]
    )
    m = np.array(
        [
            [156, 22 * h, 54, -13 * h],
            [22 * h, 4 * h * h, 13 * h, -3 * h * h],
            [54, 13 * h, 156, -22 * h],
            [-13 * h, -3 * h * h, -22 * h, 4 * h * h],
        ]
    )
    size = 2 * (elements + 1)
    stiffness, mass = sp.lil_matrix((size, size)), sp.lil_matrix((size, size))
    for e in range(elements):
        rows = slice(2 * e, 2 * e + 4)
        stiffness[rows, rows] += k / h**3
        mass[rows, rows] += m * h / 420
    start = 2 if clamped else 0
    keep = slice(start, None)
    return sp.csr_matrix(stiffness[keep, keep]), sp.csr_matrix(mass[keep, keep])


def rigid_beam(elements: int, *, length: float = 1.0):
    """(n, 2) translation and rotation about the first node of the free beam."""
    x = np.linspace(0.0, length, elements + 1)
    motions = np.zeros((2 * (elements + 1), 2))
    motions[::2, 0] = 1.0
    motions[::2, 1] = x
    motions[1::2, 1] = 1.0
    return motions

"""Exact step of modal equations q'' + C q' + Λ q = f under loads linear in time.

The matrix exponential of the state augmented by the load and its slope (C. F. Van Loan,
"Computing integrals involving the matrix exponential", IEEE Trans. Automatic Control
23, 1978).
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from fem.arrays import Float64


@dataclass(frozen=True)
class Propagator:
    """x(n+1) = E x(n) + F f(n) + H f(n+1) for x = [q, q'] and loads f in modes.

    Diagonal damping: 2 x 2 matrices per mode (m, 2, 2); else full (2m, 2m).
    """

    e: Float64
    f: Float64
    h: Float64

    def step(self, x: Float64, f0: Float64, f1: Float64) -> Float64:
        """Next state; x (c, 2, m), loads (c, m)."""
        if self.e.ndim == 3:
            return (
                np.einsum("mij,cjm->cim", self.e, x)
                + np.einsum("mi,cm->cim", self.f, f0)
                + np.einsum("mi,cm->cim", self.h, f1)
            )
        c, _, m = x.shape
        flat = x.reshape(c, 2 * m) @ self.e.T + f0 @ self.f.T + f1 @ self.h.T
        return flat.reshape(c, 2, m)


def propagator_of(stiffness: Float64, damping: Float64, h: float) -> Propagator:
    """Propagator over one step with loads that vary linearly.

    Args:
        stiffness: (m,) Λ.
        damping: (m, m) C; diagonal: modes go each on their own.
        h: step, s.
    """
    m = len(stiffness)
    if np.count_nonzero(damping - np.diag(np.diag(damping))) == 0:
        a = np.zeros((m, 4, 4))
        a[:, 0, 1] = 1.0
        a[:, 1, 0], a[:, 1, 1] = -stiffness, -np.diag(damping)
        # Augmented by load and its slope: x' = A x + b f, f' = s, s' = 0.
        a[:, 1, 2] = 1.0
        a[:, 2, 3] = 1.0 / h
        e = scipy.linalg.expm(a * h)
        level, slope = e[:, :2, 2], e[:, :2, 3]
        return Propagator(e[:, :2, :2], level - slope, slope)
    a = np.zeros((4 * m, 4 * m))
    one = np.eye(m)
    a[:m, m : 2 * m] = one
    a[m : 2 * m, :m], a[m : 2 * m, m : 2 * m] = -np.diag(stiffness), -damping
    a[m : 2 * m, 2 * m : 3 * m] = one
    a[2 * m : 3 * m, 3 * m :] = one / h
    e = scipy.linalg.expm(a * h)[: 2 * m]
    level, slope = e[:, 2 * m : 3 * m], e[:, 3 * m :]
    return Propagator(e[:, : 2 * m], level - slope, slope)

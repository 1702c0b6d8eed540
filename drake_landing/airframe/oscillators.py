"""Oscillators at rest under forces that are linear between samples, each on its own."""

import numpy as np
import numpy.typing as npt
from scipy.signal import lfilter

from fem.response.propagator import propagator_of

Float64 = npt.NDArray[np.float64]


def modal_accelerations(
    frequency_hz: Float64, damping: Float64, force: Float64, step: float
) -> Float64:
    """Accelerations of modes at rest under forces that are linear between samples.

    Args:
        frequency_hz, damping: (n,) Hz and 1/s.
        force: (t, n) modal forces per modal mass.
        step: s between samples.

    Returns:
        (t, n).
    """
    omega2 = (2.0 * np.pi * frequency_hz) ** 2
    exact = propagator_of(omega2, np.diag(damping), step)
    a = exact.e
    trace = a[:, 0, 0] + a[:, 1, 1]
    determinant = a[:, 0, 0] * a[:, 1, 1] - a[:, 0, 1] * a[:, 1, 0]
    result = force.copy()
    for i in range(len(omega2)):
        # x(k+1) = A x(k) + g(k), as a scalar recurrence of both components.
        g = np.outer(force[:-1, i], exact.f[i]) + np.outer(force[1:, i], exact.h[i])
        g[1:] += g[:-1] @ (a[i] - trace[i] * np.eye(2)).T
        poles = [1.0, -trace[i], determinant[i]]
        x = np.asarray(lfilter([1.0], poles, g, axis=0))
        result[1:, i] -= omega2[i] * x[:, 0] + damping[i] * x[:, 1]
    return result

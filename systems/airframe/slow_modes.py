"""Fast modes made slower, where only their flexibility matters.

An explicit integrator's step is bounded by the fastest mode: by its frequency, and with
damping proportional to stiffness far more by its damping, whose rate grows with the
square of the frequency. Modes of many hundred hertz, such as the static shapes of a
Craig-Bampton basis contribute, follow a landing quasi-statically. What they do then is
told by their stiffness and damping, not by their mass. So their mass is raised until
their frequency is at a bound (mass scaling).

For a load at the frequency f a mode yields 1/(1 - (f/f_i)²) of its static deflection;
with the bound in place of f_i the error is below (f/bound)² of its share.
"""

from dataclasses import replace

import numpy as np

from systems.airframe.modal_body import ModalBody


def with_slow_modes(body: ModalBody, highest_hz: float) -> ModalBody:
    """The body with no mode above a frequency.

    Shapes, modal stiffness and damping stay; the mass of the faster modes grows.

    Args:
        body: the modal body.
        highest_hz: bound, Hz.

    Raises:
        ValueError: the bound is not positive.
    """
    if not highest_hz > 0:
        raise ValueError(f"slow modes: highest_hz is {highest_hz} Hz, expected > 0")
    frequency = np.minimum(body.frequency, highest_hz)
    mass = body.modal_mass * (body.frequency / frequency) ** 2
    return replace(body, frequency=frequency, modal_mass=mass)


def fastest_rate(body: ModalBody) -> float:
    """Fastest rate of any mode, 1/s: an explicit step is to be a few of its inverse.

    The larger of angular frequency and, for an overdamped mode, its fast decay.
    """
    omega = 2.0 * np.pi * body.frequency
    half = 0.5 * np.diag(body.modal_damping) / body.modal_mass
    over = np.sqrt(np.maximum(half**2 - omega**2, 0.0))
    return float(np.max(np.where(half > omega, half + over, omega), initial=0.0))

"""A landing whose steps collapse: seen after a stated number, said with its cause."""

import numpy as np
from pydrake.systems.framework import Context

from drake_landing.landing.diagram import LandingDiagram

STEPS = 20_000  # of the integrator
LEAST = 1e-4  # s that these must cover: 5 ns a step; stiff landings take 1 us


class StallWatch:
    """Counts steps.

    Args:
        landing: that is simulated.
    """

    def __init__(self, landing: LandingDiagram) -> None:
        self._landing = landing
        self._count = 0
        self._since = 0.0

    def step(self, root: Context) -> None:
        """Counts a step of the landing.

        Raises:
            RuntimeError: `STEPS` steps took the landing less than `LEAST` further.
        """
        self._count += 1
        if self._count < STEPS:
            return
        now = root.get_time()
        if now - self._since < LEAST:
            raise RuntimeError(
                f"{STEPS} steps took it {now - self._since:.1e} s further, expected "
                f"{LEAST:g} s or more; {stiffest(self._landing, root)}"
            )
        self._count, self._since = 0, now


def stiffest(landing: LandingDiagram, root: Context) -> str:
    """The system that changes fastest, and the gear that is damped hardest."""
    fastest, largest = "", -1.0
    for system in landing.diagram.GetSystems():
        if system.num_continuous_states():
            own = system.GetMyContextFromRoot(root)
            change = system.EvalTimeDerivatives(own).CopyToVector()
            size = float(np.abs(change).max(initial=0.0))
            if size > largest:
                fastest, largest = system.get_name(), size
    gear, states = _hardest(landing, root)
    strut = f"gear {gear}: {states}" if gear else "no gear moves"
    return f"fastest is {fastest} ({largest:.1e} 1/s); {strut}"


def _hardest(landing: LandingDiagram, root: Context) -> tuple[str, str]:
    found = ("", "")
    most = -1.0
    for name, absorber in landing.shock_absorbers.items():
        stroke, rate = absorber.motion(root)
        force = float(absorber.force(root))
        if abs(force) / max(abs(rate), 1e-12) > most and rate != 0.0:
            most = abs(force) / max(abs(rate), 1e-12)
            words = f"stroke {stroke:.2e} m, rate {rate:.2e} m/s, force {force:.2e} N"
            found = (name, words)
    return found

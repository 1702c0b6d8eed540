"""Drake's integration schemes that landings are run with."""

from typing import Literal

Integrator = Literal["runge_kutta3", "runge_kutta5", "bogacki_shampine3", "radau3"]
# The fastest for a given error: docs/accuracy.md.
DEFAULT: Integrator = "runge_kutta3"
# Its steps are not bounded by the fastest mode.
IMPLICIT: Integrator = "radau3"

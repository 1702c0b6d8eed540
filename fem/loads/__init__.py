"""Loads: static load vectors, and dynamic excitation with its time steps."""

from fem.loads.dynamic import (
    Excitation,
    dynamic_excitation,
    initial_conditions,
    table_notices,
    time_steps,
)
from fem.loads.enforced_motion import EnforcedMotion, dynamic_motions
from fem.loads.nonlinear import nonlinear_load
from fem.loads.static import (
    enforced_displacements,
    static_element_loads,
    static_load,
)

__all__ = [
    "EnforcedMotion",
    "Excitation",
    "dynamic_excitation",
    "dynamic_motions",
    "enforced_displacements",
    "initial_conditions",
    "nonlinear_load",
    "static_element_loads",
    "static_load",
    "table_notices",
    "time_steps",
]

"""Loads: static load vectors, and dynamic excitation with its time steps."""

from fem.loads.dynamic import (
    Excitation,
    dynamic_excitation,
    initial_conditions,
    table_notices,
    time_steps,
)
from fem.loads.static import (
    enforced_displacements,
    static_element_loads,
    static_load,
)

__all__ = [
    "Excitation",
    "dynamic_excitation",
    "enforced_displacements",
    "initial_conditions",
    "static_element_loads",
    "static_load",
    "table_notices",
    "time_steps",
]

"""A multibody plant at the state on a port, for systems that ask it for kinematics."""

from types import MethodType
from typing import Any

from pydrake.common.value import Value
from pydrake.systems.framework import ValueProducer

from systems.tools.weak_methods import weakly


def declare_plant_context(system: Any, plant: Any) -> Any:
    """Declares a cache entry whose value is a context of the plant at its state.

    Args:
        system: a LeafSystem, with the input port of the plant's positions and
            velocities (m, rad, m/s, rad/s) as `_state`.
        plant: MultibodyPlant of the system's scalar, finalized.

    Returns:
        The cache entry; `Eval(context)` of it is the plant's context.
    """

    def allocate(_: Any) -> Value:
        return Value(plant.CreateDefaultContext())

    def calc(owner: Any, context: Any, value: Any) -> None:
        state = owner._state.Eval(context)
        plant.SetPositionsAndVelocities(value.get_mutable_value(), state)

    return system.DeclareCacheEntry(
        "plant_context",
        ValueProducer(
            allocate=weakly(MethodType(allocate, system)),
            calc=weakly(MethodType(calc, system)),
        ),
        {system._state.ticket()},
    )

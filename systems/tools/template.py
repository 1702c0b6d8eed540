"""Systems for several scalars that say what their constructor takes."""

import inspect
from typing import Any

from pydrake.systems.scalar_conversion import TemplateSystem

# The object itself, and what Drake passes on when it converts scalars.
_NOT_GIVEN_BY_USERS = {"self", "converter"}


def default_instantiation(template: TemplateSystem) -> Any:
    """The system for floats, `template[None]`, with the signature of its constructor.

    Drake constructs templated systems through an `__init__(*args, **kwargs)` of its
    own, behind which `help()` and consoles would not see what `_construct` takes.
    Type checkers see Any: the class depends on the scalar.
    """
    system: Any = template[None]
    parameters = inspect.signature(system._construct).parameters
    given = [p for name, p in parameters.items() if name not in _NOT_GIVEN_BY_USERS]
    system.__signature__ = inspect.Signature(given)
    system.__init__.__signature__ = inspect.Signature([parameters["self"], *given])
    return system

"""Systems for several scalars: made in little time, and named as a reader expects."""

import inspect
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from pydrake.autodiffutils import AutoDiffXd
from pydrake.common import cpp_template
from pydrake.systems.scalar_conversion import TemplateSystem

# The object itself, and what Drake passes on when it converts scalars.
_NOT_GIVEN_BY_USERS = {"self", "converter"}


def for_scalars(instantiation: Callable[[Any], type]) -> TemplateSystem:
    """Decorator: a function of the scalar that returns a system is a Drake template.

    For float and AutoDiffXd; the template has the name of the function, `Tire_`.
    """
    scope = sys.modules[instantiation.__module__]
    scalars = (float, AutoDiffXd)
    define = TemplateSystem.define(instantiation.__name__, T_list=scalars, scope=scope)
    return define(instantiation)


def default_instantiation(template: TemplateSystem) -> Any:
    """The system for floats, `template[None]`, as a class that `help()` can show.

    It has the plain name, `Tire` of `Tire_`, as Drake's own have, and the signature of
    its constructor: Drake constructs templated systems through an
    `__init__(*args, **kwargs)` of its own, behind which consoles would not see what
    `_construct` takes. Type checkers see Any: the class depends on the scalar.
    """
    with _modules_found_quickly():
        system: Any = template[None]
    system.__name__ = system.__qualname__ = template.name.removesuffix("_")
    parameters = inspect.signature(system._construct).parameters
    given = [p for name, p in parameters.items() if name not in _NOT_GIVEN_BY_USERS]
    system.__signature__ = inspect.Signature(given)
    system.__init__.__signature__ = inspect.Signature([parameters["self"], *given])
    return system


@contextmanager
def _modules_found_quickly() -> Iterator[None]:
    """Drake looks up its own module by `inspect.stack`, which reads every source.

    0.1 s for each of the two methods of a system: 3 s of processor time before any
    command does something.
    """
    name = "_get_module_from_stack"
    slow = getattr(cpp_template, name, None)
    if slow is None:
        yield
        return
    setattr(cpp_template, name, _module_from_stack)
    try:
        yield
    finally:
        setattr(cpp_template, name, slow)


def _module_from_stack(frame: int = 2) -> ModuleType:
    """The module of the code `frame` calls above this function."""
    return sys.modules[sys._getframe(frame).f_globals["__name__"]]

"""Methods for Drake to call that do not keep their system alive.

A system of Drake holds the functions that compute its ports and cache entries; where
these are its own methods, it would hold itself, out of sight of Python's collector.
"""

import weakref
from collections.abc import Callable
from types import MethodType
from typing import Any


def weakly(method: Callable[..., Any]) -> Callable[..., Any]:
    """A bound method as a function that refers to its object weakly.

    Args:
        method: of a system, which must live as long as the function is called: Drake
            calls it for systems that are there.
    """
    assert isinstance(method, MethodType)
    owner, function = weakref.ref(method.__self__), method.__func__
    return lambda *arguments: function(owner(), *arguments)

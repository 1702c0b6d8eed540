"""Compilation of small numerical functions to machine code.

For functions of a few microseconds that a simulation calls ten thousand times: scalar
arithmetic and short loops, where numpy spends most of its time on the call itself.
Plain Python remains the language; `function.py_func` is the function uncompiled.

The machine code is kept beside the module (or in the user's cache folder), and renewed
when the module's file changes, or `vectors`: a compiled function calls only compiled
functions of its own module and of that one.
"""

import hashlib
from collections.abc import Callable
from pathlib import Path
from typing import ParamSpec, TypeVar, cast

from numba import njit

P = ParamSpec("P")
R = TypeVar("R")

_VOCABULARY = Path(__file__).with_name("vectors.py").read_bytes()
_EDITION = hashlib.sha256(_VOCABULARY).hexdigest()[:8]

# Sums may be reordered, which lets loops use vector instructions; nothing is assumed
# of infinities, NaN or signed zeros.
_OPTIONS = {"fastmath": {"reassoc", "contract", "nsz"}, "error_model": "numpy"}


def compiled_before() -> bool:
    """Whether machine code is kept beside the modules; else the first calls compile."""
    return any(Path(__file__).with_name("__pycache__").glob("*.nbi"))


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """The function, compiled at its first call."""
    # Numba files the machine code under this name.
    function.__qualname__ += f"_{_EDITION}"
    try:
        fast = njit(cache=True, **_OPTIONS)(function)
    except RuntimeError:  # no folder that could be written to
        fast = njit(**_OPTIONS)(function)
    return cast(Callable[P, R], fast)

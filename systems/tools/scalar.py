"""Elementary functions that take a float or an AutoDiffXd.

The laws of this room are written once for both. Floats go straight to `math`, which is
many times faster than the overloads of pydrake. Compiled laws (`compiled.compiled_law`)
may call them, too (`numba_overloads`).
"""

import math
from functools import cache
from types import ModuleType
from typing import Any

# A float, or a pydrake.autodiffutils.AutoDiffXd.
Scalar = Any


@cache
def _drake() -> ModuleType:
    """pydrake.math; imported late, for schema and help do without Drake."""
    import pydrake.math

    return pydrake.math


def sin(x: Scalar) -> Scalar:
    return math.sin(x) if type(x) is float else _drake().sin(x)


def cos(x: Scalar) -> Scalar:
    return math.cos(x) if type(x) is float else _drake().cos(x)


def atan(x: Scalar) -> Scalar:
    return math.atan(x) if type(x) is float else _drake().atan(x)


def log(x: Scalar) -> Scalar:
    return math.log(x) if type(x) is float else _drake().log(x)


def sqrt(x: Scalar) -> Scalar:
    return math.sqrt(x) if type(x) is float else _drake().sqrt(x)


def power(x: Scalar, n: Scalar) -> Scalar:
    """x to the power n, x > 0 where either is an AutoDiffXd."""
    if type(x) is float and type(n) is float:
        return x**n
    return _drake().exp(n * _drake().log(x))


def exp(x: Scalar) -> Scalar:
    return math.exp(x) if type(x) is float else _drake().exp(x)

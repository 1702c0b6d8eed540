"""Elementary functions that take a float or an AutoDiffXd.

The laws of this room are written once for both. Floats go straight to `math`, which is
many times faster than the overloads of pydrake.
"""

import math
from typing import Any

import pydrake.math as drake_math

# A float, or a pydrake.autodiffutils.AutoDiffXd.
Scalar = Any


def sin(x: Scalar) -> Scalar:
    return math.sin(x) if type(x) is float else drake_math.sin(x)


def cos(x: Scalar) -> Scalar:
    return math.cos(x) if type(x) is float else drake_math.cos(x)


def atan(x: Scalar) -> Scalar:
    return math.atan(x) if type(x) is float else drake_math.atan(x)


def log(x: Scalar) -> Scalar:
    return math.log(x) if type(x) is float else drake_math.log(x)


def sqrt(x: Scalar) -> Scalar:
    return math.sqrt(x) if type(x) is float else drake_math.sqrt(x)


def power(x: Scalar, n: Scalar) -> Scalar:
    """x to the power n, x > 0 where either is an AutoDiffXd."""
    if type(x) is float and type(n) is float:
        return x**n
    return drake_math.exp(n * drake_math.log(x))


def exp(x: Scalar) -> Scalar:
    return math.exp(x) if type(x) is float else drake_math.exp(x)

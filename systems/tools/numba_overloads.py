"""What compiled laws call in place of functions of `scalar`, `table` and `grid`.

Apart from these, for whoever needs no compiled law need not load numba.
"""

import math

from numba.extending import overload, register_jitable

from systems.tools import scalar
from systems.tools.grid import interpolated, place
from systems.tools.table import look_up

register_jitable(place)


@overload(scalar.sin)
def _sin(x):
    return lambda x: math.sin(x)


@overload(scalar.cos)
def _cos(x):
    return lambda x: math.cos(x)


@overload(scalar.atan)
def _atan(x):
    return lambda x: math.atan(x)


@overload(scalar.log)
def _log(x):
    return lambda x: math.log(x)


@overload(scalar.sqrt)
def _sqrt(x):
    return lambda x: math.sqrt(x)


@overload(scalar.power)
def _power(x, n):
    return lambda x, n: x**n


@overload(scalar.exp)
def _exp(x):
    return lambda x: math.exp(x)


@overload(look_up)
def _look_up(table, x):
    def compiled(table, x):
        if x < table[0, 0]:
            return table[1, 0]
        low, high = 0, table.shape[1]
        while high - low > 1:
            middle = (low + high) // 2
            if table[0, middle] <= x:
                low = middle
            else:
                high = middle
        return table[1, low] + table[2, low] * (x - table[0, low])

    return compiled


@overload(interpolated)
def _interpolated(grid, x, y):
    def compiled(grid, x, y):
        z = grid[2]
        i, u = place(grid[0], x)
        j, v = place(grid[1], y)
        return (1.0 - u) * ((1.0 - v) * z[i, j] + v * z[i, j + 1]) + u * (
            (1.0 - v) * z[i + 1, j] + v * z[i + 1, j + 1]
        )

    return compiled

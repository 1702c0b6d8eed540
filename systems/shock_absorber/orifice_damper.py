"""Oil through an orifice: F = sgn(s') d s'².

d is one value for compression and one for rebound, in N s²/m², either multiplied by a
table over stroke (a metering pin), or over stroke and rate (valves).
"""

from numba import types
from numba.extending import overload

from systems.tools.compiled import law
from systems.tools.grid import Grid, interpolated
from systems.tools.scalar import Scalar, sqrt
from systems.tools.table import Table, look_up

Metering = Table | Grid | None
# Rate within which the flow through an orifice is laminar, m/s; where the oil is
# compressible alone, whose rate would else be infinite at no pressure.
_LAMINAR = 0.1


def coefficient(s: Scalar, speed: Scalar, d: Scalar, metering: Metering) -> Scalar:
    """Damping at stroke s (m) and magnitude of the rate (m/s), N s²/m²."""
    if metering is None:
        return d
    if isinstance(metering, Grid):
        return d * metering.value(s, speed)
    return d * metering.value(s)


@overload(coefficient)
def _coefficient(s, speed, d, metering):
    if isinstance(metering, types.NoneType):
        return lambda s, speed, d, metering: d
    if isinstance(metering, types.Array):
        return lambda s, speed, d, metering: d * look_up(metering, s)
    return lambda s, speed, d, metering: d * interpolated(metering, s, speed)


def arrays(metering: Metering) -> object:
    """What stands for a table in compiled laws."""
    return metering and (metering.axes if isinstance(metering, Grid) else metering.rows)


def varies_with_rate(metering: Metering) -> bool:
    """Whether the coefficient depends on the rate."""
    return isinstance(metering, Grid)


@overload(varies_with_rate)
def _varies_with_rate(metering):
    found = isinstance(metering, types.BaseTuple)
    return lambda metering: found


@law
def orifice_force(
    s: Scalar,
    rate: Scalar,
    compression: Scalar,
    rebound: Scalar,
    compression_metering: Metering = None,
    rebound_metering: Metering = None,
) -> Scalar:
    """Damping force against compression, N; positive in compression.

    Args:
        s: m, stroke.
        rate: m/s, stroke rate, positive in compression.
        compression, rebound: N s²/m².
        compression_metering, rebound_metering: factors over stroke, or over stroke
            and magnitude of the rate.
    """
    if rate >= 0.0:
        return coefficient(s, rate, compression, compression_metering) * rate * rate
    return -coefficient(s, -rate, rebound, rebound_metering) * rate * rate


@law
def orifice_rate(
    s: Scalar,
    force: Scalar,
    compression: Scalar,
    rebound: Scalar,
    compression_metering: Metering = None,
    rebound_metering: Metering = None,
) -> Scalar:
    """Rate at which a force (N) drives the oil, m/s: the inverse of d q √(q² + v_0²),
    which is `orifice_force` but for the slowest rates.
    """
    if force >= 0.0:
        return _flow(s, force, compression, compression_metering)
    return -_flow(s, -force, rebound, rebound_metering)


@law
def _flow(s: Scalar, size: Scalar, d: Scalar, metering: Metering) -> Scalar:
    if not varies_with_rate(metering):
        return _rate(size, coefficient(s, 0.0, d, metering))
    low, high = 0.0, 20.0
    for _ in range(50):
        q = 0.5 * (low + high)
        enough = q * sqrt(q * q + _LAMINAR**2) * coefficient(s, q, d, metering)
        if enough < size:
            low = q
        else:
            high = q
    return _rate(size, coefficient(s, high, d, metering))


@law
def _rate(force: Scalar, d: Scalar) -> Scalar:
    if not d > 0.0:
        raise ValueError("oil spring: an orifice without damping, expected > 0 N s²/m²")
    square, laminar = force / d, _LAMINAR**2
    root = sqrt(laminar * laminar + 4.0 * square * square)
    # Without the difference of two large numbers.
    return square * sqrt(2.0 / (laminar + root))

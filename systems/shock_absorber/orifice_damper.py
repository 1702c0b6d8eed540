"""Oil through an orifice: F = sgn(s') d s'².

d is one value for compression and one for rebound, in N s²/m², either multiplied by a
table over stroke (a metering pin).
"""

from systems.tools.scalar import Scalar
from systems.tools.table import Table


def orifice_force(
    s: Scalar,
    rate: Scalar,
    compression: Scalar,
    rebound: Scalar,
    compression_metering: Table | None = None,
    rebound_metering: Table | None = None,
) -> Scalar:
    """Damping force against compression, N; positive in compression.

    Args:
        s: m, stroke.
        rate: m/s, stroke rate, positive in compression.
        compression, rebound: N s²/m².
        compression_metering, rebound_metering: factors over stroke.
    """
    if rate >= 0.0:
        d = compression
        if compression_metering is not None:
            d = d * compression_metering.value(s)
        return d * rate * rate
    d = rebound
    if rebound_metering is not None:
        d = d * rebound_metering.value(s)
    return -d * rate * rate

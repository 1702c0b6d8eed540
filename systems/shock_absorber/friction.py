"""Dry friction of a strut: seals, and bearings against which a side load presses."""

from systems.tools.compiled import law
from systems.tools.scalar import Scalar, sqrt


@law
def coulomb_force(rate: Scalar, limit: Scalar, transition: float) -> Scalar:
    """Dry friction `limit` (N) against `rate`, smooth within `transition` (m/s).

    v/√(v² + v_0²) in place of the sign: 0.995 of the limit at ten times v_0.
    """
    return limit * rate / sqrt(rate * rate + transition * transition)


@law
def bearing_reactions(
    side_load: Scalar,
    s: Scalar,
    axle_arm: float,
    bearing_distance: float,
    moment: tuple[Scalar, Scalar] = (0.0, 0.0),
) -> Scalar:
    """Sum of both bearing reactions of a piston bent by a side load at the axle, N.

    The lower bearing sits in the cylinder, the upper one on the piston: with stroke
    the arm shortens and the bearings move apart.

    Args:
        side_load: N, load across the strut at the axle.
        s: m, stroke.
        axle_arm: m, axle below the lower bearing at full extension.
        bearing_distance: m, between the bearings at full extension.
        moment: N m, at the axle: bending with the side load, and across that.
    """
    force, apart = abs(side_load), bearing_distance + s
    arm = axle_arm - s
    upper = ((arm if arm > 0.0 else 0.0) * force + moment[0]) / apart
    across = moment[1] / apart
    return _length(upper, across) + _length(force + upper, across)


@law
def _length(x: Scalar, y: Scalar) -> Scalar:
    return abs(x) if y == 0.0 else sqrt(x * x + y * y)

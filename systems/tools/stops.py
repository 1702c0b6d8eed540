"""One-sided contact: a spring that only pushes, with damping that never pulls.

Hunt and Crossley's form: N = k δ (1 + χ δ'), not less than zero. It is continuous at
first contact, and what the damping takes is never negative:

    elastic k δ, energy k δ²/2; damping max(k δ χ δ', -k δ), its power × δ'.
"""

from systems.tools.compiled import law
from systems.tools.scalar import Scalar


@law
def contact_elastic(deflection: Scalar, stiffness: Scalar) -> Scalar:
    """k δ for δ > 0, else zero, N."""
    return stiffness * deflection if deflection > 0.0 else 0.0


@law
def contact_energy(deflection: Scalar, stiffness: Scalar) -> Scalar:
    """k δ²/2 for δ > 0, else zero, J."""
    return 0.5 * stiffness * deflection * deflection if deflection > 0.0 else 0.0


@law
def never_pulling(elastic: Scalar, damping: Scalar) -> Scalar:
    """The damping part, cut so that elastic + damping >= 0, N."""
    return damping if damping > -elastic else -elastic

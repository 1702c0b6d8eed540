"""Forces of slip on a tire: what a law of them gives.

A law is chosen once, by `tire_law.TireLaw`: a friction curve (`curve_law`) or the Magic
Formula (`magic_formula`). Another law is a module of its own with these three methods.
A law that is compiled is a NamedTuple of numbers and tables, and its module says what
`relaxation_share` and `wheel_forces` are when compiled; one that is not has no
`compiled_form`. Directions t and l are those of `tire_law`; slip along either is the
sliding velocity over the speed of travel.
"""

from typing import Protocol

from systems.tools.scalar import Scalar


class SlipLaw(Protocol):
    """Force in the plane of the ground over slip; floats or AutoDiffXd throughout."""

    @property
    def compiled_form(self) -> tuple | None:
        """What stands for the law in compiled laws; None: it is not compiled."""
        ...

    def slopes(self, load: float, deflection: float) -> tuple[float, float]:
        """Force per slip at small slip, along and across the wheel at rest, N.

        Args:
            load: N, along the surface normal.
            deflection: m.
        """
        ...

    def relaxation_share(self, k_t: Scalar, k_l: Scalar, deflection: Scalar) -> Scalar:
        """Relaxation length at slips along t and l over that at small slip."""
        ...

    def wheel_forces(
        self,
        k_t: Scalar,
        k_l: Scalar,
        travel: Scalar,
        deflection: Scalar,
        load: Scalar,
        factor: Scalar,
        tilt: Scalar,
    ) -> tuple[Scalar, Scalar, Scalar]:
        """Force along t and l (N), moment about the normal (N m).

        Args:
            k_t, k_l: slips along t and l that act.
            travel: speed along t, m/s.
            deflection: m.
            load: N, along the surface normal.
            factor: on the friction.
            tilt: cosine of the angle between axle and surface normal.
        """
        ...


def relaxation_share(
    law: SlipLaw, k_t: Scalar, k_l: Scalar, deflection: Scalar
) -> Scalar:
    """`SlipLaw.relaxation_share` as a function that compiled laws may call."""
    return law.relaxation_share(k_t, k_l, deflection)


def wheel_forces(
    law: SlipLaw,
    k_t: Scalar,
    k_l: Scalar,
    travel: Scalar,
    deflection: Scalar,
    load: Scalar,
    factor: Scalar,
    tilt: Scalar,
) -> tuple[Scalar, Scalar, Scalar]:
    """`SlipLaw.wheel_forces` as a function that compiled laws may call."""
    return law.wheel_forces(k_t, k_l, travel, deflection, load, factor, tilt)

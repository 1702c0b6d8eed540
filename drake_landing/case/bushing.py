"""Elastic fittings: springs between gears and airframe that the deck does not have."""

from drake_landing.case.section import Section, number


class Bushing(Section):
    """Springs and dampers between every attachment node and its fitting, isotropic.

    Directions of further attachments that have a stiffness of their own keep it. The
    default, none, holds gears without any play, in a fraction of the steps.
    """

    translational_stiffness: float = number(
        "against displacement of the fitting", "N/m", gt=0, le=1e12
    )
    rotational_stiffness: float = number(
        "against its rotation", "N m/rad", gt=0, le=1e12
    )
    translational_damping: float = number("beside it", "N s/m", 0.0, ge=0)
    rotational_damping: float = number("beside it", "N m s/rad", 0.0, ge=0)

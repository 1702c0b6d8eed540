"""Mass, center of gravity and inertia of the aircraft with its gears, extended."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from drake_landing.case.axes import gear_in_A
from drake_landing.gears.bodies import wheel_centers
from drake_landing.gears.landing_gear import LandingGear
from fem.arrays import Float64

if TYPE_CHECKING:
    from drake_landing.airframe.body import AirframeModel


@dataclass(frozen=True, kw_only=True)
class WholeMass:
    """Mass properties of airframe and gears together.

    Attributes:
        mass: kg.
        cg: (3,) m, axes B of the deck, from its origin.
        inertia: (3, 3) kg m² about the center of gravity, axes B: off-diagonal terms
            are - ∫ x y dm.
    """

    mass: float
    cg: Float64
    inertia: Float64


def whole_mass(airframe: "AirframeModel", gears: tuple[LandingGear, ...]) -> WholeMass:
    """Sum of the airframe and the rigid parts of its gears (Steiner).

    Args:
        airframe: of the run.
        gears: in B. What the steering turns counts as if it stood straight.
    """
    body, R_AB = airframe.body, airframe.R_AB
    parts = [(body.mass, np.asarray(body.p_BG), np.asarray(body.inertia_G))]
    for gear in gears:
        parts += _parts(gear_in_A(gear, R_AB))
    mass = sum(m for m, _, _ in parts)
    center = sum((m * p for m, p, _ in parts), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for m, p, own in parts:
        r = p - center
        inertia += own + m * (r @ r * np.eye(3) - np.outer(r, r))
    return WholeMass(mass=mass, cg=R_AB.T @ center, inertia=R_AB.T @ inertia @ R_AB)


def _parts(gear: LandingGear) -> Iterator[tuple[float, Float64, Float64]]:
    """Mass, place and inertia of each rigid part, axes A."""
    for part in (gear.sprung_parts | gear.moving_parts).values():
        yield part.mass, np.array(part.cg), np.diag(part.inertia)
    wheel = gear.wheel
    across = wheel.transverse
    for place in wheel_centers(gear).values():
        yield wheel.mass, place, np.diag([across, wheel.spin_inertia, across])

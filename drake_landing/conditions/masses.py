"""Rigid masses: put together, and what they resist an acceleration with."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64


@dataclass(frozen=True, kw_only=True, eq=False)
class RigidMass:
    """Mass properties of a rigid body; all in one frame.

    Attributes:
        mass: kg.
        center: (3,) center of gravity, m.
        inertia: (3, 3) tensor about it, products of inertia negative, kg m².
    """

    mass: float
    center: Float64
    inertia: Float64

    @property
    def radii(self) -> Float64:
        """(3,) of gyration about the center of gravity, m."""
        return np.sqrt(np.diag(self.inertia) / self.mass)

    def inertia_load(self, acceleration: Float64, about: Float64) -> Float64:
        """(6,) force and moment about a point that accelerate it, N and N m.

        Args:
            acceleration: (6,) linear at `about`, and angular; no rates.
            about: (3,) m.
        """
        arm = self.center - about
        linear, angular = acceleration[:3], acceleration[3:]
        force = self.mass * (linear + np.cross(angular, arm))
        return np.r_[force, np.cross(arm, force) + self.inertia @ angular]


def together(parts: Iterable[RigidMass]) -> RigidMass:
    """Several bodies as one."""
    parts = list(parts)
    mass = sum(part.mass for part in parts)
    center = sum(part.mass * part.center for part in parts) / mass
    inertia = np.zeros((3, 3))
    for part in parts:
        r = part.center - center
        inertia += part.inertia + part.mass * (r @ r * np.eye(3) - np.outer(r, r))
    return RigidMass(mass=mass, center=center, inertia=inertia)


def acceleration_under(whole: RigidMass, load: Float64) -> Float64:
    """(6,) of a free body under a load (6,) about its center of gravity."""
    return np.r_[load[:3] / whole.mass, np.linalg.solve(whole.inertia, load[3:])]

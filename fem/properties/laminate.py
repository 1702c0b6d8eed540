"""Classical lamination: plies to A, B, D, transverse shear, mass, and ply stresses.

Plies are stacked from the bottom (z0) along the element normal z. Axes are those of
the laminate (the element's material axes); a ply's axis 1 is turned by its angle. The
transverse shear flexibility is that of cylindrical bending in x and in y (Nastran's
PCOMP): shear stress tau(z) = Q S(z) / (E I) with S(z) = -int E (z - z_n) dz from the
bottom, flexibility = int tau^2 / G dz for Q = 1.
"""

from dataclasses import dataclass

import numpy as np

from fem.arrays import Float64
from fem.properties.shell_section import (
    strain_rotation,
    turned_flexibility,
    turned_stiffness,
)


@dataclass(frozen=True, kw_only=True)
class Laminate:
    """Plies from bottom to top, units of the deck.

    Attributes:
        z0: height of the bottom above the reference surface.
        thickness: (p,).
        angle: (p,) rad, from the laminate's x axis to the ply's axis 1.
        plane: (p, 3, 3) plane stress stiffness in ply axes.
        shear_flexibility: (p, 2, 2) transverse shear flexibility in ply axes.
        rho: (p,) density.
    """

    z0: float
    thickness: Float64
    angle: Float64
    plane: Float64
    shear_flexibility: Float64
    rho: Float64

    @property
    def interfaces(self) -> Float64:
        """(p + 1,) heights of the ply boundaries."""
        return self.z0 + np.concatenate([[0.0], np.cumsum(self.thickness)])

    @property
    def middle(self) -> Float64:
        """(p,) heights of the middles of the plies."""
        z = self.interfaces
        return 0.5 * (z[1:] + z[:-1])

    @property
    def total(self) -> float:
        """Thickness of the laminate, length of the deck."""
        return float(self.thickness.sum())

    @property
    def turned(self) -> Float64:
        """(p, 3, 3) ply stiffness in laminate axes."""
        return turned_stiffness(self.plane, self.angle)

    def stiffness(self) -> tuple[Float64, Float64, Float64]:
        """A, B, D, each (3, 3), about the reference surface."""
        z = self.interfaces
        a, b, d = (
            np.einsum("p,pij->ij", (z[1:] ** k - z[:-1] ** k) / k, self.turned)
            for k in (1, 2, 3)
        )
        # A symmetric stack leaves rounding in B, which would pass for coupling.
        b[np.abs(b) < 1e-12 * np.abs(a).max() * self.total] = 0.0
        return a, b, d

    def mass_height(self) -> float:
        """Height of the mass above the reference surface."""
        mass = self.rho * self.thickness
        if not mass.any():
            return 0.0
        height = float(mass @ self.middle / mass.sum())
        return 0.0 if abs(height) < 1e-12 * self.total else height

    def shear_profile(self) -> tuple[Float64, Float64]:
        """Shear stress per shear force, Q = 1, in laminate axes.

        Returns:
            (p + 1, 2) at the interfaces, and (p, 2, 3) coefficients c0 + c1 h + c2 h^2
            with h the height above the bottom of each ply, for x and y.
        """
        modulus = np.einsum("pii->pi", self.turned)[:, :2]
        z, t = self.interfaces, self.thickness
        axial = t @ modulus
        neutral = (t * self.middle) @ modulus / axial
        low, high = z[:-1, None] - neutral, z[1:, None] - neutral
        rigidity = np.sum(modulus * (high**3 - low**3) / 3.0, axis=0)
        step = -modulus * 0.5 * (high**2 - low**2)
        at = np.concatenate([np.zeros((1, 2)), np.cumsum(step, axis=0)]) / rigidity
        at[-1] = 0.0
        modulus = modulus / rigidity
        return at, np.stack([at[:-1], -modulus * low, -0.5 * modulus], axis=-1)

    def transverse_flexibility(self) -> Float64:
        """(2, 2) flexibility per unit of transverse shear force, laminate axes."""
        _, c = self.shear_profile()
        power = 1.0 / np.add.outer(np.arange(3), np.arange(3) + 1)
        t = self.thickness[:, None, None]
        scaled = c * self.thickness[:, None, None] ** np.arange(3)
        product = np.einsum("pia,ab,pjb->pij", scaled, power, scaled) * t
        ply = turned_flexibility(self.shear_flexibility, self.angle)
        return np.sum(product * ply, axis=0)

    def recovery(self, flexibility: Float64, *, strain: bool = False) -> Float64:
        """Ply stresses, or strains, from resultants.

        Args:
            flexibility: (6, 6) inverse of [A B; B D] in laminate axes.
            strain: strains 11 22 12 xz yz (engineering shear) instead of stresses.

        Returns:
            (p, 5, 8) from N (3), M (3), Q (2) in laminate axes to the stresses 11 22 12
            in ply axes at the middle of each ply, and the interlaminar shear xz, yz in
            laminate axes at its top, as Nastran prints them.
        """
        matrix = np.zeros((len(self.thickness), 5, 8))
        of_plane = flexibility[:3] + self.middle[:, None, None] * flexibility[3:]
        of_plane = strain_rotation(self.angle) @ of_plane
        matrix[:, :3, :6] = of_plane if strain else self.plane @ of_plane
        at, _ = self.shear_profile()
        matrix[:, 3, 6], matrix[:, 4, 7] = at[1:, 0], at[1:, 1]
        if strain:
            turned = turned_flexibility(self.shear_flexibility, self.angle)
            matrix[:, 3:, 6:] = turned @ matrix[:, 3:, 6:]
        return matrix

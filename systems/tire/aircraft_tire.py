"""Properties of an aircraft tire from its size and pressure: NASA TR R-64.

R. F. Smiley, W. B. Horne: Mechanical Properties of Pneumatic Tires with Special
Reference to Modern Aircraft Tires, NASA TR R-64 (1960; first as NACA TN 4110). Its
formulas for type VII tires, written here from memory; that their pieces meet in value
and slope confirms the numbers, not the source. Measured figures of a tire take their
place wherever they are known.

They hold for bias tires at rest or rolling slowly, up to bottoming, within about 10 to
30 %. d is the outer diameter, w the width, p the pressure, p_r the rated one, δ the
deflection; SI units, the formulas are homogeneous in pressure and length.
"""

from dataclasses import dataclass

from systems.tools.checks import require
from systems.tools.table import Table

# Of the carcass, in the vertical force: 0.08 p_r acts without any pressure.
_CARCASS = 0.08
# Beyond this deflection over diameter the cornering power is held.
_LAST = 0.15
_POINTS = 81


@dataclass(frozen=True, kw_only=True)
class TireSize:
    """Size and pressure of an aircraft tire.

    Attributes:
        diameter, width: m, outer ones of the inflated tire.
        rated_pressure: Pa.
        inflation: pressure over the rated one; 0 is a flat tire.

    Raises:
        ValueError: a value is out of range; the message names it.
    """

    diameter: float
    width: float
    rated_pressure: float
    inflation: float = 1.0

    def __post_init__(self) -> None:
        require("tire size", "diameter", self.diameter, "m", above=0.0)
        require("tire size", "width", self.width, "m", above=0.0, at_most=self.diameter)
        require("tire size", "rated_pressure", self.rated_pressure, "Pa", above=0.0)
        require("tire size", "inflation", self.inflation, "", at_least=0.0, at_most=2.0)

    @property
    def stiffness_factor(self) -> float:
        """Vertical force over that at the rated pressure, at the same deflection."""
        return inflation_factor(self.inflation)

    def vertical_force(self, deflection: float) -> float:
        """Static radial force at a deflection (m), N."""
        x, c = deflection / self.width, 0.03
        shape = 0.96 * x + 0.216 * x * x / c if x <= 10 * c / 3 else 2.4 * (x - c)
        pressure = (self.inflation + _CARCASS) * self.rated_pressure
        return pressure * self.width * (self.width * self.diameter) ** 0.5 * shape

    def deflection(self, force: float) -> float:
        """Deflection under a static radial force (N), m."""
        c = 0.03
        pressure = (self.inflation + _CARCASS) * self.rated_pressure
        y = force / (pressure * self.width * (self.width * self.diameter) ** 0.5)
        if y >= 2.4 * (10 * c / 3 - c):
            return self.width * (y / 2.4 + c)
        a, b = 0.216 / c, 0.96
        return self.width * 2.0 * y / (b + (b * b + 4.0 * a * y) ** 0.5)

    def cornering_power(self, force: float) -> float:
        """Side force per yaw angle at small angles under a vertical force, N/rad."""
        ratio = min(self.deflection(force) / self.diameter, _LAST)
        shape = 1.2 * ratio - 8.8 * ratio * ratio
        if ratio > 0.0875:
            shape = 0.0674 - 0.34 * ratio
        pressure = (self.inflation + 0.44) * self.rated_pressure
        return 63.0 * pressure * self.width**2 * shape

    def half_contact_length(self, deflection: float) -> float:
        """h of the footprint, m."""
        ratio = min(deflection / self.diameter, 0.5)
        return 0.85 * self.diameter * (ratio - ratio * ratio) ** 0.5

    def lateral_stiffness(self, deflection: float) -> float:
        """Side force over side displacement of the footprint, N/m."""
        pressure = (self.inflation + 0.24) * self.rated_pressure
        lost = min(0.7 * deflection / self.width, 0.7)
        return 3.0 * self.width * pressure * (1.0 - lost)

    def fore_aft_stiffness(self, deflection: float) -> float:
        """Drag over fore-and-aft displacement of the footprint, N/m; the weakest of
        the formulas: its factor is between 0.6 and 0.8.
        """
        pressure = (self.inflation + 4.0) * self.rated_pressure
        share = (max(deflection, 0.0) / self.diameter) ** (1.0 / 3.0)
        return 0.7 * self.diameter * pressure * share

    def over_deflection(self, law) -> Table:
        """Table of one of the laws above over deflections up to half the radius."""
        last = 0.25 * self.diameter
        x = [last * i / (_POINTS - 1) for i in range(_POINTS)]
        return Table(x, [law(value) for value in x])


def inflation_factor(inflation: float) -> float:
    """Vertical force at a pressure over that at the rated one, same deflection."""
    return (inflation + _CARCASS) / (1.0 + _CARCASS)


# Pneumatic trail over half the contact length where the side force is small.
SMALL_SLIP_TRAIL = 0.8


def trail_share(phi: float) -> float:
    """Pneumatic trail over that at small angles, at the angle φ = N ψ/(μ F_z).

    The quotient of the report's aligning moment and side force.
    """
    if phi <= 0.1:
        moment = 0.8 * phi
    elif phi <= 0.55:
        moment = phi - phi * phi - 0.01
    else:
        moment = max(0.2925 - 0.1 * phi, 0.0)
    force = side_force_share(phi)
    return moment / (SMALL_SLIP_TRAIL * force) if phi > 0.0 else 1.0


def side_force_share(phi: float) -> float:
    """Side force over μ F_z at the angle φ = N ψ/(μ F_z)."""
    return phi - 4.0 * phi**3 / 27.0 if phi <= 1.5 else 1.0

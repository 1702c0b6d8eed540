"""Gas springs of shock absorbers: one chamber, or two with a floating piston.

One chamber, polytropic: F = F_0 (1 - s/s_m)^(-n), s the stroke and s_m the gas length
(initial volume over piston area). n = 1 is isothermal.

Two chambers in series: the floating piston rests on its stop until the main chamber
reaches the precharge of the second one; from then on both have one pressure. As a
function of the common force F,

    s = s_1 [1 - (F_1/F)^(1/n_1)] + s_2 [1 - (F_2/F)^(1/n_2)],

forces and lengths referred to the area of the main piston; F(s) is its inverse. The
power of the net force is the sum of what both chambers store, because the pressures
are equal whenever the piston moves.

Ambient pressure is not subtracted: precharge is the force that the gas exerts.
"""

from dataclasses import dataclass

from systems.tools.checks import require
from systems.tools.compiled import law
from systems.tools.scalar import Scalar, log, power

# Below this distance from 1 the exponent is isothermal: the closed form of the energy
# would lose all digits.
_ISOTHERMAL = 1e-9


@dataclass(frozen=True, kw_only=True)
class SecondChamber:
    """A second gas chamber behind a floating piston.

    Attributes:
        precharge: N, gas force on the main piston's area at which the floating piston
            starts to move (second chamber's precharge pressure times main area).
        gas_length: m, volume of the second chamber over the area of the main piston.
        exponent: polytropic exponent, 1 = isothermal.
    """

    precharge: float
    gas_length: float
    exponent: float = 1.4

    def __post_init__(self) -> None:
        owner = "gas spring, second chamber"
        require(owner, "precharge", self.precharge, "N", above=0.0)
        require(owner, "gas_length", self.gas_length, "m", above=0.0)
        require(owner, "exponent", self.exponent, "", at_least=1.0, at_most=2.0)


@dataclass(frozen=True, kw_only=True)
class GasSpring:
    """The gas of a shock absorber.

    Attributes:
        precharge: N, gas force at zero stroke (F_0).
        gas_length: m, gas volume at zero stroke over the piston area (s_m).
        exponent: polytropic exponent n (n c_k in the paper), 1 = isothermal.
        second: the second chamber, if any.
        area: m², piston area; where given, the pressure is force over area.

    Raises:
        ValueError: a value is out of range; the message names it.
    """

    precharge: float
    gas_length: float
    exponent: float = 1.4
    second: SecondChamber | None = None
    area: float | None = None

    def __post_init__(self) -> None:
        require("gas spring", "precharge", self.precharge, "N", above=0.0)
        require("gas spring", "gas_length", self.gas_length, "m", above=0.0)
        require("gas spring", "exponent", self.exponent, "", at_least=1.0, at_most=2.0)
        if self.area is not None:
            require("gas spring", "area", self.area, "m²", above=0.0)
        if self.second and not self.second.precharge >= self.precharge:
            raise ValueError(
                f"gas spring: second chamber's precharge is {self.second.precharge} N, "
                f"expected >= that of the main chamber, {self.precharge} N"
            )

    @classmethod
    def from_pressure(
        cls,
        *,
        pressure: float,
        volume: float,
        area: float,
        exponent: float = 1.4,
        second_pressure: float | None = None,
        second_volume: float | None = None,
        second_exponent: float = 1.4,
    ) -> "GasSpring":
        """From pressures (Pa), volumes at zero stroke (m³) and piston area (m²)."""
        require("gas spring", "area", area, "m²", above=0.0)
        second = None
        if second_pressure is not None and second_volume is not None:
            second = SecondChamber(
                precharge=second_pressure * area,
                gas_length=second_volume / area,
                exponent=second_exponent,
            )
        return cls(
            precharge=pressure * area,
            gas_length=volume / area,
            exponent=exponent,
            second=second,
            area=area,
        )

    @property
    def total_length(self) -> float:
        """Stroke at which no gas volume is left, m."""
        return self.gas_length + (self.second.gas_length if self.second else 0.0)


@law
def polytropic(s: Scalar, f0: Scalar, length: Scalar, n: Scalar) -> Scalar:
    """Force of one chamber at stroke s < length, N."""
    return f0 * power(1.0 - s / length, -n)


def polytropic_energy(s: Scalar, f0: Scalar, length: Scalar, n: Scalar) -> Scalar:
    """Work to compress one chamber from zero stroke to s < length, J."""
    if abs(n - 1.0) < _ISOTHERMAL:
        return -f0 * length * log(1.0 - s / length)
    return f0 * length / (n - 1.0) * (power(1.0 - s / length, 1.0 - n) - 1.0)


@law
def series_split(
    s: Scalar, main: tuple[Scalar, Scalar, Scalar], second: tuple[float, float, float]
) -> tuple[Scalar, Scalar]:
    """Force of two chambers in series, and the part of s that the main one takes.

    Newton's method in y = (F_2/F)^(1/n_1), in which the compatibility of strokes is
    nearly linear: three or four steps.

    Args:
        s: m, stroke, less than the sum of both lengths.
        main, second: precharge N, length m, exponent of either chamber.
    """
    f1, l1, n1 = main
    f2, l2, n2 = second
    ratio = power(f1 / f2, 1.0 / n1)
    if s <= l1 * (1.0 - ratio):
        return polytropic(s, f1, l1, n1), s
    k = n1 / n2
    left, right = l1 + l2 - s, l1 * ratio
    y = left / (right + l2)
    for _ in range(50):
        y_k = power(y, k)
        step = (right * y + l2 * y_k - left) / (right + l2 * k * y_k / y)
        y = y - step if step < y else 0.1 * y
        # One step after the value has converged, so have the derivatives.
        if abs(step) < 1e-9 * y:
            break
    return f2 * power(y, -n1), l1 * (1.0 - ratio * y)


@law
def gas_force(
    s: Scalar,
    main: tuple[Scalar, Scalar, Scalar],
    second: tuple[float, float, float] | None,
    limit: Scalar,
) -> Scalar:
    """Gas force at stroke s, N; beyond `limit` (m) continued along its tangent.

    The continuation keeps trial steps of an integrator finite: both force and energy
    grow without bound where the gas has no volume left.
    """
    at = s if s < limit else limit
    force = (
        polytropic(at, *main) if second is None else series_split(at, main, second)[0]
    )
    if s < limit:
        return force
    return force + _gas_stiffness(force, main, second) * (s - limit)


def gas_energy(
    s: Scalar,
    main: tuple[Scalar, Scalar, Scalar],
    second: tuple[float, float, float] | None,
    limit: Scalar,
) -> Scalar:
    """Work done on the gas from zero stroke to s, J: the integral of `gas_force`."""
    at = s if s < limit else limit
    if second is None:
        force, energy = polytropic(at, *main), polytropic_energy(at, *main)
    else:
        force, s1 = series_split(at, main, second)
        energy = polytropic_energy(s1, *main) + polytropic_energy(at - s1, *second)
    if s < limit:
        return energy
    d = s - limit
    return energy + d * (force + 0.5 * _gas_stiffness(force, main, second) * d)


@law
def _gas_stiffness(
    force: Scalar,
    main: tuple[Scalar, Scalar, Scalar],
    second: tuple[float, float, float] | None,
) -> Scalar:
    """dF/ds where the gas force is `force`, N/m."""
    compliance = _compliance(force, main)
    if second is not None:
        compliance = compliance + _compliance(force, second)
    return 1.0 / compliance


@law
def _compliance(force: Scalar, chamber: tuple[Scalar, Scalar, Scalar]) -> Scalar:
    """Stroke of a chamber per force, m/N; none below its precharge."""
    f0, length, n = chamber
    if not force >= f0:
        return 0.0 * force
    return length / n * power(f0 / force, 1.0 / n) / force

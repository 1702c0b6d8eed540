"""Heat of the gas: adiabatic in a quick stroke, isothermal where it has time.

An ideal gas in a chamber exchanges heat with its walls, which are as warm as the
precharge: m c_v (T' - adiabatic T') = -m c_v (T - T_0)/τ. With x = V/V_0 and the
adiabatic exponent n, the state

    w = (p/p_0) xⁿ,  p = p_0 w x^(-n),  T/T_0 = w x^(1 - n)

changes by heat alone: w' = -(w - x^(n - 1))/τ, a linear equation, whatever the stroke
does. w = 1 is adiabatic from the precharge, w = x^(n - 1) isothermal. With n between 1
and 1.4 oil mixed with the gas is part of what is warmed.

Stored is what the gas can give back at the temperature of its walls (free energy),

    A = p_0 V_0 [(θ - 1 - ln θ)/(n - 1) - ln x],  θ = T/T_0,

and lost p_0 V_0 (θ - 1)²/((n - 1) θ τ), never negative: A' + loss = -p V'. Both limits
have the known energies of `gas_spring`.
"""

from typing import Any

from systems.shock_absorber.gas_spring import series_split
from systems.tools.compiled import law
from systems.tools.scalar import Scalar, log, power

# Force at the precharge (N), length (m), exponent.
Chamber = tuple[Scalar, Scalar, Scalar]
# Least volume that is left in a chamber, of the first one: for trial steps.
_LEAST_VOLUME = 1e-3
_ISOTHERMAL = 1e-9


@law
def heated(chamber: Chamber, w: Scalar) -> Chamber:
    """The chamber as a polytropic spring at a given state of heat."""
    return (chamber[0] * w, chamber[1], chamber[2])


@law
def _volume(stroke: Scalar, length: Scalar) -> Scalar:
    x = 1.0 - stroke / length
    return x if x > _LEAST_VOLUME else _LEAST_VOLUME + 0.0 * x


@law
def volumes(s: Scalar, main: Chamber, second: Chamber | None, w: Any) -> Any:
    """x of both chambers in series at stroke s; 1 where there is no second one."""
    if second is None:
        x = _volume(s, main[1])
        return x, 1.0 + 0.0 * x
    s1 = series_split(s, heated(main, w[0]), heated(second, w[1]))[1]
    return _volume(s1, main[1]), _volume(s - s1, second[1])


@law
def heat_rate(x: Scalar, chamber: Chamber, w: Scalar, tau: float) -> Scalar:
    """w' of a chamber, 1/s."""
    return (power(x, chamber[2] - 1.0) - w) / tau


def available_energy(x: Scalar, chamber: Chamber, w: Scalar) -> Scalar:
    """Stored energy of a chamber, zero at the precharge, J."""
    force, length, n = chamber
    share = -log(x)
    if n - 1.0 > _ISOTHERMAL:
        theta = w * power(x, 1.0 - n)
        share = share + (theta - 1.0 - log(theta)) / (n - 1.0)
    return force * length * share


@law
def heat_loss(x: Scalar, chamber: Chamber, w: Scalar, tau: float) -> Scalar:
    """Stored energy lost by heat that flows at unequal temperatures, W, >= 0."""
    force, length, n = chamber
    if not n - 1.0 > _ISOTHERMAL:
        return 0.0 * x * w
    theta = w * power(x, 1.0 - n)
    excess = theta - 1.0
    return force * length * excess * excess / ((n - 1.0) * theta * tau)

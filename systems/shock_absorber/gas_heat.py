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

from collections.abc import Sequence

from systems.shock_absorber.gas_spring import series_split
from systems.tools.scalar import Scalar, log, power

# Force at the precharge (N), length (m), exponent.
Chamber = tuple[Scalar, Scalar, Scalar]
# Least volume that is left in a chamber, of the first one: for trial steps.
_LEAST_VOLUME = 1e-3
_ISOTHERMAL = 1e-9


def heated(chamber: Chamber, w: Scalar) -> Chamber:
    """The chamber as a polytropic spring at a given state of heat."""
    return (chamber[0] * w, chamber[1], chamber[2])


def volumes(
    s: Scalar, chambers: Sequence[Chamber], w: Sequence[Scalar]
) -> list[Scalar]:
    """x of one chamber, or of two in series, at stroke s."""
    strokes = [s]
    if len(chambers) == 2:
        first, second = (heated(c, h) for c, h in zip(chambers, w))
        s1 = series_split(s, first, second)[1]
        strokes = [s1, s - s1]
    ratios = [1.0 - part / c[1] for part, c in zip(strokes, chambers)]
    return [x if x > _LEAST_VOLUME else _LEAST_VOLUME + 0.0 * x for x in ratios]


def heat_rates(
    x: Sequence[Scalar], chambers: Sequence[Chamber], w: Sequence[Scalar], tau: float
) -> list[Scalar]:
    """w' of each chamber, 1/s."""
    return [
        (power(volume, c[2] - 1.0) - h) / tau for volume, c, h in zip(x, chambers, w)
    ]


def available_energy(
    x: Sequence[Scalar], chambers: Sequence[Chamber], w: Sequence[Scalar]
) -> Scalar:
    """Stored energy of all chambers, zero at the precharge, J."""
    total: Scalar = 0.0
    for volume, (force, length, n), h in zip(x, chambers, w):
        share = -log(volume)
        if n - 1.0 > _ISOTHERMAL:
            theta = h * power(volume, 1.0 - n)
            share = share + (theta - 1.0 - log(theta)) / (n - 1.0)
        total = total + force * length * share
    return total


def lost_power(
    x: Sequence[Scalar], chambers: Sequence[Chamber], w: Sequence[Scalar], tau: float
) -> Scalar:
    """Stored energy lost by heat that flows at unequal temperatures, W, >= 0."""
    total: Scalar = 0.0
    for volume, (force, length, n), h in zip(x, chambers, w):
        if n - 1.0 > _ISOTHERMAL:
            theta = h * power(volume, 1.0 - n)
            excess = theta - 1.0
            loss = excess * excess / ((n - 1.0) * theta * tau)
            total = total + force * length * loss
    return total

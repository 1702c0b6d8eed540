"""What a strut does: formulas for floats and AutoDiffXd.

They are written once: `StrutLaw` calls them as they are for AutoDiffXd, and compiled
for floats; tables are `Table` or `Grid` there, and their arrays when compiled.
"""

from typing import Any, NamedTuple

from systems.shock_absorber.friction import bearing_reactions, coulomb_force
from systems.shock_absorber.gas_heat import heat_loss, heat_rate, heated, volumes
from systems.shock_absorber.gas_spring import gas_force
from systems.shock_absorber.orifice_damper import Metering, orifice_force, orifice_rate
from systems.tools.compiled import compiled_law, law
from systems.tools.scalar import Scalar
from systems.tools.stops import contact_elastic, never_pulling

# Force at the precharge (N), length (m), exponent.
Chamber = tuple[Scalar, Scalar, Scalar]


class Constants(NamedTuple):
    """Numbers of one strut, see `ShockAbsorberParameters`."""

    max_stroke: float
    extension_stop: float
    bottoming_stop: float
    stop_damping: float
    axle_arm: float
    bearing_distance: float
    transition: float


@law
def heated_gas_force(
    at: Scalar, main: Chamber, second: Chamber | None, heat: Any, limit: Scalar
) -> Scalar:
    """Force of the gas at its stroke, N; `heat`: w of each chamber, or None."""
    if heat is None:
        return gas_force(at, main, second, limit)
    if second is None:
        return gas_force(at, heated(main, heat[0]), None, limit)
    return gas_force(at, heated(main, heat[0]), heated(second, heat[1]), limit)


@law
def stop_forces(s: Scalar, rate: Scalar, f0: Scalar, c: Constants) -> Any:
    """Elastic force and damping of both stops, N."""
    elastic, damper = 0.0 * rate, 0.0 * rate
    # F_0 - k s rather than k (F_0/k - s): exactly F_0 at zero stroke.
    extension = f0 - c.extension_stop * s
    if extension > 0.0:
        elastic = -extension
        damper = -never_pulling(extension, -extension * c.stop_damping * rate)
    bottoming = contact_elastic(s - c.max_stroke, c.bottoming_stop)
    if bottoming > 0.0:
        elastic = elastic + bottoming
        damper = damper + never_pulling(bottoming, bottoming * c.stop_damping * rate)
    return elastic, damper


@law
def heat_of_gas(
    at: Scalar, main: Chamber, second: Chamber | None, heat: Any, tau: float
) -> Any:
    """Power lost, W, and rates of w, 1/s (the second is zero without such chamber)."""
    x1, x2 = volumes(at, main, second, heat)
    lost = heat_loss(x1, main, heat[0], tau)
    first = heat_rate(x1, main, heat[0], tau)
    if second is None:
        return lost, first, 0.0 * first
    lost = lost + heat_loss(x2, second, heat[1], tau)
    return lost, first, heat_rate(x2, second, heat[1], tau)


def strut_forces(
    s: Scalar,
    rate: Scalar,
    load: Any,
    tunables: Any,
    gas_stroke: Any,
    heat: Any,
    limit: Scalar,
    c: Constants,
    second: Chamber | None,
    compression_metering: Metering,
    rebound_metering: Metering,
    thermal_time: float | None,
    oil_stiffness: float | None,
) -> tuple[Scalar, ...]:
    """Parts of the force, what is lost, and how the states change.

    Args:
        s, rate: m, m/s.
        load: (3) side load, N, and its moments, N m.
        tunables: (7) of ShockAbsorberTunables.
        gas_stroke: m, the state of compressible oil; None: s.
        heat: w of each chamber; None: without heat.
        limit: m, stroke of the gas beyond which its law is continued.

    Returns:
        gas, damping, friction, stops, damping of the stops, N, positive apart; power
        lost, W; rates of w of the first and second chamber, 1/s, of the gas's stroke,
        m/s, each zero where there is no such state.
    """
    main = (tunables[0], tunables[1], tunables[2])
    at = s if gas_stroke is None else gas_stroke
    gas = heated_gas_force(at, main, second, heat, limit)
    metering = compression_metering, rebound_metering
    if oil_stiffness is None:
        flow = rate
        damping = orifice_force(
            s, rate, tunables[3], tunables[4], metering[0], metering[1]
        )
    else:
        damping = tunables[0] + oil_stiffness * (s - at) - gas
        flow = orifice_rate(
            at, damping, tunables[3], tunables[4], metering[0], metering[1]
        )
    friction = 0.0 * rate
    if tunables[5] > 0.0 or tunables[6] > 0.0:
        reactions = bearing_reactions(
            load[0], s, c.axle_arm, c.bearing_distance, (load[1], load[2])
        )
        limiting = tunables[5] * gas + tunables[6] * reactions
        friction = coulomb_force(rate, limiting, c.transition)
    elastic, damper = stop_forces(s, rate, tunables[0], c)
    lost = damping * flow + (friction + damper) * rate
    zero = 0.0 * lost
    first, other, oil = zero, zero, zero
    # Nested, for compiled code drops a branch only where one value alone is None.
    # Without its state the gas is as warm as its walls.
    if thermal_time is not None:  # noqa: SIM102
        if heat is not None:
            inside = at if at < limit else limit
            warmed, first, other = heat_of_gas(inside, main, second, heat, thermal_time)
            lost = lost + warmed
    if oil_stiffness is not None:
        oil = flow
    return gas, damping, friction, elastic, damper, lost, first, other, oil


strut_forces_of_floats = compiled_law(strut_forces)
"""The same, compiled: tables by their arrays."""

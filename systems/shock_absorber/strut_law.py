"""The force law of a shock absorber: gas, oil, friction and both end stops.

The force is positive where it drives fitting and wheel apart, stroke and rate are
positive in compression. Its parts:

    gas       `gas_spring`
    damping   `orifice_damper`
    friction  `friction`: smoothed Coulomb in seals (a share of the gas force) and
              bearings (a share of their reactions to the load across the strut)
    stops     `stops`: bottoming beyond the mechanical stroke, and the extension stop

The extension stop carries the gas preload. With stiffness k_e it is compressed by
s_0 = F_0/k_e at zero stroke, where it holds the gas force exactly: the net force is
zero at rest, and rises continuously with the slope k_e as the stop lets go between
s = 0 and s_0. No load reaches the airframe before touchdown.

Two refinements have states. Heat (`gas_heat`): w of each chamber, 1 at the precharge.
Oil that is compressible is a spring in series with orifice and gas, precharged like
the gas: the stroke of the gas is a state, and damping is what the oil carries beyond
the gas.

Energy: d(energy)/dt + dissipated_power = force × rate, energy zero at rest.
"""

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from pydrake.common.containers import namedview

from systems.shock_absorber.friction import bearing_reactions, coulomb_force
from systems.shock_absorber.gas_heat import (
    Chamber,
    available_energy,
    heat_rates,
    heated,
    lost_power,
    volumes,
)
from systems.shock_absorber.gas_spring import GasSpring, gas_energy, gas_force
from systems.shock_absorber.orifice_damper import Metering, orifice_force, orifice_rate
from systems.tools.checks import require
from systems.tools.grid import Grid
from systems.tools.scalar import Scalar
from systems.tools.stops import contact_elastic, contact_energy, never_pulling

ShockAbsorberTunables = namedview(
    "ShockAbsorberTunables",
    [
        "precharge",
        "gas_length",
        "exponent",
        "compression_damping",
        "rebound_damping",
        "seal_friction",
        "bearing_friction",
    ],
)
"""The numeric parameters that a run may change, in the order of the system."""

# The gas law is continued along its tangent over the last tenth of the way from the
# mechanical stroke to the end of the gas.
_GAS_LIMIT = 0.9


@dataclass(frozen=True, kw_only=True)
class ShockAbsorberParameters:
    """Parameters of a shock absorber.

    Attributes:
        gas: the gas spring.
        max_stroke: m, mechanical stroke, where the bottoming stop begins.
        compression_damping, rebound_damping: N s²/m².
        compression_metering, rebound_metering: factors on the damping over stroke (m),
            or over stroke and magnitude of the rate (m/s).
        thermal_time: s, of the gas with the walls around it; None: polytropic, with
            one exponent for ever.
        oil_stiffness: N/m, bulk modulus times squared piston area over volume of the
            oil; None: incompressible.
        extension_stop_stiffness, bottoming_stop_stiffness: N/m.
        stop_damping: s/m, χ of both stops.
        seal_friction: friction force over gas force.
        bearing_friction: friction force over bearing reactions.
        axle_arm: m, axle below the lower bearing at full extension.
        bearing_distance: m, between the bearings at full extension.
        friction_transition: m/s, rate within which friction changes sign.

    Raises:
        ValueError: a value is out of range; the message names it, its unit and range.
    """

    gas: GasSpring
    max_stroke: float
    compression_damping: float
    rebound_damping: float
    compression_metering: Metering = None
    rebound_metering: Metering = None
    thermal_time: float | None = None
    oil_stiffness: float | None = None
    extension_stop_stiffness: float = 5e7
    bottoming_stop_stiffness: float = 3e7
    stop_damping: float = 0.5
    seal_friction: float = 0.0
    bearing_friction: float = 0.0
    axle_arm: float = 0.0
    bearing_distance: float = 1.0
    friction_transition: float = 0.02

    def __post_init__(self) -> None:
        owner = "shock absorber"
        length = self.gas.total_length
        require(owner, "max_stroke", self.max_stroke, "m", above=0.0)
        if not self.max_stroke < length:
            raise ValueError(
                f"{owner}: max_stroke is {self.max_stroke} m, expected < {length} m, "
                "the length of the gas"
            )
        for name, unit in (
            ("compression_damping", "N s²/m²"),
            ("rebound_damping", "N s²/m²"),
            ("stop_damping", "s/m"),
            ("axle_arm", "m"),
        ):
            require(owner, name, getattr(self, name), unit, at_least=0.0)
        for name, unit in (
            ("extension_stop_stiffness", "N/m"),
            ("bottoming_stop_stiffness", "N/m"),
            ("bearing_distance", "m"),
            ("friction_transition", "m/s"),
        ):
            require(owner, name, getattr(self, name), unit, above=0.0)
        for name in ("seal_friction", "bearing_friction"):
            require(owner, name, getattr(self, name), "", at_least=0.0, at_most=1.0)
        for name in ("compression_metering", "rebound_metering"):
            table = getattr(self, name)
            if table is None:
                continue
            least = table.least if isinstance(table, Grid) else min(table.y)
            if least < 0.0:
                raise ValueError(
                    f"{owner}: {name} has the factor {least}, expected >= 0"
                )
        for name, unit in (("thermal_time", "s"), ("oil_stiffness", "N/m")):
            if getattr(self, name) is not None:
                require(owner, name, getattr(self, name), unit, above=0.0)
        if self.oil_stiffness is not None:
            for name in ("compression_damping", "rebound_damping"):
                require(
                    owner,
                    f"{name} beside compressible oil",
                    getattr(self, name),
                    "N s²/m²",
                    above=0.0,
                )

    @property
    def heats(self) -> int:
        """Number of chambers whose heat is a state."""
        if self.thermal_time is None:
            return 0
        return 2 if self.gas.second else 1

    @property
    def initial_state(self) -> list[float]:
        """At rest, extended, at the temperature of the precharge: w of each chamber,
        stroke of the gas (m).
        """
        return [1.0] * self.heats + [0.0] * (self.oil_stiffness is not None)

    @property
    def tunables(self) -> list[float]:
        """Values of the numeric parameters, in the order of ShockAbsorberTunables."""
        return [
            float(self.gas.precharge),
            float(self.gas.gas_length),
            float(self.gas.exponent),
            float(self.compression_damping),
            float(self.rebound_damping),
            float(self.seal_friction),
            float(self.bearing_friction),
        ]

    def with_tunables(self, values: Any) -> "ShockAbsorberParameters":
        """These parameters with other ShockAbsorberTunables, checked as always."""
        gas = replace(
            self.gas,
            precharge=values.precharge,
            gas_length=values.gas_length,
            exponent=values.exponent,
        )
        return replace(
            self,
            gas=gas,
            compression_damping=values.compression_damping,
            rebound_damping=values.rebound_damping,
            seal_friction=values.seal_friction,
            bearing_friction=values.bearing_friction,
        )


class StrutForces(NamedTuple):
    """Parts of a strut's force, N, positive apart; floats or AutoDiffXd."""

    gas: Scalar
    damping: Scalar
    friction: Scalar
    stops: Scalar
    stop_damping: Scalar

    @property
    def total(self) -> Scalar:
        """Gas and stops first: their sum is exactly zero at rest."""
        return (
            (self.gas + self.stops) + self.damping + self.friction + self.stop_damping
        )

    @property
    def dissipating(self) -> Scalar:
        """The part that turns power into heat: never with the motion."""
        return self.damping + self.friction + self.stop_damping


class StrutLaw:
    """The force law of one strut: pure functions of stroke, rate, side load and state.

    `tunables` are the seven values of ShockAbsorberTunables, floats or AutoDiffXd;
    `state` is as in `initial_state`, or None: adiabatic gas and incompressible oil.
    """

    def __init__(self, parameters: ShockAbsorberParameters) -> None:
        p = parameters
        self._p = p
        second = p.gas.second
        self._second = (
            (float(second.precharge), float(second.gas_length), float(second.exponent))
            if second
            else None
        )
        self._second_length = self._second[1] if self._second else 0.0

    def _limit(self, gas_length: Scalar) -> Scalar:
        length = gas_length + self._second_length
        if length <= self._p.max_stroke:
            raise ValueError(
                f"shock absorber: numeric parameter gas_length makes {length} m of "
                f"gas, expected > {self._p.max_stroke} m, the mechanical stroke"
            )
        return length - (1.0 - _GAS_LIMIT) * (length - self._p.max_stroke)

    def _chambers(self, tunables: list[Scalar]) -> list[Chamber]:
        main = (tunables[0], tunables[1], tunables[2])
        return [main] if self._second is None else [main, self._second]

    def _gas_stroke(self, s: Scalar, state: list[Scalar] | None) -> Scalar:
        return s if state is None or self._p.oil_stiffness is None else state[-1]

    def forces(
        self,
        s: Scalar,
        rate: Scalar,
        side_load: Scalar,
        tunables: list[Scalar],
        state: list[Scalar] | None = None,
        moment: tuple[Scalar, Scalar] = (0.0, 0.0),
    ) -> StrutForces:
        """The parts of the force at stroke (m), rate (m/s) and side load (N).

        The moment (N m) is that of the side load's surplus, see `bearing_reactions`.
        """
        p = self._p
        f0, _, _, compression, rebound, seal, bearing = tunables
        gas = self.gas_force(s, tunables, state)
        if state is not None and p.oil_stiffness is not None:
            damping = f0 + p.oil_stiffness * (s - state[-1]) - gas
        else:
            damping = orifice_force(
                s,
                rate,
                compression,
                rebound,
                p.compression_metering,
                p.rebound_metering,
            )
        friction = 0.0 * rate
        if seal > 0.0 or bearing > 0.0:
            reactions = bearing_reactions(
                side_load, s, p.axle_arm, p.bearing_distance, moment
            )
            friction = coulomb_force(
                rate, seal * gas + bearing * reactions, p.friction_transition
            )
        # F_0 - k s rather than k (F_0/k - s): exactly F_0 at zero stroke.
        elastic = damper = 0.0 * rate
        extension = f0 - p.extension_stop_stiffness * s
        if extension > 0.0:
            elastic = -extension
            damper = -never_pulling(extension, -extension * p.stop_damping * rate)
        bottoming = contact_elastic(s - p.max_stroke, p.bottoming_stop_stiffness)
        if bottoming > 0.0:
            elastic = elastic + bottoming
            damper = damper + never_pulling(
                bottoming, bottoming * p.stop_damping * rate
            )
        return StrutForces(gas, damping, friction, elastic, damper)

    def gas_force(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar] | None = None
    ) -> Scalar:
        """Force of the gas alone, N."""
        chambers = self._chambers(tunables)
        if state is not None and self._p.heats:
            chambers = [heated(c, w) for c, w in zip(chambers, state)]
        second = chambers[1] if len(chambers) == 2 else None
        at = self._gas_stroke(s, state)
        return gas_force(at, chambers[0], second, self._limit(tunables[1]))

    def energy(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar] | None = None
    ) -> Scalar:
        """Energy stored in gas, oil and stops, zero at zero stroke, J."""
        p = self._p
        f0 = tunables[0]
        k = p.extension_stop_stiffness
        preload = f0 / k
        return (
            self._gas_energy(s, tunables, state)
            + self._oil_energy(s, f0, state)
            + contact_energy(preload - s, k)
            - 0.5 * f0 * preload
            + contact_energy(s - p.max_stroke, p.bottoming_stop_stiffness)
        )

    def _gas_energy(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar] | None
    ) -> Scalar:
        chambers, limit = self._chambers(tunables), self._limit(tunables[1])
        at = self._gas_stroke(s, state)
        if state is None or not self._p.heats:
            second = chambers[1] if len(chambers) == 2 else None
            return gas_energy(at, chambers[0], second, limit)
        inside = at if at < limit else limit
        x = volumes(inside, chambers, state)
        energy = available_energy(x, chambers, state)
        if at < limit:
            return energy
        # Along the tangent, as the force.
        return energy + 0.5 * (at - limit) * (
            self.gas_force(limit, tunables, [*state[: self._p.heats], limit])
            + self.gas_force(s, tunables, state)
        )

    def _oil_energy(self, s: Scalar, f0: Scalar, state: list[Scalar] | None) -> Scalar:
        k = self._p.oil_stiffness
        if state is None or k is None:
            return 0.0
        pressed = s - state[-1]
        return pressed * (f0 + 0.5 * k * pressed)

    def lost_power(
        self,
        s: Scalar,
        rate: Scalar,
        forces: StrutForces,
        tunables: list[Scalar],
        state: list[Scalar] | None = None,
    ) -> Scalar:
        """Power that turns into heat, W, >= 0."""
        if state is None:
            return forces.dissipating * rate
        lost, flow = (forces.friction + forces.stop_damping) * rate, rate
        if self._p.oil_stiffness is not None:
            flow = self._flow(s, forces.damping, tunables, state)
        lost = lost + forces.damping * flow
        if self._p.thermal_time is not None:
            chambers = self._chambers(tunables)
            x = volumes(self._within(s, tunables, state), chambers, state)
            lost = lost + lost_power(x, chambers, state, self._p.thermal_time)
        return lost

    def _within(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar] | None
    ) -> Scalar:
        at, limit = self._gas_stroke(s, state), self._limit(tunables[1])
        return at if at < limit else limit

    def _flow(
        self, s: Scalar, force: Scalar, tunables: list[Scalar], state: list[Scalar]
    ) -> Scalar:
        """Rate of the stroke of the gas, m/s."""
        p = self._p
        metering = p.compression_metering, p.rebound_metering
        return orifice_rate(state[-1], force, tunables[3], tunables[4], *metering)

    def rates(
        self, s: Scalar, tunables: list[Scalar], state: list[Scalar]
    ) -> list[Scalar]:
        """Time derivatives of the state."""
        p, rates = self._p, []
        if p.thermal_time is not None:
            chambers = self._chambers(tunables)
            x = volumes(self._within(s, tunables, state), chambers, state)
            rates = heat_rates(x, chambers, state, p.thermal_time)
        if p.oil_stiffness is not None:
            gas = self.gas_force(s, tunables, state)
            carried = tunables[0] + p.oil_stiffness * (s - state[-1])
            rates.append(self._flow(s, carried - gas, tunables, state))
        return rates

    def settled(self, s: float, tunables: list[float]) -> list[float]:
        """The state after a long time at a stroke (m): as warm as the walls, no flow.

        The two chambers share the stroke isothermally.
        """
        p = self._p
        low, high = s - 0.5 * p.max_stroke, s
        for _ in range(60 if p.oil_stiffness is not None else 0):
            middle = 0.5 * (low + high)
            assert p.oil_stiffness is not None
            carried = tunables[0] + p.oil_stiffness * (s - middle)
            gas = self.gas_force(middle, tunables, self._warm(middle, tunables))
            low, high = (middle, high) if gas < carried else (low, middle)
        state = self._warm(high, tunables)
        return state[: p.heats] + [high] * (p.oil_stiffness is not None)

    def _warm(self, gas_stroke: float, tunables: list[float]) -> list[float]:
        """Isothermal w of each chamber at a stroke of the gas, and that stroke."""
        if not self._p.heats:
            return [gas_stroke]
        chambers, limit = self._chambers(tunables), self._limit(tunables[1])
        at = min(gas_stroke, limit)
        isothermal = [(force, length, 1.0) for force, length, _ in chambers]
        x = volumes(at, isothermal, [1.0] * len(chambers))
        return [v ** (c[2] - 1.0) for v, c in zip(x, chambers)] + [gas_stroke]

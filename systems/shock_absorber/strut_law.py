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

Energy: d(energy)/dt + dissipated_power = force × rate, energy zero at rest.
"""

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from pydrake.common.containers import namedview

from systems.shock_absorber.friction import bearing_reactions, coulomb_force
from systems.shock_absorber.gas_spring import GasSpring, gas_energy, gas_force
from systems.shock_absorber.orifice_damper import orifice_force
from systems.tools.checks import require
from systems.tools.scalar import Scalar
from systems.tools.stops import contact_elastic, contact_energy, never_pulling
from systems.tools.table import Table

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
        compression_metering, rebound_metering: factors on the damping over stroke (m).
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
    compression_metering: Table | None = None
    rebound_metering: Table | None = None
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
            if table is not None and min(table.y) < 0.0:
                raise ValueError(
                    f"{owner}: {name} has the factor {min(table.y)}, expected >= 0"
                )

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
    """The force law of one strut: pure functions of stroke, rate and side load.

    `tunables` are the seven values of ShockAbsorberTunables, floats or AutoDiffXd.
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

    def forces(
        self, s: Scalar, rate: Scalar, side_load: Scalar, tunables: list[Scalar]
    ) -> StrutForces:
        """The parts of the force at stroke (m), rate (m/s) and side load (N)."""
        p = self._p
        f0, _, _, compression, rebound, seal, bearing = tunables
        gas = self.gas_force(s, tunables)
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
            reactions = bearing_reactions(side_load, s, p.axle_arm, p.bearing_distance)
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

    def gas_force(self, s: Scalar, tunables: list[Scalar]) -> Scalar:
        """Force of the gas alone, N."""
        f0, length, n = tunables[:3]
        return gas_force(s, (f0, length, n), self._second, self._limit(length))

    def energy(self, s: Scalar, tunables: list[Scalar]) -> Scalar:
        """Energy stored in gas and stops, zero at zero stroke, J."""
        p = self._p
        f0, length, n = tunables[:3]
        k = p.extension_stop_stiffness
        preload = f0 / k
        return (
            gas_energy(s, (f0, length, n), self._second, self._limit(length))
            + contact_energy(preload - s, k)
            - 0.5 * f0 * preload
            + contact_energy(s - p.max_stroke, p.bottoming_stop_stiffness)
        )

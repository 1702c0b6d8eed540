"""What a shock absorber is made of: numbers of its law, checked."""

from dataclasses import dataclass, replace
from typing import Any

from pydrake.common.containers import namedview

from systems.shock_absorber.gas_spring import GasSpring
from systems.shock_absorber.orifice_damper import Metering
from systems.tools.checks import require
from systems.tools.grid import Grid

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

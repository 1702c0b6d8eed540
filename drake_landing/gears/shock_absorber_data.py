"""A shock absorber as a case file gives it, validated; SI units."""

from itertools import pairwise
from typing import Self

from pydantic import (
    Field,
    model_validator,
)

from drake_landing.gears.fields import (
    Data,
    NotNegative,
    Positive,
    Table,
)


class GasChamber(Data):
    """A second gas chamber behind a floating piston."""

    precharge_force: Positive = Field(
        description="strut force at which the floating piston starts to move, N"
    )
    gas_length: Positive = Field(
        le=10, description="volume over main piston area, m, > 0 and <= 10"
    )
    gas_exponent: float = Field(
        default=1.4, ge=1.0, le=2.0, description="1 isothermal, 1.4 adiabatic"
    )


class Orifices(Data):
    """Orifices, metering pin, relief valve and recoil chamber with its snubber."""

    piston_area: Positive = Field(
        le=1, description="m², that drives oil through the main orifice"
    )
    main: Positive | Table = Field(
        description="m², free area; or stroke (m, ascending) against it: metering pin"
    )
    density: Positive = Field(
        default=860.0, ge=500, le=1500, description="of the oil, kg/m³"
    )
    discharge: Positive = Field(
        default=0.75, le=1, description="discharge coefficient of all orifices"
    )
    relief_pressure: Positive | None = Field(
        default=None,
        description="at which a relief valve opens in compression, Pa; default none",
    )
    relief_area: NotNegative = Field(
        default=0.0, description="m², of the open relief valve"
    )
    relief_band: Positive = Field(
        default=1e6, description="beyond relief_pressure, over which it opens, Pa"
    )
    recoil_area: NotNegative = Field(
        default=0.0, le=1, description="m², of the recoil chamber; 0: none"
    )
    recoil_compression: Positive | None = Field(
        default=None, description="m², through which it fills; default freely"
    )
    recoil_rebound: Positive | Table | None = Field(
        default=None,
        description="m², through which it empties; or stroke (m, ascending) against "
        "it: snubber",
    )

    @model_validator(mode="after")
    def _sound(self) -> Self:
        if self.recoil_area and self.recoil_rebound is None:
            raise ValueError(
                "recoil_rebound: missing, the area through which the recoil chamber "
                "empties"
            )
        if (self.relief_pressure is None) != (self.relief_area == 0.0):
            raise ValueError(
                "relief_pressure and relief_area: found one, expected both or none"
            )
        for name in ("main", "recoil_rebound"):
            table = getattr(self, name)
            if isinstance(table, list) and min(area for _, area in table) <= 0.0:
                raise ValueError(f"{name}: found an area <= 0, expected > 0 m²")
        for name in ("main", "relief_area", "recoil_compression", "recoil_rebound"):
            value = getattr(self, name) or 0.0
            largest = max(a for _, a in value) if isinstance(value, list) else value
            if largest >= self.piston_area:
                raise ValueError(
                    f"{name}: found {largest:g} m², expected less than the piston's "
                    f"{self.piston_area:g} m²"
                )
        return self


class DampingMap(Data):
    """Measured damping forces over stroke and rate."""

    strokes: tuple[float, ...] = Field(
        min_length=2, description="m, strictly ascending"
    )
    rates: tuple[float, ...] = Field(
        min_length=2, description="m/s, > 0, strictly ascending"
    )
    compression: tuple[tuple[NotNegative, ...], ...] = Field(
        description="N, when closing: a row for each stroke, a value for each rate"
    )
    rebound: tuple[tuple[NotNegative, ...], ...] = Field(
        description="N, magnitude when opening: rows as in compression"
    )

    @model_validator(mode="after")
    def _complete(self) -> Self:
        for name in ("strokes", "rates"):
            for before, after in pairwise(getattr(self, name)):
                if not after > before:
                    raise ValueError(
                        f"{name}: {after:g} follows {before:g}, expected strictly "
                        "ascending"
                    )
        if not self.rates[0] > 0.0:
            raise ValueError(f"rates: found {self.rates[0]:g} m/s, expected > 0")
        for name in ("compression", "rebound"):
            rows = getattr(self, name)
            if len(rows) != len(self.strokes):
                raise ValueError(
                    f"{name}: found {len(rows)} rows, expected {len(self.strokes)}, "
                    "one for each stroke"
                )
            for row in rows:
                if len(row) != len(self.rates):
                    raise ValueError(
                        f"{name}: found a row of {len(row)}, expected "
                        f"{len(self.rates)}, one for each rate"
                    )
        return self


class ShockAbsorber(Data):
    """Gas spring, orifice damper, friction and end stops along the strut.

    The gas force is precharge_force·(1 - stroke/gas_length)^(-gas_exponent).
    """

    stroke: Positive = Field(
        le=2, description="mechanical stroke to the stop, m, > 0 and <= 2"
    )
    gas_length: Positive = Field(
        le=10, description="length of the gas column, m, > stroke and <= 10"
    )
    precharge_force: Positive = Field(
        description="gas force fully extended, N, > 0; the extension stop carries it"
    )
    gas_exponent: float = Field(
        default=1.4, ge=1.0, le=2.0, description="1 isothermal, 1.4 adiabatic"
    )
    second_chamber: GasChamber | None = None
    piston_area: Positive | None = Field(
        default=None, description="m²; where given, the gas pressure is reported"
    )
    compression_damping: NotNegative | None = Field(
        default=None,
        description="force over squared rate when closing, N s²/m²; or give orifices "
        "or damping_map",
    )
    rebound_damping: NotNegative | None = Field(
        default=None,
        description="force over squared rate when opening, N s²/m²; beside "
        "compression_damping",
    )
    compression_metering: Table | None = Field(
        default=None, description="stroke (m) against factor on compression_damping"
    )
    rebound_metering: Table | None = Field(
        default=None, description="stroke (m) against factor on rebound_damping"
    )
    orifices: Orifices | None = Field(
        default=None, description="areas and valves, in place of damping coefficients"
    )
    damping_map: DampingMap | None = Field(
        default=None, description="measured forces, in place of damping coefficients"
    )
    thermal_time: Positive | None = Field(
        default=None,
        description="of the gas in its walls, s: adiabatic (gas_exponent) in a quick "
        "stroke, isothermal at rest; default: one exponent for ever",
    )
    oil_bulk_modulus: float | None = Field(
        default=None,
        ge=1e7,
        le=1e10,
        description="Pa, of the oil; beside oil_volume and piston_area; default: "
        "incompressible",
    )
    oil_volume: Positive | None = Field(
        default=None, le=1, description="m³, of the oil under pressure"
    )
    compression_stop_stiffness: Positive = Field(
        default=3e7, description="beyond the stroke, N/m, > 0"
    )
    extension_stop_stiffness: Positive = Field(default=5e7, description="N/m, > 0")
    stop_damping: float = Field(
        default=0.5,
        ge=0,
        le=10,
        description="of the stops: damping over elastic force and rate, s/m",
    )
    seal_friction: float = Field(
        default=0.0, ge=0, le=1, description="friction force over gas force"
    )
    bearing_friction: float = Field(
        default=0.0, ge=0, le=1, description="friction force over bearing reactions"
    )
    bearing_distance: Positive = Field(
        default=0.5, description="between the bearings, extended, m, > 0"
    )
    axle_arm: NotNegative = Field(
        default=1.0, description="axle below the lower bearing, extended, m"
    )

    @model_validator(mode="after")
    def _gas_remains(self) -> Self:
        second = self.second_chamber
        length = self.gas_length + (second.gas_length if second else 0.0)
        if length <= self.stroke:
            raise ValueError(
                f"gas_length: found {length:g} m, expected more than the stroke, "
                f"{self.stroke:g} m: at full stroke some gas is left"
            )
        return self

    @model_validator(mode="after")
    def _one_damping(self) -> Self:
        coefficients = (self.compression_damping, self.rebound_damping)
        ways = [
            name
            for name, given in (
                ("compression_damping", any(c is not None for c in coefficients)),
                ("orifices", self.orifices is not None),
                ("damping_map", self.damping_map is not None),
            )
            if given
        ]
        if len(ways) != 1:
            found = " and ".join(ways) or "none"
            raise ValueError(
                f"damping: found {found}, expected one of compression_damping with "
                "rebound_damping, orifices, damping_map"
            )
        if ways == ["compression_damping"]:
            for name, value in zip(("compression", "rebound"), coefficients):
                if value is None:
                    raise ValueError(f"{name}_damping: missing")
        elif self.compression_metering or self.rebound_metering:
            raise ValueError(
                f"compression_metering, rebound_metering: found beside {ways[0]}, "
                "expected with compression_damping only"
            )
        return self

    @model_validator(mode="after")
    def _oil(self) -> Self:
        given = [
            self.oil_bulk_modulus is not None,
            self.oil_volume is not None,
        ]
        names = ("oil_bulk_modulus", "oil_volume", "piston_area")
        lacking = [name for name in names if getattr(self, name) is None]
        if any(given) and lacking:
            raise ValueError(
                f"{lacking[0]}: found none, expected oil_bulk_modulus, oil_volume and "
                "piston_area together, for compressible oil"
            )
        if all(given) and 0.0 in (self.compression_damping, self.rebound_damping):
            raise ValueError(
                "oil_bulk_modulus: found beside a damping of 0, expected > 0 in either "
                "direction for compressible oil"
            )
        return self

    @model_validator(mode="after")
    def _warms(self) -> Self:
        second = self.second_chamber
        exponents = [self.gas_exponent, *([second.gas_exponent] if second else [])]
        if self.thermal_time is not None and max(exponents) == 1.0:
            raise ValueError(
                "thermal_time: found beside gas_exponent 1, which is isothermal; "
                "expected the adiabatic exponent, 1.1 to 1.4"
            )
        return self

    @model_validator(mode="after")
    def _metered_over_the_stroke(self) -> Self:
        for name in ("compression_metering", "rebound_metering"):
            table = getattr(self, name)
            if table and table[-1][0] > 3.0 * self.stroke:
                raise ValueError(
                    f"{name}: found a stroke of {table[-1][0]:g} m, expected about "
                    f"{self.stroke:g} m, the mechanical stroke"
                )
        return self

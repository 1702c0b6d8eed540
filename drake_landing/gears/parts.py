"""Parts of a landing gear: validated data, as written in a case file.

Positions and inertias are in the airframe frame B (x aft, y to starboard, z up), gear
extended, aircraft undeformed. SI units except angles in degrees.
"""

from itertools import pairwise
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    ValidationInfo,
    field_validator,
    model_validator,
)

Vector3 = tuple[float, float, float]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]


def _ascending(table: list[tuple[float, float]]) -> list[tuple[float, float]]:
    for (before, _), (after, _) in pairwise(table):
        if not after > before:
            raise ValueError(
                f"{after:g} follows {before:g}, expected strictly ascending abscissae"
            )
    return table


Table = Annotated[
    list[tuple[float, float]], Field(min_length=2), AfterValidator(_ascending)
]


def _existing(path: Path, info: ValidationInfo) -> Path:
    """A file relative to the folder of the case."""
    folder = (info.context or {}).get("folder")
    path = Path(folder, path) if folder else path
    if not path.is_file():
        raise ValueError(f"found {path}, expected a file that is there")
    return path


InputFile = Annotated[Path, AfterValidator(_existing)]


class Data(BaseModel):
    """Frozen; unknown keys are errors."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class RigidPart(Data):
    """Mass properties of one rigid part."""

    mass: Positive = Field(description="mass, kg, > 0")
    cg: Vector3 = Field(description="centre of gravity in B, gear extended, m")
    inertia: tuple[Positive, Positive, Positive] = Field(
        description="principal moments of inertia about the centre of gravity along "
        "the axes of B, kg m², > 0; none may exceed the sum of the others"
    )

    @model_validator(mode="after")
    def _physical(self) -> Self:
        x, y, z = self.inertia
        if 2 * max(x, y, z) > x + y + z:
            raise ValueError(
                f"inertia ({x}, {y}, {z}) kg m²: one moment exceeds the sum of the "
                "other two, which no body has"
            )
        return self


class Wheel(Data):
    """One wheel with tyre and rotating brake parts; all wheels of a gear are equal."""

    mass: Positive = Field(description="mass of one wheel, kg, > 0")
    spin_inertia: Positive = Field(description="about the axle, kg m², > 0")
    transverse_inertia: Positive | None = Field(
        default=None,
        description="about any axis across the axle through the wheel centre, kg m², "
        "> half the spin inertia; default 0.6 of the spin inertia",
    )

    @property
    def transverse(self) -> float:
        """Moment of inertia across the axle, kg m²."""
        return self.transverse_inertia or 0.6 * self.spin_inertia

    @model_validator(mode="after")
    def _physical(self) -> Self:
        if 2 * self.transverse < self.spin_inertia:
            raise ValueError(
                f"transverse_inertia {self.transverse} kg m² is below half the spin "
                f"inertia {self.spin_inertia} kg m², which no body has"
            )
        return self


class Tyre(Data):
    """One tyre. The vertical law is F = stiffness·δ - nominal_force + damping·δ'.

    With width and pressure, what is not given follows from them (NASA TR R-64).
    """

    radius: Positive = Field(le=2, description="unloaded radius, m, > 0 and <= 2")
    stiffness: Positive | None = Field(
        default=None, description="vertical stiffness, N/m, > 0; or give load_table"
    )
    load_table: Table | None = Field(
        default=None,
        description="measured deflection (m, ascending) against load (N), from [0, 0]; "
        "instead of stiffness",
    )
    damping: NotNegative = Field(default=0.0, description="vertical damping, N s/m")
    damping_table: Table | None = Field(
        default=None,
        description="deflection (m, ascending) against vertical damping (N s/m), from "
        "[0, 0]; instead of damping",
    )
    nominal_force: NotNegative = Field(
        default=0.0, description="F_zN, subtracted from the vertical force, N"
    )
    bottoming_deflection: Positive | None = Field(
        default=None, description="deflection at which the rim touches, m; default none"
    )
    bottoming_stiffness: Positive = Field(
        default=2e7, description="of the rim, added beyond bottoming_deflection, N/m"
    )
    friction_peak: NotNegative = Field(
        default=0.8, le=2.0, description="D of mu = D sin(C atan(B slip)), 0 to 2"
    )
    friction_shape: float = Field(
        default=1.6, ge=1.0, le=2.0, description="C of the friction law, 1 to 2"
    )
    friction_stiffness: Positive = Field(
        default=12.5, description="B of the friction law, > 0"
    )
    friction_table: Table | None = Field(
        default=None,
        description="slip (ascending) against friction coefficient, from [0, 0]; "
        "instead of the friction law",
    )
    lateral_friction_ratio: Positive = Field(
        default=1.0, description="friction across over friction along the wheel, > 0"
    )
    relaxation_length: NotNegative = Field(
        default=0.0, description="m; 0: the force follows the slip without delay"
    )
    rolling_radius: Literal["effective", "loaded"] | Table = Field(
        default="effective",
        description="effective: a third of the deflection below the unloaded radius; "
        "loaded: the axle's height; or deflection (m, ascending) against rolling "
        "radius (m)",
    )
    width: Positive | None = Field(
        default=None, description="outer width, m; beside pressure"
    )
    pressure: float | None = Field(
        default=None,
        gt=5e4,
        le=5e6,
        description="rated inflation pressure, Pa, at which stiffness or load_table "
        "hold",
    )
    inflation: float = Field(
        default=1.0,
        ge=0,
        le=1.5,
        description="pressure over the rated one: 0 is a flat tyre; beside pressure",
    )
    cornering_slope: Positive | None = Field(
        default=None,
        le=50,
        description="side force over load and slip angle, 1/rad; default: from width "
        "and pressure, else that of the friction law",
    )
    cornering_table: Table | None = Field(
        default=None,
        description="load (N, ascending) against side force over slip angle (N/rad); "
        "instead of cornering_slope",
    )
    pneumatic_trail: NotNegative | None = Field(
        default=None,
        le=1,
        description="of the side force at small angles, m; default: from width and "
        "pressure, else 0",
    )
    carcass: Literal["rigid", "elastic"] = Field(
        default="rigid",
        description="elastic: tyre forces follow the slip over relaxation lengths, "
        "from fore_aft_stiffness and lateral_stiffness",
    )
    fore_aft_stiffness: Positive | None = Field(
        default=None,
        description="of the elastic carcass, N/m; default: from width and pressure",
    )
    lateral_stiffness: Positive | None = Field(
        default=None,
        description="of the elastic carcass, N/m; default: from width and pressure",
    )
    hysteresis: float = Field(
        default=0.0,
        ge=0,
        le=0.9,
        description="work lost over the work of loading, in a slow cycle of load",
    )
    rolling_resistance: float = Field(
        default=0.0, ge=0, le=0.5, description="drag of free rolling over load"
    )
    magic_formula: InputFile | None = Field(
        default=None,
        description="property file (.tir) of the Magic Formula, relative to the case "
        "file, in place of friction, cornering and trail",
    )

    @model_validator(mode="after")
    def _one_law(self) -> Self:
        if (self.stiffness is None) == (self.load_table is None):
            raise ValueError("give either stiffness or load_table")
        if self.damping > 0.0 and self.damping_table is not None:
            raise ValueError("give either damping or damping_table")
        return self

    @field_validator("magic_formula")
    @classmethod
    def _formula(cls, path: Path | None) -> Path | None:
        if path is not None:
            # The laws import Drake, which help and schema do without.
            from systems.tire.magic_formula import MagicFormula

            MagicFormula.from_file(path)
        return path

    @model_validator(mode="after")
    def _sized(self) -> Self:
        sized = self.width is not None and self.pressure is not None
        if (self.width is None) != (self.pressure is None):
            lacking = "pressure" if self.pressure is None else "width"
            raise ValueError(f"{lacking}: found none, expected width and pressure")
        if self.width is not None and self.width > 2.0 * self.radius:
            raise ValueError(
                f"width: found {self.width:g} m, expected less than the diameter, "
                f"{2.0 * self.radius:g} m"
            )
        if self.inflation != 1.0 and not sized:
            raise ValueError(
                f"inflation: found {self.inflation:g}, which needs width and pressure"
            )
        if self.cornering_slope is not None and self.cornering_table is not None:
            raise ValueError("give either cornering_slope or cornering_table")
        stiff = self.fore_aft_stiffness is not None, self.lateral_stiffness is not None
        if self.carcass == "elastic" and not (all(stiff) or sized):
            raise ValueError(
                "carcass: an elastic one needs fore_aft_stiffness and "
                "lateral_stiffness, or width and pressure"
            )
        if self.carcass == "rigid" and any(stiff):
            raise ValueError(
                "carcass: found rigid, expected elastic beside fore_aft_stiffness or "
                "lateral_stiffness"
            )
        if self.carcass == "elastic" and self.relaxation_length:
            raise ValueError(
                f"relaxation_length: found {self.relaxation_length:g} m, expected 0 "
                "with an elastic carcass, from which it follows"
            )
        return self

    @model_validator(mode="after")
    def _tables(self) -> Self:
        cornering = self.cornering_table
        if cornering and (cornering[0][0] < 0 or min(y for _, y in cornering) <= 0):
            raise ValueError("cornering_table: loads >= 0 and values > 0 are expected")
        if isinstance(self.rolling_radius, list):
            radii = [y for _, y in self.rolling_radius]
            if not 0.5 * self.radius < min(radii) <= max(radii) <= 1.1 * self.radius:
                raise ValueError(
                    f"rolling_radius: found {min(radii):g} to {max(radii):g} m, "
                    f"expected about the radius, {self.radius:g} m"
                )
        return self

    @model_validator(mode="after")
    def _within_radius(self) -> Self:
        ends = {
            "load_table": self.load_table and self.load_table[-1][0],
            "damping_table": self.damping_table and self.damping_table[-1][0],
            "bottoming_deflection": self.bottoming_deflection,
        }
        for name, deflection in ends.items():
            if deflection and deflection > self.radius:
                raise ValueError(
                    f"{name}: found a deflection of {deflection:g} m, expected less "
                    f"than the radius, {self.radius:g} m"
                )
        return self


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
                f"gas_length {length} m must exceed the stroke {self.stroke} m: at "
                "full stroke some gas is left"
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
        if any(given) and not (all(given) and self.piston_area is not None):
            raise ValueError(
                "oil_bulk_modulus: compressible oil needs oil_bulk_modulus, oil_volume "
                "and piston_area"
            )
        if all(given) and 0.0 in (self.compression_damping, self.rebound_damping):
            raise ValueError(
                "oil_bulk_modulus: compressible oil needs a damping > 0 in either "
                "direction"
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


class AntiSkid(Data):
    """Release of the brakes over slip."""

    onset: NotNegative = Field(
        default=0.08, description="slip up to which the demanded torque acts"
    )
    release: Positive = Field(
        default=0.2, le=1, description="slip from which on the brake is off, > onset"
    )
    protection_load: Positive = Field(
        default=1e4,
        description="tyre load at which the brake is fully available (touchdown "
        "protection), N",
    )

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if not self.release > self.onset:
            raise ValueError(
                f"release {self.release} must exceed the onset {self.onset}"
            )
        return self


class Brake(Data):
    """The brake of every wheel of a gear: demanded torque while brakes are applied."""

    torque: NotNegative | None = Field(
        default=None, description="of one wheel, N m; or give torque_table"
    )
    torque_table: Table | None = Field(
        default=None,
        description="time (s, ascending) against torque of one wheel (N m, >= 0)",
    )
    anti_skid: AntiSkid | None = Field(
        default=None, description="releases the brake over slip; default none"
    )

    @model_validator(mode="after")
    def _one_law(self) -> Self:
        if (self.torque is None) == (self.torque_table is None):
            raise ValueError("give either torque or torque_table")
        if self.torque_table and min(t for _, t in self.torque_table) < 0:
            raise ValueError("torque_table: a torque is negative, expected >= 0 N m")
        return self


class PitchDamper(Data):
    """Damper and positioner between piston and bogie beam."""

    trim_deg: float = Field(
        default=0.0,
        gt=-60,
        lt=60,
        description="pitch of the beam in flight, front axle up > 0, degrees",
    )
    stiffness: NotNegative = Field(
        default=0.0, description="of the positioner about the trim, N m/rad"
    )
    max_moment: Positive | None = Field(
        default=None,
        description="that the positioner yields at, N m; default: it never yields",
    )
    damping: NotNegative = Field(default=0.0, description="moment over rate, N m s/rad")
    quadratic_damping: NotNegative = Field(
        default=0.0, description="moment over squared rate, N m s²/rad²"
    )
    stop_deg: Positive | None = Field(
        default=None,
        description="travel to either side of the level beam, degrees; default none",
    )
    stop_stiffness: Positive = Field(default=5e7, description="N m/rad, > 0")

    @model_validator(mode="after")
    def _within_stops(self) -> Self:
        if self.stop_deg is not None and abs(self.trim_deg) > self.stop_deg:
            raise ValueError(
                f"trim_deg {self.trim_deg} lies beyond the stop at {self.stop_deg} deg"
            )
        return self


class FurtherAttachment(Data):
    """A second hold of the fitting on the airframe, by translations only.

    A drag or side stay: one direction, from end to end. A bearing that leaves the
    fitting free along its pin: two.
    """

    name: str = Field(
        pattern=r"^[a-z][a-z0-9_]*$", description="unique in the gear, e.g. drag_stay"
    )
    node: int = Field(gt=0, description="grid of the airframe model")
    directions: tuple[Vector3, ...] = Field(
        min_length=1,
        max_length=3,
        description="in which the fitting holds the node, B; any length, independent",
    )
    stiffness: Positive | None = Field(
        default=None,
        description="along each direction, N/m; default: rigid, for which the airframe "
        "must be flexible wherever a gear is held in more than six directions",
    )
    damping: NotNegative = Field(
        default=0.0, description="along each direction, beside a stiffness, N s/m"
    )

    @model_validator(mode="after")
    def _sound(self) -> Self:
        if any(not any(direction) for direction in self.directions):
            raise ValueError("directions: (0, 0, 0) is none")
        if self.stiffness is None and self.damping:
            raise ValueError("damping needs a stiffness beside it")
        return self

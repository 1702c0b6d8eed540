"""A tire as a case file gives it, validated; SI units."""

from pathlib import Path
from typing import Literal, Self

from pydantic import (
    Field,
    field_validator,
    model_validator,
)

from drake_landing.gears.fields import (
    Data,
    NotNegative,
    Positive,
    Table,
    one_of,
)
from drake_landing.input_paths import InputFile


class Tire(Data):
    """One tire. The vertical law is F = stiffness·δ - nominal_force + damping·δ'.

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
        description="pressure over the rated one: 0 is a flat tire; beside pressure",
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
        description="elastic: tire forces follow the slip over relaxation lengths, "
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
        one_of(stiffness=self.stiffness, load_table=self.load_table)
        if self.damping_table is not None:
            one_of(damping=self.damping or None, damping_table=self.damping_table)
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
        if self.cornering_slope is not None:
            table = self.cornering_table
            one_of(cornering_slope=self.cornering_slope, cornering_table=table)
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
            raise ValueError(
                f"cornering_table: found loads from {cornering[0][0]:g} N and values "
                f"from {min(y for _, y in cornering):g} N/rad, expected loads >= 0 and "
                "values > 0"
            )
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

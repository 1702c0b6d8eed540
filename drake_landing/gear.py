"""What has to be known of a landing gear: validated data, as written in a case file.

All positions and inertias are in the airframe frame B (x aft, y to starboard, z up),
gear extended, aircraft undeformed. SI units except angles in degrees. A gear is one
rigid fitting held by the airframe, a piston with its axle that slides in it along the
strut axis, and wheels that spin on the axle.
"""

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

Vector3 = tuple[float, float, float]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Table = Annotated[list[tuple[float, float]], Field(min_length=2)]


class _Data(BaseModel):
    """Frozen; unknown keys are errors."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class RigidPart(_Data):
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


class Wheel(_Data):
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


class Tyre(_Data):
    """One tyre. The vertical law is F = stiffness·δ - nominal_force + damping·δ'."""

    radius: Positive = Field(description="unloaded radius, m, > 0")
    stiffness: Positive | None = Field(
        default=None, description="vertical stiffness, N/m, > 0; or give load_table"
    )
    load_table: Table | None = Field(
        default=None,
        description="measured deflection (m, ascending) against load (N), from [0, 0]; "
        "instead of stiffness",
    )
    damping: NotNegative = Field(default=0.0, description="vertical damping, N s/m")
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

    @model_validator(mode="after")
    def _one_law(self) -> Self:
        if (self.stiffness is None) == (self.load_table is None):
            raise ValueError("give either stiffness or load_table")
        return self


class GasChamber(_Data):
    """A second gas chamber behind a floating piston."""

    precharge_force: Positive = Field(
        description="strut force at which the floating piston starts to move, N"
    )
    gas_length: Positive = Field(description="volume over main piston area, m")
    gas_exponent: float = Field(
        default=1.4, ge=1.0, le=2.0, description="1 isothermal, 1.4 adiabatic"
    )


class ShockAbsorber(_Data):
    """Gas spring, orifice damper, friction and end stops along the strut.

    The gas force is precharge_force·(1 - stroke/gas_length)^(-gas_exponent).
    """

    stroke: Positive = Field(description="mechanical stroke to the stop, m, > 0")
    gas_length: Positive = Field(description="length of the gas column, m, > stroke")
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
    compression_damping: NotNegative = Field(
        description="force over squared rate when closing, N s²/m²"
    )
    rebound_damping: NotNegative = Field(
        description="force over squared rate when opening, N s²/m²"
    )
    compression_metering: Table | None = Field(
        default=None, description="stroke (m) against factor on compression_damping"
    )
    rebound_metering: Table | None = Field(
        default=None, description="stroke (m) against factor on rebound_damping"
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


class LandingGear(_Data):
    """One landing gear."""

    name: str = Field(
        pattern=r"^[a-z][a-z0-9_]*$",
        description="unique; lower case, digits and underscores, e.g. main_left",
    )
    kind: Literal["telescopic"] = "telescopic"
    attachment_node: int = Field(
        gt=0, description="grid of the airframe model that holds the fitting"
    )
    axle: Vector3 = Field(description="middle of the axle in B, gear extended, m")
    rake_deg: float = Field(
        default=0.0,
        gt=-45,
        lt=45,
        description="angle of the strut axis from the up axis, about the lateral axis; "
        "positive: the lower end lies further forward",
    )
    wheel_offsets: tuple[float, ...] = Field(
        min_length=1,
        description="wheel centres along the axle from its middle, m, starboard > 0, "
        "ascending, e.g. [-0.465, 0.465] for a twin",
    )
    fitting: RigidPart = Field(description="sprung part: main fitting, stays, doors")
    piston: RigidPart = Field(description="piston, axle, brake stators; no wheels")
    wheel: Wheel
    tyre: Tyre
    shock_absorber: ShockAbsorber

    @model_validator(mode="after")
    def _wheels_apart(self) -> Self:
        offsets = self.wheel_offsets
        if any(b <= a for a, b in pairwise(offsets)):
            raise ValueError(f"wheel_offsets {offsets} m must be strictly ascending")
        return self

    @property
    def wheel_names(self) -> tuple[str, ...]:
        """`<gear>`, or `<gear>_left`, `<gear>_right` for a twin, or numbered."""
        sides = {1: ("",), 2: ("_left", "_right")}
        count = len(self.wheel_offsets)
        numbered = tuple(f"_{i}" for i in range(1, count + 1))
        return tuple(self.name + side for side in sides.get(count, numbered))

    @property
    def mass(self) -> float:
        """Of the whole gear, kg."""
        wheels = len(self.wheel_offsets) * self.wheel.mass
        return self.fitting.mass + self.piston.mass + wheels

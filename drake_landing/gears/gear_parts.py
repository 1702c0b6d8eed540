"""Bodies, wheels, brakes and holds of a gear, validated, as in a case file.

Positions and inertias are in the airframe frame B (x aft, y to starboard, z up), gear
extended, aircraft undeformed. SI units except angles in degrees.
"""

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
    Vector3,
    one_of,
)


class RigidPart(Data):
    """Mass properties of one rigid part."""

    mass: Positive = Field(description="mass, kg, > 0")
    cg: Vector3 = Field(description="center of gravity in B, gear extended, m")
    inertia: tuple[Positive, Positive, Positive] = Field(
        description="principal moments of inertia about the center of gravity along "
        "the axes of B, kg m², > 0; none may exceed the sum of the others"
    )

    @model_validator(mode="after")
    def _physical(self) -> Self:
        x, y, z = self.inertia
        if 2 * max(x, y, z) > x + y + z:
            raise ValueError(
                f"inertia: found ({x:g}, {y:g}, {z:g}) kg m², expected no moment above "
                "the sum of the other two, as no body has it"
            )
        return self


class Wheel(Data):
    """One wheel with tire and rotating brake parts; all wheels of a gear are equal."""

    mass: Positive = Field(description="mass of one wheel, kg, > 0")
    spin_inertia: Positive = Field(description="about the axle, kg m², > 0")
    transverse_inertia: Positive | None = Field(
        default=None,
        description="about any axis across the axle through the wheel center, kg m², "
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
                f"transverse_inertia: found {self.transverse:g} kg m², expected "
                f"no less than half of spin_inertia, {self.spin_inertia:g} kg m²"
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
        description="tire load at which the brake is fully available (touchdown "
        "protection), N",
    )

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if not self.release > self.onset:
            raise ValueError(
                f"release: found {self.release:g}, expected more than the onset, "
                f"{self.onset:g}"
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
        one_of(torque=self.torque, torque_table=self.torque_table)
        least = min((t for _, t in self.torque_table or ()), default=0.0)
        if least < 0:
            raise ValueError(
                f"torque_table: found a torque of {least:g} N m, expected >= 0"
            )
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
                f"trim_deg: found {self.trim_deg:g}, expected within stop_deg, "
                f"{self.stop_deg:g}"
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
            raise ValueError("directions: found (0, 0, 0), expected a direction")
        if self.stiffness is None and self.damping:
            raise ValueError(
                f"damping: found {self.damping:g} N s/m, expected a stiffness beside it"
            )
        return self

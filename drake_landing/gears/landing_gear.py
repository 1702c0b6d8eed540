"""What has to be known of a landing gear: validated data, as written in a case file.

All positions and inertias are in the airframe frame B (x aft, y to starboard, z up),
gear extended and not steered, aircraft undeformed. SI units except angles in degrees.
Three kinds:

    telescopic  a piston with its axle slides in the fitting along the strut axis
    levered     an arm with the axle pivots on the fitting; the shock absorber spans
                a point of the fitting and a point of the arm
    bogie       a beam with several axles pivots at the lower end of a piston

A gear is held by the airframe at one node or at several, see `further_attachments`.
"""

from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import (
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    TypeAdapter,
    ValidationInfo,
    model_validator,
)

from drake_landing.gears.fields import Data
from drake_landing.gears.fields import Vector3 as Vector3
from drake_landing.gears.gear_parts import Brake, FurtherAttachment, PitchDamper, Wheel
from drake_landing.gears.gear_parts import RigidPart as RigidPart
from drake_landing.gears.legs import Leg, require_over_stroke
from drake_landing.gears.model_file import FIELDS, ModelFile, with_bodies
from drake_landing.gears.shock_absorber_data import ShockAbsorber
from drake_landing.gears.tire_data import Tire

_WIDEST = 5.0  # m
_PIVOT_AXES = "the pivot's axis is the lateral one"


class LandingGear(Data):
    """What all kinds of landing gear have in common."""

    positions: ClassVar[tuple[str, ...]] = ()
    """Names of the fields that are positions in B."""

    name: str = Field(
        pattern=r"^[a-z][a-z0-9_]{0,39}$",
        description="unique; lower case, digits and underscores, e.g. main_left",
    )
    kind: str
    attachment_node: int = Field(
        gt=0, description="grid of the airframe model that holds the fitting"
    )
    attachment: Literal["rigid", "ball"] = Field(
        default="rigid",
        description="what attachment_node holds of the fitting: rigid, all of it; "
        "ball, its translations only",
    )
    further_attachments: tuple[FurtherAttachment, ...] = Field(
        default=(), description="other grids that hold the fitting: stays, bearings"
    )
    wheel_offsets: tuple[float, ...] = Field(
        min_length=1,
        description="wheel centers along the axle from its middle, m, starboard > 0, "
        "ascending, e.g. [-0.465, 0.465] for a twin",
    )
    steering_deg: float = Field(
        default=0.0,
        ge=-80,
        le=80,
        description="fixed angle by which all below the fitting is turned, wheels to "
        "starboard > 0: about the strut axis, of a levered gear (with its shock "
        "absorber) about the up axis through the pivot",
    )
    fitting: RigidPart = Field(description="sprung part: main fitting, stays, doors")
    wheel: Wheel
    tyre: Tire = Field(description="of every wheel that `tyres` does not name")
    tyres: dict[str, Tire] = Field(
        default={},
        description="name of a wheel -> what its tire has otherwise than `tyre`, e.g. "
        "main_left_right: {inflation: 0}",
        # As it is written: only what differs.
        json_schema_extra={"additionalProperties": {"type": "object"}},
    )
    brake: Brake | None = Field(default=None, description="of every wheel; or none")
    shock_absorber: ShockAbsorber
    cylinder: RigidPart | None = Field(
        default=None,
        description="what of the leg is sprung but swings as it bends, beside the "
        "fitting, which then is what the airframe clamps; default none",
    )
    leg: Leg | None = Field(
        default=None,
        description="flexibility between fitting and axle; default none, a rigid leg",
    )

    @model_validator(mode="after")
    def _leg_fits(self) -> Self:
        if self.cylinder is not None and not (self.leg and self.leg.bends):
            raise ValueError(
                "cylinder: found one on a leg that does not bend, expected its mass in "
                "fitting, or leg.fore_aft, leg.lateral or leg.beam"
            )
        if self.leg is not None:
            sliding = not isinstance(self, LeveredGear)
            require_over_stroke(self.leg, self.shock_absorber.stroke, sliding)
        return self

    @model_validator(mode="before")
    @classmethod
    def _complete_tires(cls, data: Any) -> Any:
        """Tires of single wheels have the rest from the common one."""
        common = data.get("tyre") if isinstance(data, dict) else None
        single = data.get("tyres") if isinstance(data, dict) else None
        if isinstance(common, Tire):
            common = common.model_dump(exclude_unset=True)
        if not isinstance(common, dict) or not isinstance(single, dict):
            return data
        filled = {
            name: common | changes if isinstance(changes, dict) else changes
            for name, changes in single.items()
        }
        return data | {"tyres": filled}

    @model_validator(mode="after")
    def _known_wheels(self) -> Self:
        for name in self.tyres:
            if name not in self.wheel_names:
                raise ValueError(
                    f"tyres: found {name!r}, expected one of the wheels "
                    f"{', '.join(self.wheel_names)}"
                )
        return self

    def __hash__(self) -> int:
        return hash((self.kind, self.name, self.attachment_node, self.wheel_offsets))

    def tire_of(self, wheel: str) -> Tire:
        """The tire of a wheel, by its name."""
        return self.tyres.get(wheel, self.tyre)

    @model_validator(mode="after")
    def _wheels_apart(self) -> Self:
        offsets = self.wheel_offsets
        if any(b <= a for a, b in pairwise(offsets)):
            raise ValueError(
                f"wheel_offsets: found {offsets} m, expected strictly ascending ones"
            )
        if max(map(abs, offsets)) > _WIDEST:
            raise ValueError(
                f"wheel_offsets: found {offsets} m, expected within {_WIDEST:g} m of "
                "the middle of the axle"
            )
        return self

    @model_validator(mode="after")
    def _held(self) -> Self:
        further = self.further_attachments
        names = [hold.name for hold in further]
        nodes = [self.attachment_node, *(hold.node for hold in further)]
        for what, values in (("name", names), ("node", nodes)):
            twice = sorted({v for v in values if values.count(v) > 1}, key=str)
            if twice:
                raise ValueError(
                    f"further_attachments: found {what} {twice[0]} twice, expected "
                    f"each {what} once, attachment_node included"
                )
        count = sum(len(hold.directions) for hold in further)
        if self.attachment == "ball" and count < 3:
            raise ValueError(
                "attachment: found a ball, which holds 3 directions, and "
                f"further_attachments that hold {count}, expected 6 or more together"
            )
        return self

    @property
    def axles(self) -> tuple[Vector3, ...]:
        """Middle of each axle in B, gear extended, m."""
        raise TypeError("a landing gear is one of its kinds")

    @property
    def sprung_parts(self) -> dict[str, RigidPart]:
        """Rigid parts above the shock absorber's stroke, by name."""
        cylinder = {} if self.cylinder is None else {"cylinder": self.cylinder}
        return {"fitting": self.fitting, **cylinder}

    @property
    def sprung_mass(self) -> float:
        """Mass of the sprung parts, kg."""
        return sum(part.mass for part in self.sprung_parts.values())

    @property
    def moving_parts(self) -> dict[str, RigidPart]:
        """Rigid parts between fitting and wheels, by name."""
        raise TypeError("a landing gear is one of its kinds")

    @property
    def axle_names(self) -> tuple[str, ...]:
        """Parts of wheel names that tell the axles apart: nothing for one axle."""
        count = len(self.axles)
        numbered = tuple(f"_axle{i}" for i in range(1, count + 1))
        return {1: ("",), 2: ("_front", "_rear")}.get(count, numbered)

    @property
    def wheel_names(self) -> tuple[str, ...]:
        """`<gear>`, `<gear>_left`, `<gear>_right` for a twin, or numbered.

        With two axles `<gear>_front_left` and so on, axle after axle.
        """
        sides = {1: ("",), 2: ("_left", "_right")}
        count = len(self.wheel_offsets)
        numbered = tuple(f"_{i}" for i in range(1, count + 1))
        across = sides.get(count, numbered)
        return tuple(self.name + a + side for a in self.axle_names for side in across)

    @property
    def attachments(self) -> dict[str, int]:
        """Name of each attachment -> grid; the first has the name of the gear."""
        further = {f"{self.name}_{h.name}": h.node for h in self.further_attachments}
        return {self.name: self.attachment_node, **further}

    @property
    def unsprung_mass(self) -> float:
        """Mass of the parts that move and of the wheels, kg."""
        parts = sum(part.mass for part in self.moving_parts.values())
        return parts + len(self.wheel_names) * self.wheel.mass

    @property
    def mass(self) -> float:
        """Mass of the whole gear, kg."""
        return self.sprung_mass + self.unsprung_mass


def _bodies_or_their_fields(schema: dict[str, Any]) -> None:
    """A model file brings some of the fields with it."""
    schema["required"] = [name for name in schema["required"] if name not in FIELDS]
    schema["anyOf"] = [{"required": ["bodies"]}, {"required": list(FIELDS)}]


Rake = Annotated[
    float,
    Field(
        gt=-45,
        lt=45,
        description="angle of the strut axis from the up axis, about the lateral axis; "
        "positive: the lower end lies further forward",
    ),
]


class OneAxleGear(LandingGear):
    """What gears with one axle have in common."""

    axle: Vector3 = Field(description="middle of the axle in B, gear extended, m")

    @property
    def axles(self) -> tuple[Vector3, ...]:
        """The one axle."""
        return (self.axle,)


class TelescopicGear(OneAxleGear):
    """A piston with one axle that slides in the fitting."""

    positions: ClassVar[tuple[str, ...]] = ("axle",)

    model_config = ConfigDict(json_schema_extra=_bodies_or_their_fields)

    kind: Literal["telescopic"] = "telescopic"
    bodies: ModelFile | None = Field(
        default=None,
        exclude=True,  # read, it has become the fields that it stands for
        description=f"a model file in place of {', '.join(FIELDS)}; default none",
    )
    rake_deg: Rake = 0.0
    piston: RigidPart = Field(description="piston, axle, brake stators; no wheels")

    @model_validator(mode="before")
    @classmethod
    def _read_bodies(cls, data: Any, info: ValidationInfo) -> Any:
        if not isinstance(data, dict) or data.get("bodies") is None:
            return data
        return with_bodies(data, info.context)

    @property
    def moving_parts(self) -> dict[str, RigidPart]:
        """The piston."""
        return {"piston": self.piston}


class LeveredGear(OneAxleGear):
    """An arm with one axle that pivots on the fitting about the lateral axis."""

    positions: ClassVar[tuple[str, ...]] = (
        "axle",
        "pivot",
        "absorber_upper",
        "absorber_lower",
    )

    kind: Literal["levered"] = "levered"
    pivot: Vector3 = Field(
        description=f"of the arm on the fitting, in B, m; {_PIVOT_AXES}"
    )
    absorber_upper: Vector3 = Field(
        description="shock absorber's end on the fitting, in B, m"
    )
    absorber_lower: Vector3 = Field(
        description="shock absorber's end on the arm, in B, gear extended, m"
    )
    arm: RigidPart = Field(description="arm, axle, brake stators; no wheels")

    @model_validator(mode="after")
    def _pinned(self) -> Self:
        if self.shock_absorber.bearing_friction:
            raise ValueError(
                "shock_absorber.bearing_friction: a pin-ended shock absorber carries "
                "no side load, expected 0; seal_friction is there"
            )
        return self

    @property
    def moving_parts(self) -> dict[str, RigidPart]:
        """The arm."""
        return {"arm": self.arm}


class BogieGear(LandingGear):
    """A beam with several axles that pivots at the lower end of a piston."""

    positions: ClassVar[tuple[str, ...]] = ("pivot", "axle_positions")

    kind: Literal["bogie"] = "bogie"
    pivot: Vector3 = Field(
        description=f"of the beam on the piston, in B, gear extended, m; {_PIVOT_AXES}"
    )
    axle_positions: tuple[Vector3, ...] = Field(
        min_length=1,
        description="middle of each axle in B, gear extended and beam level, m, front "
        "axle first",
    )
    rake_deg: Rake = 0.0
    piston: RigidPart = Field(description="piston without the beam")
    beam: RigidPart = Field(
        description="bogie beam, level, with axles and brake stators; no wheels"
    )
    pitch_damper: PitchDamper = Field(
        default=PitchDamper(), description="between piston and beam"
    )

    @property
    def axles(self) -> tuple[Vector3, ...]:
        """Front to rear."""
        return self.axle_positions

    @property
    def moving_parts(self) -> dict[str, RigidPart]:
        """Piston and beam."""
        return {"piston": self.piston, "beam": self.beam}


def _tag(value: Any) -> str:
    data = value if isinstance(value, dict) else vars(value) if _is_gear(value) else {}
    return f"({data.get('kind', 'telescopic')})"


def _is_gear(value: Any) -> bool:
    return isinstance(value, LandingGear)


# One of the kinds by its field `kind`, telescopic by default; tags are in parentheses,
# see `case.reading`.
AnyGear = Annotated[
    Annotated[TelescopicGear, Tag("(telescopic)")]
    | Annotated[LeveredGear, Tag("(levered)")]
    | Annotated[BogieGear, Tag("(bogie)")],
    Discriminator(
        _tag,
        custom_error_type="gear_kind",
        custom_error_message="expected telescopic, levered or bogie for kind",
    ),
]

_ANY_GEAR: TypeAdapter[LandingGear] = TypeAdapter(AnyGear)


def read_gear(data: Any) -> LandingGear:
    """A landing gear of the kind that the data name.

    Raises:
        pydantic.ValidationError: the data are not a landing gear; a ValueError.
    """
    return _ANY_GEAR.validate_python(data)

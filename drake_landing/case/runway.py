"""The runway of a scenario: surface, crown, and profiles of its height."""

from typing import Annotated, Any, Literal, Self

from pydantic import (
    Discriminator,
    Field,
    Tag,
    model_validator,
)

from drake_landing.case.section import Section, number
from drake_landing.gears.fields import one_of
from drake_landing.input_paths import InputFile
from systems.runway.roughness import ISO_8608
from systems.runway.runway_profile import FOOT, MeasuredProfile, measured_tracks


class Bump(Section):
    """One full 1-cosine."""

    kind: Literal["bump"]
    height: float = number("height, negative for a dip", "m", ge=-1, le=1)
    length: float = number("length", "m", gt=0)
    start: float = number("distance ahead of the start", "m", 5.0)


class WaveTrain(Section):
    """A sine without end."""

    kind: Literal["waves"]
    amplitude: float = number("amplitude", "m", ge=-1, le=1)
    wavelength: float = number("wavelength", "m", gt=0)
    start: float = number("distance of a zero crossing ahead of the start", "m", 0.0)


class Ramp(Section):
    """A step with a smooth ramp."""

    kind: Literal["step"]
    height: float = number("height, negative for a step down", "m", ge=-1, le=1)
    ramp: float = number("length of the ramp", "m", gt=0)
    start: float = number("distance ahead of the start", "m", 5.0)


class Measured(Section):
    """A measured profile, of the whole width or of a left and a right track."""

    kind: Literal["measured"]
    file: InputFile = Field(
        description="distance and height, or distance, height of the left and of the "
        "right track, in columns; relative to the case file"
    )
    unit: Literal["m", "ft"] = Field(default="m", description="of all columns")
    start: float = number("added to the distances ahead of the start", "m", 0.0)
    backwards: bool = Field(
        default=False, description="travelled from the last point to the first"
    )
    track_spacing: float | None = Field(
        default=None,
        gt=0,
        le=50,
        description="between left and right track, m; needed for three columns",
    )

    @model_validator(mode="after")
    def _readable(self) -> Self:
        two = len(self.tracks) == 2
        if two and self.track_spacing is None:
            raise ValueError(
                f"track_spacing: found none, but {self.file.name} has two tracks, "
                "expected their distance in m"
            )
        if not two and self.track_spacing is not None:
            raise ValueError(
                f"track_spacing: found {self.track_spacing:g} m, but {self.file.name} "
                "has one track, expected none"
            )
        return self

    @property
    def tracks(self) -> tuple[MeasuredProfile, ...]:
        """One, or left and right."""
        unit = FOOT if self.unit == "ft" else 1.0
        return measured_tracks(
            self.file, unit=unit, start=self.start, backwards=self.backwards
        )


class Roughness(Section):
    """Random roughness of a spectrum after ISO 8608."""

    kind: Literal["roughness"]
    iso_class: Literal["A", "B", "C", "D", "E", "F", "G", "H"] | None = Field(
        default=None, description="of ISO 8608, A smoothest; or give intensity"
    )
    intensity: float | None = Field(
        default=None,
        gt=0,
        le=1,
        description="spectral density at 0.1 cycles/m, m³; class A 16e-6",
    )
    seed: int = Field(default=1, ge=0, description="of the random phases")
    length: float = number("of the rough part", "m", 2000.0, gt=0, le=20000)
    start: float = number("distance ahead of the start", "m", 5.0)
    run_in: float = number("over which it grows to full size", "m", 10.0, gt=0)
    wavelengths: tuple[float, float] = Field(
        default=(1.0, 90.0), description="shortest and longest, m"
    )
    track_spacing: float = number(
        "between left and right track, which differ in short waves; 0: one for all "
        "wheels",
        "m",
        0.0,
        ge=0,
        le=50,
    )

    @model_validator(mode="after")
    def _sound(self) -> Self:
        one_of(iso_class=self.iso_class, intensity=self.intensity)
        short, long = self.wavelengths
        if not 0.1 <= short < long:
            raise ValueError(
                f"wavelengths: found {short:g} to {long:g} m, expected ascending, "
                ">= 0.1 m"
            )
        if self.length <= 2.0 * long:
            raise ValueError(
                f"length: found {self.length:g} m, expected more than twice the "
                f"longest wavelength, {long:g} m"
            )
        if self.run_in > self.length:
            raise ValueError(
                f"run_in: found {self.run_in:g} m, expected less than the length, "
                f"{self.length:g} m"
            )
        return self

    @property
    def density(self) -> float:
        """Spectral density at 0.1 1/m, m³."""
        return self.intensity or ISO_8608[self.iso_class or "A"]


_KINDS = ("bump", "waves", "step", "measured", "roughness")


def _profile_tag(value: Any) -> str:
    kind = value.get("kind") if isinstance(value, dict) else getattr(value, "kind", "")
    return f"({kind})"


AnyProfile = Annotated[
    Annotated[Bump, Tag("(bump)")]
    | Annotated[WaveTrain, Tag("(waves)")]
    | Annotated[Ramp, Tag("(step)")]
    | Annotated[Measured, Tag("(measured)")]
    | Annotated[Roughness, Tag("(roughness)")],
    Discriminator(
        _profile_tag,
        custom_error_type="profile_kind",
        custom_error_message=f"expected a mapping with kind {', '.join(_KINDS)}",
    ),
]


class RunwaySection(Section):
    """The ground."""

    surface: Literal["dry", "wet", "icy"] = Field(
        default="dry", description="sets the friction of the tires"
    )
    friction_factor: float | None = Field(
        default=None,
        ge=0,
        description="factor on the tires' dry friction, in place of the surface's",
    )
    profile: AnyProfile | None = Field(
        default=None,
        description="height over distance ahead of the foremost tire; default flat",
    )
    crown: float = number(
        "fall to either side of the center line, over distance", "1", 0.0, ge=0, le=0.1
    )
    offset: float = number(
        "of the aircraft at the start from the center line, to starboard",
        "m",
        0.0,
        ge=-50,
        le=50,
    )

"""What an aircraft does at the start of a run: touches down, or rolls on its gears.

Zero angles: level, along the track. A `preset` stands for a condition of CS-25 and
fills in whatever is not given beside it.
"""

from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import (
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    ValidationInfo,
    model_validator,
)

from drake_landing.case.presets import LANDING_SINK_RATE, PRESETS, Preset, PresetName
from drake_landing.case.section import Section, number
from systems.runway.roughness import ISO_8608
from systems.runway.runway_profile import FOOT, MeasuredProfile, measured_tracks

_RESERVE_SINK_RATE = 3.66  # m/s, 14 CFR 25.723(b)


class Tail(Section):
    """A lifting surface without force in the flight before touchdown."""

    nodes: tuple[int, ...] = Field(
        min_length=1, description="grids that carry it, in equal shares"
    )
    area: float = number("of the tailplane", "m²", gt=0)
    slope: float = number("lift coefficient over angle of attack", "1/rad", gt=0, le=10)
    downwash: float = number(
        "angle of the downwash over that of the wing", "1", 0.0, ge=0, lt=1
    )
    lag: float = number(
        "of the downwash, about its distance over the speed", "s", 0.0, ge=0, le=5
    )


class Following(Section):
    """Lift that follows angle of attack and speed, strip by strip."""

    area: float = number("of the wing", "m²", gt=0)
    slope: float = number("lift coefficient over angle of attack", "1/rad", gt=0, le=10)
    density: float = number("of the air", "kg/m³", 1.225, gt=0, le=2)
    pitch_damping: float = number(
        "moment against the pitch rate at the touchdown speed, beside what the strips "
        "give",
        "N m s/rad",
        0.0,
        ge=0,
    )
    tail: Tail | None = Field(default=None, description="default none")


class ReverseThrust(Section):
    """Force aft along the runway."""

    nodes: tuple[int, ...] = Field(
        min_length=1, description="grids of the engines, equal shares"
    )
    table: list[tuple[float, float]] = Field(
        min_length=2, description="time (s, ascending) against force of all, N"
    )

    @model_validator(mode="after")
    def _over_time(self) -> Self:
        times = [time for time, _ in self.table]
        if any(b <= a for a, b in pairwise(times)):
            raise ValueError(
                f"table: found the times {', '.join(f'{t:g}' for t in times)} s, "
                "expected strictly ascending ones"
            )
        if self.table[0][1] != 0.0:
            raise ValueError(
                f"table: begins with {self.table[0][1]:g} N, expected 0 N: the flight "
                "before touchdown is without"
            )
        return self


class Lift(Section):
    """Gravity acts, and nodes of the wing carry the aircraft."""

    nodes: tuple[int, ...] = Field(
        default=(),
        description="grids that carry the lift, round the centre of gravity; the "
        "built-in models have their own",
    )
    shares: tuple[float, ...] | None = Field(
        default=None,
        description="of each node, >= 0, tilted such that the resultant passes the "
        "centre of gravity; default equal",
    )
    factor: float = number("lift over weight at touchdown", "1", 1.0, ge=0, le=1.5)
    decay_start: float = number("when the lift begins to fall", "s", 0.0, ge=0)
    decay_duration: float | None = Field(
        default=None, gt=0, description="how long it falls, s; default: it stays"
    )
    remaining: float = number("lift over weight after the fall", "1", 0.0, ge=0, le=1.5)
    follows: Following | None = Field(
        default=None,
        description="how the lift changes with the motion of the aircraft, beside its "
        "fall; default: not at all",
    )
    reverse_thrust: ReverseThrust | None = Field(
        default=None, description="of the engines; default none"
    )

    @property
    def further_nodes(self) -> dict[int, str]:
        """Grids of tail and engines -> field that names them."""
        tail = self.follows.tail.nodes if self.follows and self.follows.tail else ()
        engines = self.reverse_thrust.nodes if self.reverse_thrust else ()
        return {
            **dict.fromkeys(tail, "follows.tail.nodes"),
            **dict.fromkeys(engines, "reverse_thrust.nodes"),
        }

    @model_validator(mode="after")
    def _carries(self) -> Self:
        if self.follows and not self.factor > 0:
            raise ValueError(
                f"factor: found {self.factor:g} beside follows, expected > 0: the lift "
                "of the flight before touchdown"
            )
        return self

    @model_validator(mode="after")
    def _one_share_each(self) -> Self:
        if self.shares is not None and len(self.shares) != len(self.nodes):
            raise ValueError(
                f"shares: {len(self.shares)} for {len(self.nodes)} nodes, expected one "
                "each"
            )
        return self


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
    file: Path = Field(
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
    def _readable(self, info: ValidationInfo) -> Self:
        folder = (info.context or {}).get("folder")
        if folder:
            object.__setattr__(self, "file", Path(folder, self.file))
        if not self.file.is_file():
            raise ValueError(f"no such file: {self.file}")
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
        if (self.iso_class is None) == (self.intensity is None):
            raise ValueError("give either iso_class or intensity")
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
        default="dry", description="sets the friction of the tyres"
    )
    friction_factor: float | None = Field(
        default=None,
        ge=0,
        description="factor on the tyres' dry friction, in place of the surface's",
    )
    profile: AnyProfile | None = Field(
        default=None,
        description="height over distance ahead of the foremost tyre; default flat",
    )
    crown: float = number(
        "fall to either side of the centre line, over distance", "1", 0.0, ge=0, le=0.1
    )
    offset: float = number(
        "of the aircraft at the start from the centre line, to starboard",
        "m",
        0.0,
        ge=-50,
        le=50,
    )


AnyLift = Annotated[
    Annotated[Literal["weight", "none"], Tag("(name)")]
    | Annotated[Lift, Tag("(lift)")],
    Discriminator(lambda value: "(name)" if isinstance(value, str) else "(lift)"),
]


def _sink_rate_or_preset(schema: dict[str, Any]) -> None:
    """A preset, and an aircraft that rolls, bring a sink rate with them."""
    schema["required"].remove("sink_rate")
    rolling = {"properties": {"start": {"const": "rolling"}}, "required": ["start"]}
    presets = {"properties": {"preset": {"type": "string"}}, "required": ["preset"]}
    schema["anyOf"] = [{"required": ["sink_rate"]}, presets, rolling]


class Scenario(Section):
    """State of the aircraft at the start. Zero angles: level, on the track."""

    model_config = ConfigDict(json_schema_extra=_sink_rate_or_preset)

    preset: PresetName | None = Field(
        default=None,
        description="condition of CS-25 that fills in what is not given here",
    )
    start: Literal["touchdown", "rolling"] = Field(
        default="touchdown",
        description="touchdown: just above the runway; rolling: at rest on the gears, "
        "but for the forward speed",
    )
    sink_rate: float = number(
        "vertical speed at touchdown (rolling: its energy is the reference of the "
        "energy balance)",
        "m/s",
        gt=0,
        le=10,
    )
    forward_speed: float = number("along the runway", "m/s", 67.0, ge=0, le=150)
    side_speed: float = number("toward starboard", "m/s", 0.0, ge=-30, le=30)
    pitch: float = number("nose up", "deg", 0.0, ge=-20, le=30)
    roll: float = number("starboard wing down", "deg", 0.0, ge=-30, le=30)
    yaw: float = number(
        "nose to starboard of the track (drift, side-slip)", "deg", 0.0, ge=-45, le=45
    )
    pitch_rate: float = number("nose up", "deg/s", 0.0, ge=-30, le=30)
    roll_rate: float = number("starboard wing down", "deg/s", 0.0, ge=-60, le=60)
    yaw_rate: float = number("nose to starboard", "deg/s", 0.0, ge=-30, le=30)
    lift: AnyLift = Field(
        default="weight",
        description="weight: lift balances the weight, neither acts, all responses are "
        "increments to steady flight; none: gravity alone; or nodes that carry it",
    )
    braking: float = number(
        "share of the gears' brake torques that is applied", "1", 0.0, ge=0, le=2
    )
    runway: RunwaySection = Field(default=RunwaySection(), description="the ground")
    one_gear: Literal["starboard", "port"] | None = Field(
        default=None,
        description="25.483: the airframe gets the loads of the gear on that side "
        "alone, as this landing has made them; inertia reacts what is unbalanced",
    )

    @model_validator(mode="before")
    @classmethod
    def _fill_in(cls, data: Any) -> Any:
        if not isinstance(data, dict):
            return data
        name = data.get("preset")
        preset = PRESETS.get(name) if isinstance(name, str) else None
        filled = {**(preset.values if preset else {}), **data}
        unknown = name is not None and preset is None  # one message is enough
        if filled.get("start") == "rolling" or unknown:
            filled.setdefault("sink_rate", LANDING_SINK_RATE)
        return filled

    @model_validator(mode="after")
    def _one_gear(self) -> Self:
        if self.one_gear and (self.lift != "weight" or self.start != "touchdown"):
            raise ValueError(
                "one_gear: found it with lift or an aircraft that rolls, expected a "
                "touchdown with lift: weight"
            )
        return self

    @model_validator(mode="after")
    def _rolling(self) -> Self:
        if self.start == "touchdown":
            return self
        if self.lift == "weight":
            raise ValueError(
                "lift: found 'weight', expected none or nodes where the aircraft rolls "
                "on its gears: gravity must act"
            )
        moving = ("side_speed", "pitch_rate", "roll_rate", "yaw_rate")
        given = (*moving, "pitch", "roll", "yaw")
        turned = [name for name in given if getattr(self, name)]
        if turned:
            raise ValueError(
                f"{', '.join(turned)}: an aircraft that rolls at the start stands as "
                "its gears let it, expected 0"
            )
        return self

    @property
    def remarks(self) -> tuple[str, ...]:
        """What is odd; begins with the field."""
        if self.one_gear:
            return (
                "scenario.one_gear: tables of gears, tires and energies are those of "
                "the landing on all gears; attachment loads, accelerations and what "
                f"the full model answers are those of the {self.one_gear} gear alone, "
                "with the inertia of the airframe without gears",
                *self._fast,
            )
        return self._fast

    @property
    def _fast(self) -> tuple[str, ...]:
        if self.start != "touchdown" or self.sink_rate <= _RESERVE_SINK_RATE:
            return ()
        return (
            f"scenario.sink_rate: found {self.sink_rate:g} m/s, more than the "
            f"{_RESERVE_SINK_RATE:g} m/s (12 ft/s) of the reserve energy drop of "
            f"25.723(b); {self.sink_rate:g} ft/s would be "
            f"{0.3048 * self.sink_rate:.3g} m/s",
        )

    @property
    def preset_data(self) -> Preset | None:
        """Of the preset, if any."""
        return PRESETS[self.preset] if self.preset else None

    @property
    def gravity(self) -> bool:
        """Gravity acts."""
        return self.lift != "weight"

    @property
    def story(self) -> str:
        """What the aircraft does, e.g. `touched down at 3.05 m/s sink rate ...`."""
        angles = {"pitch": self.pitch, "roll": self.roll, "yaw": self.yaw}
        turned = [f"{name} {value:g}°" for name, value in angles.items() if value]
        if self.start == "rolling":
            parts = [f"rolled at {self.forward_speed:g} m/s"]
        else:
            parts = [
                f"touched down at {self.sink_rate:g} m/s sink rate and "
                f"{self.forward_speed:g} m/s",
                *(turned or ["level"]),
            ]
        profile = self.runway.profile
        parts += [f"{self.runway.surface} runway"] * (self.runway.surface != "dry")
        parts += [f"profile: {profile.kind}"] if profile else []
        parts += [f"crown {100 * self.runway.crown:g} %"] * (self.runway.crown > 0)
        parts += ["brakes applied"] * (self.braking > 0)
        parts += [f"loads of the {self.one_gear} gear alone"] * bool(self.one_gear)
        parts += ["preset " + self.preset] if self.preset else []
        return ", ".join(parts)

    @property
    def lift_story(self) -> str:
        """How lift and weight act."""
        if self.lift == "weight":
            return "lift balances the weight, and neither is applied"
        if self.lift == "none" or not isinstance(self.lift, Lift):
            return "gravity without lift"
        lift = self.lift
        text = (
            f"gravity, lift {lift.factor:g} of the weight over {len(lift.nodes)} grids"
        )
        text += ", following the angle of attack" if lift.follows else ""
        text += ", reverse thrust" if lift.reverse_thrust else ""
        if lift.decay_duration is None:
            return text
        end = lift.decay_start + lift.decay_duration
        return (
            f"{text}, falling to {lift.remaining:g} from {lift.decay_start:g} to "
            f"{end:g} s"
        )

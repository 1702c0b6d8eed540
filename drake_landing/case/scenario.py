"""What an aircraft does at the start of a run: touches down, or rolls on its gears.

Zero angles: level, along the track. A `preset` stands for a condition of CS-25 and
fills in whatever is not given beside it.
"""

from typing import Any, Literal, Self

from pydantic import (
    ConfigDict,
    Field,
    model_validator,
)

from drake_landing.case.lift import AnyLift
from drake_landing.case.lift import Lift as Lift
from drake_landing.case.presets import LANDING_SINK_RATE, PRESETS, PresetName
from drake_landing.case.runway import RunwaySection
from drake_landing.case.section import Section, number

_RESERVE_SINK_RATE = 3.66  # m/s, 14 CFR 25.723(b)


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
        """Odd values; each remark begins with the field."""
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
    def gravity(self) -> bool:
        """Gravity acts."""
        return self.lift != "weight"

    @property
    def story(self) -> str:
        """What the aircraft does, e.g. `touched down at 3.05 m/s sink rate ...`."""
        angles = {
            "pitch": (self.pitch, "nose up", "nose down"),
            "roll": (self.roll, "starboard wing down", "port wing down"),
            "yaw": (self.yaw, "nose to starboard", "nose to port"),
        }
        turned = [
            f"{name} {abs(value):g}° {down if value < 0.0 else up}"
            for name, (value, up, down) in angles.items()
            if value
        ]
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

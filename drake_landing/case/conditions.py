"""What a case says of the ground-load conditions of the rules."""

from typing import Literal

from pydantic import Field

from drake_landing.case.section import Section, number

Role = Literal["nose", "main", "tail"]


class Conditions(Section):
    """Static cases of the rules for the mass of a case (`drake-landing conditions`)."""

    rules: Literal["CS-25", "CS-23"] = Field(
        default="CS-25", description="CS-25 (14 CFR 25), or CS-23 before Amendment 64"
    )
    weight: Literal["landing", "take_off"] = Field(
        default="take_off",
        description="which design weight the mass of the case is: landing, or "
        "take-off (ramp); sets the sink rate and which paragraphs apply",
    )
    sink_rate: float | None = Field(
        default=None,
        gt=0,
        le=10,
        description="of the landings that give the largest vertical loads, m/s; "
        "default the rule's: 3.048 at the landing, 1.8288 at the take-off weight; "
        "CS-23 4.4 (W/S)^1/4 ft/s",
    )
    forward_speed: float = number(
        "of these landings; with stall_speed they are flown at V_L1 and 1.25 V_L2 "
        "(tail-down V_L2) instead",
        "m/s",
        67.0,
        gt=0,
        le=150,
    )
    level_pitch: float = number(
        "of the landing on main wheels", "deg", 2.0, ge=-20, le=30
    )
    tail_down_pitch: float = number(
        "of the tail-down landing", "deg", 10.0, ge=0, le=30
    )
    vertical: dict[str, float] = Field(
        default={},
        description="gear -> its largest vertical load in the level landing, N, "
        "instead of landings; a nose gear's is that of the landing on all gears",
    )
    roles: dict[str, Role] = Field(
        default={},
        description="gear -> nose, main or tail; default by their places",
    )
    steering_torque: float | None = Field(
        default=None, gt=0, description="full normal torque of the steering, N m"
    )
    pitch_damping: float | None = Field(
        default=None,
        ge=0,
        lt=1,
        description="ratio of pitching about the main wheels, of 25.493(e); default "
        "its f = 2",
    )
    wing_area: float | None = Field(default=None, gt=0, description="m², for CS-23")
    stall_speed: float | None = Field(
        default=None,
        gt=0,
        le=150,
        description="V_S0 in the landing, m/s: V_L1, V_L2 of CS-25, spin-up by "
        "Appendix D of CS-23",
    )
    altitude: float = number(
        "of the highest airfield, for V_L2 at ISA + 22.8 K", "m", 0.0, ge=0, le=6000
    )

"""Landing and ground-handling conditions of CS-25 (14 CFR Part 25), Subpart C.

Each preset is a set of values for the fields of `Scenario`; any of them can be given
otherwise beside the preset. The paragraphs prescribe attitudes, speeds and sink rates;
where they leave a choice, the values are examples for a transport of 70 t. The static
ratios are what the paragraph asks for where no rational analysis is made: drag and side
over vertical, by gear.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

PresetName = Literal[
    "three_point",
    "two_point",
    "tail_down",
    "rolled",
    "drift",
    "rebound",
    "taxi_bump",
    "braked_roll",
    "reserve_energy",
]

LANDING_SINK_RATE = 3.048
"""10 ft/s at the design landing weight, 25.473(a)(2), m/s."""
TAKE_OFF_SINK_RATE = 1.8288
"""6 ft/s at the design take-off weight, 25.473(a)(3), m/s."""
RESERVE_SINK_RATE = 3.6576
"""12 ft/s at the design landing weight, 25.723(b), m/s."""

_LANDING_MASS = "design landing weight; with sink_rate 1.8288 design take-off weight"


@dataclass(frozen=True, kw_only=True)
class Preset:
    """One condition.

    Attributes:
        paragraph: of CS-25.
        title: in words.
        values: of `Scenario`.
        mass: what the paragraph says of the mass; the mass is that of the case.
        remarks: what is left to the case, and how the condition is read here.
        duration: a run that shows the peaks of all gears, s.
        symmetric: port and starboard see the same.
        static_ratios: quantity -> ratio to the vertical load that the paragraph asks
            for without a rational analysis.
    """

    paragraph: str
    title: str
    values: Mapping[str, Any]
    mass: str
    remarks: str
    duration: float
    symmetric: bool = True
    static_ratios: Mapping[str, float] = field(default_factory=dict)


PRESETS: dict[PresetName, Preset] = {
    "three_point": Preset(
        paragraph="25.479(c)(2)",
        title="level landing, nose and main wheels touch together",
        values={"sink_rate": LANDING_SINK_RATE, "forward_speed": 67.0, "pitch": 0.0},
        mass=_LANDING_MASS,
        remarks="forward_speed from V_L1 to 1.25 V_L2; pitch at which all wheels "
        "touch at once",
        duration=0.5,
        static_ratios={"drag": 0.25},
    ),
    "two_point": Preset(
        paragraph="25.479(c)(1)",
        title="level landing on the main wheels, nose wheel just clear",
        values={"sink_rate": LANDING_SINK_RATE, "forward_speed": 67.0, "pitch": 2.0},
        mass=_LANDING_MASS,
        remarks="forward_speed from V_L1 to 1.25 V_L2; the nose comes down later",
        duration=0.5,
        static_ratios={"drag": 0.25},
    ),
    "tail_down": Preset(
        paragraph="25.481",
        title="tail-down landing",
        values={"sink_rate": LANDING_SINK_RATE, "forward_speed": 58.0, "pitch": 10.0},
        mass=_LANDING_MASS,
        remarks="forward_speed from V_L1 to V_L2; pitch of the stall, or the largest "
        "that keeps the tail clear of the runway",
        duration=0.5,
    ),
    "rolled": Preset(
        paragraph="beside 25.483",
        title="rolled landing, one main gear first",
        values={
            "sink_rate": LANDING_SINK_RATE,
            "forward_speed": 67.0,
            "pitch": 2.0,
            "roll": 5.0,
        },
        mass=_LANDING_MASS,
        remarks="the starboard main gear touches first, the inertia of the aircraft "
        "resists; the other gear follows as the aircraft rolls back. Not the rule's "
        "condition, which takes the load of the level landing on one side "
        "(drake-landing conditions): a rolled landing loads the gear more",
        duration=0.5,
        symmetric=False,
    ),
    "drift": Preset(
        paragraph="25.479(d)(2)",
        title="lateral drift landing",
        values={
            "sink_rate": LANDING_SINK_RATE,
            "forward_speed": 67.0,
            "pitch": 2.0,
            "yaw": 5.0,
        },
        mass=_LANDING_MASS,
        remarks="yaw is the side-slip on the runway: the track is along it. Without "
        "rational analysis 75 % of the largest vertical load, with 40 % of that as "
        "drag and 25 % to the side; 25.485 is a condition of its own (drake-landing "
        "conditions)",
        duration=0.5,
        symmetric=False,
        static_ratios={"drag": 0.40, "side": 0.25},
    ),
    "rebound": Preset(
        paragraph="25.487",
        title="rebound: the gears extend as the aircraft leaves the runway",
        values={"sink_rate": LANDING_SINK_RATE, "forward_speed": 67.0, "pitch": 2.0},
        mass=_LANDING_MASS,
        remarks="a two-point landing, long enough for the gears to reach their "
        "extension stops in the air. 25.487(b) in any case asks for 20 g on the "
        "unsprung parts (drake-landing conditions)",
        duration=1.2,
    ),
    "taxi_bump": Preset(
        paragraph="25.491",
        title="taxi over a bump",
        values={
            "start": "rolling",
            "forward_speed": 30.0,
            "lift": "none",
            "runway": {"profile": {"kind": "bump", "height": 0.05, "length": 10.0}},
        },
        mass="design ramp weight",
        remarks="an example bump; give the profile of the roughest runway that may be "
        "expected, and speeds up to lift-off",
        duration=1.5,
    ),
    "braked_roll": Preset(
        paragraph="25.493",
        title="braked roll, brakes applied at once",
        values={
            "start": "rolling",
            "forward_speed": 40.0,
            "lift": "none",
            "braking": 1.0,
        },
        mass="design ramp weight, and design landing weight",
        remarks="needs gears with brakes; without rational analysis 0.8 of the "
        "vertical load as drag, no more than the brakes give; 25.493(e) asks for the "
        "dynamic load of the nose gear that this run shows",
        duration=1.5,
        static_ratios={"drag": 0.8},
    ),
    "reserve_energy": Preset(
        paragraph="25.723(b)",
        title="reserve energy: level landing at 12 ft/s",
        values={"sink_rate": RESERVE_SINK_RATE, "forward_speed": 67.0, "pitch": 2.0},
        mass="design landing weight",
        remarks="lift not above the weight; the gear must not fail",
        duration=0.5,
    ),
}

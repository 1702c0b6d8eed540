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
    "one_gear",
    "rolled",
    "drift",
    "rebound",
    "taxi_bump",
    "braked_roll",
    "reserve_energy",
    "high_drag",
    "second_touchdown",
    "crosswind",
    "derotation",
    "taxi",
    "take_off_run",
    "landing_roll",
]

LANDING_SINK_RATE = 3.048
"""10 ft/s at the design landing weight, 25.473(a)(2), m/s."""
TAKE_OFF_SINK_RATE = 1.8288
"""6 ft/s at the design take-off weight, 25.473(a)(3), m/s."""
RESERVE_SINK_RATE = 3.6576
"""12 ft/s at the design landing weight, 25.723(b), m/s."""

# Rough ground under wheels of different tracks: short waves differ, long ones do not.
_TRACKS = {
    "kind": "roughness",
    "length": 400.0,
    "run_in": 20.0,
    "track_spacing": 5.0,
}


def _rough(iso_class: str) -> dict[str, Any]:
    return {"profile": {**_TRACKS, "iso_class": iso_class}}


_PROFILE_REMARK = (
    "a random profile of two tracks stands for the roughest ground that may be "
    "expected (AC 25.491-1 takes San Francisco 28R as it was): give a measured one "
    "with runway.profile, and speeds"
)
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
        speeds: of V_L2, the upper end of the speeds of its rule; 0: it names none.
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
    speeds: float = 0.0
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
        speeds=1.25,
        duration=0.5,
        static_ratios={"drag": 0.25},
    ),
    "two_point": Preset(
        paragraph="25.479(c)(1)",
        title="level landing on the main wheels, nose wheel just clear",
        values={"sink_rate": LANDING_SINK_RATE, "forward_speed": 67.0, "pitch": 2.0},
        mass=_LANDING_MASS,
        remarks="forward_speed from V_L1 to 1.25 V_L2; the nose comes down later",
        speeds=1.25,
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
        speeds=1.0,
        duration=0.5,
    ),
    "one_gear": Preset(
        paragraph="25.483",
        title="one-gear landing",
        values={
            "sink_rate": LANDING_SINK_RATE,
            "forward_speed": 67.0,
            "pitch": 2.0,
            "one_gear": "starboard",
        },
        mass=_LANDING_MASS,
        remarks="the loads over time that the gear of that side has in the level "
        "landing on both; the airframe, without gears, reacts what is unbalanced by "
        "its inertia. The static peak: drake-landing conditions",
        speeds=1.25,
        duration=0.5,
        static_ratios={"drag": 0.25},
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
        speeds=1.25,
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
        speeds=1.25,
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
        speeds=1.25,
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
    "high_drag": Preset(
        paragraph="beside 25.479",
        title="level landing with the brakes on",
        values={
            "sink_rate": LANDING_SINK_RATE,
            "forward_speed": 67.0,
            "pitch": 2.0,
            "braking": 1.0,
        },
        mass=_LANDING_MASS,
        remarks="brakes applied before touchdown: the drag does not end with spin-up "
        "but lasts to the vertical peak. Needs gears with brakes; anti-skid limits it "
        "where the brakes have one",
        duration=0.5,
    ),
    "second_touchdown": Preset(
        paragraph="beside 25.479, 25.487",
        title="bounced landing: the aircraft leaves the runway and comes down again",
        values={
            "sink_rate": LANDING_SINK_RATE,
            "forward_speed": 67.0,
            "pitch": 2.0,
            "lift": {"decay_start": 0.4, "decay_duration": 1.0, "remaining": 0.3},
        },
        mass=_LANDING_MASS,
        remarks="lift falls while the aircraft rebounds; the second touchdown meets "
        "gears that have just extended. lift.nodes: grids that carry the lift of a "
        "deck of one's own; how fast and how far it falls",
        duration=2.2,
    ),
    "crosswind": Preset(
        paragraph="beside 25.479(d)(2)",
        title="crosswind landing, wing low and nose not quite along the track",
        values={
            "sink_rate": LANDING_SINK_RATE,
            "forward_speed": 67.0,
            "pitch": 2.0,
            "roll": 3.0,
            "yaw": 3.0,
        },
        mass=_LANDING_MASS,
        remarks="wing and nose toward the wind from starboard; the air's forces do not "
        "change in so short a time",
        duration=0.6,
        symmetric=False,
    ),
    "derotation": Preset(
        paragraph="beside 25.479(c)",
        title="derotation: the nose comes down fast on the rolling aircraft",
        values={
            "sink_rate": 1.0,
            "forward_speed": 67.0,
            "pitch": 3.0,
            "pitch_rate": -6.0,
        },
        mass=_LANDING_MASS,
        remarks="the pitch rate at touchdown, nose down; the vertical speed of the "
        "nose wheel is that of the aircraft and of the rate times its distance",
        duration=0.9,
    ),
    "taxi": Preset(
        paragraph="25.491",
        title="taxi over rough ground, wheels on different tracks",
        values={
            "start": "rolling",
            "forward_speed": 15.0,
            "lift": "none",
            "runway": _rough("B"),
        },
        mass="design ramp weight",
        remarks=_PROFILE_REMARK,
        duration=4.0,
        symmetric=False,
    ),
    "take_off_run": Preset(
        paragraph="25.491",
        title="take-off run over a rough runway",
        values={
            "start": "rolling",
            "forward_speed": 60.0,
            "lift": "none",
            "runway": _rough("A"),
        },
        mass="design take-off weight",
        remarks=_PROFILE_REMARK + ". Without lift: lift.nodes and factor give it",
        duration=3.0,
        symmetric=False,
    ),
    "landing_roll": Preset(
        paragraph="25.491",
        title="landing roll over a rough runway, braked",
        values={
            "start": "rolling",
            "forward_speed": 50.0,
            "lift": "none",
            "braking": 0.5,
            "runway": _rough("A"),
        },
        mass="design landing weight",
        remarks=_PROFILE_REMARK
        + "; share of the brake torque. Needs gears with brakes",
        duration=3.0,
        symmetric=False,
    ),
}

"""CS-25 (14 CFR 25) ground loads, 25.471 to 25.519: every paragraph."""

from drake_landing.conditions import flat_tires25, rolling25, towing25, turning25
from drake_landing.conditions import landing25 as landing
from drake_landing.conditions.paragraph import (
    Paragraph,
    needs_brakes,
    needs_largest,
    needs_mains,
    needs_nose,
    needs_several_wheels,
    needs_sides,
    needs_steering,
    needs_tail,
    needs_tail_down,
)

_LANDING = (needs_mains, needs_largest)

CS25: tuple[Paragraph, ...] = (
    Paragraph(
        number="25.471",
        title="general",
        rule="the loads are in equilibrium with linear and angular inertia; the "
        "critical centers of gravity for each element of the gear, fore and aft, "
        "vertical and lateral (random lateral shifts that add no more than 3 % to the "
        "loads of a main gear may be let go)",
        does="mass cases of a campaign, each with its own center of gravity; every "
        "static case is balanced, and its equilibrium is printed",
    ),
    Paragraph(
        number="25.473",
        title="landing load conditions and assumptions",
        rule="10 ft/s (3.048 m/s) at the landing weight, 6 ft/s (1.829 m/s) at the "
        "take-off weight; lift no more than the weight; friction need not exceed 0.8; "
        "gear dynamics, spin-up, spring-back, rigid body and airframe modeled",
        does="the landing run gives the largest vertical loads; sink rate by "
        "conditions.weight",
    ),
    Paragraph(
        number="25.477",
        title="landing gear arrangement",
        rule="25.479 to 25.485 hold for conventional nose or tail wheels",
        does="roles of the gears from their places, or conditions.roles",
    ),
    Paragraph(
        number="25.479(a)-(c)",
        title="level landing",
        rule="main wheels with the nose wheel just clear, and all wheels; speeds from "
        "V_L1 to 1.25 V_L2",
        does="dynamic presets at the speeds that the case gives",
        presets=("two_point", "three_point"),
    ),
    Paragraph(
        number="25.479(d)(1)",
        title="level landing, largest vertical load",
        rule="in addition: the largest vertical load with a drag of at least 25 % of "
        "it, at the axle",
        unsure="at the axle",
        does="static cases: main gears at level_pitch, all gears in the attitude in "
        "which all wheels stand on the ground",
        cases=landing.level_drag,
        needs=_LANDING,
    ),
    Paragraph(
        number="25.479(d)(2)",
        title="drift",
        rule="rational, or 75 % of the largest vertical load with 40 % of that as "
        "drag and 25 % to the side; deflections 75 %",
        unsure="deflections 75 %",
        does="static cases to both sides, at the ground; rational: preset drift",
        cases=landing.drift,
        presets=("drift",),
        needs=_LANDING,
    ),
    Paragraph(
        number="25.481",
        title="tail-down landing",
        rule="pitch of the stall or of the tail clear, main wheels, V_L1 to V_L2; "
        "vertical and drag loads at the axle (no share of 25 %)",
        does="dynamic preset; its vertical peak as a static case",
        cases=landing.tail_down,
        presets=("tail_down",),
        needs=(needs_mains, needs_tail_down),
    ),
    Paragraph(
        number="25.483",
        title="one-gear landing",
        rule="level, one main gear: the loads of that side of 25.479(d)(1); the "
        "unbalanced ones are reacted by inertia",
        does="static cases for each main gear; over time: preset one_gear; preset "
        "rolled is another condition, with larger loads",
        cases=landing.one_gear,
        presets=("one_gear", "rolled"),
        needs=_LANDING,
    ),
    Paragraph(
        number="25.485",
        title="side load",
        rule="level, main wheels: half of the largest vertical load each, 0.8 of it "
        "inward on one side and 0.6 outward on the other at once; no drag; at the "
        "ground",
        does="static cases to both sides",
        cases=landing.side,
        needs=(*_LANDING, needs_sides),
    ),
    Paragraph(
        number="25.487",
        title="rebound",
        rule="gears extended, off the ground: 20 g must act on the unsprung parts in "
        "the direction in which they extend",
        does="static cases; the rational motion: preset rebound",
        cases=landing.rebound,
        presets=("rebound",),
        needs=(needs_mains,),
    ),
    Paragraph(
        number="25.489",
        title="ground handling",
        rule="25.491 to 25.509 at the ramp weight, no lift; deflections may be static",
        does="so it is",
    ),
    Paragraph(
        number="25.491",
        title="taxi, take-off and landing roll",
        rule="the roughest ground that may reasonably be expected; AMC 25.491: "
        "profiles, or 1.7 times the loads at rest",
        does="presets over profiles with one or two tracks; the discrete load as a "
        "static case",
        mark="secondary",
        cases=rolling25.taxi,
        presets=("taxi_bump",),
    ),
    Paragraph(
        number="25.493(b)",
        title="braked roll",
        rule="n = 1.2 at the landing, 1.0 at the ramp weight; drag 0.8 of the "
        "vertical load at braked wheels, less where the brakes give less; (1) all "
        "gears, no pitching acceleration, (2) main gears, pitching by inertia",
        does="static cases (1) and (2); the remark says where the brakes limit the "
        "drag",
        cases=rolling25.braked_roll,
        needs=(needs_mains, needs_brakes),
    ),
    Paragraph(
        number="25.493(d), (e)",
        title="brakes at once",
        rule="take-off weight: static nose load with the largest dynamic increment, "
        "or by the formula, f = 2 or by the pitch damping",
        does="static case by the formula; rational: preset braked_roll",
        mark="memory",
        cases=rolling25.sudden_braking,
        presets=("braked_roll",),
        needs=(needs_nose, needs_brakes),
        design=("take_off",),
    ),
    Paragraph(
        number="25.495",
        title="turning",
        rule="n_z 1.0, n_y 0.5; side load of every wheel 0.5 of its vertical load",
        does="static cases to both sides; vertical loads from equilibrium in roll",
        cases=turning25.turning,
        needs=(needs_sides,),
        design=("take_off",),
    ),
    Paragraph(
        number="25.497",
        title="tail wheel yawing",
        rule="load at rest with as much to the side: swivelled 90° through the axle; "
        "with a lock, steering or damper also trailing, at the ground",
        does="static cases",
        cases=turning25.tail_wheel_yaw,
        needs=(needs_tail,),
        design=("take_off",),
    ),
    Paragraph(
        number="25.499(a)",
        title="nose wheel yaw",
        rule="n = 1, side load 0.8 of the vertical load at the nose wheel's ground "
        "point",
        does="static cases to both sides",
        mark="memory",
        cases=turning25.nose_yaw,
        needs=(needs_nose,),
        design=("take_off",),
    ),
    Paragraph(
        number="25.499(b)-(d)",
        title="brakes of one side",
        rule="drag 0.8 of the vertical load of one main gear; side and vertical loads "
        "of the nose wheel from equilibrium, n_y = 0; nose side load need not exceed "
        "0.8 of its vertical load, inertia takes the rest",
        does="static cases for both sides",
        mark="memory",
        cases=turning25.one_side_braked,
        needs=(needs_nose, needs_brakes, needs_sides),
        design=("take_off",),
    ),
    Paragraph(
        number="25.499(e)",
        title="nose wheel steering",
        rule="full normal steering torque with 1.33 times the largest load at rest",
        does="static cases both ways",
        mark="memory",
        cases=turning25.steering,
        needs=(needs_nose, needs_steering),
        design=("take_off",),
    ),
    Paragraph(
        number="25.503",
        title="pivoting",
        rule="about one main gear with locked brakes, n = 1, friction 0.8, static "
        "equilibrium of loads at the ground",
        does="static cases: torque 0.8 Z times the wheels' mean distance from their "
        "middle, held by side loads of nose and locked gear; named by the way in which "
        "that torque turns the nose",
        cases=turning25.pivoting,
        needs=(needs_brakes, needs_several_wheels),
        design=("take_off",),
    ),
    Paragraph(
        number="25.507",
        title="reversed braking",
        rule="three-point: forward load 0.55 of the vertical load at braked wheels, "
        "or of 1.2 times the largest static brake torque; nose wheel types: pitching "
        "by inertia",
        does="static case",
        cases=rolling25.reversed_braking,
        needs=(needs_brakes,),
        design=("take_off",),
    ),
    Paragraph(
        number="25.509",
        title="towing",
        rule="F = 0.3 W to 30 000 lb, (6 W + 450 000)/70 to 100 000 lb, 0.15 W above: "
        "main gears 0.75 F each, parallel and at 30°; nose or tail F, at 45° 0.5 F; "
        "reacted at the axle up to its vertical load and by inertia, or by inertia",
        unsure="nose and tail: F, 45°, 0.5 F",
        does="static cases, both reactions; the fitting is taken at the axle",
        cases=towing25.towing,
        design=("take_off",),
    ),
    Paragraph(
        number="25.511(b)",
        title="several wheels, tires inflated",
        rule="shares of the wheels of a gear by their arrangement (of bogies by their "
        "seesaw), two thirds of the worst difference of tire diameters, pressures "
        "±5 %, crown 0 and 1.5 % with the nose gear on either slope, attitude, "
        "deflection of the structure; the shift of the load's middle may be neglected "
        "for the load on the gear",
        does="dynamic runs with a tire of its own per wheel (gears.<name>.tyres: "
        "radius, inflation), runway.crown and offset; bogies seesaw. No static cases: "
        "without the shift no load on gear or airframe changes, only those of axles "
        "and wheels, which are no parts of the airframe",
    ),
    Paragraph(
        number="25.511(c), (d)",
        title="flat tires, landing",
        rule="one flat tire 60 %, two (of four or more wheels) 50 % of the gear's "
        "loads; 25.485: the whole vertical load; not with drift",
        unsure="60 %, 50 %; the whole load of 25.485 was read",
        does="static cases; the shift of the load's middle is let go",
        cases=landing.flat_tire_landing,
        needs=(*_LANDING, needs_several_wheels),
    ),
    Paragraph(
        number="25.511(e), (f)",
        title="flat tires, handling",
        rule="side and drag factors up to 50 and 40 % of the limit; braked roll: no "
        "less than of each inflated tire before; n 60, 50 %, no less than 1; tow 60, "
        "50 %",
        does="static cases of turning, braked roll (where there are brakes), towing",
        cases=flat_tires25.flat_tire_handling,
        needs=(needs_several_wheels, needs_sides),
        design=("take_off",),
    ),
    Paragraph(
        number="25.519",
        title="jacking, tie-down",
        rule="gears at the ramp weight: 1.33 of the load at rest, alone and with 0.33 "
        "of it any way; jack pads of the airframe at the jacking weight: the same, and "
        "with their local structure 2.0 of it, alone and with 0.33; tie-down points, "
        "where provided, in a horizontal wind of 65 kt from anywhere",
        does="static cases of gears. Jack pads and tie-down are the user's, as FORCE "
        "cards: their places are not in the deck, and the wind's loads, at 685 Pa of "
        "dynamic pressure, need coefficients of the standing aircraft",
        cases=towing25.jacking,
        design=("take_off",),
    ),
)

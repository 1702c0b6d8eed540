"""CS-23 (14 CFR 23 before Amendment 64) ground loads, 23.471 to 23.511."""

from drake_landing.conditions import cases23 as cases
from drake_landing.conditions.ground import GroundAircraft
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
)

_LANDING = (needs_mains, needs_largest)


def _needs_spin_up(aircraft: GroundAircraft) -> str:
    """What Appendix D asks for."""
    if aircraft.stall_speed is None:
        return "no stall speed in the landing (set conditions.stall_speed)"
    known = all(g.time_to_peak is not None for g in aircraft.mains)
    return (
        ""
        if known
        else (
            "the time to the vertical peak is not known (landings find it: set no "
            "conditions.vertical)"
        )
    )


CS23: tuple[Paragraph, ...] = (
    Paragraph(
        number="23.471",
        title="general",
        rule="loads and inertia are in equilibrium",
        does="every static case is balanced, and its equilibrium is printed",
    ),
    Paragraph(
        number="23.473",
        title="landing conditions and assumptions",
        rule="4.4 (W/S)^¼ ft/s, between 7 and 10; lift two thirds of the weight; n no "
        "less than 2.67 and on the ground 2.0",
        unsure="2.67, 2.0",
        does="sink rate of the landing from conditions.wing_area; both least factors",
    ),
    Paragraph(
        number="23.477",
        title="landing gear arrangement",
        rule="conventional nose or tail wheels",
        does="roles of the gears from their places, or conditions.roles",
        mark="memory",
    ),
    Paragraph(
        number="23.479",
        title="level landing",
        rule="nose wheel clear, and all wheels with inclined reactions; drag K n W of "
        "Appendix C, K = 0.25 to 0.33",
        does="static cases, at the axle; nose wheel clear at level_pitch, all wheels "
        "in the attitude in which they stand on the ground",
        cases=cases.level,
        needs=_LANDING,
    ),
    Paragraph(
        number="23.479(c)",
        title="spin-up, spring-back",
        rule="by Appendix D, no more than 0.8 of the vertical load; spring-back the "
        "same forward",
        does="static cases; rational: the landing run",
        cases=cases.spin_up,
        presets=("two_point",),
        needs=(*_LANDING, _needs_spin_up),
    ),
    Paragraph(
        number="23.481",
        title="tail-down landing",
        rule="vertical loads alone",
        does="static case",
        mark="memory",
        cases=cases.tail_down,
        presets=("tail_down",),
        needs=_LANDING,
    ),
    Paragraph(
        number="23.483",
        title="one-wheel landing",
        rule="level, one main gear with its loads of 23.479",
        does="static cases",
        cases=cases.one_wheel,
        needs=_LANDING,
    ),
    Paragraph(
        number="23.485",
        title="side load",
        rule="level, main wheels: n = 1.33 shared equally; 0.5 W inward on one side "
        "and 0.33 W outward on the other (of W, not of the reaction); static "
        "deflections",
        does="static cases to both sides",
        cases=cases.side,
        needs=(needs_sides,),
    ),
    Paragraph(
        number="23.493",
        title="braked roll",
        rule="n = 1.33, attitudes of 23.479, drag 0.8 of the vertical load of braked "
        "wheels, no more than the brakes give",
        does="static cases",
        cases=cases.braked_roll,
        needs=(needs_mains, needs_brakes),
    ),
    Paragraph(
        number="23.497",
        title="tail wheel",
        rule="obstruction: the tail-down reaction 45° up and aft through the axle; "
        "load at rest with as much to the side",
        does="static cases",
        mark="memory",
        cases=cases.tail_wheel,
        needs=(needs_tail, needs_largest),
    ),
    Paragraph(
        number="23.499",
        title="nose wheel",
        rule="2.25 times the load at rest with 0.8 aft, 0.4 forward (axle) or 0.7 to "
        "the side (ground)",
        does="static cases",
        cases=cases.nose_wheel,
        needs=(needs_nose,),
    ),
    Paragraph(
        number="23.499(e)",
        title="powered steering",
        rule="1.33 times the full torque with 1.33 times the load at rest",
        does="static cases",
        cases=cases.steering,
        needs=(needs_nose, needs_steering),
    ),
    Paragraph(
        number="23.505",
        title="skis",
        rule="0.036 W to the side near the tail",
        does="out of scope: no skis",
    ),
    Paragraph(
        number="23.507",
        title="jacking",
        rule="1.35 of the load at rest with 0.4 of it fore, aft and to the side, in "
        "all combinations",
        does="static cases at the gears; jack pads of the airframe are the user's",
        cases=cases.jacking,
    ),
    Paragraph(
        number="23.509",
        title="towing",
        rule="n = 1; main gears 0.225 W each, parallel and at 30°; nose or tail 0.3 "
        "W, at 45° 0.15 W; reacted as in 25.509",
        unsure="0.3",
        does="static cases, both reactions; the fitting is taken at the axle",
        cases=cases.towing23,
    ),
    Paragraph(
        number="23.511(a)",
        title="pivoting",
        rule="n = 1, friction 0.8",
        does="static cases, as 25.503",
        cases=cases.pivoting23,
        needs=(needs_brakes, needs_several_wheels),
    ),
    Paragraph(
        number="23.511(b), (c)",
        title="unequal and flat tires",
        rule="landing loads 60 to 40 % on twin wheels; one flat tire: 60 % of the "
        "landing loads, of 23.485 and 23.493 60 % of drag and side, the whole "
        "vertical load",
        does="static cases",
        cases=cases.unequal_tires,
        needs=(*_LANDING, needs_several_wheels, needs_sides),
    ),
)

"""The largest vertical loads of the landings that the rules start from."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from drake_landing.airframe.gear_places import pitch_of_all
from drake_landing.case.axes import gear_in_A
from drake_landing.case.conditions import Conditions
from drake_landing.case.design_values import LEVEL_FACTOR, touchdown_speeds
from drake_landing.case.scenario import Scenario
from drake_landing.case.simulation import Simulation
from drake_landing.conditions.cases23 import sink_rate as sink_rate_23
from drake_landing.conditions.poses import Deflections
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.parameters import shock_absorber_parameters, tire_parameters
from drake_landing.landing.history import LandingHistory
from drake_landing.landing.run import build_landing, fly
from fem.arrays import Float64
from fem.errors import InputError
from systems.airframe.modal_body import ModalBody
from systems.runway.runway import Runway
from systems.shock_absorber.strut_law import StrutLaw
from systems.tire.tire_law import TireLaw

SINK = {"landing": 3.048, "take_off": 1.8288}
"""10 and 6 ft/s, 25.473(a), m/s."""
_DURATION = 0.6  # s, in which all gears have had their peak
_CUTS = 60  # of a bisection


@dataclass(frozen=True, kw_only=True, eq=False)
class Peak:
    """Largest vertical load of a gear in a landing, and the deflections with it.

    Attributes:
        vertical: largest load, N.
        time: from its touchdown to it, s.
        at: deflections then.
    """

    vertical: float
    time: float
    at: Deflections


@dataclass(frozen=True, kw_only=True, eq=False)
class Peaks:
    """Landings: on the main wheels, on all wheels, tail-down; gear -> its peak."""

    level: Mapping[str, Peak] = field(default_factory=dict)
    all_wheels: Mapping[str, Peak] = field(default_factory=dict)
    tail_down: Mapping[str, Peak] = field(default_factory=dict)


def sink_rate(conditions: Conditions, mass: float) -> float:
    """Sink rate of the landings, m/s.

    Raises:
        InputError: CS-23 without a wing area.
    """
    if conditions.sink_rate is not None:
        return conditions.sink_rate
    if conditions.rules == "CS-25":
        return SINK[conditions.weight]
    if conditions.wing_area is None:
        raise InputError(
            "conditions.wing_area: found none, expected the wing area in m² (or "
            "conditions.sink_rate): the sink rate of CS-23 is 4.4 (W/S)^1/4 ft/s"
        )
    return sink_rate_23(mass, conditions.wing_area)


def landing_peaks(
    body: ModalBody,
    gears: Sequence[LandingGear],
    R_AB: Float64,
    conditions: Conditions,
    sink: float,
) -> Peaks:
    """Runs the three landings, each at both speeds of its rule where these are known.

    Args:
        body: of the airframe, A.
        gears: in B.
        R_AB: (3, 3).
        conditions: of the case.
        sink: rate, m/s.
    """
    attitudes = {
        "level": conditions.level_pitch,
        "all_wheels": _pitch_of_all(gears, R_AB),
        "tail_down": conditions.tail_down_pitch,
    }
    simulation = Simulation(duration=_DURATION)
    landing, found = None, {}
    for name, pitch in attitudes.items():
        peaks = []
        for speed in landing_speeds(conditions, tail_down=name == "tail_down"):
            given = {"sink_rate": sink, "forward_speed": speed, "pitch": pitch}
            scenario = Scenario.model_validate(given)
            if landing is None:
                landing = build_landing(body, gears, {}, R_AB, scenario)
            history = fly(landing, scenario, simulation, {}, R_AB)
            peaks.append({gear.name: _peak(history, gear.name) for gear in gears})
        found[name] = {
            gear.name: max((p[gear.name] for p in peaks), key=lambda p: p.vertical)
            for gear in gears
        }
    return Peaks(**found)


def _pitch_of_all(gears: Sequence[LandingGear], R_AB: Float64) -> float:
    """At which all wheels touch at once, deg; 0: no such pitch."""
    pitch = pitch_of_all([gear_in_A(gear, R_AB) for gear in gears])
    return float(np.clip(np.degrees(pitch or 0.0), -20.0, 30.0))  # of a scenario


def landing_speeds(conditions: Conditions, *, tail_down: bool) -> tuple[float, ...]:
    """V_L1 and 1.25 V_L2 (tail-down V_L2) of CS-25, or what the case gives, m/s."""
    if conditions.stall_speed is None or conditions.rules != "CS-25":
        return (conditions.forward_speed,)
    low, high = touchdown_speeds(conditions.stall_speed, conditions.altitude)
    return low, high if tail_down else LEVEL_FACTOR * high


def landing_story(conditions: Conditions, mass: float) -> str:
    """Sink rate and speeds of the landings, in words, or what they lack."""
    try:
        sink = sink_rate(conditions, mass)
    except InputError as error:
        return f"none: {error}"
    level, down = (
        " and ".join(f"{v:.1f}" for v in landing_speeds(conditions, tail_down=tail))
        for tail in (False, True)
    )
    return (
        f"{sink:.4g} m/s sink rate ({conditions.weight.replace('_', '-')} weight), "
        f"level at {level} m/s, tail-down at {down} m/s"
    )


def _peak(history: LandingHistory, gear: str) -> Peak:
    vertical = history.leg(gear, "vertical")
    row = int(np.argmax(vertical.to_numpy()))
    touched = np.flatnonzero(vertical.to_numpy() > 0.0)
    start = history.time[touched[0]] if len(touched) else history.time[row]
    tires = {
        w: max(history.tire[w]["deflection"].iloc[row], 0.0)
        for w in history.wheels[gear]
    }
    stroke = max(float(history.strut[gear]["stroke"].iloc[row]), 0.0)
    return Peak(
        vertical=float(vertical.iloc[row]),
        time=float(history.time[row] - start),
        at=Deflections(stroke=stroke, tire={w: float(d) for w, d in tires.items()}),
    )


def given_peak(gear: LandingGear, vertical: float) -> Peak:
    """The peak that a load of the case gives: tires and gas spring deflect under it."""
    each = vertical / len(gear.wheel_names)
    tire = {}
    for wheel in gear.wheel_names:
        law = TireLaw(tire_parameters(gear.tire_of(wheel)), Runway())
        tire[wheel] = _inverse(
            law.elastic_force, each, 0.9 * gear.tire_of(wheel).radius
        )
    parameters = shock_absorber_parameters(gear.shock_absorber)
    strut = StrutLaw(parameters)

    def gas(stroke: float) -> float:
        tunables = parameters.tunables
        return strut.gas_force(stroke, tunables, strut.settled(stroke, tunables))

    stroke = _inverse(gas, vertical, parameters.max_stroke)
    return Peak(
        vertical=vertical, time=np.nan, at=Deflections(stroke=stroke, tire=tire)
    )


def _inverse(force, wanted: float, most: float) -> float:
    """Where a rising force reaches a value, between 0 and `most`."""
    low, high = 0.0, most
    for _ in range(_CUTS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if force(middle) < wanted else (low, middle)
    return 0.5 * (low + high)

"""What the design weight and the stall speed of a case say of its conditions.

The rules pair weights with sink rates (25.473(a): 10 ft/s at the landing, 6 ft/s at the
take-off weight) and attitudes with speeds (25.479(a), 25.481(a)):

    V_L1 = V_S0 at sea level, ISA;  V_L2 = V_S0 at the altitude, ISA + 22.8 K

level from V_L1 to 1.25 V_L2, tail-down from V_L1 to V_L2, true airspeeds.
"""

import copy
from typing import Any

from drake_landing.case.presets import LANDING_SINK_RATE, PRESETS, TAKE_OFF_SINK_RATE

HOT = 22.8
"""K above ISA, 41 degrees Fahrenheit (25.479(a)(2))."""
LEVEL_FACTOR = 1.25
_SEA_LEVEL, _LAPSE, _EXPONENT = 288.15, 0.0065, 5.25588  # ISA, K, K/m


def touchdown_speeds(stall_speed: float, altitude: float) -> tuple[float, float]:
    """V_L1 and V_L2, true airspeeds, m/s.

    Args:
        stall_speed: V_S0 as calibrated airspeed, m/s.
        altitude: of the highest airfield, m.
    """
    temperature = _SEA_LEVEL - _LAPSE * altitude
    pressure = (temperature / _SEA_LEVEL) ** _EXPONENT
    density = pressure * _SEA_LEVEL / (temperature + HOT)
    return stall_speed, stall_speed / density**0.5


def with_design_values(data: Any) -> Any:
    """A case file's mapping with what follows from design weight and stall speed.

    Values that the file gives stay. `design` of the chosen mass case becomes
    `conditions.weight`; a preset at the landing weight's sink rate takes that of the
    take-off weight, and the upper speed of its rule.
    """
    if not isinstance(data, dict) or not isinstance(data.get("airframe"), dict):
        return data
    conditions = data.get("conditions", {})
    scenario = data.get("scenario")
    if not isinstance(conditions, dict) or not isinstance(scenario, dict):
        return data
    found, design = copy.copy(data), _design(data["airframe"])
    if design and "weight" not in conditions:
        found["conditions"] = {**conditions, "weight": design}
    name = scenario.get("preset")
    preset = PRESETS.get(name) if isinstance(name, str) else None
    if preset is None:
        return found
    own: dict[str, float] = {}
    if design == "take_off" and preset.values.get("sink_rate") == LANDING_SINK_RATE:
        own["sink_rate"] = TAKE_OFF_SINK_RATE
    stall, altitude = (conditions.get(k) for k in ("stall_speed", "altitude"))
    if preset.speeds and isinstance(stall, int | float) and stall > 0:
        high = float(altitude) if isinstance(altitude, int | float) else 0.0
        own["forward_speed"] = preset.speeds * touchdown_speeds(stall, high)[1]
    found["scenario"] = {**own, **scenario}
    return found


def _design(airframe: dict[str, Any]) -> str:
    """Design weight of the mass case that is chosen, or empty."""
    cases = airframe.get("mass_cases")
    chosen = cases.get(airframe.get("mass_case")) if isinstance(cases, dict) else None
    design = chosen.get("design") if isinstance(chosen, dict) else None
    return design if design in ("landing", "take_off") else ""

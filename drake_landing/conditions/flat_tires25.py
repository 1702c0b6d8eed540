"""CS-25 (14 CFR 25) ground handling with flat tires, 25.511(e) and (f)."""

from collections.abc import Iterator
from dataclasses import replace

from drake_landing.conditions.ground import BookCase, GroundAircraft
from drake_landing.conditions.rolling25 import braked_roll
from drake_landing.conditions.towing25 import towing
from drake_landing.conditions.turning25 import turning

FLAT = ((1, 2, 0.6, "one"), (2, 4, 0.5, "two"))


def flat_tire_handling(aircraft: GroundAircraft) -> Iterator[BookCase]:
    """25.511(e), (f): side and drag factors up to 50 and 40 %, n = 1; tow 60, 50 %."""
    for flat, enough, tow, word in FLAT:
        if not any(gear.wheels >= enough for gear in aircraft.mains):
            continue
        # 40 % of the drag, no less than that of the tires which are inflated.
        kept = {
            g.name: max(0.4, 1.0 - flat / max(g.wheels, flat)) for g in aircraft.mains
        }
        braked = braked_roll(aircraft, kept) if aircraft.braked else ()
        cases = [*turning(aircraft, 0.5), *braked]
        for case in cases:
            yield replace(
                case, paragraph="25.511(e)", name=f"{word} flat: {case.title}"
            )
        for case in towing(aircraft, tow):
            yield replace(
                case, paragraph="25.511(f)", name=f"{word} flat: {case.title}"
            )

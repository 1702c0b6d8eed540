"""What elastic legs make of the gears' loads, by frequency, from case files.

    OPENBLAS_NUM_THREADS=1 python -m benchmarks.leg_flexibility

First the response of one leg, clamped at its root, to the drag of a spin-up, beside
Duhamel's integral. Then the conceptual aircraft at 10 ft/s on its main gears; laws of
tires and shock absorbers as in the paper, so that the legs are all that differs, and
all of the gear but 1 kg swings. Loads of one main gear at its attachment node, in B.
"""

import json
import math
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from collections.abc import Iterator
from functools import cache
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml

from drake_landing.airframe.body import load_airframe
from drake_landing.cache import Cache
from drake_landing.case.reading import parse_case
from drake_landing.landing.trial import Trial, try_scenario
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.reference.d150.gears import landing_gears
from systems.airframe.modal_body import ModalBody
from tests.drake_landing.gears.test_legs import Rig, duhamel, pulse_response
from tests.drake_landing.landing_gears import aircraft_gears

FREQUENCIES = (None, 20.0, 16.0, 12.0, 10.0)  # Hz
DAMPING_RATIO = 0.03
GEAR = "main_left"
HERTZ = 12.0
_LEAST = {"mass": 1.0, "inertia": [1.0, 1.0, 1.0]}


def case_of(frequency: float | None, preset: str = "two_point", **leg: object) -> str:
    """A case file with the reference gears, whose legs all have this frequency."""
    law = {"frequency": frequency, "damping_ratio": DAMPING_RATIO}
    legs = {"fore_aft": law, "lateral": law, **leg} if frequency else None
    gears = [json.loads(gear.model_dump_json()) for gear in landing_gears(paper=True)]
    for gear in gears:
        gear["leg"] = legs
        if legs:  # all of the gear swings, as on the bushing
            gear["cylinder"] = gear["fitting"]
            gear["fitting"] = _LEAST | {"cg": gear["cylinder"]["cg"]}
    return yaml.safe_dump(
        {
            "name": "legs",
            "airframe": {"model": "con", "select": "below 50 Hz"},
            "gears": gears,
            "scenario": {"preset": preset},
        }
    )


@cache
def airframe() -> ModalBody:
    """The conceptual aircraft's modes below 50 Hz."""
    case = parse_case(case_of(None))
    with TemporaryDirectory() as folder:
        aircraft = prepare_aircraft(case, Path(folder))
        return load_airframe(case.airframe, aircraft, cache=Cache.of_user()).body


def landing(frequency: float | None, duration: float = 0.3) -> Trial:
    """The run of `case_of` a frequency."""
    case = parse_case(case_of(frequency))
    gears = case.gears
    assert not isinstance(gears, str)
    return try_scenario(airframe(), gears, case.scenario, duration=duration)


def row(trial: Trial) -> str:
    """Largest and least F_x and M_y of one main gear."""
    history = trial.history(GEAR)
    fx, my = (history[name] / 1e3 for name in ("fx", "my"))
    return (
        f"{fx.max():.0f} / {fx.min():.0f} | {my.min():.0f} / {my.max():.0f} | "
        f"{trial.seconds:.2f}"
    )


def pulses() -> Iterator[str]:
    """Response factors of a leg under spin-up pulses, and the closed form."""
    yield "| rise over period | damping | aft | Duhamel | forward | Duhamel |"
    yield "|---|---|---|---|---|---|"
    for zeta, ratio in product((0.0, 0.05), (0.1, 0.3, 0.6, 1.0, 2.0)):
        law = {"frequency": HERTZ, "damping_ratio": zeta}
        rig = Rig(aircraft_gears()[1], fore_aft=law)
        rise = ratio / HERTZ
        time, force = pulse_response(rig, 1 / HERTZ, rise)
        exact = [duhamel(t, 2 * math.pi * HERTZ, zeta, rise) for t in time]
        yield (
            f"| {ratio:g} | {zeta:g} | {force.max():.3f} | {max(exact):.3f} | "
            f"{-force.min():.3f} | {-min(exact):.3f} |"
        )


def main() -> None:
    """Prints the tables."""
    print(*pulses(), sep="\n", end="\n\n")
    print("| leg | Fx aft / forward, kN | My, kNm | CPU s |\n|---|---|---|---|")
    landing(None, 0.01)
    for frequency in FREQUENCIES:
        name = f"{frequency:g} Hz" if frequency else "rigid"
        print(f"| {name} | {row(landing(frequency))} |", flush=True)


if __name__ == "__main__":
    main()

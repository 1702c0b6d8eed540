"""What elastic legs make of the gears' loads, by frequency, from case files.

    OPENBLAS_NUM_THREADS=1 python -m benchmarks.leg_flexibility

The conceptual aircraft at 10 ft/s on its main gears; laws of the tyres and shock
absorbers as in the paper, so that the legs are all that differs. The oracle has rigid
legs on a rotational spring between fitting and airframe, the bushing attachment, stiff
in translation, whose rotational stiffness gives the same frequency of the whole gear.
Loads of one main gear at its attachment node, in B, increments.
"""

import json
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from functools import cache
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

FREQUENCIES = (None, 20.0, 16.0, 12.0, 10.0)  # Hz
DAMPING_RATIO = 0.03
GEAR = "main_left"
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


def main() -> None:
    """Prints the table."""
    print("| leg | Fx aft / forward, kN | My, kNm | CPU s |\n|---|---|---|---|")
    landing(None, 0.01)
    for frequency in FREQUENCIES:
        name = f"{frequency:g} Hz" if frequency else "rigid"
        print(f"| {name} | {row(landing(frequency))} |", flush=True)


if __name__ == "__main__":
    main()

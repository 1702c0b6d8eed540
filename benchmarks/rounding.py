"""How far rounding carries in a landing: to how many digits its history is the same.

python -m benchmarks.rounding CASE.yaml ...

Each landing is flown twice, the second time with a sink rate that is larger by one unit
in its last place. Difference of the attachment loads over their peak, in five parts of
the run, beside the largest load of each part; and the difference of the largest loads.
"""

import argparse
import itertools
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pandas as pd

from benchmarks.page import markdown
from drake_landing.airframe.body import load_airframe
from drake_landing.case.axes import rotation_AB
from drake_landing.case.reading import load_case
from drake_landing.landing.run import build_landing, fly
from drake_landing.process.aircraft import prepare_aircraft
from fem.errors import InputError

PARTS = 5
STEP = 5e-4  # s


def landings(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Attachment loads (t, 6 k) of a landing and of its neighbour, on one grid."""
    case = load_case(path)
    with TemporaryDirectory() as folder:
        aircraft = prepare_aircraft(case, Path(folder))
        airframe = load_airframe(case.airframe, aircraft)
    R_AB, points = rotation_AB(case.airframe.axes), aircraft.monitoring
    scenario, simulation = aircraft.scenario, case.simulation
    built = build_landing(airframe.body, aircraft.gears, points, R_AB, scenario)
    loads = []
    for rate in (scenario.sink_rate, np.nextafter(scenario.sink_rate, np.inf)):
        touching = scenario.model_copy(update={"sink_rate": float(rate)})
        history = fly(built, touching, simulation, points, R_AB)
        loads.append(history.attachment_loads())
    end = min(load.time[-1] for load in loads)
    one, other = (load.resampled(STEP, end).load for load in loads)
    return one.reshape(len(one), -1), other.reshape(len(other), -1)


def rows(path: Path) -> list[dict[str, str]]:
    """The parts of a run, and its peaks."""
    one, other = landings(path)
    scale = np.abs(one).max()
    bounds = np.linspace(0, len(one), PARTS + 1).astype(int)
    found = []
    for begin, end in itertools.pairwise(bounds):
        difference = np.abs(other[begin:end] - one[begin:end]).max()
        found.append(
            {
                "case": path.stem,
                "s": f"{begin * STEP:.2f} to {end * STEP:.2f}",
                "largest load": f"{np.abs(one[begin:end]).max() / scale:.2f}",
                "difference": f"{difference / scale:.0e}",
            }
        )
    peak = np.abs(np.abs(other).max(axis=0) - np.abs(one).max(axis=0)).max()
    found.append(
        {
            "case": path.stem,
            "s": "peaks",
            "largest load": "1.00",
            "difference": f"{peak / scale:.0e}",
        }
    )
    return found


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="+", type=Path)
    cases = parser.parse_args().cases
    try:
        print(markdown(pd.DataFrame([row for path in cases for row in rows(path)])))
    except InputError as error:
        parser.error(str(error))


if __name__ == "__main__":
    main()

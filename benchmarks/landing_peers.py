"""One second of a landing with 73 modes: this project beside Exudyn.

    python -m benchmarks.landing_peers [--exudyn-python PATH]

Both land the same aircraft (`lattice_aircraft`), in turns in one run. Exudyn comes with
`pip install '.[peers]'`; with `--exudyn-python` it may live in an environment of its
own. Times are processor seconds of the simulation alone. Errors are those of the worst
peak (forces of oleos and tires) against the finest run of the same code; "modes up to"
is the bound of `systems.airframe.slow_modes`, "all" leaves the modes as they are. The
last column, the peak acceleration of a wing tip in m/s², is not part of the error: it
follows the jump of all forces at the start, and with it the highest modes.

The ratio is taken at equal accuracy: for each run of this project, against the fastest
run of Exudyn that is at least as accurate.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from benchmarks import lattice_aircraft as aircraft
from benchmarks.lattice_landing import land, make_landing, modal_body
from systems.airframe.slow_modes import with_slow_modes

# Peaks of an independent model of the same case in Exudyn 1.13.6, N.
PUBLISHED = {
    "oleo_left": 439.1e3,
    "oleo_right": 439.1e3,
    "oleo_nose": 158.3e3,
    "tire_left": 442.8e3,
    "tire_right": 442.8e3,
    "tire_nose": 161.5e3,
}
STEPS = (5e-3, 3e-3, 2e-3, 1e-3, 5e-4)  # s, of Exudyn
BOUND_HZ = 150.0
OURS = tuple(
    (bound, "runge_kutta3", accuracy)
    for bound, accuracies in ((BOUND_HZ, (3e-3, 1e-3, 3e-4)), (0.0, (1e-3, 1e-5)))
    for accuracy in accuracies
)


@dataclass(frozen=True, kw_only=True)
class Run:
    """One simulation."""

    name: str
    seconds: float
    peaks: dict[str, float]

    def error(self, limit: dict[str, float]) -> float:
        """Of the worst peak force, relative."""
        return max(abs(self.peaks[name] / limit[name] - 1.0) for name in PUBLISHED)


def our_runs(repeats: int) -> list[Run]:
    """Best of several; the last is the finest."""
    runs = []
    for bound, scheme, accuracy in OURS:
        body = modal_body()
        landing = make_landing(with_slow_modes(body, bound) if bound else body)
        land(landing, scheme, 1e-2)  # compiles what is not yet compiled
        seconds = []
        for _ in range(repeats if bound else 1):
            start = time.process_time()
            landed = land(landing, scheme, accuracy)
            seconds.append(time.process_time() - start)
        modes = f"modes up to {bound:.0f} Hz" if bound else "all modes"
        name = f"{scheme} {accuracy:g}, {modes}, {landed.evaluations} evaluations"
        runs.append(Run(name=name, seconds=min(seconds), peaks=landed.peaks))
    return runs


def exudyn_runs(python: str, repeats: int) -> list[Run]:
    """Best of several; the last is the finest. Empty where there is no Exudyn."""
    runs = []
    script = Path(__file__).with_name("exudyn_landing.py")
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder, "model.npz")
        write_model(model)
        for step in STEPS:
            command = [python, str(script), str(model), str(step)]
            found = []
            for _ in range(repeats if step >= 2e-3 else 1):
                done = subprocess.run(command, capture_output=True, text=True)
                if done.returncode:
                    print(done.stderr.strip().splitlines()[-1])
                    return []
                found.append(json.loads(done.stdout.strip().splitlines()[-1]))
            best = min(found, key=lambda result: result["seconds"])
            name = f"Exudyn {best['version']}, step {step:g} s"
            runs.append(Run(name=name, seconds=best["seconds"], peaks=best["peaks"]))
    return runs


def write_model(path: Path) -> None:
    """The case as arrays, for programs that know nothing of this project."""
    model = aircraft.lattice()
    case = {
        "inner_modes": aircraft.INNER_MODES,
        "sink_rate": aircraft.SINK_RATE,
        "duration": aircraft.DURATION,
        "oleo_length": aircraft.OLEO_LENGTH,
        "gas_length": aircraft.GAS_LENGTH,
        "gas_exponent": aircraft.GAS_EXPONENT,
        "stroke": aircraft.STROKE,
        "stop_stiffness": aircraft.STOP_STIFFNESS,
        "stiffness_damping": aircraft.STIFFNESS_DAMPING,
        "side_stiffness": aircraft.SIDE_STIFFNESS,
        "side_damping": aircraft.SIDE_DAMPING,
        "tire_damping": aircraft.TIRE_DAMPING,
        "largest_damped_rate": aircraft.LARGEST_DAMPED_RATE,
        "gears": [vars(gear) for gear in aircraft.GEARS],
    }
    matrices = {
        f"{name}_{part}": getattr(matrix, part)
        for name, matrix in (("massMatrix", model.M), ("stiffnessMatrix", model.K))
        for part in ("data", "indices", "indptr")
    }
    np.savez(
        path,
        xyz=model.xyz,
        cubes=model.cubes,
        faces=np.array(list(model.faces.values())),
        tip=model.row(aircraft.TIP),
        case=json.dumps(case),
        **matrices,
    )


def report(ours: list[Run], theirs: list[Run]) -> str:
    """The table."""
    lines = []
    for runs in (theirs, ours):
        for run in runs:
            peaks = "".join(f"{run.peaks[name] / 1e3:8.2f}" for name in PUBLISHED)
            peaks += f"{run.peaks['tip']:8.2f}"
            error = 100 * run.error(runs[-1].peaks)
            lines.append(f"{run.name:64s}{run.seconds:8.2f}{error:8.3f}{peaks}")
    head = f"{'':64s}{'CPU s':>8s}{'err. %':>8s}"
    names = [name.replace("right", "r").replace("left", "l") for name in PUBLISHED]
    lines.insert(0, head + "".join(f"{name[:7]:>8s}" for name in (*names, "tip")))
    for run in ours:
        reached = run.error(ours[-1].peaks)
        fair = [t.seconds for t in theirs if t.error(theirs[-1].peaks) <= reached]
        if fair:
            lines.append(f"{run.name:64s}{min(fair) / run.seconds:7.1f} x as fast")
    off = 100 * ours[-1].error(PUBLISHED)
    lines.append(f"worst peak of this project against the published ones: {off:.2f} %")
    return "\n".join(lines)


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description="This project beside Exudyn.")
    parser.add_argument("--exudyn-python", default=sys.executable)
    parser.add_argument("--repeats", type=int, default=3)
    chosen = parser.parse_args()
    theirs = exudyn_runs(chosen.exudyn_python, chosen.repeats)
    print(report(our_runs(chosen.repeats), theirs))


if __name__ == "__main__":
    main()

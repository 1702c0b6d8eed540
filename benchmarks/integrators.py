"""Integrators: error of the peak loads against evaluations and processor time.

    python -m benchmarks.integrators [--modes 73] [--gears paper|legs|d150]

One second of the conceptual aircraft's landing: spin-up, spring-back, first rebound.
Error: worst of the peaks of F_x and F_z at the attachment nodes, over the largest of
each direction, against a run of 1e-7; the energy error is over the sink energy. A peak
is that of the logged steps, as reports have it.
"""

import argparse
import os
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

from benchmarks.conceptual_landing import SINK_RATE, make_landing, modal_body
from drake_landing.landing.diagram import LandingDiagram
from systems.airframe.slow_modes import fastest_rate
from tests.drake_landing.landing_run import Run, land

CHOICES = (
    ("runge_kutta3", (1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5)),
    ("bogacki_shampine3", (1e-3, 1e-4, 1e-5)),
    ("runge_kutta5", (1e-3, 1e-4, 1e-5)),
    ("radau3", (1e-3,)),
)
GEARS = ("paper", "legs", "d150")
LIMIT = ("runge_kutta3", 1e-7)


def peaks(run: Run) -> np.ndarray:
    """(2, gears) largest |F_x| and |F_z| at the attachment nodes, N."""
    load = run["attachment.load_in_airframe_axes"]
    largest = np.abs(load).max(axis=1).reshape(-1, 6)
    return largest[:, [0, 2]].T


def timed(landing: LandingDiagram, scheme: str, accuracy: float) -> tuple[Run, float]:
    """A landing and its processor seconds."""
    start = time.process_time()
    run = land(
        landing, duration=1.0, accuracy=accuracy, scheme=scheme, sink_rate=SINK_RATE
    )
    return run, time.process_time() - start


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description="Integrators of a landing.")
    parser.add_argument("--modes", type=int, default=73)
    parser.add_argument("--radau", action="store_true", help="slow")
    parser.add_argument("--gears", choices=GEARS, default="paper")
    chosen = parser.parse_args()
    body = modal_body(chosen.modes)
    landing = make_landing(body, chosen.modes, gears=chosen.gears)
    mass = body.mass + sum(gear.mass for gear in landing.gears)
    sink_energy = 0.5 * mass * SINK_RATE**2
    timed(landing, "runge_kutta3", 1e-2)  # compiles what is not yet compiled
    limit = peaks(timed(landing, *LIMIT)[0])
    print(
        f"{body.n} modes, fastest {fastest_rate(body):.0f} 1/s\n"
        "| scheme | accuracy | steps | evaluations | CPU s | peak error % "
        "| energy error |\n|---|---|---|---|---|---|---|"
    )
    for scheme, accuracies in CHOICES:
        if scheme == "radau3" and not chosen.radau:
            continue
        for accuracy in accuracies:
            run, seconds = timed(landing, scheme, accuracy)
            error = np.abs(peaks(run) - limit) / limit.max(axis=1, keepdims=True)
            total = run["energy_budget.total"][0]
            lost = np.abs(total - total[0]).max() / sink_energy
            print(
                f"| {scheme} | {accuracy:g} | {len(run.time)} | {run.evaluations} "
                f"| {seconds:.2f} | {100 * error.max():.3f} | {lost:.1e} |",
                flush=True,
            )


if __name__ == "__main__":
    main()

"""What the steps and the observers of a direct transient cost beside the bare solve.

    python -m benchmarks.transient_observers [--model full] [--cases 32] [--steps 96]

All ratios come from one run, with one PARDISO thread. A block is judged by processor
time, as each core has a block of its own; a single case by the wall clock, as its
observers work beside its steps: it wants two free cores, and others' share of the
machine is printed.
"""

import argparse
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time, thread_time

import numpy as np
import scipy.sparse as sp

from benchmarks.machine import description
from drake_landing.case.reading import parse_case
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.process.full_response import parts_watch
from drake_landing.transient.extremes import OfFirstCase, element_envelopes
from fem.model.structure import Structure
from fem.response.direct import direct_transient, sampled_load
from fem.response.nastran_scheme import NastranScheme
from fem.response.observation import Chunk, Observer
from fem.response.system import TransientSystem

STEP = 5e-4
_REPEATS = 5


@dataclass
class Timed:
    """An observer and the processor time of its thread, s."""

    observer: Observer
    seconds: float = 0.0

    def begin(self, time: np.ndarray, cases: int, size: int) -> None:
        """See `Observer`."""
        self.observer.begin(time, cases, size)

    def observe(self, chunk: Chunk) -> None:
        """See `Observer`."""
        start = thread_time()
        self.observer.observe(chunk)
        self.seconds += thread_time() - start

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """See `Observer`."""
        return self.observer.memory_bytes(times, cases, size)


def others(since: tuple[float, float, float] | None = None) -> tuple:
    """Processor time of everybody and of this process, and the wall clock, s."""
    with open("/proc/stat") as file:
        ticks = [int(x) for x in file.readline().split()[1:]]
    now = (sum(ticks) - ticks[3] - ticks[4]) / 100.0, process_time(), perf_counter()
    if since is None:
        return now
    everybody, own, wall = (b - a for a, b in zip(since, now))
    return ((everybody - own) / wall,)


def bare_solve(structure: Structure, cases: int) -> tuple[float, float]:
    """Least processor and wall time of one solve of so many columns, s."""
    system = TransientSystem.assemble(
        structure.stiffness,
        structure.mass,
        structure.damping,
        None,
        solver=None,
        threads=1,
    )
    factors = NastranScheme().matrix_factors(system, STEP)
    right = np.random.default_rng(0).standard_normal((cases, system.size))
    out = np.empty_like(right)
    spent = []
    with system.factorize(*factors, cases) as factor:
        for _ in range(_REPEATS if cases > 4 else 8 * _REPEATS):
            start, wall = process_time(), perf_counter()
            factor.solve(right.T, out=out.T)
            spent.append((process_time() - start, perf_counter() - wall))
    processor, wall = np.array(spent).T
    return float(np.median(processor)), float(np.median(wall))


def transient(
    structure: Structure,
    nodes: np.ndarray,
    cases: int,
    steps: int,
    observers: Sequence[Observer],
) -> tuple[float, float]:
    """Processor and wall time per step, without the factorisation, s."""
    pattern = sp.csr_matrix(structure.operator(nodes, frame="basic").T)
    rng, time = np.random.default_rng(0), STEP * np.arange(steps + 3)
    scale = 1e5 * rng.uniform(0.5, 1.5, (cases, 6 * len(nodes), 1))
    factors = scale * np.sin(np.pi * time / time[-1]) ** 2
    start, marks = [], []

    def tick(done: int, _: int) -> None:
        if done == 1:
            start.append((process_time(), perf_counter()))
        marks.append(done)

    direct_transient(
        structure.stiffness,
        structure.mass,
        structure.damping,
        steps=[(steps, STEP)],
        load=sampled_load(pattern, time, factors),
        observers=observers,
        threads=1,
        mass_product=structure.mass_product,
        progress=tick,
    )
    processor = process_time() - start[0][0]
    return processor / (steps - 1), (perf_counter() - start[0][1]) / (steps - 1)


def main() -> None:
    """Prints the table."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--model", default="full")
    options.add_argument("--cases", type=int, default=32)
    options.add_argument("--steps", type=int, default=96)
    given = options.parse_args()
    topology = "distributed" if given.model == "full" else '"1"'
    text = (
        f"name: speed\nairframe: {{model: {given.model}, topology: {topology}}}\n"
        f"scenario: {{sink_rate: 1.8}}\ntransient: {{step: {STEP}}}\n"
    )
    case = parse_case(text)
    with tempfile.TemporaryDirectory() as folder:
        aircraft = prepare_aircraft(case, Path(folder))
        structure = aircraft.structure()
        nodes = np.unique(aircraft.attachment_nodes)
        watch = parts_watch(case, aircraft, structure, nodes, None)
    print(f"{aircraft.name}, {structure.size} freedoms; {description()}")
    for cases in (1, given.cases):
        steps = given.steps if cases == 1 else max(16, given.steps // 4)
        measure(structure, nodes, cases, steps, watch.observers)


def measure(
    structure: Structure,
    nodes: np.ndarray,
    cases: int,
    steps: int,
    of_parts: Sequence[Observer],
) -> None:
    """Prints the table of so many load cases."""
    seen = [Timed(observer) for observer in of_parts]
    extremes = Timed(OfFirstCase(element_envelopes(structure)))
    everything = [*seen, extremes]
    transient(structure, nodes, cases, 4, everything)  # compiles
    for timed in everything:
        timed.seconds = 0.0
    solve = bare_solve(structure, cases)
    before = others()
    plain = transient(structure, nodes, cases, steps, [])
    whole = transient(structure, nodes, cases, steps, everything)
    stress, *moved = (timed.seconds / steps for timed in seen)
    block = cases > 1
    rows = [
        ("bare solve", *solve, ""),
        ("step without observers", *plain, ""),
        ("stress watch", stress, np.nan, "at most 0.2" if block else ""),
        ("accelerations, section loads", sum(moved), np.nan, ""),
        ("extremes of all results, first case", extremes.seconds / steps, np.nan, ""),
        ("whole step", *whole, f"at most {1.4 if block else 1.15}"),
    ]
    print(f"\n{cases} load case{'s' * block}; ms per step and case")
    print("| | processor | wall | over the solve | wanted |\n|---|---|---|---|---|")
    for what, processor, wall, wanted in rows:
        judged = processor / solve[0] if block else wall / solve[1]
        if np.isnan(judged):
            judged = processor / solve[0]
        print(
            f"| {what} | {1e3 / cases * processor:.2f} | {1e3 / cases * wall:.2f} | "
            f"{judged:.2f} | {wanted} |",
            flush=True,
        )
    print(f"others took {others(before)[0]:.2f} cores meanwhile")


if __name__ == "__main__":
    main()

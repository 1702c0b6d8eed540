"""Solutions at aircraft scale against the machine's bound and against targets.

    python -m benchmarks.transient_scale [--parts step,block,...] [--json FILE]

The model is `benchmarks.stiffened_aircraft`: more than 34,000 grids, 205,000 freedoms.
Each part runs in a process of its own, so that its peak memory is its own.

The bound of a step with one load case is the time of two reads of the factor at the
memory bandwidth that is measured before and after. On a machine that others use the
wall clock says little: ratios are given in processor time of one thread, and beside
them by the wall clock with all cores; the best of many steps counts.
"""

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, process_time
from typing import Any

import numpy as np

import fem
from benchmarks.machine import load, peak_memory, read_bandwidth
from benchmarks.stiffened_aircraft import Size, deck
from fem.recovery.envelope import Envelope
from fem.response.direct import TransientRun

STEP = 1e-3
Figures = dict[str, float]


def structure(size: Size) -> fem.Structure:
    """The model, read from a deck in text."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "aircraft.bdf"
        path.write_text(deck(size)[0])
        return fem.Structure.from_deck(fem.read_deck(path))


def loads(model: fem.Structure, cases: int) -> fem.TransientLoad:
    """Vertical pulses at three grids of the fuselage, other heights for each case."""
    grids = _some_grids(model, 0.06, 0.25, 0.251)
    pattern = model.operator(grids, (3,), frame="basic").T
    factors = 1e4 * np.random.default_rng(0).uniform(0.5, 1.5, (cases, 3))

    def evaluate(time: np.ndarray) -> np.ndarray:
        pulse = np.sin(np.pi * np.clip(time / 0.05, 0.0, 1.0)) ** 2
        return factors[:, :, None] * pulse

    return fem.TransientLoad(pattern, evaluate)


def _some_grids(model: fem.Structure, *places: float) -> np.ndarray:
    """Grids at parts of the list of ids."""
    ids = model.points.grid_id
    return ids[(np.array(places) * len(ids)).astype(int)]


class Clock:
    """Wall and processor time of each step, by the progress call."""

    def __init__(self) -> None:
        self.wall: list[float] = []
        self.process: list[float] = []

    def __call__(self, done: int, total: int) -> None:
        self.wall.append(perf_counter())
        self.process.append(process_time())

    def best(self) -> tuple[float, float]:
        """Shortest step by the wall clock and in processor time, s."""
        return float(np.diff(self.wall).min()), float(np.diff(self.process).min())


def transient(
    model: fem.Structure, steps: int, cases: int, threads: int, observers: list
) -> tuple[TransientRun, Clock]:
    """Some steps."""
    clock = Clock()
    run = fem.direct_transient(
        model.stiffness,
        model.mass,
        model.damping,
        steps=[(steps, STEP)],
        load=loads(model, cases),
        observers=observers,
        threads=threads,
        progress=clock,
    )
    return run, clock


def _tip(model: fem.Structure) -> fem.Observation:
    rows = model.operator(_some_grids(model, 0.06, 0.6), (1, 2, 3))
    return fem.Observation("acceleration", rows)


def part_model(size: Size) -> Figures:
    """Reading and assembly."""
    start = process_time()
    model = structure(size)
    read = process_time() - start
    nonzeros = model.stiffness.nnz
    assembled = process_time() - start - read
    return {
        "grids": len(model.points.grid_id),
        "freedoms": model.size,
        "nonzeros of K": nonzeros,
        "reading, s of processor time": read,
        "assembly and constraints, s of processor time": assembled,
    }


def part_step(size: Size, steps: int = 70) -> Figures:
    """One load case, one thread and all of them."""
    model = structure(size)
    found: Figures = {}
    for threads in sorted({1, os.cpu_count() or 1}):
        before = read_bandwidth(threads)
        run, clock = transient(model, steps, 1, threads, [_tip(model)])
        after = read_bandwidth(threads)
        wall, process = clock.best()
        reads = 16.0 * run.nnz_factor
        tag = f"{threads} thread{'s' * (threads > 1)}"
        if threads == 1:
            bound = reads / max(before.process, after.process)
            found["factor entries, millions"] = run.nnz_factor / 1e6
            found["ms per step (processor)"] = 1e3 * process
            found["bound, ms (processor)"] = 1e3 * bound
            found["step over bound (processor)"] = process / bound
        found[f"factorisation, s, {tag}"] = run.factor_seconds
        found[f"ms per step, {tag}"] = 1e3 * wall
        found[f"bound, ms, {tag}"] = 1e3 * reads / max(before.wall, after.wall)
        found[f"step over bound, {tag}"] = wall / (reads / max(before.wall, after.wall))
    return found


def part_block(size: Size, steps: int = 12) -> Figures:
    """Thirty-two load cases at once against one, in processor time of one thread."""
    model = structure(size)
    _, single = transient(model, 3 * steps, 1, 1, [_tip(model)])
    run, block = transient(model, steps, 32, 1, [_tip(model)])
    one, many = single.best()[1], block.best()[1] / 32
    return {
        "ms per step and case, 32 cases (processor)": 1e3 * many,
        "one case over one of 32": one / many,
        "factorisation, s": run.factor_seconds,
    }


def part_envelope(size: Size, steps: int = 1000) -> Figures:
    """Extremes of the stresses of all elements, von Mises among them, while running."""
    model = structure(size)
    tables = fem.element_tables(model.points, model.blocks, "stress")
    spent = []
    for envelopes in ([], tables):
        observers = [Envelope(table, model.elimination.T) for table in envelopes]
        _, clock = transient(model, steps, 1, 1, [_tip(model), *observers])
        spent.append(clock.process[-1] - clock.process[0])
    bare, whole = spent
    return {
        "elements": sum(len(table.id) for table in tables),
        "steps": steps,
        "s for all steps without (processor)": bare,
        "s for all steps with (processor)": whole,
        "additional cost": whole / bare - 1.0,
    }


def part_modes(size: Size, count: int = 300) -> Figures:
    """Three hundred modes of the free structure."""
    model = structure(size)
    k, m, rigid = model.stiffness, model.mass, model.rigid_body
    start, used = perf_counter(), process_time()
    modes = fem.normal_modes(k, m, count=count, rigid_body=rigid)
    residual = k @ modes.shape - (m @ modes.shape) * modes.eigenvalue
    scale = np.linalg.norm(k @ modes.shape[:, modes.rigid :], axis=0).min()
    return {
        "modes": modes.count,
        "rigid-body modes": modes.rigid,
        "highest, Hz": float(modes.frequency_hz[-1]),
        "counted less found (Sturm)": float(
            sum(abs(c.counted - c.found) for c in modes.sturm)
        ),
        "largest residual": float(np.linalg.norm(residual, axis=0).max() / scale),
        "s by the wall clock": perf_counter() - start,
        "s of processor time": process_time() - used,
    }


def part_guyan(size: Size, grids: int = 261) -> Figures:
    """Reduction onto 1566 freedoms."""
    model = structure(size)
    ids = model.points.grid_id
    chosen = ids[np.linspace(0, len(ids) - 1, grids).astype(int)]
    kept = model.free_rows(
        model.points.dof(chosen[:, None], np.arange(1, 7)).ravel(), "ASET"
    )
    k, m, damping = model.stiffness, model.mass, model.damping
    start, used = perf_counter(), process_time()
    reduced = fem.reduce_guyan(k, m, damping, kept)
    return {
        "columns": reduced.size,
        "s by the wall clock": perf_counter() - start,
        "s of processor time": process_time() - used,
    }


def part_superlu(size: Size) -> Figures:
    """The same matrix by scipy's SuperLU, one thread."""
    model = structure(size)
    matrix = model.stiffness + 4.0 / STEP**2 * model.mass
    right = np.random.default_rng(0).normal(size=model.size)
    found: Figures = {}
    for solver in ("pardiso", "superlu"):
        used = process_time()
        with fem.factorize(matrix, solver=solver, threads=1) as factor:
            found[f"{solver}: factorisation, s (processor)"] = process_time() - used
            best = np.inf
            for _ in range(6):
                used = process_time()
                factor.solve(right)
                best = min(best, process_time() - used)
            found[f"{solver}: ms per solution (processor)"] = 1e3 * best
            found[f"{solver}: factor, MB"] = factor.memory_bytes / 1e6
    for what in ("factorisation, s (processor)", "ms per solution (processor)"):
        ratio = found[f"superlu: {what}"] / found[f"pardiso: {what}"]
        found[f"SuperLU over PARDISO, {what.split(',')[0]}"] = ratio
    return found


PARTS: dict[str, Callable[[Size], Figures]] = {
    name.removeprefix("part_"): value
    for name, value in globals().items()
    if name.startswith("part_")
}

# Largest (smallest for the block) values that are wanted, by part and figure.
TARGETS: dict[tuple[str, str], float] = {
    ("step", "step over bound (processor)"): 1.6,
    ("block", "one case over one of 32"): 4.0,
    ("envelope", "additional cost"): 0.5,
    ("modes", "s of processor time"): 300.0,
    ("modes", "counted less found (Sturm)"): 0.0,
    ("guyan", "s of processor time"): 240.0,
    **{(part, "peak memory, GB"): 8.0 for part in PARTS if part != "superlu"},
}
AT_LEAST = {("block", "one case over one of 32")}


def run_part(name: str, size: Size) -> Figures:
    """Figures of a part with its peak memory and the load of the machine."""
    figures = PARTS[name](size)
    figures["peak memory, GB"] = peak_memory() / 1e9
    figures["load of the machine"] = load()
    return figures


def run_apart(name: str, *, small: bool = False) -> Figures:
    """`run_part` in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.transient_scale", "--part", name]
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    answer = subprocess.run(
        command + ["--small"] * small,
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    )
    return json.loads(answer.stdout.splitlines()[-1])


def verdict(part: str, figure: str, value: float) -> str:
    """What is wanted of a figure, and whether it is so; '' where nothing is."""
    wanted = TARGETS.get((part, figure))
    if wanted is None:
        return ""
    least = (part, figure) in AT_LEAST
    met = value >= wanted if least else value <= wanted
    text = f"{'at least' if least else 'at most'} {wanted:g}"
    return text if met else f"{text}: MISSED"


def table(results: dict[str, Figures]) -> str:
    """Figures of all parts as Markdown."""
    lines = ["| part | figure | value | wanted |", "|---|---|---|---|"]
    for part, figures in results.items():
        for figure, value in figures.items():
            wanted = verdict(part, figure, value)
            lines.append(f"| {part} | {figure} | {plain(value)} | {wanted} |")
    return "\n".join(lines)


def plain(value: float, digits: int = 4) -> str:
    """A figure without exponents where it is large or whole."""
    whole = float(value).is_integer() or abs(value) >= 1e3
    return f"{value:.0f}" if whole else f"{value:.{digits}g}"


SMALL = Size(around=24, along=36, wing=(6, 12), tail=(4, 8))


def main(arguments: list[str] | None = None) -> dict[str, Any]:
    """Run parts and print their figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--part", choices=PARTS, help="one part, here, as JSON")
    parser.add_argument("--parts", default=",".join(PARTS))
    parser.add_argument("--small", action="store_true", help="a model for trials")
    options = parser.parse_args(arguments)
    if options.part:
        figures = run_part(options.part, SMALL if options.small else Size())
        print(json.dumps(figures))
        return figures
    results = {}
    for name in options.parts.split(","):
        print(f"{name} ...", flush=True)
        results[name] = run_apart(name, small=options.small)
        print(table({name: results[name]}), flush=True)
    return results


if __name__ == "__main__":
    main()

"""Times and peak memory of the stages from an empty file to a reduced aircraft.

    python -m benchmarks.aircraft_stages [pre full] [--threads 2] [--page]

Each stage runs in a process of its own after those that it needs; its time is its own,
its peak memory that of the process. Threads are those of the sparse solver and of dense
products. The machine may be shared: processor time is nearly untouched by that, the
wall clock is not, so the load that each stage met is told.
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

import pandas as pd

from benchmarks.machine import description, load, peak_memory
from benchmarks.page import DOCS, markdown, put
from drake_landing.reduced.make import reduce_structure
from drake_landing.reference.d150 import build, interface_nodes, write_model
from fem.algebra.linear_solver import factorize
from fem.algebra.modes import normal_modes
from fem.deck.reader import read_deck
from fem.model.structure import Structure

INTERIOR = 150.0  # Hz
HIGHEST = 50.0  # Hz
Stage = Callable[[str, Path], tuple[Callable[[], object], str]]


def _assembled(path: Path) -> Structure:
    structure = Structure.from_deck(read_deck(path))
    _ = structure.stiffness, structure.mass, structure.damping
    return structure


def generation(level: str, path: Path) -> tuple[Callable[[], object], str]:
    """Facts to a deck in a file."""
    return lambda: write_model(level, path, "2"), "deck of topology 2"


def reading(level: str, path: Path) -> tuple[Callable[[], object], str]:
    """A deck to checked card tables."""
    return lambda: read_deck(path), ""


def assembly(level: str, path: Path) -> tuple[Callable[[], object], str]:
    """Card tables to K, M, B of the free set."""
    structure = Structure.from_deck(read_deck(path))

    def run() -> object:
        return structure.stiffness, structure.mass, structure.damping

    return run, ""


def factorisation(level: str, path: Path) -> tuple[Callable[[], object], str]:
    """K shifted by M, as the eigenmodes need it."""
    structure = _assembled(path)
    matrix = structure.stiffness + 100.0 * structure.mass
    return lambda: factorize(matrix).close(), f"{structure.size} freedoms"


def guyan(level: str, path: Path) -> tuple[Callable[[], object], str]:
    """Onto the 261 reference nodes."""
    structure = _assembled(path)
    grids = interface_nodes()
    return lambda: reduce_structure(structure, grids, "guyan"), "261 grids"


def craig_bampton(level: str, path: Path) -> tuple[Callable[[], object], str]:
    """The same with interior modes."""
    structure = _assembled(path)
    grids = interface_nodes()

    def run() -> object:
        return reduce_structure(structure, grids, "craig-bampton", highest_hz=INTERIOR)

    return run, f"interior modes below {INTERIOR:g} Hz"


def eigenmodes(level: str, path: Path) -> tuple[Callable[[], object], str]:
    """Of the full model."""
    structure = _assembled(path)

    def run() -> object:
        return normal_modes(
            structure.stiffness,
            structure.mass,
            band=(0.0, HIGHEST),
            rigid_body=structure.rigid_body,
        )

    return run, f"full model, below {HIGHEST:g} Hz"


STAGES: dict[str, Stage] = {
    "generation": generation,
    "reading": reading,
    "assembly": assembly,
    "factorisation": factorisation,
    "Guyan": guyan,
    "Craig-Bampton": craig_bampton,
    "eigenmodes": eigenmodes,
}


def measure(level: str, stage: str) -> dict[str, object]:
    """One stage, in this process."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"{level}.bdf"
        if stage != "generation":
            path.write_text(build(level, "2").deck, encoding="ascii")
        run, remark = STAGES[stage](level, path)
        used, start = process_time(), perf_counter()
        run()
        return {
            "processor s": process_time() - used,
            "wall s": perf_counter() - start,
            "peak GB": peak_memory() / 1e9,
            "load": load(),
            "remark": remark,
        }


def measure_apart(level: str, stage: str, threads: int) -> dict[str, object]:
    """`measure` in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.aircraft_stages", level]
    names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    answer = subprocess.run(
        [*command, "--stage", stage],
        env={**os.environ, **{name: str(threads) for name in names}},
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    )
    return json.loads(answer.stdout.splitlines()[-1])


def table(rows: list[dict[str, object]]) -> str:
    """All stages as Markdown."""
    shown = pd.DataFrame(rows)
    for column, digits in (
        ("processor s", 1),
        ("wall s", 1),
        ("peak GB", 2),
        ("load", 1),
    ):
        shown[column] = shown[column].map(f"{{:.{digits}f}}".format)
    return markdown(shown)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("levels", nargs="*", default=["pre", "full"])
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--stage", choices=STAGES, help="one stage, here, as JSON")
    parser.add_argument("--page", action="store_true")
    arguments = parser.parse_args()
    if arguments.stage:
        print(json.dumps(measure(arguments.levels[0], arguments.stage)))
        return
    rows = []
    for level in arguments.levels:
        for stage in STAGES:
            found = measure_apart(level, stage, arguments.threads)
            rows.append({"model": level.upper(), "stage": stage, **found})
            print(rows[-1], flush=True)
    text = f"{arguments.threads} threads, {description()}.\n\n{table(rows)}"
    print(text)
    if arguments.page:
        put(DOCS / "aircraft.md", "stages", text)


if __name__ == "__main__":
    main()

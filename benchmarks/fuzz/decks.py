"""Decks, damaged and solved: finite results in equilibrium, or a message."""

import random
from pathlib import Path

import h5py
import numpy as np

from benchmarks.fuzz.mutations import mutate_bytes, mutate_values
from benchmarks.fuzz.outcome import Outcome, of_command
from fem.deck.reader import read_deck
from fem.geometry.points import Points
from fem.model.points import read_points
from fem.solution.equilibrium import UNBALANCED
from tests.fem.mixed_structure import every_solution
from tests.fem.mutations import mutate

_TESTS = Path(__file__).parents[2] / "tests"


def seeds(folder: Path) -> list[Path]:
    """A deck with every kind of element and solution, one with INCLUDE, an aircraft.

    Args:
        folder: for them.
    """
    mixed = every_solution()
    (folder / "mixed.bdf").write_text(mixed)
    control, bulk = mixed.split("BEGIN BULK\n")
    (folder / "bulk.inc").write_text(bulk)
    including = folder / "including.bdf"
    including.write_text(f"{control}BEGIN BULK\nINCLUDE 'bulk.inc'\nENDDATA\n")
    aircraft = (_TESTS / "drake_landing" / "tiny_aircraft.bdf").read_text()
    (folder / "aircraft.bdf").write_text(aircraft)
    return [folder / name for name in ("mixed.bdf", "mixed.bdf", "including.bdf")] + [
        folder / "aircraft.bdf"
    ]


def damaged(seed: Path, rng: random.Random, place: Path) -> None:
    """Writes a damaged copy of a deck: slips of people, of transfers, absurd numbers.

    Args:
        seed: good file.
        rng: decides what happens to it.
        place: of the copy, beside its INCLUDE.
    """
    action = rng.randrange(4)
    if action < 2:
        place.write_text(mutate(seed.read_text(), rng), encoding="utf-8")
        return
    change = mutate_bytes if action == 2 else mutate_values
    place.write_bytes(change(seed.read_bytes(), rng))


def outcome(path: Path) -> tuple[Outcome, str]:
    """Of `python -m fem`; nothing is left where it fails."""
    from fem.cli import app

    out = path.parent / "out"
    for old in out.glob("*"):
        old.unlink()
    how, why = of_command(app, path, "--out", out)
    results = out / f"{path.stem}.h5"
    if how is Outcome.message and any(out.glob("*")):
        left = ", ".join(p.name for p in out.glob("*"))
        return Outcome.bad, f"a message, and files left: {left}"
    if how is not Outcome.right:
        return how, why
    if not results.is_file():
        return Outcome.bad, "status 0 without results"
    return _judged(results, read_points(read_deck(path)), why)


def _judged(results: Path, points: Points, said: str) -> tuple[Outcome, str]:
    with h5py.File(results) as file:
        infinite: list[str] = []

        def look(name: str, item: object) -> None:
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
                values = item[()]
                blanks = "element_" in name or "quality" in name
                wrong = np.isinf(values) if blanks else ~np.isfinite(values)
                if wrong.any():
                    infinite.append(name)

        file.visititems(look)
        if infinite:
            return Outcome.bad, f"not finite: {', '.join(infinite)}"
        for name, case in file.get("static", {}).items():
            if "applied_load" not in case or "spc_force" not in case:
                continue
            force = case["applied_load"][:, :3] + case["spc_force"][:, :3]
            sum_ = np.einsum("gij,gj->i", points.rotation, force)
            forces = case["applied_load"][:, :3], case["spc_force"][:, :3]
            largest = np.abs(forces).max()
            warned = f"subcase {name}: loads and reactions balance to" in said
            if np.abs(sum_).max() > UNBALANCED * max(largest, 1e-30) and not warned:
                return Outcome.bad, f"subcase {name}: loads and reactions differ"
    return Outcome.right, ""

"""One deck: run as `fem` runs it, and judged by the file beside it."""

import multiprocessing
import re
import traceback
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from queue import Empty
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.suite.compare import differences
from benchmarks.suite.tables import Name, Table, read_f06, read_op2
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.files.op2 import write_op2
from fem.model.structure import Structure
from fem.solution import run_deck, solution_problems

_DECK = re.compile(r"\.(bdf|dat|nas)$", re.IGNORECASE)
# Difference that counts as right: of what is solved for, and of what follows from it.
SOLVED, DERIVED = 0.01, 0.05
_SOLVED = ("displacement", "frequency", "SPC force", "MPC force")
VERDICTS = ("right", "wrong", "nothing in common", "refused", "slow", "crashed")


@dataclass
class Outcome:
    """What became of a deck.

    Attributes:
        deck: its path below the folder.
        verdict: of VERDICTS.
        why: reasons, or the worst differences.
        beyond: tables whose difference is too large, by name.
    """

    deck: str
    verdict: str
    why: list[str] = field(default_factory=list)
    beyond: dict[str, float] = field(default_factory=dict)


def pairs(folder: Path) -> Iterator[tuple[Path, Path]]:
    """Decks with a SOL statement, each with the result file beside it (OP2 first)."""
    for deck in sorted(folder.rglob("*")):
        if not _DECK.search(deck.name) or not deck.is_file():
            continue
        near = {
            (p.stem.lower(), p.suffix.lower()): p
            for p in deck.parent.iterdir()
            if p.suffix.lower() in (".op2", ".f06")
        }
        beside = [near.get((deck.stem.lower(), end)) for end in (".op2", ".f06")]
        found = next((p for p in beside if p is not None), None)
        text = deck.read_text(errors="replace")[:20000]
        if found is not None and re.search(r"^\s*SOL\b", text, re.M | re.I):
            yield deck, found


def judge(deck: Path, reference: Path, folder: Path, seconds: float) -> Outcome:
    """Run and compare in a process of its own, which may fail or be stopped."""
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    name = str(deck.relative_to(folder))
    process = context.Process(target=_into, args=(queue, deck, reference, name))
    process.start()
    try:
        outcome = queue.get(timeout=seconds)
    except Empty:
        verdict = "slow" if process.is_alive() else "crashed"
        outcome = Outcome(name, verdict, [f"no answer within {seconds:.0f} s"])
    process.terminate()
    process.join()
    return outcome


def _into(queue: multiprocessing.Queue, deck: Path, reference: Path, name: str) -> None:
    try:
        queue.put(_outcome(deck, reference, name))
    except InputError as error:
        queue.put(Outcome(name, "refused", [line for line in error.problems]))
    except BaseException:
        queue.put(Outcome(name, "crashed", traceback.format_exc().splitlines()[-3:]))


def _outcome(deck: Path, reference: Path, name: str) -> Outcome:
    problems = solution_problems(deck)
    if problems:
        raise InputError(problems)
    ours, length = _ours(deck)
    try:
        theirs = read_op2(reference) if reference.suffix.lower() == ".op2" else {}
    except ValueError:
        theirs = {}
    listing = next(reference.parent.glob(f"{reference.stem}.[fF]06"), None)
    if listing is not None and not _shared(ours, theirs):
        theirs = read_f06(listing)
    found = differences(ours, theirs, length)
    if not found:
        return Outcome(name, "nothing in common")
    beyond = {
        d.name: d.value
        for d in reversed(found)
        if not d.value <= (SOLVED if d.name in _SOLVED else DERIVED)
    }
    why = [f"{d.name} {d.value:.2g}" for d in found[:4]]
    return Outcome(name, "wrong" if beyond else "right", why, beyond)


def _shared(ours: dict[Name, Table], theirs: dict[Name, Table]) -> bool:
    return bool(differences(ours, theirs))


def _ours(deck: Path) -> tuple[dict[Name, Table], float]:
    """Tables of our own results of a deck, as in our OP2 file, and its diagonal."""
    with TemporaryDirectory() as folder:
        model = read_deck(deck)
        results = run_deck(model, Path(folder) / "ours.h5")
        path = results.with_suffix(".op2")
        structure = Structure(model)
        write_op2(results, structure, path)
        xyz = structure.points.xyz
        size = np.ptp(xyz, axis=0) if len(xyz) else np.full(3, np.inf)
        return read_op2(path), float(np.linalg.norm(size))

"""One deck: run as `fem` runs it, and judged by the file beside it."""

import multiprocessing
import re
import traceback
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from queue import Empty
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.suite.compare import differences
from benchmarks.suite.hdf5_tables import read_nastran_hdf5
from benchmarks.suite.mystran_listing import read_mystran
from benchmarks.suite.printed_shear import balanced
from benchmarks.suite.tables import Name, Table, read_f06, read_op2
from fem.deck.reader import read_deck
from fem.deck.text.source import include_reach
from fem.errors import InputError
from fem.files.op2 import write_op2
from fem.model.structure import Structure
from fem.solution import Options, declared_solution, run_deck, solution_problems

_DECK = re.compile(r"\.(bdf|dat|nas|inp)$", re.IGNORECASE)
_RESULTS = (".op2", ".h5", ".f06")
# Difference that counts as right: of what is solved for, and of what follows from it.
SOLVED, DERIVED = 0.01, 0.05
_SOLVED = ("displacement", "frequency", "load factor", "SPC force", "MPC force")
VERDICTS = (
    "right",
    "wrong",
    "nothing in common",
    "ran",
    "refused",
    "slow",
    "crashed",
)


@dataclass
class Outcome:
    """What became of a deck.

    Attributes:
        deck: its path below the folder.
        verdict: of VERDICTS; "ran": there is no result file beside it.
        why: reasons, or the worst differences.
        beyond: tables whose difference is too large, by name.
        solution: of its SOL statement, 0 where it cannot be read.
        declared: whether that, or an ANALYSIS, is one of the solutions here.
    """

    deck: str
    verdict: str
    why: list[str] = field(default_factory=list)
    beyond: dict[str, float] = field(default_factory=dict)
    solution: int = 0
    declared: bool = True


def decks(folder: Path) -> Iterator[tuple[Path, list[Path]]]:
    """Decks with a SOL statement, each with the result files beside it (OP2 first)."""
    for deck in sorted(folder.rglob("*")):
        if not _DECK.search(deck.name) or not deck.is_file():
            continue
        near = {
            (p.stem.lower(), p.suffix.lower()): p
            for p in deck.parent.iterdir()
            if p.suffix.lower() in _RESULTS
        }
        beside = [near.get((deck.stem.lower(), end)) for end in _RESULTS]
        text = deck.read_text(errors="replace")[:20000]
        if re.search(r"^\s*SOL\b", text, re.M | re.I):
            yield deck, [p for p in beside if p is not None]


def judge(
    deck: Path, references: Sequence[Path], folder: Path, seconds: float
) -> Outcome:
    """Run and compare in a process of its own, which may fail or be stopped.

    INCLUDE reaches all of the folder.
    """
    with include_reach([folder]):
        outcome = _judge(deck, references, folder, seconds)
        with suppress(InputError):
            outcome.solution = declared_solution(deck)
            outcome.declared = not solution_problems(deck)
    return outcome


def _judge(
    deck: Path, references: Sequence[Path], folder: Path, seconds: float
) -> Outcome:
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    name = str(deck.relative_to(folder))
    process = context.Process(target=_into, args=(queue, deck, references, folder))
    process.start()
    try:
        outcome = queue.get(timeout=seconds)
    except Empty:
        verdict = "slow" if process.is_alive() else "crashed"
        outcome = Outcome(name, verdict, [f"no answer within {seconds:.0f} s"])
    process.terminate()
    process.join()
    return outcome


def _into(
    queue: multiprocessing.Queue, deck: Path, references: Sequence[Path], folder: Path
) -> None:
    name = str(deck.relative_to(folder))
    try:
        queue.put(_outcome(deck, references, name))
    except InputError as error:
        queue.put(Outcome(name, "refused", [line for line in error.problems]))
    except BaseException:
        queue.put(Outcome(name, "crashed", traceback.format_exc().splitlines()[-3:]))


def _outcome(deck: Path, references: Sequence[Path], name: str) -> Outcome:
    problems = solution_problems(deck)
    if problems:
        raise InputError(problems)
    ours, length = _ours(deck)
    if not references:
        return Outcome(name, "ran")
    theirs: dict[Name, Table] = {}
    for reference in references:
        with suppress(ValueError):
            theirs = _read(reference, buckling=declared_solution(deck) in _BUCKLING)
        if differences(ours, theirs):
            break
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


_BUCKLING = (105,)


def _read(path: Path, *, buckling: bool) -> dict[Name, Table]:
    if path.suffix.lower() == ".op2":
        return balanced(read_op2(path))
    if path.suffix.lower() == ".h5":
        return read_nastran_hdf5(path)
    return read_f06(path, buckling=buckling) or read_mystran(path, buckling=buckling)


def _ours(deck: Path) -> tuple[dict[Name, Table], float]:
    """Tables of our own results of a deck, as in our OP2 file, and its diagonal."""
    with TemporaryDirectory() as folder:
        model = read_deck(deck)
        # Nastran's tables of transients leave out what PLOAD1 does between the ends.
        plain = Options(bar_loads=False)
        results = run_deck(model, Path(folder) / "ours.h5", plain)
        path = results.with_suffix(".op2")
        structure = Structure(model)
        write_op2(results, structure, path)
        xyz = structure.points.xyz
        size = np.ptp(xyz, axis=0) if len(xyz) else np.full(3, np.inf)
        return read_op2(path), float(np.linalg.norm(size))

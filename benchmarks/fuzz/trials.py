"""Attempts in a process of their own: crashes, endless work and memory are seen, too.

    python -m benchmarks.fuzz.trials KIND FIRST COUNT FOLDER

The child tells of every attempt when it begins and how it ended, in lines of JSON; the
parent starts another one where it falls silent or dies.
"""

import json
import os
import random
import resource
import select
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from benchmarks.fuzz.outcome import Outcome

SECONDS = 240.0  # of one attempt, also where others work on the machine
_BYTES = 12_000_000_000  # of address space; the libraries alone take a third
_START = 400.0  # s until the first line: imports, good files


@dataclass(frozen=True, kw_only=True)
class Attempt:
    """How a damaged file was taken.

    Attributes:
        kind, seed: which attempt.
        outcome: how it ended.
        text: what is wrong, where it is bad.
    """

    kind: str
    seed: int
    outcome: Outcome
    text: str = ""


def attempts(
    kind: str, first: int, count: int, kept: Path, *, seconds: float = float("inf")
) -> Iterator[Attempt]:
    """Attempts of a kind, one after another.

    Args:
        kind: of `benchmarks.fuzz.kinds`.
        first, count: seeds.
        kept: folder for the files of those that are bad.
        seconds: begin none after so long.
    """
    end, last = time.monotonic() + seconds, first + count
    while first < last and time.monotonic() < end:
        with tempfile.TemporaryDirectory() as folder:
            for attempt in _of_child(kind, first, last - first, Path(folder)):
                first = attempt.seed + 1
                if attempt.outcome is Outcome.bad:
                    _keep(Path(folder), attempt.seed, kept / f"{kind}_{attempt.seed}")
                yield attempt
                if time.monotonic() >= end:
                    break


def _of_child(kind: str, first: int, count: int, folder: Path) -> Iterator[Attempt]:
    """Until the child has done all, dies, or takes too long over one."""
    line = ["benchmarks.fuzz.trials", kind, str(first), str(count), str(folder)]
    with subprocess.Popen(
        [sys.executable, "-m", *line],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        cwd=Path(__file__).parents[2],
        bufsize=0,  # what is buffered is not seen by `select`
    ) as child:
        assert child.stdout is not None
        seed, wait, why = first, _START, ""
        try:
            while True:
                ready, _, _ = select.select([child.stdout], [], [], wait)
                text = child.stdout.readline() if ready else b""
                if not ready:
                    why = f"took over {wait:g} s"
                elif not text:
                    status = child.wait(SECONDS)
                    if status == 0:
                        return
                    why = f"process died (status {status})"
                if not text:
                    yield Attempt(kind=kind, seed=seed, outcome=Outcome.bad, text=why)
                    return
                found = json.loads(text)
                seed = found["seed"]
                wait = SECONDS if "outcome" not in found else _START
                if "outcome" in found:
                    how = Outcome(found["outcome"])
                    yield Attempt(kind=kind, seed=seed, outcome=how, text=found["text"])
        finally:
            child.kill()


def _keep(folder: Path, seed: int, place: Path) -> None:
    place.mkdir(parents=True, exist_ok=True)
    for path in folder.glob(f"tried_{seed}_*"):
        if path.is_file() and not path.is_symlink():
            (place / path.name).write_bytes(path.read_bytes()[:10_000_000])


def _child(kind: str, first: int, count: int, folder: Path) -> None:
    from benchmarks.fuzz.kinds import KINDS

    tell = os.fdopen(os.dup(1), "w", buffering=1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    chosen = KINDS[kind]
    seeds = chosen.seeds(folder)
    for source in {*seeds}:  # else a message would be no merit
        outcome, text = chosen.outcome(source)
        if outcome is not Outcome.right:
            found = {"seed": first, "outcome": "bad", "text": f"{source.name}: {text}"}
            print(json.dumps(found), file=tell)
            sys.exit(1)
    resource.setrlimit(resource.RLIMIT_AS, (_BYTES, resource.RLIM_INFINITY))
    for seed in range(first, first + count):
        rng = random.Random(f"{kind}{seed}")
        source = rng.choice(seeds)
        # The child goes on while the parent keeps what was bad: names of their own.
        place = source.with_name(f"tried_{seed}_{source.name}")
        print(json.dumps({"seed": seed}), file=tell)
        try:
            chosen.damage(source, rng, place)
            outcome, text = chosen.outcome(place)
        except ImportError:
            raise
        except Exception:
            outcome, text = Outcome.bad, traceback.format_exc(limit=-6)
        found = {"seed": seed, "outcome": outcome.value, "text": text}
        print(json.dumps(found), file=tell)
        if outcome is not Outcome.bad:
            place.unlink(missing_ok=True)


if __name__ == "__main__":
    _child(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))

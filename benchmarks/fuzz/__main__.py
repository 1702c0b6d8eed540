"""Damages inputs of all kinds for a time: tried, message, right, bad.

    python -m benchmarks.fuzz [SECONDS] [SEED] [KIND ...]
    python -m benchmarks.fuzz disks|signals|races [COUNT]

What ends in neither a message nor an answer, a crash or endless work included, is kept
in out/fuzz under its kind and seed; the exit status is then 1.
"""

import random
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from benchmarks.fuzz import full_disk, signals
from benchmarks.fuzz.kinds import KINDS
from benchmarks.fuzz.outcome import Outcome
from benchmarks.fuzz.trials import attempts

_KEPT = Path("out", "fuzz")
_ENOUGH = 1_000_000  # seeds: the time ends before


def _told(name: str, counts: Counter[Outcome]) -> None:
    figures = ", ".join(f"{how.value} {counts[how]}" for how in Outcome)
    print(f"{name}: tried {counts.total()}, {figures}", flush=True)


def fuzz(
    seconds: float, first: int, kinds: Sequence[str] = (), count: int = _ENOUGH
) -> int:
    """Attempts of every kind in turn; exit status.

    Args:
        seconds: for all kinds together, in equal shares.
        first: seed.
        kinds: which; default all.
        count: of attempts of a kind, at most.
    """
    bad = 0
    for kind in kinds or KINDS:
        counts: Counter[Outcome] = Counter()
        share = seconds / len(kinds or KINDS)
        for attempt in attempts(kind, first, count, _KEPT, seconds=share):
            counts[attempt.outcome] += 1
            if attempt.outcome is Outcome.bad:
                print(f"{kind}, seed {attempt.seed}: {attempt.text}", flush=True)
        _told(f"{kind}, seeds from {first}", counts)
        bad += counts[Outcome.bad]
    return int(bad > 0)


def disks(count: int) -> int:
    """Every command on disks that fill up; exit status."""
    bad = 0
    for command in full_disk.COMMANDS:
        counts: Counter[Outcome] = Counter()
        with tempfile.TemporaryDirectory() as folder:
            tried = full_disk.attempts(command, count, random.Random(1), Path(folder))
            for outcome, text in tried:
                counts[outcome] += 1
                if outcome is Outcome.bad:
                    print(f"{command.name}: {text}", flush=True)
        _told(command.name, counts)
        bad += counts[Outcome.bad]
    return int(bad > 0)


def processes(what: str, count: int) -> int:
    """Every command interrupted, or doubled; exit status."""
    trial = {"signals": signals.interrupted, "races": signals.races}[what]
    bad = 0
    for name in signals.COMMANDS:
        counts: Counter[Outcome] = Counter()
        with tempfile.TemporaryDirectory() as folder:
            for outcome, text in trial(name, count, random.Random(1), Path(folder)):
                counts[outcome] += 1
                if outcome is Outcome.bad:
                    print(f"{name}: {text}", flush=True)
        _told(f"{what}, {name}", counts)
        bad += counts[Outcome.bad]
    return int(bad > 0)


def main(words: Sequence[str]) -> int:
    """See the module."""
    if words and words[0] == "disks":
        return disks(int(words[1]) if len(words) > 1 else 20)
    if words and words[0] in ("signals", "races"):
        return processes(words[0], int(words[1]) if len(words) > 1 else 12)
    seconds = float(words[0]) if words else 1500.0
    return fuzz(seconds, int(words[1]) if len(words) > 1 else 0, words[2:])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

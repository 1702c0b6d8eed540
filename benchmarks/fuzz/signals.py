"""Commands that are killed, interrupted, or run twice at once.

An interrupted command says so in one line, ends with 128 and the signal's number, and
leaves no temporary file. After any end, SIGKILL's too, the same command runs through
and gives the results of one that was left in peace. Of two at once in one folder one
succeeds and the other gets one line, or both succeed one after the other.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np

from benchmarks.fuzz.full_disk import write_inputs
from benchmarks.fuzz.outcome import Outcome

_ROOT = Path(__file__).parents[2]
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)
_SECONDS = 600.0
COMMANDS = {
    "run": "-m drake_landing run {given}/tiny_case.yaml --out {out}",
    "fem": "-m fem {given}/deck.bdf --op2 --paraview --out {out}",
    "campaign": "-m drake_landing campaign {given}/campaign.yaml --workers 2 "
    "--out {out}",
    "reduce": "-m drake_landing reduce {given}/tiny_aircraft.bdf --interface 1,5,9 "
    "--out {out}",
}


def _start(name: str, given: Path, out: Path) -> subprocess.Popen[str]:
    line = COMMANDS[name].format(given=given, out=out)
    return subprocess.Popen(
        [sys.executable, *line.split()],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(_ROOT), "DRAKE_LANDING_CACHE": "off"},
    )


def _ended(process: subprocess.Popen[str]) -> tuple[int, str]:
    _, told = process.communicate(timeout=_SECONDS)
    return process.returncode, told


def _parts(out: Path) -> list[str]:
    return [str(p.relative_to(out)) for p in out.rglob(".*.part*")]


def _numbers(out: Path) -> dict[str, np.ndarray]:
    """Displacements of the deck's result file, for comparison."""
    found: dict[str, np.ndarray] = {}
    for path in sorted(out.glob("*.h5")):
        with h5py.File(path) as file:

            def keep(name: str, item: object, path: Path = path) -> None:
                if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
                    found[f"{path.name}/{name}"] = item[()]

            file.visititems(keep)
    return found


def interrupted(
    name: str, count: int, rng: random.Random, folder: Path
) -> Iterator[tuple[Outcome, str]]:
    """A command ended at any time, then run again.

    Args:
        name: of `COMMANDS`.
        count: of attempts; the last one is followed by a run in peace.
        rng: chooses signals and times.
        folder: for inputs and results.
    """
    given, out, peace = folder / "given", folder / "out", folder / "peace"
    given.mkdir()
    write_inputs(given)
    start = time.monotonic()
    status, told = _ended(_start(name, given, peace))
    length = time.monotonic() - start
    if status:
        yield Outcome.bad, told[-800:]
        return
    for _ in range(count):
        number, after = rng.choice(_SIGNALS), rng.uniform(0.3, length)
        start = time.monotonic()
        process = _start(name, given, out)
        time.sleep(after)
        process.send_signal(number)
        status, told = _ended(process)
        if status == 0:  # the first run had to make what later ones find
            length = min(length, time.monotonic() - start)
        yield _judged(number, status, told, out, f"{number.name} after {after:.2f} s")
    status, told = _ended(_start(name, given, out))
    same = status == 0 and _alike(_numbers(out), _numbers(peace))
    what = "" if same else f"then in peace: status {status}: {told[-800:]}"
    yield Outcome.right if same else Outcome.bad, what
    shutil.rmtree(out)


def _judged(
    number: signal.Signals, status: int, told: str, out: Path, when: str
) -> tuple[Outcome, str]:
    if status == 0:  # it was through already
        return Outcome.right, ""
    if number == signal.SIGKILL:
        return (Outcome.message, "") if status == -number else (Outcome.bad, told)
    last = told.strip().splitlines()[-1:] or [""]
    words = "interrupted" if number == signal.SIGINT else f"ended by {number.name}"
    early = status == -number or "KeyboardInterrupt" in told  # Python itself starts
    if early and not out.exists():
        return Outcome.message, ""
    said = status == 128 + number and last == [words] and "Traceback" not in told
    if said and not _parts(out):
        return Outcome.message, ""
    return Outcome.bad, f"{when}: status {status}, left {_parts(out)}: {told[-800:]}"


def _alike(one: dict[str, np.ndarray], other: dict[str, np.ndarray]) -> bool:
    return one.keys() == other.keys() and all(
        np.array_equal(one[name], other[name], equal_nan=True) for name in one
    )


def races(
    name: str, count: int, rng: random.Random, folder: Path
) -> Iterator[tuple[Outcome, str]]:
    """Two at once in one folder; see `interrupted` for the arguments."""
    given, peace = folder / "given", folder / "peace"
    given.mkdir()
    write_inputs(given)
    _ended(_start(name, given, peace))
    for k in range(count):
        out = folder / f"out_{k}"
        first = _start(name, given, out)
        time.sleep(rng.uniform(0.0, 1.0))
        ends = [_ended(process) for process in (_start(name, given, out), first)]
        states = sorted(status for status, _ in ends)
        refused = all(
            "is being written by" in told and "Traceback" not in told
            for status, told in ends
            if status == 2
        )
        good = states in ([0, 0], [0, 2]) and refused and not _parts(out)
        good = good and _alike(_numbers(out), _numbers(peace))
        yield Outcome.right if good else Outcome.bad, "" if good else str(ends)[-800:]
        shutil.rmtree(out, ignore_errors=True)

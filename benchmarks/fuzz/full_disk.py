"""Disks that fill up under every command that writes.

A command runs once on a disk that is large enough, then on disks with less and less
room beside the results of that first run. It must then say in one line what could not
be written, end with status 1, and leave every earlier file as it was or new and whole.
The superuser gets small file systems in memory; for others files may not grow beyond a
size.
"""

import contextlib
import hashlib
import os
import random
import resource
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from benchmarks.fuzz.outcome import Outcome

_ROOT = Path(__file__).parents[2]
_TESTS = _ROOT / "tests"
_PAGE = 4096  # bytes that a small file takes
_SECONDS = 600.0


@dataclass(frozen=True)
class Command:
    """A command that writes into a folder.

    Attributes:
        name: of what it writes.
        line: arguments of Python, with the folder of inputs and that for results.
        caches: the folder is that of the caches, the results go elsewhere.
    """

    name: str
    line: Callable[[Path, Path], list[str | Path]]
    caches: bool = False


def _drake(*words: str | Path) -> list[str | Path]:
    return ["-m", "drake_landing", *words]


COMMANDS = (
    Command(
        "fem: HDF5, OP2, ParaView",
        lambda given, out: [
            *("-m", "fem", given / "deck.bdf", "--op2", "--paraview", "--out", out)
        ],
    ),
    Command(
        "reduce: OUTPUT4, DMIG, HDF5, CSV, PNG",
        lambda given, out: _drake(
            "reduce", given / "tiny_aircraft.bdf", "--interface", "1,5,9", "--out", out
        ),
    ),
    Command(
        "show: PNG, HTML, CSV",
        lambda given, out: _drake(
            "show", given / "tiny_aircraft.bdf", "--modes", "2", "--out", out
        ),
    ),
    Command(
        "model: deck", lambda _, out: _drake("model", "con", "--out", out / "c.bdf")
    ),
    Command(
        "new: case",
        lambda given, out: _drake(
            "new", out / "case.yaml", "--deck", given / "tiny_aircraft.bdf"
        ),
    ),
    Command(
        "run: HDF5, CSV, deck, HTML, PNG",
        lambda given, out: _drake("run", given / "tiny_case.yaml", "--out", out),
    ),
    Command(
        "conditions: CSV, deck, PNG",
        lambda given, out: _drake("conditions", given / "tiny_case.yaml", "--out", out),
    ),
    Command(
        "campaign: setups, HDF5, tables, page",
        lambda given, out: _drake(
            *("campaign", given / "campaign.yaml", "--scheduler", "here"),
            *("--out", out),
        ),
    ),
    Command(
        "caches",
        lambda given, out: _drake(
            "run", given / "tiny_case.yaml", "--out", given / "out"
        ),
        caches=True,
    ),
)


def write_inputs(folder: Path) -> None:
    """A case, a campaign and a deck that all commands can do with.

    Args:
        folder: for them.
    """
    source = _TESTS / "drake_landing"
    shutil.copy(source / "tiny_aircraft.bdf", folder)
    case = (source / "tiny_case.yaml").read_text()
    short = case.replace("duration: 0.4", "duration: 0.1")
    (folder / "tiny_case.yaml").write_text(short)
    (folder / "campaign.yaml").write_text(
        "name: tiny\nbase: tiny_case.yaml\naxes:\n"
        "  scenario.sink_rate: [0.6, 1.2]\nconfirm: {sample: 1, most: 1}\n"
    )
    deck = (source / "tiny_aircraft.bdf").read_text()
    deck = deck.replace("METHOD = 1", "METHOD = 1\nFORCE = ALL\nSTRESS = ALL")
    (folder / "deck.bdf").write_text(deck)


def _state(folder: Path) -> dict[str, str]:
    """Checksum of every file; of names alone where they come and go."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def _size(folder: Path) -> int:
    """Bytes in whole pages, as a file system counts them."""
    sizes = [p.stat().st_size for p in folder.rglob("*") if p.is_file()]
    return sum((size + _PAGE - 1) // _PAGE * _PAGE for size in sizes)


@contextlib.contextmanager
def small_disk(folder: Path, size: int) -> Iterator[None]:
    """A file system of so many bytes over a folder.

    Raises:
        OSError: the user may not mount one.
    """
    option = f"size={size},nr_inodes=100000"
    line = ["mount", "-t", "tmpfs", "-o", option, "tmpfs", str(folder)]
    if subprocess.run(line, capture_output=True, check=False).returncode:
        raise OSError(f"no file system can be mounted on {folder}")
    try:
        yield
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def _may_mount(folder: Path) -> bool:
    try:
        with small_disk(folder, 65_536):
            return True
    except OSError:
        return False


def _run(
    command: Command, given: Path, out: Path, largest: int | None = None
) -> tuple[int, str]:
    """Status and standard error; files may not grow beyond `largest` bytes."""

    def limit() -> None:
        if largest is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest))

    cache = str(out) if command.caches else "off"
    done = subprocess.run(
        [sys.executable, *map(str, command.line(given, out))],
        capture_output=True,
        text=True,
        check=False,
        timeout=_SECONDS,
        cwd=given,
        preexec_fn=limit,
        env={
            **os.environ,
            "PYTHONPATH": str(_ROOT),
            "DRAKE_LANDING_CACHE": cache,
            **({"XDG_CACHE_HOME": cache} if command.caches else {}),
        },
    )
    return done.returncode, done.stderr


def judged(
    status: int,
    message: str,
    before: dict[str, str],
    after: dict[str, str],
    *,
    may_fail: bool = True,
) -> tuple[Outcome, str]:
    """How a run ended, and what is wrong with it.

    Args:
        status, message: of the command.
        before, after: its folder.
        may_fail: else it must go on without what could not be written.
    """
    left = [name for name in after if ".part" in Path(name).name]
    lost = [name for name in before if name not in after]
    errors = [line for line in message.splitlines() if line.startswith("error: ")]
    if status == 0 and not left and not lost:
        return Outcome.right, ""
    said = len(errors) == 1 and "Traceback" not in message
    if status == 1 and said and may_fail and not left and not lost:
        return Outcome.message, ""
    what = f"status {status}, left {left}, lost {lost}: {message.strip()[-600:]}"
    return Outcome.bad, what


def attempts(
    command: Command, count: int, rng: random.Random, folder: Path
) -> Iterator[tuple[Outcome, str]]:
    """A command on disks with ever other room.

    Args:
        command: one of `COMMANDS`.
        count: of disks.
        rng: chooses their sizes.
        folder: for inputs and results.
    """
    given, first, out = folder / "given", folder / "first", folder / "out"
    for place in (given, first, out):
        place.mkdir()
    write_inputs(given)
    status, message = _run(command, given, first)
    if status:
        yield Outcome.bad, f"with room enough: {message[-600:]}"
        return
    total, inputs, mounts = _size(first), _state(given), _may_mount(out)
    biggest = max(p.stat().st_size for p in first.rglob("*") if p.is_file())
    keeps = command.name != "new: case"  # it never replaces a file
    for k in range(count):
        share = 1.02 * (k + rng.random()) / count
        kept = keeps and not command.caches
        # Each file that is replaced frees the room of the earlier one.
        room = 2 * _PAGE + (total + share * biggest if kept else share * total)
        disk = small_disk(out, int(room)) if mounts else contextlib.nullcontext()
        with disk:
            if kept:
                shutil.copytree(first, out, dirs_exist_ok=True)
            before = _state(out)
            largest = None if mounts else int(share * biggest)
            status, message = _run(command, given, out, largest)
            after = _state(out)
        outcome, what = judged(
            status, message, before, after, may_fail=not command.caches
        )
        if not command.caches and _state(given) != inputs:
            outcome, what = Outcome.bad, "inputs changed"
        yield outcome, f"{share:.0%} of what it needs: {what}" if what else ""
        if not mounts:
            shutil.rmtree(out)
            out.mkdir()

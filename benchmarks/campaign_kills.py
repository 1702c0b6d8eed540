"""A campaign that is killed again and again: nothing lost, nothing twice, same tables.

    python -m benchmarks.campaign_kills [--kills 20] [--seed 0]

A campaign of the beam aircraft of the tests runs with two workers. At random times
either a worker or the command itself, which holds the scheduler, gets SIGKILL; a
command that died is started again. At the end every landing has one result, none was
computed again after its file was there, and the tables are byte by byte those of an
undisturbed run with one worker.
"""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from time import monotonic, sleep

import psutil

from benchmarks.machine import description, load

ROOT = Path(__file__).resolve().parents[1]
_LANDINGS = 24
_CAMPAIGN = f"""\
name: kills
base: case.yaml
axes:
  scenario.sink_rate: {{from: 0.6, to: 1.8, count: {_LANDINGS}}}
confirm: {{sample: 3, most: 3, block: 2}}
"""


def prepare(folder: Path) -> Path:
    """The campaign file, its case and deck."""
    source = ROOT / "tests" / "drake_landing"
    shutil.copy(source / "tiny_aircraft.bdf", folder)
    case = (source / "tiny_case.yaml").read_text()
    (folder / "case.yaml").write_text(case.replace("duration: 0.4", "duration: 0.1"))
    path = folder / "campaign.yaml"
    path.write_text(_CAMPAIGN)
    return path


def start(campaign: Path, out: Path, workers: int) -> subprocess.Popen:
    """The command, in a session of its own."""
    code = (
        "from drake_landing.__main__ import main\nif __name__ == '__main__': main()\n"
    )
    script = campaign.with_name("command.py")
    script.write_text(code)
    return subprocess.Popen(
        [
            *(sys.executable, script, "campaign", campaign),
            *("--out", out, "--workers", str(workers)),
        ],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def kill_one(command: subprocess.Popen, choose: random.Random) -> str:
    """SIGKILL to a worker, or to the command; says which."""
    workers = [
        p
        for p in psutil.Process(command.pid).children(recursive=True)
        if "spawn_main" in " ".join(p.cmdline())
    ]
    if workers and choose.random() < 0.6:
        choose.choice(workers).send_signal(signal.SIGKILL)
        return "worker"
    command.send_signal(signal.SIGKILL)
    command.wait()
    end = monotonic() + 60.0
    while any(p.is_running() for p in workers) and monotonic() < end:
        sleep(0.1)
    left = sum(p.is_running() for p in workers)
    return "scheduler" + (f" ({left} workers live on)" if left else "")


def tables(out: Path) -> dict[str, bytes]:
    """Bytes of all tables."""
    return {p.name: p.read_bytes() for p in (out / "tables").glob("*.parquet")}


def written(out: Path) -> dict[str, int]:
    """Result files and when each was written."""
    return {p.name: p.stat().st_mtime_ns for p in (out / "cases").glob("*.h5")}


def main() -> None:
    """Prints what was killed and what was found."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--kills", type=int, default=20)
    options.add_argument("--seed", type=int, default=0)
    given = options.parse_args()
    choose = random.Random(given.seed)
    print(f"{description()}, load {load():.1f}")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        campaign = prepare(folder)
        begin = monotonic()
        assert start(campaign, folder / "calm", 1).wait() == 0
        calm = monotonic() - begin
        kills, twice, resumes = [], 0, []
        out, seen, round_ = folder / "killed0", {}, 0
        command, begun = start(campaign, out, 2), monotonic()
        while len(kills) < given.kills:
            sleep(choose.uniform(0.0, 1.0) * max(2.0, calm / 4.0))
            if command.poll() is None:
                kills.append(kill_one(command, choose))
            elif command.returncode == 0:
                check(out, folder / "calm")  # done: once more, from nothing
                round_ += 1
                out, seen = folder / f"killed{round_}", {}
            if command.poll() is not None:
                found = written(out)
                twice += sum(found[k] != v for k, v in seen.items() if k in found)
                seen, begun = found, monotonic()
                command = start(campaign, out, 2)
        assert command.wait() == 0
        resumes.append(monotonic() - begun)
        check(out, folder / "calm")
    print(f"{len(kills)} kills: {', '.join(kills)}")
    print(f"computed twice: {twice}; calm run {calm:.0f} s, last {resumes[-1]:.0f} s")


def check(out: Path, calm: Path) -> None:
    """Nothing is missing, and all tables are the same."""
    missing = set(written(calm)) - set(written(out))
    assert not missing, f"lost: {missing}"
    assert tables(out) == tables(calm), "tables differ"


if __name__ == "__main__":
    main()

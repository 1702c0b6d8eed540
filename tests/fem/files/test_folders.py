"""Folders and temporary files belong to one process."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from fem.errors import InputError
from fem.files.atomic import PART, write_aside, written_aside
from fem.files.folders import claim

HOLD = """
import sys
from pathlib import Path
from fem.files.folders import claim
try:
    claim(Path(sys.argv[1]), "fem", sys.argv[2])
except ValueError as error:
    print(error)
    sys.exit(2)
print("held", flush=True)
sys.stdin.read(1)
"""


def holder(folder: Path, work: str = "a") -> subprocess.Popen:
    command = [sys.executable, "-c", HOLD, str(folder), work]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True)


def test_the_second_comer_gets_one_line(tmp_path):
    first = holder(tmp_path)
    assert first.stdout is not None
    assert first.stdout.readline() == "held\n"
    with pytest.raises(InputError, match=f"written by process {first.pid} on"):
        claim(tmp_path, "fem", "a")
    claim(tmp_path, "fem", "b")  # another deck's results
    first.kill()
    first.wait()
    first.stdout.close()
    first.stdin.close()
    claim(tmp_path, "fem", "a")  # the lock went with its process


def test_commands_respect_each_other(tmp_path):
    claim(tmp_path, "run tiny")
    with pytest.raises(InputError, match="holds the results of 'run tiny'"):
        claim(tmp_path, "fem", "wing")


def test_temporary_files_of_dead_processes_go(tmp_path):
    dead = tmp_path / f".results.{2**22 + 1}-{'0' * 16}.part.h5"
    mine = tmp_path / f".results.{os.getpid()}-{'0' * 16}.part.h5"
    other = tmp_path / ".results.part.h5"
    for path in (dead, mine, other):
        path.touch()
    claim(tmp_path, "fem")
    assert not dead.exists()
    assert mine.exists()
    assert other.exists()


def test_planted_links_are_not_followed(tmp_path):
    precious = tmp_path / "precious"
    precious.write_text("kept")
    for name in (".x.part.h5", "x.h5"):
        (tmp_path / name).symlink_to(precious)
    write_aside(tmp_path / "x.h5", lambda part: part.write_text("new"))
    assert precious.read_text() == "kept"
    assert (tmp_path / "x.h5").read_text() == "new"
    assert not (tmp_path / "x.h5").is_symlink()


def test_temporary_names_are_unique(tmp_path):
    with written_aside(tmp_path / "x.h5") as a, written_aside(tmp_path / "x.h5") as b:
        assert a != b
        assert PART.match(a.name)
    with written_aside(tmp_path / ("y" * 240 + ".h5")) as long:
        long.write_text("z")


def test_a_planted_lock_is_no_way_out(tmp_path):
    precious = tmp_path / "precious"
    precious.write_text("kept")
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / ".lock").symlink_to(precious)
    with pytest.raises(OSError, match=r"symbolic|loop|links"):
        claim(folder, "fem")
    assert precious.read_text() == "kept"

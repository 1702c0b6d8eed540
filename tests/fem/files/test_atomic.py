"""Files appear complete or not at all, whatever stops their writing."""

import errno
import resource
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from fem.files.atomic import written_aside
from fem.files.atomic_hdf5 import written_hdf5
from fem.files.hdf5 import ResultFile


@contextmanager
def small_disk(size: int) -> Iterator[None]:
    """The system refuses to let files grow beyond a size."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)


def write_text(path: Path) -> None:
    with written_aside(path) as part, part.open("w") as file:
        file.writelines("x" * 1000 for _ in range(1000))


def write_hdf5(path: Path) -> None:
    with written_hdf5(path) as file:
        file["a"] = np.zeros(10**6)


@pytest.mark.parametrize("write", [write_text, write_hdf5])
def test_a_full_disk_leaves_the_old_file_and_names_it(tmp_path: Path, write) -> None:
    path = tmp_path / "results.h5"
    path.write_text("old")
    with small_disk(100_000), pytest.raises(OSError, match=str(path)) as caught:
        write(path)
    assert caught.value.errno == errno.EFBIG
    assert caught.value.filename == str(path)
    assert [p.name for p in tmp_path.iterdir()] == ["results.h5"]
    assert path.read_text() == "old"


MANY = """
import resource, sys
from pathlib import Path
import h5py, numpy as np
from fem.files.hdf5 import ResultFile
from fem.files.atomic_hdf5 import written_hdf5

def write(path):
    with written_hdf5(path) as file:
        for k in range(40):
            group = file.create_group(f"group_{k}")
            group.attrs["columns"] = [f"column {i}" for i in range(60)]
            group["value"] = np.full((k + 1, 50), float(k))
            table = group.create_dataset("rows", (40, 30), "f8", chunks=(7, 30))
            for i in range(0, 40, 5):
                table[i : i + 5] = i

path = Path(sys.argv[1])
write(path)
whole = path.read_bytes()
for size in range(0, len(whole), len(whole) // 40):
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))
    try:
        write(path)
    except OSError as error:
        assert error.filename == str(path), error
    else:
        raise SystemExit(f"{size} of {len(whole)} bytes were enough")
    assert path.read_bytes() == whole
    assert list(path.parent.iterdir()) == [path]
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY,) * 2)
write(path)
with h5py.File(path) as file:
    assert file["group_39/value"][0, 0] == 39.0
"""


def test_hdf5_outlives_a_disk_that_fills_up_anywhere(tmp_path: Path) -> None:
    """HDF5 by itself ends the process when it cannot close a file."""
    line = [sys.executable, "-c", MANY, str(tmp_path / "a.h5")]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_an_interrupt_leaves_nothing(tmp_path: Path) -> None:
    def write() -> None:
        with written_aside(tmp_path / "a.txt") as part:
            part.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write()
    assert list(tmp_path.iterdir()) == []


def test_a_complete_file_replaces_the_old_one(tmp_path: Path) -> None:
    path = tmp_path / "new folder" / "a.txt"
    for text in ("old", "new"):
        with written_aside(path) as part:
            part.write_text(text)
    assert path.read_text() == "new"
    assert list(path.parent.iterdir()) == [path]


def test_errors_of_other_files_keep_their_names(tmp_path: Path) -> None:
    with (
        pytest.raises(FileNotFoundError) as caught,
        written_aside(tmp_path / "a.txt"),
    ):
        (tmp_path / "source").read_text()
    assert caught.value.filename == str(tmp_path / "source")


def test_a_folder_that_may_not_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("a file")
    with (
        pytest.raises(OSError, match="taken"),
        written_aside(tmp_path / "taken" / "a.txt") as part,
    ):
        part.write_text("x")


def test_results_that_no_disk_holds_are_refused_before_the_work(tmp_path: Path) -> None:
    path = tmp_path / "a.h5"

    def begin() -> None:
        with ResultFile(path) as results:
            results.file.create_dataset("a", (10**12,), dtype="f8")
            results.require_room()

    with pytest.raises(OSError, match=r"results of 8,000,000 MB, .* MB are free") as e:
        begin()
    assert e.value.errno == errno.ENOSPC
    assert list(tmp_path.iterdir()) == []

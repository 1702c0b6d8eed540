"""Files appear complete or not at all, whatever stops their writing."""

import errno
import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import h5py
import numpy as np
import pytest

from fem.files.aside import written_aside


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
    with written_aside(path) as part, h5py.File(part, "w") as file:
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

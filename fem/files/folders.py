"""Folders of results: each command has its own, and none takes another's.

A folder says in the file `.made-by` whose results it holds. Whoever writes into it
holds the file `.lock`, with process and host in it; the system lets go of it when the
process ends, however that happens, so that no lock outlives its process.
"""

import atexit
import contextlib
import os
import socket
from collections.abc import Iterator
from pathlib import Path

from fem.errors import InputError
from fem.files.atomic import PART, written_aside

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None

_MARK = ".made-by"
_LONGEST = 1000  # bytes of it
_held: dict[Path, int] = {}  # lock -> open file, for the life of the process


def claim(folder: Path, maker: str, work: str = "") -> Path:
    """The folder, made where it is not there, for the results of a command.

    Args:
        folder: as given by --out, or the default.
        maker: command and what it works on, "run tiny"; run again, it may replace its
            own results.
        work: where a command puts several results into one folder, which of them.

    Raises:
        InputError: the folder holds results of something else, somebody else writes
            into it, it is a file, or a folder in it is a link.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError(f"--out: {folder} is a file, expected a folder")
    mark = folder / _MARK
    found = _maker(mark) or maker
    if found != maker:
        raise InputError(
            f"--out: {folder} holds the results of '{found}', those of '{maker}' would "
            "overwrite them; give another folder, or delete this one"
        )
    folder.mkdir(parents=True, exist_ok=True)
    _refuse_links(folder)
    _lock(folder.resolve() / _lock_name(work), folder)
    _sweep(folder)
    with written_aside(mark) as part:
        part.write_text(maker + "\n", encoding="utf-8")
    return folder


def _refuse_links(folder: Path) -> None:
    """Results go into a folder, not to where a link in it leads."""
    for place, names, _ in os.walk(folder):
        for name in names:
            path = Path(place, name)
            if path.is_symlink():
                raise InputError(
                    f"--out: {path} is a link to {path.readlink()}, expected a folder "
                    "of its own; give another folder, or remove the link"
                )


def _maker(mark: Path) -> str:
    """Whose results there are; a link tells nothing of where it leads."""
    if mark.is_symlink() or not mark.is_file():
        return ""
    with mark.open("rb") as file:
        return file.read(_LONGEST).decode("utf-8", "replace").strip()


@contextlib.contextmanager
def claimed(folder: Path, maker: str, work: str = "") -> Iterator[Path]:
    """The folder as `claim` gives it, for as long as the work lasts.

    Work that fails leaves no mark where there was none, and no empty folder.
    """
    made, marked = not folder.exists(), (folder / _MARK).exists()
    claim(folder, maker, work)
    try:
        yield folder
    except BaseException:
        if not marked:
            (folder / _MARK).unlink(missing_ok=True)
        raise
    finally:
        _release(folder.resolve() / _lock_name(work))
        if made:
            with contextlib.suppress(OSError):  # there are results
                folder.rmdir()


def _lock_name(work: str) -> str:
    return f".lock-{work}" if work else ".lock"


def _release(path: Path) -> None:
    file = _held.pop(path, None)
    if file is not None:
        path.unlink(missing_ok=True)
        os.close(file)


@atexit.register
def _release_all() -> None:
    for path in list(_held):
        with contextlib.suppress(OSError):
            _release(path)


def _lock(path: Path, folder: Path) -> None:
    if fcntl is None or path in _held:
        return
    flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
    file = os.open(path, flags, 0o666)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        owner = os.read(file, 200).decode("utf-8", "replace").strip()
        os.close(file)
        raise InputError(
            f"--out: {folder} is being written by {owner or 'another process'}; wait "
            "for it, or give another folder"
        ) from None
    except OSError:  # a file system without locks
        os.close(file)
        return
    if not path.exists() or os.fstat(file).st_ino != path.stat().st_ino:
        os.close(file)  # whoever had it let go of it just now
        _lock(path, folder)
        return
    with contextlib.suppress(OSError):  # a full disk: the lock holds without its text
        os.ftruncate(file, 0)
        os.write(file, f"process {os.getpid()} on {socket.gethostname()}\n".encode())
    _held[path] = file


def _sweep(folder: Path) -> None:
    """Temporary files of processes that are no more."""
    for path in folder.iterdir():
        match = PART.match(path.name)
        if match and not _alive(int(match[1])):
            with contextlib.suppress(OSError):
                path.unlink()


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except OSError:
        return True
    return True

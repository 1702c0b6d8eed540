"""Files that appear when they are complete, or not at all."""

import os
import re
import secrets
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

# Name of a temporary file: its process, digits that nobody can foresee.
PART = re.compile(r"\..*\.(\d+)-[0-9a-f]{16}\.part[^.]*(?:\.\w+)?$")
_LONGEST = 100  # characters of a stem

# What HDF5 says of the system's error.
_ERRNO = re.compile(r"errno = (\d+)")


@contextmanager
def written_aside(path: Path) -> Iterator[Path]:
    """A temporary name in the folder of a file, renamed at the end.

    A reader never meets a half-written file, and whatever stops the writing, a full
    disk or Ctrl-C, leaves the old file and nothing else. The folder is made.

    Raises:
        OSError: names the file itself.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    part = _reserved(path)
    try:
        yield part
        part.replace(path)
    except (OSError, RuntimeError) as error:  # the latter from HDF5
        problem = _of_target(error, part, path)
        if problem is None:
            raise
        raise problem from None
    finally:
        part.unlink(missing_ok=True)


def _reserved(path: Path) -> Path:
    """A file of ours alone: nothing that lies there is opened or followed."""
    number = f"{os.getpid()}-{secrets.token_hex(8)}"
    part = path.with_name(f".{path.stem[:_LONGEST]}.{number}.part{path.suffix}")
    flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY | getattr(os, "O_NOFOLLOW", 0)
    try:
        os.close(os.open(part, flags, 0o666))
    except OSError as error:
        number = error.errno or 0
        raise OSError(number, os.strerror(number), str(path)) from None
    return part


def write_aside(path: Path, write: Callable[[Path], object]) -> None:
    """Calls `write` with a temporary name in the same folder, then renames.

    A reader never meets a half-written file, and an interrupted run leaves the old one.
    """
    with written_aside(path) as part:
        write(part)


def _of_target(error: Exception, part: Path, path: Path) -> OSError | None:
    """The error in terms of the file that was to be; None where it is another's."""
    found = _ERRNO.search(str(error))
    number = getattr(error, "errno", None) or (int(found[1]) if found else None)
    name = getattr(error, "filename", None)
    if number is None or name not in (None, str(part)):
        return None
    return OSError(number, os.strerror(number), str(path))

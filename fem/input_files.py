"""Text files from outside: regular files of a size that can be, in an encoding that is
known. Folders, devices and pipes are named for what they are, and never waited for."""

import stat
from pathlib import Path

from fem.errors import InputError, nearest

_UTF_16 = (b"\xff\xfe", b"\xfe\xff")


def expect_file(path: Path) -> None:
    """Raises an InputError, with the nearest name, where nothing is at a path."""
    if path.exists():
        return
    others: list[str] = []
    if path.parent.is_dir():
        others = sorted(p.name for p in path.parent.iterdir() if p.is_file())
    raise InputError(f"{path}: no such file{nearest(path.name, others)}")


def input_bytes(path: Path, what: str, most: int = 100_000_000) -> bytes:
    """Content of a file.

    Args:
        path: as the user gave it.
        what: is expected, "case file", for the message.
        most: bytes.

    Raises:
        InputError: it cannot be read, or is no regular file, or too large.
    """
    try:
        found = path.stat()
        if not stat.S_ISREG(found.st_mode):
            kind = "a folder" if stat.S_ISDIR(found.st_mode) else "a device or pipe"
            raise InputError(f"{path}: is {kind}, expected a {what}")
        if found.st_size > most:
            size = f"{found.st_size / 1e6:,.0f} MB"
            raise InputError(
                f"{path}: {size}, expected a {what} of at most {most / 1e6:,.0f} MB"
            )
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path}: no such {what}") from None
    except PermissionError:
        raise InputError(f"{path}: may not be read (permission denied)") from None
    except (OSError, ValueError) as error:  # the latter of names with NUL
        why = getattr(error, "strerror", None) or str(error)
        raise InputError(f"{path}: {why}, expected a {what}") from None


def input_text(path: Path, what: str, most: int = 100_000_000) -> str:
    """Text of a file in UTF-8, with or without its mark at the start.

    Raises:
        InputError: see `input_bytes`; or it is no such text.
    """
    data = input_bytes(path, what, most)
    if data.startswith(_UTF_16):
        raise InputError(f"{path}: text in UTF-16, expected a {what} in UTF-8")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path}: not a UTF-8 text file (byte {error.start})"
        ) from None

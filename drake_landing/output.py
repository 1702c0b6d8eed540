"""Folders of results: each command has its own, and none takes another's.

A folder says in the file `.made-by` whose results it holds.
"""

from pathlib import Path

from fem.errors import InputError
from fem.files.aside import written_aside

_MARK = ".made-by"


def claim(folder: Path, maker: str) -> Path:
    """The folder, made where it is not there, for the results of a command.

    Args:
        folder: as given by --out, or the default.
        maker: command and what it works on, "run tiny"; run again, it may replace its
            own results.

    Raises:
        InputError: the folder holds results of something else, or is a file.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError(f"--out: {folder} is a file, expected a folder")
    mark = folder / _MARK
    found = mark.read_text(encoding="utf-8").strip() if mark.is_file() else maker
    if found != maker:
        raise InputError(
            f"--out: {folder} holds the results of '{found}', those of '{maker}' would "
            "overwrite them; give another folder, or delete this one"
        )
    with written_aside(mark) as part:
        part.write_text(maker + "\n", encoding="utf-8")
    return folder

"""OUTPUT4 files, text (`op4_text`) and binary (`op4_binary`) told apart."""

from pathlib import Path

from fem.errors import InputError
from fem.matrix_files.named import NamedMatrix
from fem.matrix_files.op4_binary import byte_order, read_binary
from fem.matrix_files.op4_text import read_text


def read_output4(path: Path) -> list[NamedMatrix]:
    """All matrices of an OUTPUT4 file.

    Raises:
        InputError: no such file, or what is no OUTPUT4.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    with path.open("rb") as file:
        binary = byte_order(file.read(4)) is not None
    size = path.stat().st_size
    if binary:
        with path.open("rb") as file:
            return read_binary(file, str(path), size)
    with path.open(encoding="latin-1") as file:
        return read_text(file, str(path), size)

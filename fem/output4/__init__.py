"""OUTPUT4 files: matrices by name, text and binary."""

from pathlib import Path

from fem.errors import InputError
from fem.output4.named import NamedMatrix as NamedMatrix
from fem.output4.op4_binary import byte_order, read_binary
from fem.output4.op4_text import read_text


def read_output4(path: Path) -> dict[str, NamedMatrix]:
    """Matrices of an OUTPUT4 file by name.

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
            found = read_binary(file, str(path), size)
    else:
        with path.open(encoding="latin-1") as file:
            found = read_text(file, str(path), size)
    return {matrix.name: matrix for matrix in found}

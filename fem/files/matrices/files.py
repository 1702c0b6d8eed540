"""Matrix files by what they contain, not by what they are called."""

from collections.abc import Sequence
from pathlib import Path

from fem.errors import InputError
from fem.files.atomic import write_aside
from fem.files.matrices.dmig import read_punch, write_punch
from fem.files.matrices.nastran_h5 import read_h5
from fem.output4.named import NamedMatrix
from fem.output4.op4_binary import byte_order, read_binary, write_binary
from fem.output4.op4_text import read_text, write_text

_HDF5 = b"\x89HDF"


def read_matrices(path: Path) -> dict[str, NamedMatrix]:
    """All matrices of a file by name.

    Raises:
        InputError: no such file, no matrix in it, or a name twice.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    size = path.stat().st_size
    with path.open("rb") as file:
        start = file.read(4096)
    if start.startswith(_HDF5):
        found = read_h5(path)
    elif byte_order(start):
        with path.open("rb") as file:
            found = read_binary(file, str(path), size)
    elif b"DMIG" in start.upper():
        found = read_punch(path)
    else:
        with path.open(encoding="latin-1") as file:
            found = read_text(file, str(path), size)
    names = [matrix.name for matrix in found]
    if not found:
        raise InputError(f"{path}: no matrix; expected DMIG, OUTPUT4 or HDF5")
    if twice := sorted({n for n in names if names.count(n) > 1}):
        raise InputError(f"{path}: matrix {', '.join(twice)} is there twice")
    return dict(zip(names, found))


def write_op4(
    path: Path, matrices: Sequence[NamedMatrix], *, binary: bool = False
) -> None:
    """OUTPUT4 in double precision."""

    def write(part: Path) -> None:
        if binary:
            with part.open("wb") as file:
                for matrix in matrices:
                    write_binary(file, matrix)
            return
        with part.open("w", encoding="ascii") as file:
            for matrix in matrices:
                write_text(file, matrix)

    write_aside(path, write)


def write_dmig(path: Path, matrices: Sequence[NamedMatrix]) -> None:
    """DMIG as Nastran punches it: ten digits."""

    def write(part: Path) -> None:
        with part.open("w", encoding="ascii") as file:
            for matrix in matrices:
                write_punch(file, matrix)

    write_aside(path, write)

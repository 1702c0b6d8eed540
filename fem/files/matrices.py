"""Files of matrices by what they contain, not by what they are called.

Those that need no deck are those of `fem.matrix_files`; DMIG are cards of one.
"""

from collections.abc import Sequence
from pathlib import Path

from fem.errors import InputError
from fem.files.atomic import write_aside
from fem.files.dmig_punch import read_punch, write_punch
from fem.matrix_files.named import NamedMatrix
from fem.matrix_files.nastran_h5 import read_h5
from fem.matrix_files.op4_binary import byte_order, write_binary
from fem.matrix_files.op4_text import write_text
from fem.matrix_files.output4 import read_output4

_HDF5 = b"\x89HDF"


def read_matrices(path: Path) -> dict[str, NamedMatrix]:
    """All matrices of a file by name.

    Raises:
        InputError: no such file, no matrix in it, or a name twice.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    with path.open("rb") as file:
        start = file.read(4096)
    if start.startswith(_HDF5):
        found = read_h5(path)
    elif b"DMIG" in start.upper() and not byte_order(start):
        found = read_punch(path)
    else:
        found = read_output4(path)
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

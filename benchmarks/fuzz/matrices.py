"""Matrix files of every format, damaged: an error that names the file, or a matrix."""

import random
from pathlib import Path

import h5py
import numpy as np

from benchmarks.fuzz.mutations import mutate_bytes
from benchmarks.fuzz.outcome import Outcome
from fem.errors import InputError
from fem.files.matrices import read_matrices, write_dmig, write_op4
from fem.matrix_files.named import NamedMatrix
from fem.matrix_files.nastran_h5 import write_h5


def seeds(folder: Path) -> list[Path]:
    """Good files of each format, written by this program.

    Args:
        folder: for them.
    """
    values = np.random.default_rng(7).normal(size=(9, 9)) * 1e6
    values[3:6, :4] = 0.0
    labels = np.array([(10 + k // 6, k % 6 + 1) for k in range(9)])
    square = NamedMatrix(
        name="KAA", values=values + values.T, rows=labels, columns=labels
    )
    wide = NamedMatrix(name="GOA", values=values[:4], rows=labels[:4], columns=labels)
    both = [square, wide]
    write_op4(folder / "text.op4", both)
    write_op4(folder / "binary.op4", both, binary=True)
    write_dmig(folder / "punch.pch", both)
    free = "DMIG,K,0,6,1,0\nDMIG,K,1,1,,1,1,2.\n,2,0,-1.5\nDMIG,K,2,0,,2,0,4.\n"
    (folder / "free.bdf").write_text(free)
    strings = f"{3:8d}{-4:8d}{2:8d}{2:8d}{'A':8}1P,3E23.16\n{1:8d}{0:8d}{6:8d}\n"
    strings += f"{5:8d}{2:8d}\n{1.0:23.16E}{2.5:23.16E}\n"
    strings += f"{4:8d}{1:8d}{1:8d}\n{1.0:23.16E}\n"
    (folder / "sparse.op4").write_text(strings)
    with h5py.File(folder / "nastran.h5", "w") as file:
        write_h5(file, both)
    return sorted(folder.iterdir())


def damaged(seed: Path, rng: random.Random, place: Path) -> None:
    """Writes a damaged copy of a file.

    Args:
        seed: good file.
        rng: decides what happens to it.
        place: of the copy.
    """
    if seed.suffix == ".h5" and rng.random() < 0.6:
        place.write_bytes(seed.read_bytes())
        _lie(place, rng)
    else:
        place.write_bytes(mutate_bytes(seed.read_bytes(), rng))


def _lie(path: Path, rng: random.Random) -> None:
    """One number of a table of an HDF5 file, or a table itself, is another."""
    lies = [-1, 0, 1, 10, 10_000_000, 2**31, 2**62, -(2**62)]
    with h5py.File(path, "r+") as file:
        group = file["NASTRAN/RESULT/MATRIX/GENERAL"]
        name = rng.choice(["IDENTITY", "COLUMN", "DATA"])
        if rng.random() < 0.2:
            del group[name]
            if rng.random() < 0.5:
                group[name] = h5py.ExternalLink("/etc/hostname", "/x")
            return
        table = group[name][()]
        column = rng.choice(table.dtype.names)
        row = rng.randrange(len(table))
        floating = table.dtype[column].kind == "f"
        if table.dtype[column].kind != "S":
            table[column][row] = rng.choice(
                [np.nan, np.inf, 1e300] if floating else lies
            )
        group[name][...] = table


def outcome(path: Path) -> tuple[Outcome, str]:
    """Reads a file; matrices must be finite, messages name the file."""
    try:
        found = read_matrices(path)
    except InputError as error:
        if str(path) in str(error):
            return Outcome.message, ""
        return Outcome.bad, f"the file is not named: {error}"
    finite = all(np.isfinite(matrix.values).all() for matrix in found.values())
    return (Outcome.right, "") if found and finite else (Outcome.bad, "not finite")

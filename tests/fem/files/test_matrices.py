"""Matrix files: round trips, another program's files, broken files."""

import struct
from pathlib import Path

import h5py
import numpy as np
import pytest
from cpylog import SimpleLogger
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from pyNastran.op4.op4 import OP4

from fem.errors import InputError
from fem.files.matrices import read_matrices, write_dmig, write_op4
from fem.matrix_files.named import NamedMatrix
from fem.matrix_files.nastran_h5 import write_h5

NUMBERS = st.floats(-1e12, 1e12).map(lambda x: 0.0 if abs(x) < 1e-30 else x)
ANY = arrays(float, array_shapes(min_dims=2, max_dims=2, max_side=7), elements=NUMBERS)


def labelled(values: np.ndarray, name: str = "KAAX") -> NamedMatrix:
    def labels(n: int) -> np.ndarray:
        return np.array([(10 + k // 6, k % 6 + 1) for k in range(n)])

    n, m = values.shape
    return NamedMatrix(name=name, values=values, rows=labels(n), columns=labels(m))


@given(ANY)
@settings(max_examples=40, deadline=None)
@pytest.mark.parametrize("binary", [False, True])
def test_op4_keeps_every_digit(tmp_path_factory, binary: bool, values) -> None:
    path = tmp_path_factory.mktemp("op4") / "m.op4"
    both = [labelled(values), labelled(values.T.copy(), "MAAX")]
    write_op4(path, both, binary=binary)
    found = read_matrices(path)
    np.testing.assert_array_equal(found["KAAX"].values, values)
    np.testing.assert_array_equal(found["MAAX"].values, values.T)


@pytest.mark.parametrize("binary", [False, True])
def test_pynastran_reads_our_op4(tmp_path: Path, binary: bool) -> None:
    values = np.random.default_rng(1).normal(size=(7, 7)) * 1e7
    values[:, 3] = 0.0
    values[:2, 4] = 0.0
    path = tmp_path / "m.op4"
    write_op4(path, [labelled(values + values.T)], binary=binary)
    op4 = OP4(log=SimpleLogger("error"))
    matrices = op4.read_op4(str(path))
    matrix = matrices["KAAX"]
    form, data = (matrix.form, matrix.data) if hasattr(matrix, "form") else matrix
    assert form == 6
    np.testing.assert_allclose(data, values + values.T, rtol=1e-15)


def sparse_text(big: bool) -> str:
    """Column 1: rows 2-3; column 3: row 1, rows 3-4."""
    rows, digits = (-4, "{:8d}{:8d}") if big else (4, "{:8d}")

    def string(words: int, row: int) -> str:
        if big:
            return digits.format(words + 1, row) + "\n"
        return digits.format(row + 65536 * (words + 1)) + "\n"

    def value(*numbers: float) -> str:
        return "".join(f"{x:23.16E}" for x in numbers) + "\n"

    return (
        f"{3:8d}{rows:8d}{2:8d}{2:8d}{'A':8}1P,3E23.16\n"
        + f"{1:8d}{0:8d}{5 + big:8d}\n{string(4, 2)}{value(-2.0, 3.5)}"
        + f"{3:8d}{0:8d}{8 + 2 * big:8d}\n{string(2, 1)}{value(1.0)}"
        + f"{string(4, 3)}{value(-7.0, -8.0)}"
        + f"{4:8d}{1:8d}{1:8d}\n{value(1.0)}"
    )


SPARSE = np.array([[0, 0, 1.0], [-2.0, 0, 0], [3.5, 0, -7.0], [0, 0, -8.0]])


@pytest.mark.parametrize("big", [False, True])
def test_sparse_text(tmp_path: Path, big: bool) -> None:
    path = tmp_path / "m.op4"
    path.write_text(sparse_text(big))
    np.testing.assert_array_equal(read_matrices(path)["A"].values, SPARSE)


@pytest.mark.parametrize("big", [False, True])
@pytest.mark.parametrize(("order", "word"), [("<", 4), (">", 4), ("<", 8)])
def test_sparse_binary(tmp_path: Path, big: bool, order: str, word: int) -> None:
    integer = {4: "i", 8: "q"}[word]
    per_value = 8 // word

    def record(body: bytes) -> bytes:
        count = struct.pack(order + "i", len(body))
        return count + body + count

    def integers(*numbers: int) -> bytes:
        return struct.pack(f"{order}{len(numbers)}{integer}", *numbers)

    def string(row: int, *numbers: float) -> bytes:
        words = per_value * len(numbers)
        packed = (words + 1, row) if big else (row + 65536 * (words + 1),)
        return integers(*packed) + struct.pack(f"{order}{len(numbers)}d", *numbers)

    text = record(integers(3, -4 if big else 4, 2, 2) + b"A".ljust(2 * word))
    text += record(integers(1, 0, 5) + string(2, -2.0, 3.5))
    text += record(integers(3, 0, 8) + string(1, 1.0) + string(3, -7.0, -8.0))
    text += record(integers(4, 1, 1) + struct.pack(order + "d", 1.0))
    path = tmp_path / "m.op4"
    path.write_bytes(text)
    np.testing.assert_array_equal(read_matrices(path)["A"].values, SPARSE)


def test_dmig_keeps_ten_digits_and_names(tmp_path: Path) -> None:
    values = np.random.default_rng(2).normal(size=(9, 9)) * 10.0 ** np.arange(-8, 10, 2)
    path = tmp_path / "m.pch"
    square = labelled(values + values.T)
    rectangular = labelled(values[:, :3], "R")
    write_dmig(path, [square, rectangular])
    found = read_matrices(path)
    for written in (square, rectangular):
        read = found[written.name]
        np.testing.assert_allclose(read.values, written.values, rtol=6e-10)
        np.testing.assert_array_equal(read.rows, written.rows)
        np.testing.assert_array_equal(read.columns, written.columns)


def test_dmig_in_small_and_free_fields(tmp_path: Path) -> None:
    path = tmp_path / "m.bdf"
    path.write_text(
        "DMIG,K,0,6,1,0\nDMIG,K,1,1,,1,1,2.\n,2,0,-1.5\n"
        "DMIG    K       2       0               2       0       4.\n"
    )
    matrix = read_matrices(path)["K"]
    np.testing.assert_array_equal(matrix.values, [[2.0, -1.5], [-1.5, 4.0]])
    assert matrix.rows is not None
    assert matrix.rows.tolist() == [[1, 1], [2, 0]]


def test_matrices_in_nastrans_hdf5(tmp_path: Path) -> None:
    path = tmp_path / "m.h5"
    with h5py.File(path, "w") as file:
        write_h5(file, [labelled(SPARSE, "A"), labelled(np.eye(3), "B")])
    found = read_matrices(path)
    np.testing.assert_array_equal(found["A"].values, SPARSE)
    np.testing.assert_array_equal(found["B"].values, np.eye(3))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no matrix"),
        (b"GRID,1,,0.\n", "expected the header"),
        (sparse_text(True).encode()[:126], "ends within"),
        (struct.pack("<i", 24) + b"12345", "broken record"),
        (b"DMIG,K,1,1,,1,1,2.\n", "no header"),
        (b"\x89HDF\r\n\x1a\n", "no HDF5"),
    ],
)
def test_broken_files(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "m"
    path.write_bytes(content)
    with pytest.raises(InputError, match=words):
        read_matrices(path)

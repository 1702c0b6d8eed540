"""Text OUTPUT4 against other readers, and what its lines may and may not say."""

from pathlib import Path

import numpy as np
import pytest

from fem.errors import InputError
from fem.files.matrices import read_matrices, write_op4
from fem.matrix_files.named import NamedMatrix

END = f"{3:8d}{1:8d}{1:8d}\n 1.000000000E+00\n"


def op4(tmp_path: Path, *lines: str, head: str = "1P,5E16.9") -> Path:
    """A matrix of 3 rows, 2 columns, single precision."""
    path = tmp_path / "m.op4"
    start = f"{2:8d}{3:8d}{2:8d}{1:8d}{'K':8}{head}\n"
    path.write_text(start + "".join(line + "\n" for line in lines) + END)
    return path


def column(number: int, row: int, count: int) -> str:
    return f"{number:8d}{row:8d}{count:8d}"


ONE, TWO = " 1.500000000E+00", "-2.500000000E-01"
DENSE = [[1.5, 0], [-0.25, 0], [0, 1.5]]


def test_written_dense_columns_count_values(tmp_path):
    path = tmp_path / "m.op4"
    write_op4(path, [NamedMatrix(name="K", values=np.array(DENSE))])
    lines = path.read_text().splitlines()
    assert lines[1].split() == ["1", "1", "2"]
    assert lines[3].split() == ["2", "3", "1"]


def test_pyyeti_reads_what_is_written(tmp_path):
    other = pytest.importorskip("pyyeti.nastran.op4")
    values = np.random.default_rng(3).normal(size=(11, 7))
    values[2:5, 1] = 0.0
    values[:, 4] = 0.0
    for binary in (False, True):
        path = tmp_path / f"{binary}.op4"
        write_op4(path, [NamedMatrix(name="K", values=values)], binary=binary)
        np.testing.assert_array_equal(other.load(str(path))["k"][0], values)


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("sparse", ["dense", "bigmat", "nonbigmat"])
def test_what_pyyeti_writes_is_read(tmp_path, binary, sparse):
    other = pytest.importorskip("pyyeti.nastran.op4")
    real = np.random.default_rng(4).normal(size=(5, 6))
    real[1:3, 2] = 0.0
    matrices = {"r": real, "c": real + 1j * real[::-1]}
    path = tmp_path / "m.op4"
    other.write(str(path), matrices, binary=binary, sparse=sparse)
    found = read_matrices(path)
    for name, values in matrices.items():
        np.testing.assert_allclose(found[name.upper()].values, values, rtol=1e-15)


@pytest.mark.parametrize("head", ["", "1P,5E16.9", "(1P,5D16.9)", "5E16.9", "1P5E16.9"])
def test_formats_of_headers(tmp_path, head):
    lines = column(1, 1, 2), ONE + TWO, column(2, 3, 1), ONE
    path = op4(tmp_path, *lines, head=head)
    np.testing.assert_array_equal(read_matrices(path)["K"].values, DENSE)


def test_wide_integers(tmp_path):
    path = tmp_path / "m.op4"
    path.write_text(
        f"{2:16d}{3:16d}{2:8d}{1:8d}{'K':8}1P,5E16.9|I16\n"
        f"{1:16d}{1:16d}{2:16d}\n{ONE}{TWO}\n{2:16d}{3:16d}{1:16d}\n{ONE}\n"
        f"{3:16d}{1:16d}{1:16d}\n{ONE}\n"
    )
    np.testing.assert_array_equal(read_matrices(path)["K"].values, DENSE)


def test_columns_in_any_order(tmp_path):
    path = op4(tmp_path, column(2, 3, 1), ONE, column(1, 1, 2), ONE + TWO)
    np.testing.assert_array_equal(read_matrices(path)["K"].values, DENSE)


def test_exponents_of_three_digits(tmp_path):
    path = op4(tmp_path, column(1, 1, 1), " 1.50000000-100")
    assert read_matrices(path)["K"].values[0, 0] == 1.5e-100


def test_a_complex_matrix_beside_a_real_one(tmp_path):
    path = op4(tmp_path, column(1, 1, 2), ONE + TWO, column(2, 3, 1), ONE)
    start = f"{1:8d}{2:8d}{2:8d}{3:8d}{'Q':8}1P,5E16.9\n{column(1, 2, 2)}\n"
    more = f"{start}{ONE}{TWO}\n{column(2, 1, 1)}\n{ONE}\n"
    path.write_text(path.read_text() + more)
    found = read_matrices(path)
    np.testing.assert_array_equal(found["K"].values, DENSE)
    np.testing.assert_array_equal(found["Q"].values, [[0], [1.5 - 0.25j]])


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        ((column(0, 1, 1), ONE), "column 0, expected 1 or more"),
        ((column(-1, 1, 1), ONE), "column -1, expected 1 or more"),
        ((column(1, 1, 1), ONE, column(1, 2, 1), TWO), "column 1 is there twice"),
        ((column(1, -2, 1), ONE), "row -2"),
        ((column(1, 3, 2), ONE + TWO), "values down to row 4 of 3"),
        ((column(1, 1, 3), ONE + TWO), "announces 3 values, and has 2"),
        ((column(1, 1, 1), " 1.5E+999       "), "row 1, column 1 is inf"),
        ((column(1, 1, 1), "           ...  "), "could not convert"),
        ((column(1, 0, 3), "  131073", ONE, "  131099", ONE), "row 27 of 3"),
        ((ONE,), "values without a row"),
        ((column(1, 1, 1), ONE * 100), "has 160[01] characters"),
    ],
)
def test_lines_that_cannot_be(tmp_path, lines, words):
    with pytest.raises(InputError, match=words):
        read_matrices(op4(tmp_path, *lines))

"""Matrices from outside: sizes that lie, indices out of range, links, damage."""

import random
import struct
from pathlib import Path

import h5py
import numpy as np
import pytest

from benchmarks.fuzz.matrices import damaged, outcome, seeds
from benchmarks.fuzz.outcome import Outcome
from fem.errors import InputError
from fem.files.matrices import read_matrices
from fem.matrix_files.nastran_h5 import GROUP


@pytest.fixture
def h5(tmp_path) -> Path:
    return next(path for path in seeds(tmp_path) if path.suffix == ".h5")


@pytest.mark.parametrize(
    ("table", "column", "row", "value", "words"),
    [
        ("DATA", "ROW", 3, 10_000_000, "rows from 0 to 10000000, expected 0 to 8"),
        ("DATA", "ROW", 0, -1, "rows from -1"),
        ("DATA", "VALUE", 2, np.nan, "expected a finite number"),
        ("COLUMN", "POSITION", 2, 10**15, "columns overlap"),
        ("IDENTITY", "ROW", 0, 10**9, "would take 72.0 GB"),
        ("IDENTITY", "ROW", 0, 10**7, "the header says 10000000 x 9"),
        ("IDENTITY", "COLUMN", 0, -3, "-3 columns"),
        ("IDENTITY", "NON_ZERO", 0, 10**9, "terms 0 to 1000000000"),
        ("IDENTITY", "DATA_POS", 0, -5, "terms -5"),
        ("IDENTITY", "COLUMN_POS", 1, 10**9, "columns 1000000000"),
        ("IDENTITY", "FORM", 1, 6, "is said to be symmetric"),
    ],
)
def test_numbers_of_an_hdf5_file_that_lie(h5, table, column, row, value, words):
    with h5py.File(h5, "r+") as file:
        content = file[GROUP][table][()]
        content[column][row] = value
        file[GROUP][table][...] = content
    with pytest.raises(InputError, match=words):
        read_matrices(h5)


def test_links_of_an_hdf5_file_are_not_followed(h5, tmp_path):
    other = tmp_path / "other.h5"
    other.write_bytes(h5.read_bytes())
    for link in (h5py.ExternalLink(str(other), f"{GROUP}/DATA"), h5py.SoftLink("/x")):
        with h5py.File(h5, "r+") as file:
            del file[f"{GROUP}/DATA"]
            file[GROUP]["DATA"] = link
        with pytest.raises(InputError, match="is a link"):
            read_matrices(h5)


def test_a_group_that_is_a_link(h5, tmp_path):
    path = tmp_path / "linked.h5"
    with h5py.File(path, "w") as file:
        file["NASTRAN"] = h5py.ExternalLink(str(h5), "/NASTRAN")
    with pytest.raises(InputError, match="is a link"):
        read_matrices(path)


def test_storage_outside_the_file(h5, tmp_path):
    (tmp_path / "raw").write_bytes(b"\0" * 1600)
    with h5py.File(h5, "r+") as file:
        kind = file[f"{GROUP}/DATA"].dtype
        del file[f"{GROUP}/DATA"]
        raw = [(str(tmp_path / "raw"), 0, 1600)]
        file[GROUP].create_dataset("DATA", (100,), kind, external=raw)
    with pytest.raises(InputError, match="no dataset of this file"):
        read_matrices(h5)


def test_a_table_larger_than_its_file(h5):
    with h5py.File(h5, "r+") as file:
        kind = file[f"{GROUP}/DATA"].dtype
        del file[f"{GROUP}/DATA"]
        file[GROUP].create_dataset("DATA", (10**10,), kind, chunks=(1000,))
    with pytest.raises(InputError, match=r"160\.0 GB, in a file of"):
        read_matrices(h5)


@pytest.mark.parametrize(
    ("columns", "rows", "words"),
    [(100_000, 100_000, "80.0 GB"), (9_000_000, 1, "the header says 1 x 9000000")],
)
def test_headers_of_op4_that_lie(tmp_path, columns, rows, words):
    text = tmp_path / "text.op4"
    text.write_text(f"{columns:8d}{rows:8d}{2:8d}{2:8d}K       1P,3E23.16\n")
    binary = tmp_path / "binary.op4"
    head = struct.pack("<4i8s", columns, rows, 2, 2, b"K       ")
    binary.write_bytes(struct.pack("<i", 24) + head + struct.pack("<i", 24))
    for path in (text, binary):
        with pytest.raises(InputError, match=words):
            read_matrices(path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("DMIG,K,0,2,1,0\nDMIG,K,1,1,,1,9,2.", "component 9"),
        ("DMIG,K,0,2,1,0\nDMIG,K,-1,1,,1,1,2.", "point -1"),
        ("DMIG,K,0,2,1,0\nDMIG,K,1,1,,1,1,2.\n,1,1,3.", "has two values"),
        ("DMIG,K,0,6,1,0\nDMIG,K,1,1,,2,1,2.\nDMIG,K,2,1,,1,1,3.", "two values"),
        ("DMIG,K,0,6,3,0\nDMIG,K,1,1,,1,x,2.", "an integer"),
    ],
)
def test_terms_of_dmig_that_cannot_be(tmp_path, text, words):
    path = tmp_path / "k.bdf"
    path.write_text(text + "\n")
    with pytest.raises(InputError, match=words):
        read_matrices(path)


def test_complex_dmig_beside_a_real_one(tmp_path):
    path = tmp_path / "k.bdf"
    path.write_text(
        "DMIG,K,0,6,1,0\nDMIG,K,1,1,,1,1,2.\n"
        "DMIG,B,0,6,3,0\nDMIG,B,1,1,,1,1,2.,.5\n"
        "DMIG,P,0,2,3,0,1\nDMIG,P,1,1,,1,1,2.,90.\n"
    )
    found = read_matrices(path)
    assert found["K"].values.tolist() == [[2.0]]
    assert found["B"].values.tolist() == [[2.0 + 0.5j]]
    np.testing.assert_allclose(found["P"].values, [[2.0j]], atol=1e-15)


@pytest.mark.parametrize("seed", range(6))
def test_damaged_matrix_files_give_a_message_or_a_matrix(tmp_path, seed):
    rng = random.Random(seed)
    (tmp_path / "good").mkdir()
    for path in seeds(tmp_path / "good"):
        assert outcome(path)[0] is Outcome.right
        place = tmp_path / f"bad{path.suffix}"
        for _ in range(30):
            damaged(path, rng, place)
            assert outcome(place)[0] is not Outcome.bad

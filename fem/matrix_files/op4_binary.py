"""OUTPUT4 as Fortran records: dense, sparse, BIGMAT; 4- or 8-byte words.

Each record stands between two counts of its bytes. The header holds columns, rows,
form, type and name; a column holds its number, first row and words before its values,
see `op4_text` for strings.
"""

import struct
from collections.abc import Iterator
from typing import BinaryIO

import numpy as np
import numpy.typing as npt

from fem.errors import InputError
from fem.matrix_files.checks import check_size, checked
from fem.matrix_files.named import NamedMatrix

_STRING = 65536
_HEADERS = {24: 4, 48: 8}  # bytes of the header's record -> bytes of a word
_COMPLEX = (3, 4)
_SINGLE = (1, 3)


def byte_order(start: bytes) -> str | None:
    """`<` or `>` where the first bytes are those of an OUTPUT4 header, else None."""
    for order in "<>":
        if len(start) >= 4 and struct.unpack(order + "i", start[:4])[0] in _HEADERS:
            return order
    return None


def read_binary(file: BinaryIO, name: str, size: int) -> list[NamedMatrix]:
    """All matrices of a file.

    Args:
        file: open, at its start.
        name: how messages name it.
        size: in bytes.

    Raises:
        InputError: the file is cut, or no OUTPUT4.
    """
    order = byte_order(file.read(4)) or "<"
    file.seek(0)
    matrices = []
    records = _records(file, order, name, size)
    for record in records:
        word = _HEADERS.get(len(record), 0)
        if not word:
            raise InputError(f"{name}: a header of {len(record)} bytes, expected 24")
        integer = f"{order}i{word}"
        columns, rows, form, kind = np.frombuffer(record, integer, 4).tolist()
        title = record[4 * word :].decode("ascii", "replace").strip().upper()
        title = "".join(c if c.isprintable() else "?" for c in title)
        try:
            if kind not in (1, 2, 3, 4):
                raise ValueError(f"type {kind}, expected 1 to 4")
            parts = 2 if kind in _COMPLEX else 1
            real = f"{order}f{4 if kind in _SINGLE and word == 4 else 8}"
            check_size(abs(rows), columns, size, parts)
            values = np.zeros((columns, abs(rows) * parts))
            _fill(values, records, parts, rows < 0, integer, real)
            dense = values.view(complex if parts == 2 else float).T.copy()
            matrices.append(checked(title, dense, form))
        except ValueError as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{name}: matrix {title}: {error}") from None
    return matrices


def _fill(
    values: npt.NDArray,
    records: Iterator[bytes],
    parts: int,
    big: bool,
    integer: str,
    real: str,
) -> None:
    """Columns from records, up to the one that ends the matrix.

    Args:
        values: (columns, numbers of a column).
        records: of the file, from the first column.
        parts: numbers of a value.
        big: whether strings have heads of two words.
        integer, real: types of words and numbers.
    """
    word = np.dtype(integer).itemsize
    seen = set()
    for record in records:
        if len(record) < 3 * word:
            raise ValueError(f"a column of {len(record)} bytes")
        column, row, _ = np.frombuffer(record, integer, 3).tolist()
        if column > len(values):
            return
        if column < 1 or column in seen:
            what = "is there twice" if column in seen else "expected 1 or more"
            raise ValueError(f"column {column}, {what}")
        seen.add(column)
        body = record[3 * word :]
        for first, part in [(row, body)] if row else _strings(body, big, integer):
            numbers = np.frombuffer(part, real)
            start = (first - 1) * parts
            if first < 1 or start + len(numbers) > values.shape[1]:
                raise ValueError(
                    f"column {column}: {len(numbers) // parts} values from row {first} "
                    f"of {values.shape[1] // parts}"
                )
            values[column - 1, start : start + len(numbers)] = numbers
    raise ValueError("the file ends within the matrix")


def _strings(body: bytes, big: bool, integer: str) -> Iterator[tuple[int, bytes]]:
    """Row and bytes of each string of a sparse column."""
    word = np.dtype(integer).itemsize
    heads = 2 if big else 1
    at = 0
    while at < len(body):
        head = np.frombuffer(body[at : at + heads * word], integer).tolist()
        if len(head) < heads:
            raise ValueError("a string without its head")
        length, row = head if big else divmod(head[0], _STRING)
        at += heads * word
        end = at + (length - 1) * word
        if length < 1 or end > len(body):
            raise ValueError(f"a string of {length - 1} words in {len(body)} bytes")
        yield row, body[at:end]
        at = end


def _records(file: BinaryIO, order: str, name: str, size: int) -> Iterator[bytes]:
    while start := file.read(4):
        (count,) = struct.unpack(order + "i", start) if len(start) == 4 else (-1,)
        record = file.read(count) if 0 <= count <= size else b""
        if len(record) != count or file.read(4) != start:
            raise InputError(f"{name}: a broken record; the file is cut or no OUTPUT4")
        yield record


def write_binary(file: BinaryIO, matrix: NamedMatrix) -> None:
    """One matrix, dense, double precision, little-endian."""
    rows, columns = matrix.values.shape
    head = struct.pack("<4i", columns, rows, matrix.form, 2)
    _write(file, head + matrix.name.ljust(8).encode("ascii"))
    for k, column in enumerate(matrix.values.T):
        filled = np.flatnonzero(column)
        if len(filled) == 0:
            continue
        part = column[filled[0] : filled[-1] + 1]
        start = struct.pack("<3i", k + 1, filled[0] + 1, 2 * len(part))
        _write(file, start + part.astype("<f8").tobytes())
    _write(file, struct.pack("<3id", columns + 1, 1, 1, 1.0))


def _write(file: BinaryIO, record: bytes) -> None:
    count = struct.pack("<i", len(record))
    file.write(count + record + count)

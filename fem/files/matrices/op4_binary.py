"""OUTPUT4 as Fortran records: dense, sparse, BIGMAT; 4- or 8-byte words.

Each record stands between two counts of its bytes. The header holds columns, rows,
form, type and name; a column holds its number, first row and words before its values,
see `op4_text` for strings.
"""

import struct
from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from fem.errors import InputError
from fem.files.matrices.named import NamedMatrix

_STRING = 65536
_HEADERS = {24: 4, 48: 8}  # bytes of the header's record -> bytes of a word


def byte_order(start: bytes) -> str | None:
    """`<` or `>` where the first bytes are those of an OUTPUT4 header, else None."""
    for order in "<>":
        if len(start) >= 4 and struct.unpack(order + "i", start[:4])[0] in _HEADERS:
            return order
    return None


def read_binary(file: BinaryIO, name: str) -> list[NamedMatrix]:
    """All matrices of a file.

    Raises:
        InputError: the file is cut, or a matrix is complex.
    """
    order = byte_order(file.read(4)) or "<"
    file.seek(0)
    matrices = []
    records = _records(file, order, name)
    for record in records:
        word = _HEADERS.get(len(record), 0)
        if not word:
            raise InputError(f"{name}: a header of {len(record)} bytes, expected 24")
        integer = f"{order}i{word}"
        columns, rows, _, kind = np.frombuffer(record, integer, 4).tolist()
        title = record[4 * word :].decode("ascii", "replace").strip().upper()
        if kind not in (1, 2):
            raise InputError(f"{name}: {title} is complex, expected real")
        real = f"{order}f{4 if kind == 1 and word == 4 else 8}"
        values = np.zeros((abs(rows), columns))
        for record in records:
            column, row, _ = np.frombuffer(record, integer, 3).tolist()
            if column > columns:
                break
            body = record[3 * word :]
            parts = [(row, body)] if row else _strings(body, rows < 0, integer, word)
            for first, part in parts:
                numbers = np.frombuffer(part, real)
                if first - 1 + len(numbers) > abs(rows):
                    raise InputError(f"{name}: {title}: column {column} is too long")
                values[first - 1 : first - 1 + len(numbers), column - 1] = numbers
        else:
            raise InputError(f"{name}: the file ends within {title}")
        matrices.append(NamedMatrix(name=title, values=values))
    return matrices


def _strings(
    body: bytes, big: bool, integer: str, word: int
) -> Iterator[tuple[int, bytes]]:
    """Row and bytes of each string of a sparse column."""
    at = 0
    while at < len(body):
        if big:
            length, row = np.frombuffer(body, integer, 2, at).tolist()
            length, at = length - 1, at + 2 * word
        else:
            packed = int(np.frombuffer(body, integer, 1, at)[0])
            length, row, at = packed // _STRING - 1, packed % _STRING, at + word
        yield row, body[at : at + length * word]
        at += length * word


def _records(file: BinaryIO, order: str, name: str) -> Iterator[bytes]:
    while start := file.read(4):
        (count,) = struct.unpack(order + "i", start) if len(start) == 4 else (-1,)
        record = file.read(count) if count >= 0 else b""
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

"""OUTPUT4 as text: dense, sparse, and sparse of many rows (BIGMAT).

A matrix is a header (columns, rows, form, type, name, Fortran format), then for each
column "column, first row, words" and its values; first row 0 announces strings, each
with its own row: "words + 1, row" if the rows of the header are negative (BIGMAT), else
row + 65536 (words + 1) in one number. A column beyond the last ends it. Lines of values
have decimal points, lines of integers have none: word counts need not be trusted.

Reference: MSC Nastran DMAP Programmer's Guide, OUTPUT4.
"""

import re
from collections.abc import Iterator
from typing import TextIO

import numpy as np

from fem.arrays import Float64
from fem.errors import InputError
from fem.files.matrices.named import NamedMatrix

_HEADER = re.compile(
    r"^\s*(-?\d+)\s+(-?\d+)\s+(\d+)\s+(\d)\s*([A-Za-z]\w*)\s*(?:1P,?)?\s*(\d+)[ED](\d+)"
)
_STRING = 65536
_PER_LINE = 3
_REAL = (1, 2)


def read_text(lines: Iterator[str], file: str) -> list[NamedMatrix]:
    """All matrices of a file.

    Raises:
        InputError: what is no OUTPUT4 text, or complex.
    """
    matrices: list[NamedMatrix] = []
    numbered = enumerate(lines, 1)
    for number, line in numbered:
        if not line.strip():
            continue
        match = _HEADER.match(line)
        if match is None:
            raise InputError(
                f"{file}:{number}: found '{line.strip()[:40]}', expected the header of "
                "an OUTPUT4 matrix: columns, rows, form, type, name, format"
            )
        columns, rows, _, kind = (int(match[k]) for k in range(1, 5))
        if kind not in _REAL:
            raise InputError(f"{file}:{number}: {match[5]} is complex, expected real")
        try:
            values = _values(numbered, abs(rows), columns, rows < 0, int(match[7]))
        except (ValueError, IndexError) as error:
            raise InputError(f"{file}: matrix {match[5]}: {error}") from None
        matrices.append(NamedMatrix(name=match[5].upper(), values=values))
    return matrices


def _values(
    lines: Iterator[tuple[int, str]], rows: int, columns: int, big: bool, width: int
) -> Float64:
    values = np.zeros((rows, columns))
    column = row = 0
    for number, line in lines:
        if "." in line:
            numbers = _reals(line, width)
            if column > columns:  # the one value that follows the last column
                return values
            if row < 1 or row - 1 + len(numbers) > rows:
                raise ValueError(f"line {number}: row {row} of {rows}")
            values[row - 1 : row - 1 + len(numbers), column - 1] = numbers
            row += len(numbers)
            continue
        words = [int(word) for word in line.split()]
        if len(words) == 3:
            column, row = words[0], words[1]
        elif len(words) == 2 and big:
            row = words[1]
        elif len(words) == 1 and not big:
            row = words[0] % _STRING
        elif words:
            raise ValueError(f"line {number}: found '{line.strip()}'")
    raise ValueError("the file ends within the matrix")


def _reals(line: str, width: int) -> list[float]:
    text = line.rstrip().replace("D", "E")
    return [float(text[k : k + width]) for k in range(0, len(text), width)]


def write_text(file: TextIO, matrix: NamedMatrix) -> None:
    """One matrix, dense, double precision: every digit survives."""
    rows, columns = matrix.values.shape
    file.write(
        f"{columns:8d}{rows:8d}{matrix.form:8d}{2:8d}{matrix.name:8}1P,3E23.16\n"
    )
    for k, column in enumerate(matrix.values.T):
        filled = np.flatnonzero(column)
        if len(filled) == 0:
            continue
        part = column[filled[0] : filled[-1] + 1]
        file.write(f"{k + 1:8d}{filled[0] + 1:8d}{2 * len(part):8d}\n")
        texts = [f"{value:23.16E}" for value in part.tolist()]
        for start in range(0, len(texts), _PER_LINE):
            file.write("".join(texts[start : start + _PER_LINE]) + "\n")
    file.write(f"{columns + 1:8d}{1:8d}{1:8d}\n{1.0:23.16E}\n")

"""OUTPUT4 as text: dense, sparse, and sparse of many rows (BIGMAT).

A matrix is a header (columns, rows, form, type, name, Fortran format), eight columns
each, or sixteen for the first two where the line ends in |I16; without a format it is
5E16.9. Then for each column "column, first row, count" and its values, the parts of
complex ones after each other. The count of a dense column is that of its numbers. First
row 0 announces strings, each with its own row: "words + 1, row" if the rows of the
header are negative (BIGMAT), else row + 65536 (words + 1) in one number; the count of
such a column is that of all words, heads included, two for a number in double
precision. A column beyond the last ends the matrix. Lines of values have decimal
points, lines of integers have none. Counts are compared with what was read; those of
other writers, which count a number as a word or a word as a number, are accepted.

Reference: MSC Nastran DMAP Programmer's Guide, OUTPUT4; files written by MSC Nastran.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple, TextIO

import numpy as np
import numpy.typing as npt

from fem.arrays import Float64
from fem.errors import InputError
from fem.matrix_files.checks import check_size, checked
from fem.matrix_files.named import NamedMatrix

_FORMAT = re.compile(r"\(?(?:1P)?,?\s*(\d+)[ED](\d+)(?:\.\d+)?", re.IGNORECASE)
_SPLIT = re.compile(r"\s*(-?\d+)\s+(-?\d+)\s+(\d+)\s+(\d)\s*([A-Za-z]\w{0,7})\s*(.*)")
_SHORT_EXPONENT = re.compile(r"([+-]?\d*\.\d*)([+-]\d+)$")
_STRING = 65536
_PER_LINE = 3
_COMPLEX = (3, 4)
_DOUBLE = (2, 4)
_DEFAULT_WIDTH = 16  # of 5E16.9
_LONGEST = 1000  # characters of a line; Nastran writes 80


class _Header(NamedTuple):
    columns: int
    rows: int
    big: bool
    form: int
    kind: int
    name: str
    width: int

    @property
    def parts(self) -> int:
        """Numbers of a value."""
        return 2 if self.kind in _COMPLEX else 1

    @property
    def words(self) -> int:
        """Words of a number."""
        return 2 if self.kind in _DOUBLE else 1


def read_text(lines: Iterator[str], file: str, size: int) -> list[NamedMatrix]:
    """All matrices of a file.

    Args:
        lines: of the file.
        file: how messages name it.
        size: in bytes.

    Raises:
        InputError: what is no OUTPUT4 text.
    """
    matrices: list[NamedMatrix] = []
    numbered = enumerate(lines, 1)
    for number, line in numbered:
        if not line.strip():
            continue
        header = _header(line.rstrip())
        if header is None:
            raise InputError(
                f"{file}:{number}: expected the header of an OUTPUT4 matrix: columns, "
                "rows, form, type, name, format"
            )
        try:
            check_size(header.rows, header.columns, size, header.parts)
            values = _Columns(header).read(numbered)
            matrices.append(checked(header.name, values, header.form))
        except ValueError as error:
            raise InputError(f"{file}: matrix {header.name}: {error}") from None
    return matrices


def _header(line: str) -> _Header | None:
    """None where the line is none."""
    cuts = (0, 8, 16, 24, 32, 40)
    if line.endswith("|I16"):
        line, cuts = line[:-4], (0, 16, 32, 40, 48, 56)
    texts = [line[a:b].strip() for a, b in pairwise(cuts)]
    rest = line[cuts[-1] :]
    try:
        numbers = [int(text) for text in texts[:4]]
    except ValueError:
        match = _SPLIT.match(line[:200])
        if match is None:
            return None
        *found, name, rest = match.groups()
        numbers, texts = [int(text) for text in found], [*found, name]
    columns, rows, form, kind = numbers
    layout = _FORMAT.match(rest.strip())
    width = int(layout[2]) if layout else _DEFAULT_WIDTH
    known = kind in (1, 2, 3, 4) and 0 < width <= _LONGEST
    if not known or (rest.strip() and layout is None):
        return None
    return _Header(columns, abs(rows), rows < 0, form, kind, texts[4].upper(), width)


@dataclass
class _Columns:
    """The columns of a matrix while they are read.

    Attributes:
        header: of the matrix.
        column, row: where the next numbers go; row 0: a string must come first.
        count: announced by the column's head.
        numbers: read since the last head, of a column or a string.
        strings: words + 1 and numbers of the strings of the column.
    """

    header: _Header
    column: int = 0
    row: int = 0
    count: int = 0
    sparse: bool = False
    numbers: int = 0
    strings: list[tuple[int, int]] = field(default_factory=list)

    def __post_init__(self) -> None:
        shape = (self.header.columns, self.header.rows * self.header.parts)
        self.values: Float64 = np.zeros(shape)
        self.seen = np.zeros(self.header.columns + 1, bool)

    def read(self, lines: Iterator[tuple[int, str]]) -> npt.NDArray:
        """(rows, columns), real or complex; the lines after it are left."""
        for number, line in lines:
            try:
                if self.take(line):
                    kind = complex if self.header.parts == 2 else float
                    return self.values.view(kind).T.copy()
            except ValueError as error:
                raise ValueError(f"line {number}: {error}") from None
        raise ValueError("the file ends within the matrix")

    def take(self, line: str) -> bool:
        """Whether that was the last line."""
        if len(line) > _LONGEST:
            raise ValueError(f"has {len(line)} characters")
        if "." in line:
            if self.column > self.header.columns:
                return True  # the one value that follows the last column
            self.put(_reals(line, self.header.width))
            return False
        words = [int(word) for word in line.split()]
        if len(words) == 3:
            self.begin(*words)
        elif len(words) == 2 and self.header.big and self.sparse:
            self.begin_string(words[0], words[1])
        elif len(words) == 1 and not self.header.big and self.sparse:
            self.begin_string(words[0] // _STRING, words[0] % _STRING)
        elif words:
            raise ValueError("expected the head of a column, or values")
        return False

    def begin(self, column: int, row: int, count: int) -> None:
        self.finish()
        if column < 1:
            raise ValueError(f"column {column}, expected 1 or more")
        if column <= self.header.columns:
            if self.seen[column]:
                raise ValueError(f"column {column} is there twice")
            self.seen[column] = True
        if row < 0 or count < 0:
            raise ValueError(f"column {column}: row {row}, count {count}")
        self.column, self.row, self.count = column, row, count
        self.sparse, self.numbers, self.strings = row == 0, 0, []

    def begin_string(self, length: int, row: int) -> None:
        self.finish_string()
        if row < 1:
            raise ValueError(f"column {self.column}: a string at row {row}")
        self.row, self.numbers = row, 0
        self.strings.append((length, 0))

    def put(self, numbers: list[float]) -> None:
        parts = self.header.parts
        start = (self.row - 1) * parts + self.numbers
        end = start + len(numbers)
        if self.column < 1 or self.row < 1:
            raise ValueError("values without a row and a column")
        if end > self.values.shape[1]:
            raise ValueError(
                f"column {self.column}: values down to row {-(-end // parts)} "
                f"of {self.header.rows}"
            )
        self.values[self.column - 1, start:end] = numbers
        self.numbers += len(numbers)

    def finish(self) -> None:
        """Checks that all terms which a column announced have come."""
        if not self.sparse:
            self.compare(self.count, self.numbers, 0)
            return
        self.finish_string()
        numbers = sum(n for _, n in self.strings)
        self.compare(self.count, numbers, (1 + self.header.big) * len(self.strings))

    def finish_string(self) -> None:
        if self.strings:
            length = self.strings[-1][0]
            self.strings[-1] = (length, self.numbers)
            self.compare(length, self.numbers, 1)

    def compare(self, count: int, numbers: int, heads: int) -> None:
        if count not in (numbers + heads, self.header.words * numbers + heads):
            raise ValueError(
                f"column {self.column} announces {count - heads} values, "
                f"and has {numbers}"
            )


def _reals(line: str, width: int) -> list[float]:
    text = line.rstrip().upper().replace("D", "E")
    return [_real(text[k : k + width]) for k in range(0, len(text), width)]


def _real(text: str) -> float:
    """A number of Fortran's; E is left out before three digits of exponent."""
    try:
        return float(text)
    except ValueError:
        if (match := _SHORT_EXPONENT.match(text.strip())) is None:
            raise
        return float(f"{match[1]}E{match[2]}")


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
        file.write(f"{k + 1:8d}{filled[0] + 1:8d}{len(part):8d}\n")
        texts = [f"{value:23.16E}" for value in part.tolist()]
        for start in range(0, len(texts), _PER_LINE):
            file.write("".join(texts[start : start + _PER_LINE]) + "\n")
    file.write(f"{columns + 1:8d}{1:8d}{1:8d}\n{1.0:23.16E}\n")

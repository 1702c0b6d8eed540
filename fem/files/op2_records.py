"""Frames of OP2 files: FORTRAN records, tables, headers; 32 bits, little endian.

A table has a name and pairs of records: 146 words that say what follows (analysis,
result, element, time, widths, titles), and the data. The same frames as NX and MSC
Nastran write with PARAM,POST,-1.
"""

from dataclasses import dataclass
from typing import BinaryIO

import numpy as np
import numpy.typing as npt

_WORD = np.dtype("<i4")
_REAL = np.dtype("<f4")
DEVICE = 2  # plot

STATIC, MODAL, FREQUENCY, TRANSIENT, BUCKLING = 1, 2, 5, 6, 8


@dataclass(frozen=True, kw_only=True)
class State:
    """The load case, mode or time to which results belong.

    Attributes:
        analysis: STATIC, MODAL, FREQUENCY, BUCKLING or TRANSIENT.
        subcase: id.
        number: mode, from 1; 0 otherwise.
        value: eigenvalue, rad²/s², load factor, frequency, Hz, or time, s.
        frequency: Hz, of a mode.
        title: of the subcase.
    """

    analysis: int
    subcase: int
    number: int = 0
    value: float = 0.0
    frequency: float = 0.0
    title: str = ""


@dataclass(frozen=True, kw_only=True)
class Kind:
    """What a record of data holds.

    Attributes:
        table: name of the OP2 table, "OES1X1".
        code: Nastran's code of the result, 1 for displacements.
        element: element type, 0 for points.
        width: words per element or point.
        stress: Nastran's SCODE.
        parts: 1 for real numbers, 2 for real and imaginary parts, 3 for magnitude and
            phase.
    """

    table: str
    code: int
    element: int = 0
    width: int
    stress: int = 0
    parts: int = 1


class Op2File:
    """A file that is being written.

    Args:
        file: opened for binary writing.
    """

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._subtable = 0
        self._record(np.array([1, 1, 0], _WORD).tobytes())
        self._record(b"NASTRAN FORT TAPE ID CODE - ")
        self._record(b"NX8.5   ")
        self._markers(-1, 0)

    def begin_table(self, name: str) -> None:
        """Start a table."""
        label = name.encode().ljust(8)
        self._record(label)
        self._markers(-1)
        self._record(np.array([102, 0, 0, 0, 512, 0, 0], _WORD).tobytes())
        self._markers(-2, 1, 0)
        self._record(label + np.array([1, 1, 0, 0, 1], _WORD).tobytes())
        self._subtable = -3

    def add(self, kind: Kind, state: State, data: npt.NDArray[np.float32]) -> None:
        """Header and data of one state of one element type."""
        self._next_subtable()
        self._record(_header(kind, state))
        self._next_subtable()
        self._record(np.ascontiguousarray(data, _REAL).tobytes())

    def end_table(self) -> None:
        """Finish a table."""
        self._next_subtable()
        self._markers(0)

    def close(self) -> None:
        """Finish the file; the stream stays open."""
        self._markers(0)

    def _next_subtable(self) -> None:
        self._markers(self._subtable, 1, 0)
        self._subtable -= 1

    def _markers(self, *values: int) -> None:
        words = [word for value in values for word in (4, value, 4)]
        self._file.write(np.array(words, _WORD).tobytes())

    def _record(self, data: bytes) -> None:
        """A record: its length in words, then its data between lengths in bytes."""
        self._markers(len(data) // 4)
        frame = np.array([len(data)], _WORD).tobytes()
        self._file.write(frame + data + frame)


def _header(kind: Kind, state: State) -> bytes:
    """146 words before the data."""
    words = np.zeros(50, _WORD)
    words[0] = 10 * state.analysis + DEVICE
    # Thousands: the values are complex.
    words[1] = kind.code + (1000 if kind.parts > 1 else 0)
    words[2], words[3] = kind.element, state.subcase
    reals = words.view(_REAL)
    if state.analysis in (TRANSIENT, FREQUENCY):
        reals[4] = state.value
    elif state.analysis in (MODAL, BUCKLING):
        words[4] = state.number
        reals[5], reals[6] = state.value, state.frequency
    else:
        words[4] = state.subcase
    words[8], words[9], words[10] = kind.parts, kind.width, kind.stress
    title = state.title.encode("ascii", "replace")[:128].ljust(128)
    return words.tobytes() + title + b" " * 256

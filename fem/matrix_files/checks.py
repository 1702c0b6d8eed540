"""What every reader of matrices checks: sizes before memory is taken, values after.

A matrix from outside says how large it is before it shows a value. Nothing is allocated
on its word alone: beyond 64 MB a file must have a byte for each row and column, and
beyond 2 GB no matrix is read (a reduction of that size is none).
"""

import numpy as np
import numpy.typing as npt

from fem.arrays import Int64
from fem.matrix_files.named import SYMMETRIC, NamedMatrix

LARGEST = 2_000_000_000  # bytes of a matrix
_SMALL = 64_000_000  # bytes that no file needs to earn
_ASYMMETRIC = 1e-6  # of the largest term


def check_size(rows: int, columns: int, size: int, parts: int = 1) -> None:
    """A matrix may be allocated.

    Args:
        rows, columns: as the file says.
        size: of the file, bytes.
        parts: numbers of a value, 2 for complex ones.

    Raises:
        ValueError: it may not.
    """
    if rows < 0 or columns < 0:
        raise ValueError(f"{rows} rows, {columns} columns")
    memory = 8 * parts * rows * columns
    if memory > LARGEST:
        raise ValueError(
            f"{rows} x {columns} would take {memory / 1e9:,.1f} GB, more than the "
            f"{LARGEST / 1e9:g} GB that are read"
        )
    if memory > _SMALL and max(rows, columns) > size:
        raise ValueError(
            f"the header says {rows} x {columns}, in a file of {size} bytes"
        )


def checked(
    name: str,
    values: npt.NDArray,
    form: int,
    rows: Int64 | None = None,
    columns: Int64 | None = None,
) -> NamedMatrix:
    """A matrix, its values looked over.

    Args:
        name: of the matrix.
        values: (n, m), real or complex.
        form: as the file says, 6: symmetric.
        rows, columns: names, see `NamedMatrix`.

    Raises:
        ValueError: values are not finite or not symmetric.
    """
    finite = np.isfinite(values)
    if not finite.all():
        row, column = np.argwhere(~finite)[0]
        raise ValueError(
            f"row {row + 1}, column {column + 1} is {values[row, column]}, "
            "expected a finite number"
        )
    n, m = values.shape
    if form == SYMMETRIC:
        if n != m:
            raise ValueError(f"is said to be symmetric, but has {n} rows, {m} columns")
        scale = np.abs(values).max(initial=0.0)
        if np.abs(values - values.T).max(initial=0.0) > _ASYMMETRIC * scale:
            raise ValueError("is said to be symmetric and is not")
    return NamedMatrix(name=name, values=values, rows=rows, columns=columns)

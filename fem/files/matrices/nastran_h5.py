"""Matrices in the HDF5 results of MSC Nastran (HDF5OUT ... MTX YES).

In /NASTRAN/RESULT/MATRIX/GENERAL all matrices lie one after another: IDENTITY says
where each begins, COLUMN where each column begins within DATA (counted from the start
of DATA), DATA the rows, from 0, and the values.
"""

from pathlib import Path

import h5py
import numpy as np
import scipy.sparse as sp

from fem.errors import InputError
from fem.files.matrices.named import NamedMatrix

GROUP = "NASTRAN/RESULT/MATRIX/GENERAL"


def read_h5(path: Path) -> list[NamedMatrix]:
    """All matrices of a file.

    Raises:
        InputError: the file has none in Nastran's layout.
    """
    try:
        with h5py.File(path) as file:
            if GROUP not in file:
                raise InputError(
                    f"{path}: no group {GROUP}; expected the matrices of MSC Nastran "
                    "(HDF5OUT with MTX YES)"
                )
            group = file[GROUP]
            identity = np.asarray(group["IDENTITY"])
            starts = np.asarray(group["COLUMN"])["POSITION"]
            data = np.asarray(group["DATA"])
    except OSError as error:
        raise InputError(f"{path}: no HDF5 file: {error}") from None
    return [_matrix(row, starts, data) for row in identity]


def _matrix(row: np.void, starts: np.ndarray, data: np.ndarray) -> NamedMatrix:
    columns, first, count = row["COLUMN"], row["DATA_POS"], row["NON_ZERO"]
    at = row["COLUMN_POS"]
    # The end of the last column is left out where nothing follows.
    ends = np.append(starts[at : at + columns], first + count) - first
    part = data[first : first + count]
    values = sp.csc_matrix(
        (part["VALUE"], part["ROW"], ends), shape=(row["ROW"], columns)
    )
    name = row["NAME"].decode("ascii").strip().upper()
    return NamedMatrix(name=name, values=values.toarray().astype(float))


def write_h5(file: h5py.File, matrices: list[NamedMatrix]) -> None:
    """Adds matrices to a file in the same layout."""
    sparse = [sp.csc_matrix(m.values) for m in matrices]
    identity = np.zeros(
        len(matrices),
        [("NAME", "S8")]
        + [(n, "i8") for n in ("FORM", "ROW", "COLUMN", "NON_ZERO")]
        + [(n, "i8") for n in ("COLUMN_POS", "DATA_POS")],
    )
    starts, data_at, column_at = [], 0, 0
    for k, (matrix, s) in enumerate(zip(matrices, sparse)):
        s.sort_indices()
        n, m = matrix.values.shape
        name = matrix.name.encode("ascii")
        identity[k] = (*(name, matrix.form, n, m, s.nnz), column_at, data_at)
        starts.append(s.indptr.astype(np.int64) + data_at)
        data_at, column_at = data_at + s.nnz, column_at + m + 1
    data = np.zeros(data_at, [("ROW", "i8"), ("VALUE", "f8")])
    data["ROW"] = np.concatenate([s.indices for s in sparse])
    data["VALUE"] = np.concatenate([s.data for s in sparse])
    group = file.create_group(GROUP)
    group["IDENTITY"] = identity
    group["COLUMN"] = np.concatenate(starts).astype([("POSITION", "i8")])
    group.create_dataset("DATA", data=data, compression="gzip")

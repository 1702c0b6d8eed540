"""Matrices in the HDF5 results of MSC Nastran (HDF5OUT ... MTX YES).

In /NASTRAN/RESULT/MATRIX/GENERAL all matrices lie one after another: IDENTITY says
where each begins, COLUMN where each column begins within DATA (counted from the start
of DATA), DATA the rows, from 0, and the values. Only what lies in the file itself is
read: links and storage in other files are refused.
"""

from pathlib import Path

import h5py
import numpy as np
import scipy.sparse as sp

from fem.errors import InputError
from fem.matrix_files.checks import LARGEST, check_size, checked
from fem.matrix_files.named import NamedMatrix

GROUP = "NASTRAN/RESULT/MATRIX/GENERAL"
_IDENTITY = ("FORM", "ROW", "COLUMN", "NON_ZERO", "COLUMN_POS", "DATA_POS")
_DEFLATED = 1100  # times its size in the file is the most that deflate makes of data
# h5py makes of what HDF5 says of a damaged file one of these.
_DAMAGED = (OSError, RuntimeError, KeyError, TypeError, ValueError, OverflowError)


def read_h5(path: Path) -> list[NamedMatrix]:
    """All matrices of a file.

    Raises:
        InputError: the file has none in Nastran's layout, is damaged, or refers to
            other files.
    """
    size = path.stat().st_size
    try:
        with h5py.File(path, "r") as file:
            group = _own(file, path)
            identity = _table(group, "IDENTITY", ("NAME", *_IDENTITY), size)
            starts = _table(group, "COLUMN", ("POSITION",), size)["POSITION"]
            data = _table(group, "DATA", ("ROW", "VALUE"), size)
    except InputError:
        raise
    except _DAMAGED as error:
        kind = "no HDF5 file" if isinstance(error, OSError) else "no matrices"
        raise InputError(f"{path}: {kind}: {error}") from None
    return [_named(row, starts, data, path) for row in identity]


def _named(
    row: np.void, starts: np.ndarray, data: np.ndarray, path: Path
) -> NamedMatrix:
    name = row["NAME"].decode("ascii", "replace").strip().upper()
    name = "".join(c if c.isprintable() else "?" for c in name)
    try:
        return _matrix(name, row, starts, data, path.stat().st_size)
    except ValueError as error:
        raise InputError(f"{path}: matrix {name}: {error}") from None


def _own(file: h5py.File, path: Path) -> h5py.Group:
    """The group of matrices, reached without links."""
    place: h5py.Group | h5py.Dataset | h5py.Datatype = file
    for part in GROUP.split("/"):
        if not isinstance(place, h5py.Group) or part not in place.keys():  # noqa: SIM118
            raise InputError(
                f"{path}: no group {GROUP}; expected the matrices of MSC Nastran "
                "(HDF5OUT with MTX YES)"
            )
        _refuse_link(place, part)
        place = place[part]
    if not isinstance(place, h5py.Group):
        raise ValueError(f"{GROUP} is no group")
    return place


def _refuse_link(group: h5py.Group, name: str) -> None:
    link = group.get(name, getlink=True)
    if not isinstance(link, h5py.HardLink):
        raise ValueError(f"{group.name}/{name} is a link, which is not followed")


def _table(
    group: h5py.Group, name: str, columns: tuple[str, ...], size: int
) -> np.ndarray:
    """A dataset, once it is clear that it lies in the file and how large it is."""
    if name not in group.keys():  # noqa: SIM118
        raise ValueError(f"no dataset {name}")
    _refuse_link(group, name)
    dataset = group[name]
    if not isinstance(dataset, h5py.Dataset) or dataset.is_virtual or dataset.external:
        raise ValueError(f"{name} is no dataset of this file")
    if missing := set(columns) - set(dataset.dtype.names or ()):
        raise ValueError(f"{name} has no column {', '.join(sorted(missing))}")
    if dataset.ndim != 1 or dataset.nbytes > min(LARGEST, _DEFLATED * size):
        raise ValueError(
            f"{name} is {dataset.shape}, {dataset.nbytes / 1e9:,.1f} GB, in a file of "
            f"{size} bytes"
        )
    for column in columns:
        kinds = {"NAME": "S", "VALUE": "f"}.get(column, "iu")
        found = dataset.dtype[column]
        if found.kind not in kinds or found.shape:
            raise ValueError(f"{name}: {column} is {found}")
    return dataset[()]


def _matrix(
    name: str, row: np.void, starts: np.ndarray, data: np.ndarray, size: int
) -> NamedMatrix:
    form, n, columns, count, at, first = (int(row[key]) for key in _IDENTITY)
    check_size(n, columns, size)
    if not (at >= 0 and at + columns <= len(starts)):
        raise ValueError(f"columns {at} to {at + columns} of {len(starts)}")
    if not (first >= 0 and count >= 0 and first + count <= len(data)):
        raise ValueError(f"terms {first} to {first + count} of {len(data)}")
    # The end of the last column is left out where nothing follows.
    ends = np.append(starts[at : at + columns].astype(np.int64), first + count) - first
    if ends[0] != 0 or (np.diff(ends) < 0).any() or ends[-1] != count:
        raise ValueError("columns overlap or lie elsewhere")
    part = data[first : first + count]
    rows = part["ROW"].astype(np.int64)
    if len(rows) and not 0 <= rows.min() <= rows.max() < n:
        raise ValueError(
            f"rows from {rows.min()} to {rows.max()}, expected 0 to {n - 1}"
        )
    values = sp.csc_matrix((part["VALUE"], rows, ends), shape=(n, columns))
    return checked(name, values.toarray().astype(float), form)


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

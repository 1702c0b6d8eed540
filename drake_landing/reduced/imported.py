"""A user's own reduced matrices as a model.

The interface table (CSV) names the grids: `id, x, y, z` in the basic frame and, where
not all six are freedoms, `components` (digits). The others follow through the recovery
matrix; without one they are held at zero, where the grid has a freedom at all. DMIG
name their rows; rows of OUTPUT4 and HDF5 stand in the order of the table, components
ascending, generalised coordinates last. Displacement frames of all grids are the basic
frame.
"""

import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.reduced.model import ReducedModel
from fem.errors import InputError, Problems, nearest
from fem.files.matrices import read_matrices
from fem.matrix_files.named import NamedMatrix

Float64 = npt.NDArray[np.float64]

_GROUNDED = 1e-6  # of the largest term: force on a rigid motion that is not round-off
_ASYMMETRIC = 1e-6
ALL = "123456"
_LARGEST_ID = 99_999_999


def read_reduced(
    files: Sequence[Path], grids: Path, names: Mapping[str, str]
) -> ReducedModel:
    """Reads matrices and their interface table.

    Args:
        files: with the matrices among them.
        grids: CSV table.
        names: `stiffness`, `mass`, `damping`, `recovery` -> name of the matrix; a
            damping or recovery of the default name may be absent.

    Raises:
        InputError: what is missing or does not fit; every problem of a table.
    """
    table = read_grids(grids)
    found: dict[str, NamedMatrix] = {}
    for path in files:
        found |= read_matrices(path)
    kept = np.array([[c in digits for c in ALL] for digits in table.components])
    k, m = (_required(found, names[role], role) for role in ("stiffness", "mass"))
    damped = names["damping"].upper() in found
    b = _required(found, names["damping"], "damping") if damped else None
    size = len(k.values)
    _check_shapes([k, m, *([b] if b is not None else [])])
    labels = _labels(k, table.id.to_numpy(), kept, size)
    notices = [] if b is not None else ["the matrices have no damping: undamped modes"]
    stiffness, mass = (_square(x, labels, names) for x in (k, m))
    damping = np.zeros((size, size)) if b is None else _square(b, labels, names)
    order = np.argsort(table.id.to_numpy(), kind="stable")
    if labels is None:
        rows = _sorted_rows(order, kept, size)
        at = np.ix_(rows, rows)
        stiffness, mass, damping = stiffness[at], mass[at], damping[at]
    else:
        rows = np.arange(size)
    draft = ReducedModel(
        grid_id=table.id.to_numpy()[order],
        p=table[["x", "y", "z"]].to_numpy(float)[order],
        kept=kept[order],
        stiffness=stiffness,
        mass=mass,
        damping=damping,
        recovery=np.zeros((0, size)),
        interior_hz=np.zeros(0),
        source=", ".join(path.name for path in files),
    )
    recovery = _recovery(found, names, draft, k, rows, order, kept)
    free, more = _freed(draft)
    return ReducedModel(
        **{
            **draft.__dict__,
            "stiffness": free,
            "recovery": recovery,
            "notices": (*notices, *more),
        }
    )


def read_grids(path: Path) -> pd.DataFrame:
    """The interface table with text in `components`.

    Raises:
        InputError: no such file, columns missing, or rows that cannot be.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file")
    try:
        with warnings.catch_warnings():
            # Rows longer than the head: no column becomes an index unseen.
            warnings.simplefilter("error", pd.errors.ParserWarning)
            table = pd.read_csv(
                path,
                dtype={"components": str},
                skipinitialspace=True,
                index_col=False,
                compression=None,
            )
    except (ValueError, pd.errors.ParserError, pd.errors.ParserWarning) as error:
        raise InputError(f"{path}: {error}") from None
    missing = [c for c in ("id", "x", "y", "z") if c not in table]
    if missing or table.empty:
        raise InputError(
            f"{path}: columns {', '.join(table.columns)}; expected id, x, y, z"
            " [, components] and a row for each grid"
        )
    if "components" not in table:
        table["components"] = ALL
    table["components"] = table["components"].fillna("").str.strip()
    problems = Problems()
    for column in ("id", "x", "y", "z"):
        numbers = pd.to_numeric(table[column], errors="coerce")
        for row in np.flatnonzero(~np.isfinite(numbers)):
            value = table[column].iloc[row]
            problems.append(f"{path}:{row + 2}: {column}: found {value!r}")
        table[column] = numbers
    for row in np.flatnonzero(~table["id"].between(1, _LARGEST_ID)):
        problems.append(f"{path}:{row + 2}: id: expected 1 to {_LARGEST_ID}")
    for row, digits in enumerate(table.components):
        if set(digits) - set(ALL) or len(set(digits)) != len(digits):
            problems.append(
                f"{path}:{row + 2}: components: found '{digits}', expected digits 1-6"
            )
    problems.report()
    table["id"] = table["id"].astype(np.int64)
    if twice := table.id[table.id.duplicated()].tolist():
        raise InputError(f"{path}: grid {', '.join(map(str, twice))} is there twice")
    return table


def _required(found: Mapping[str, NamedMatrix], name: str, role: str) -> NamedMatrix:
    if name.upper() not in found:
        known = sorted(found)
        raise InputError(
            f"matrices: no {role} matrix '{name}'; the files have {', '.join(known)}"
            + nearest(name.upper(), known)
        )
    matrix = found[name.upper()]
    if np.iscomplexobj(matrix.values):
        raise InputError(f"matrices: {role} {matrix.name} is complex, expected real")
    return matrix


def _check_shapes(matrices: Sequence[NamedMatrix]) -> None:
    """All are square; those without names of their rows, of one size."""
    first = matrices[0]
    for matrix in matrices:
        rows, columns = matrix.values.shape
        named = matrix.rows is not None and first.rows is not None
        if rows != columns or (rows != len(first.values) and not named):
            raise InputError(
                f"matrices: {matrix.name} is {rows} x {columns}, expected "
                f"{len(first.values)} x {len(first.values)} as {first.name}"
                if matrix is not first
                else f"matrices: {matrix.name} is {rows} x {columns}, expected a square"
            )


def _labels(
    k: NamedMatrix, ids: npt.NDArray, kept: npt.NDArray, size: int
) -> npt.NDArray | None:
    """Rows of labelled matrices in the model's order; None where rows have no names.

    Raises:
        InputError: the table and the matrix name different freedoms.
    """
    if k.rows is None:
        if size < kept.sum():
            raise InputError(
                f"matrices: {k.name} has {size} rows, fewer than the {kept.sum()} "
                "freedoms of the interface table"
            )
        return None
    named = set(map(tuple, k.rows.tolist()))
    grid, component = np.nonzero(kept)
    wanted = [(int(g), int(c) + 1) for g, c in zip(ids[grid], component)]
    wanted.sort()
    known = set(ids.tolist())
    strange = sorted(
        (g, c) for g, c in named - set(wanted) if g in known or c not in (0, 1)
    )
    if strange:
        some = ", ".join(f"{g} component {c}" for g, c in strange[:8])
        raise InputError(
            f"matrices: {k.name} has freedoms that the interface table lacks: {some}"
        )
    rest = sorted(named - set(wanted))
    return np.array([*wanted, *rest], dtype=np.int64).reshape(-1, 2)


def _square(
    matrix: NamedMatrix, labels: npt.NDArray | None, names: Mapping[str, str]
) -> Float64:
    """Values in the model's order, symmetric."""
    values = matrix.values
    if labels is not None:
        if matrix.rows is None:
            raise InputError(
                f"matrices: rows of {names['stiffness']} have names and those of "
                f"{matrix.name} have none; give both in one format"
            )
        values = _placed(values, matrix.rows, labels, matrix.rows, labels)
    scale = np.abs(values).max(initial=0.0)
    if np.abs(values - values.T).max(initial=0.0) > _ASYMMETRIC * scale:
        raise InputError(f"matrices: {matrix.name} is not symmetric")
    return 0.5 * (values + values.T)


def _placed(
    values: Float64,
    rows: npt.NDArray,
    to_rows: npt.NDArray,
    columns: npt.NDArray,
    to_columns: npt.NDArray,
) -> Float64:
    at_row = {tuple(label): i for i, label in enumerate(to_rows.tolist())}
    at_column = {tuple(label): i for i, label in enumerate(to_columns.tolist())}
    result = np.zeros((len(to_rows), len(to_columns)))
    try:
        i = [at_row[tuple(label)] for label in rows.tolist()]
        j = [at_column[tuple(label)] for label in columns.tolist()]
    except KeyError as error:
        g, c = error.args[0]
        raise InputError(
            f"matrices: point {g} component {c} is no freedom of the stiffness"
        ) from None
    result[np.ix_(i, j)] = values
    return result


def _sorted_rows(order: npt.NDArray, kept: npt.NDArray, size: int) -> npt.NDArray:
    """Rows of the matrices when the table is sorted by grid id."""
    start = np.concatenate([[0], np.cumsum(kept.sum(axis=1))])
    spans = [np.arange(start[k], start[k + 1]) for k in order]
    return np.concatenate([*spans, np.arange(start[-1], size)]).astype(np.intp)


def _recovery(
    found: Mapping[str, NamedMatrix],
    names: Mapping[str, str],
    model: ReducedModel,
    k: NamedMatrix,
    rows: npt.NDArray,
    order: npt.NDArray,
    kept: npt.NDArray,
) -> Float64:
    """(r, a + q) of the components that follow, see `ReducedModel.following`.

    Args:
        found, names: the matrices and their names.
        model: without it.
        k: the stiffness as it stands in the file.
        rows: of unnamed matrices in the model's order.
        order: rows of the table by ascending grid.
        kept: (g, 6) in the order of the table.
    """
    following = model.following
    absent = names["recovery"].upper() not in found
    if len(following) == 0 or (absent and len(model.followers) == 0):
        return np.zeros((len(following), model.size))
    matrix = _required(found, names["recovery"], "recovery")
    if matrix.rows is not None and matrix.columns is not None and k.rows is not None:
        labels = _labels(k, model.grid_id, model.kept, model.size)
        assert labels is not None
        return _placed(matrix.values, matrix.rows, following, matrix.columns, labels)
    if matrix.values.shape != (len(following), model.size):
        raise InputError(
            f"matrices: {matrix.name} is {matrix.values.shape[0]} x "
            f"{matrix.values.shape[1]}, expected {len(following)} x {model.size}: "
            "a row for each component that the table leaves out"
        )
    start = np.concatenate([[0], np.cumsum((~kept).sum(axis=1))])
    spans = [np.arange(start[g], start[g + 1]) for g in order]
    return matrix.values[:, rows][np.concatenate(spans).astype(np.intp)]


def _freed(model: ReducedModel) -> tuple[Float64, list[str]]:
    """K without the forces that round-off makes rigid motions meet.

    Raises:
        InputError: the forces are larger than that: the matrices are supported, or the
            positions are not those of the matrices.
    """
    motion = model.rigid_body(model.p.mean(axis=0))
    motion = motion / np.abs(motion).max(axis=0)
    force = np.abs(model.stiffness @ motion).max(initial=0.0)
    share = force / np.abs(model.stiffness).max(initial=1e-300)
    if share > _GROUNDED:
        raise InputError(
            f"matrices: rigid motions meet forces of {share:.1e} of the largest "
            f"stiffness, expected below {_GROUNDED:g}: the matrices are supported, "
            "positions are not theirs, or displacement frames are not the basic frame"
        )
    projector = np.eye(model.size) - motion @ np.linalg.pinv(motion)
    free = projector.T @ model.stiffness @ projector
    lines = []
    if share > 1e-12:
        lines.append(
            f"rigid motions met forces of {share:.1e} of the largest stiffness, from "
            "the digits of the file; they were taken out"
        )
    return 0.5 * (free + free.T), lines

"""DMIG cards, as Nastran punches them and as people write them.

A punched matrix has a header in small fields and a large-field card for each column:
"DMIG*, name, G, C" and a line "*, G, C, value" for each term, D for the exponent, ten
digits. Symmetric ones (form 6) give one triangle. Complex ones have two values a term,
or amplitude and phase in degrees (POLAR).
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

import numpy as np
import numpy.typing as npt

from fem.arrays import Int64
from fem.deck.cards.dmig import read_dmig
from fem.deck.text.lexer import RawCard, read_cards
from fem.deck.text.source import read_source
from fem.errors import InputError
from fem.matrix_files.checks import check_size, checked
from fem.matrix_files.named import RECTANGULAR, SYMMETRIC, NamedMatrix

_RECTANGULAR_HEADER = 9
_FORMS = (1, 2, SYMMETRIC, _RECTANGULAR_HEADER)
_REAL = (1, 2)
_KEY = 10  # point · 10 + component: sorts as freedoms do
_LARGEST_COMPONENT = 6
_LARGEST_ID = 10**12  # beyond it no integer of a deck is one


def read_punch(path: Path) -> list[NamedMatrix]:
    """All DMIG of a file; other cards are passed over.

    Raises:
        InputError: whatever is wrong with a card.
    """
    rows = _punched(path.read_text("latin-1").splitlines())
    try:
        if rows is None:
            cards = read_cards(read_source(path).lines).cards
            rows = _rows(path, [card for card in cards if card.name == "DMIG"])
        return [_matrix(row) for row in rows]
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None


def _rows(path: Path, cards: list[RawCard]) -> list[dict[str, Any]]:
    problems: list[str] = []
    rows = read_dmig(cards, problems)
    if problems:
        raise InputError(
            p if p.startswith(f"{path}:") else f"{path}: {p}" for p in problems
        )
    return rows


def _punched(lines: list[str]) -> list[dict[str, Any]] | None:
    """The same rows for a file that is punched: a million lines in seconds.

    None where a line looks different, so that the general reader has a look at it.
    """
    forms: dict[str, int] = {}
    terms: dict[str, list[tuple[int, int, int, int, float]]] = {}
    column, into = (0, 0), None
    try:
        for line in lines:
            if line.startswith("*"):
                if into is None:
                    return None
                value = float(line[40:56].replace("D", "E"))
                into.append((int(line[8:24]), int(line[24:40]), *column, value))
            elif line.startswith("DMIG*"):
                name = line[8:24].strip()
                column = int(line[24:40]), int(line[40:56])
                into = terms[name]
            elif line.startswith("DMIG  ") and int(line[16:24]) == 0:
                name, kind = line[8:16].strip(), int(line[32:40])
                if kind not in _REAL or int(line[24:32]) not in _FORMS:
                    return None
                forms[name], terms[name] = int(line[24:32]), []
            elif line.strip() and not line.startswith("$"):
                return None
    except (ValueError, KeyError):
        return None
    for found in terms.values():
        if any(abs(n) > _LARGEST_ID for term in found for n in term[:4]):
            return None
    return [_row(name, forms[name], found) for name, found in terms.items()]


def _row(
    name: str, form: int, terms: list[tuple[int, int, int, int, float]]
) -> dict[str, Any]:
    if form == SYMMETRIC:
        terms = terms + [(c, d, a, b, x) for a, b, c, d, x in terms if (a, b) != (c, d)]
    parts = list(zip(*terms)) or [()] * 5
    keys = ("rowids", "rowcs", "colids", "colcs")
    row: dict[str, Any] = {k: np.array(p, np.int64) for k, p in zip(keys, parts)}
    return {"name": name, "form": form, **row, "values": np.array(parts[4], float)}


def _matrix(row: dict[str, Any]) -> NamedMatrix:
    """Square ones get the same freedoms for rows and columns."""
    name, values = row["name"].upper(), row["values"]
    try:
        rows = _keys(row["rowids"], row["rowcs"])
        columns = _keys(row["colids"], row["colcs"])
        row_keys, column_keys = np.unique(rows), np.unique(columns)
        if row["form"] not in (RECTANGULAR, _RECTANGULAR_HEADER):
            row_keys = column_keys = np.union1d(row_keys, column_keys)
        # Each freedom stands in the file, so that its size is no measure.
        n, m = len(row_keys), len(column_keys)
        check_size(n, m, n + m, 2 if values.dtype == complex else 1)
        dense = np.zeros((n, m), values.dtype)
        at = np.searchsorted(row_keys, rows), np.searchsorted(column_keys, columns)
        dense[at] = values
        _refuse_other_values(row, dense[at] != values)
        labels = _labels(row_keys), _labels(column_keys)
        return checked(name, dense, row["form"], *labels)
    except ValueError as error:
        raise ValueError(f"DMIG {name}: {error}") from None


def _refuse_other_values(row: dict[str, Any], other: npt.NDArray) -> None:
    if (again := np.flatnonzero(other & ~np.isnan(row["values"]))).size:
        k = again[0]
        raise ValueError(
            f"row {row['rowids'][k]} component {row['rowcs'][k]}, column "
            f"{row['colids'][k]} component {row['colcs'][k]} has two values"
        )


def _keys(ids: Int64, components: Int64) -> Int64:
    wrong = (ids < 1) | (components < 0) | (components > _LARGEST_COMPONENT)
    if (at := np.flatnonzero(wrong)).size:
        raise ValueError(
            f"found point {ids[at[0]]}, component {components[at[0]]}, expected a "
            f"positive id and a component from 0 to {_LARGEST_COMPONENT}"
        )
    return ids * _KEY + components


def _labels(keys: Int64) -> Int64:
    return np.column_stack([keys // _KEY, keys % _KEY])


def write_punch(file: TextIO, matrix: NamedMatrix) -> None:
    """One matrix with labelled rows and columns."""
    assert matrix.rows is not None
    assert matrix.columns is not None
    form = matrix.form
    width = ""
    if form == RECTANGULAR:
        form, width = _RECTANGULAR_HEADER, f"{len(matrix.columns):8d}"
    blank = " " * 16 if width else ""
    file.write(f"DMIG    {matrix.name:8}{0:8d}{form:8d}{2:8d}{0:8d}{blank}{width}\n")
    labels = [f"*       {g:16d}{c:16d}" for g, c in matrix.rows.tolist()]
    for k, (point, component) in enumerate(matrix.columns.tolist()):
        column = matrix.values[:, k]
        start = k if form == SYMMETRIC else 0
        filled = start + np.flatnonzero(column[start:])
        if len(filled):
            file.write(f"DMIG*   {matrix.name:16}{point:16d}{component:16d}\n")
            file.writelines(_terms(labels, filled, column))


def _terms(labels: list[str], rows: Int64, column: npt.NDArray) -> Iterator[str]:
    for row, value in zip(rows.tolist(), column[rows].tolist()):
        yield f"{labels[row]}{value:16.9E}\n".replace("E", "D")

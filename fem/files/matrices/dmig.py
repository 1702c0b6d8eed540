"""DMIG cards, as Nastran punches them and as people write them.

A punched matrix has a header in small fields and a large-field card for each column:
"DMIG*, name, G, C" and a line "*, G, C, value" for each term, D for the exponent, ten
digits. Symmetric ones (form 6) give one triangle.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

import numpy as np
import numpy.typing as npt

from fem.arrays import Int64
from fem.deck.cards.dmig import read_dmig
from fem.deck.lexer import read_cards
from fem.deck.source import read_source
from fem.errors import InputError
from fem.files.matrices.named import RECTANGULAR, SYMMETRIC, NamedMatrix

_RECTANGULAR_HEADER = 9
_REAL = (1, 2)
_KEY = 10  # point · 10 + component: sorts as freedoms do


def read_punch(path: Path) -> list[NamedMatrix]:
    """All DMIG of a file; other cards are passed over.

    Raises:
        InputError: whatever is wrong with a card.
    """
    rows = _punched(path.read_text("latin-1").splitlines())
    if rows is None:
        lines = read_source(path).lines
        cards = [card for card in read_cards(lines).cards if card.name == "DMIG"]
        problems: list[str] = []
        rows = read_dmig(cards, problems)
        if problems:
            raise InputError(problems)
    return [
        _matrix(
            row["name"].upper(),
            int(row["form"]),
            _keys(row["rowids"], row["rowcs"]),
            _keys(row["colids"], row["colcs"]),
            row["values"],
        )
        for row in rows
    ]


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
                if kind > len(_REAL):
                    return None
                forms[name], terms[name] = int(line[24:32]), []
            elif line.strip() and not line.startswith("$"):
                return None
    except (ValueError, KeyError):
        return None
    rows: list[dict[str, Any]] = []
    for name, found in terms.items():
        if forms[name] == SYMMETRIC:
            found += [(c, d, a, b, x) for a, b, c, d, x in found if (a, b) != (c, d)]
        parts = [np.array(part) for part in zip(*found)] or [np.zeros(0, int)] * 5
        keys = ("rowids", "rowcs", "colids", "colcs", "values")
        rows.append({"name": name, "form": forms[name], **dict(zip(keys, parts))})
    return rows


def _keys(ids: Int64, components: Int64) -> Int64:
    return ids * _KEY + components


def _matrix(
    name: str, form: int, rows: Int64, columns: Int64, values: npt.NDArray
) -> NamedMatrix:
    """Square ones get the same freedoms for rows and columns."""
    row_keys, column_keys = np.unique(rows), np.unique(columns)
    if form not in (RECTANGULAR, _RECTANGULAR_HEADER):
        row_keys = column_keys = np.union1d(row_keys, column_keys)
    dense = np.zeros((len(row_keys), len(column_keys)))
    at = np.searchsorted(row_keys, rows), np.searchsorted(column_keys, columns)
    dense[at] = values
    return NamedMatrix(
        name=name, values=dense, rows=_labels(row_keys), columns=_labels(column_keys)
    )


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

"""External superelements: parts that another run has reduced (EXTSEOUT).

The assembly has their boundary points and generalised coordinates in BEGIN SUPER = n;
their matrices are in an OUTPUT4 file (SEBULK EXTOP4, ASSIGN INPUTT4) or stand there as
DMIG (SEBULK EXTERNAL). Rows go by the card EXTRN. They become direct input on the
points of the whole, in statics as in dynamics: nothing is reduced again.

The names of the matrices are those found in files of MSC (KAA, MAA, BAA, K4AA, PA; DMIG
with an X more) and NX (KXX, MXX, BXX1, K4XX1, PX1).
"""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.control.executive import Executive
from fem.deck.deck import Deck
from fem.deck.text.source import found_file
from fem.errors import InputError, Problems
from fem.matrix_files.named import NamedMatrix
from fem.matrix_files.output4 import read_output4

# Kind of matrix -> its names, DMIG and OUTPUT4.
_NAMES = {
    "stiffness": ("KAA", "KAAX", "KXX"),
    "mass": ("MAA", "MAAX", "MXX"),
    "damping": ("BAA", "BAAX", "BXX", "BXX1"),
    "structural damping": ("K4AA", "K4AAX", "K4XX", "K4XX1"),
    "loads": ("PA", "PAX", "PX", "PX1"),
}
_KEPT = ("stiffness", "mass", "damping")
_ASSIGN = re.compile(
    r"ASSIGN\s+(?:INPUTT4|INPUTT2)\s*=\s*['\"]?([^'\",\s]+)['\"]?.*?\bUNIT\s*=\s*(\d+)",
    re.I,
)
# Solutions in which loads of the component's own run, and K4, change nothing.
_WITHOUT_LOADS = (103, 108, 109, 111, 112)
_STATIC = (101, 103, 105)
TYPES = ("EXTOP4", "EXTERNAL")
_UNEVEN = 1e-6  # of the largest entry, between both triangles


def assigned_files(executive: Executive) -> dict[int, str]:
    """Unit -> name of the files with matrices that ASSIGN gives it."""
    said = " \n".join(executive.statements)
    return {int(unit): name for name, unit in _ASSIGN.findall(said)}


def with_matrices(
    deck: Deck, parts: Mapping[int, Deck], executive: Executive
) -> tuple[Deck, dict[int, Deck], list[str]]:
    """The deck and its parts with the matrices of external superelements as DMIG.

    Args:
        deck: main bulk data.
        parts: bulk data of BEGIN SUPER = n.
        executive: the section, with SOL and ASSIGN.

    Returns:
        The deck, which names them (`Deck.external`), the parts, and notices.

    Raises:
        InputError: all that is wrong with them.
    """
    files = assigned_files(executive)
    found, problems, notices = dict(parts), Problems(), []
    names: list[tuple[str, str]] = []
    for _, row in deck.cards["SEBULK"].iterrows():
        number = int(row["seid"])
        if row["type"] not in TYPES or number not in parts:
            continue
        with problems.gathered(f"{row['file']}:{row['line']}: SEBULK {number}"):
            own, where = _matrices(deck, parts[number], row, files)
            table, kept = _as_dmig(own, parts[number], number, where)
            unused = _unused(own, where, executive.sol)
            cards = {**parts[number].cards, "DMIG": table}
            found[number] = replace(parts[number], cards=cards)
            names += kept
            kinds = ", ".join(kind for kind, _ in kept)
            notices.append(
                f"superelement {number}: {kinds} as {where} has them; GRAV, ACCEL, "
                f"ACCEL1 and RFORCE do not act on its mass{unused}"
            )
    problems.report()
    return replace(deck, external=tuple(names)), found, notices


def _matrices(
    deck: Deck, part: Deck, row: pd.Series, files: Mapping[int, str]
) -> tuple[dict[str, Any], str]:
    """Matrices by name, those of DMIG as rows of their table, and where they are."""
    if row["type"] == "EXTERNAL":
        table = part.cards["DMIG"]
        return {str(r["name"]).upper(): r for _, r in table.iterrows()}, "its DMIG"
    unit = int(row["unitno"])
    if unit not in files:
        known = ", ".join(map(str, sorted(files))) or "none"
        raise InputError(
            f"unit {unit} is assigned to no file, expected ASSIGN INPUTT4 = 'FILE', "
            f"UNIT = {unit}; assigned: {known}"
        )
    path = found_file(files[unit], Path(deck.path))
    return {m.name.upper(): m for m in read_output4(path)}, path.name


def _as_dmig(
    own: Mapping[str, Any], part: Deck, number: int, where: str
) -> tuple[pd.DataFrame, list[tuple[str, str]]]:
    """Rows of the table DMIG and their kinds and names, one per matrix that is used."""
    rows, kept = [], []
    freedoms = _freedoms(part)
    for kind in _KEPT:
        names = _NAMES[kind]
        name = next((n for n in names if n in own), "")
        if not name:
            if kind == "stiffness":
                raise InputError(
                    f"{where} has no stiffness, expected one of {', '.join(names)}; "
                    f"found {', '.join(sorted(own)) or 'nothing'}"
                )
            continue
        matrix = own[name]
        if isinstance(matrix, NamedMatrix):
            if not matrix.values.any():
                continue
            matrix = _row(matrix, freedoms, where)
        elif not np.any(matrix["values"]):
            continue
        label = f"{kind[0].upper()}.{number}"
        rows.append({**dict(matrix), "name": label})
        kept.append((kind, label))
    table = pd.DataFrame(rows).reindex(columns=part.cards["DMIG"].columns)
    return table.fillna({"file": "", "line": 0}), kept


def _unused(own: Mapping[str, Any], where: str, sol: int) -> str:
    """What is said of matrices that change nothing in a solution.

    Raises:
        InputError: they would change its answer.
    """
    notice = ""
    for kind, without in (("loads", _WITHOUT_LOADS), ("structural damping", _STATIC)):
        there = [
            name for name in _NAMES[kind] if name in own and np.any(_values(own[name]))
        ]
        if there and sol not in without:
            raise InputError(
                f"{where} has {kind} ({there[0]}), which is not supported for external "
                f"superelements in SOL {sol}"
            )
        if there:
            notice += f"; its {kind} ({there[0]}) are not used"
    return notice


def _values(matrix: Any) -> Any:
    return matrix.values if isinstance(matrix, NamedMatrix) else matrix["values"]


def _freedoms(part: Deck) -> tuple[Int64, Int64]:
    """(n,) points and components of the rows: EXTRN, else ASET and QSET sorted."""
    pairs: list[tuple[int, int]] = []
    tables = ["EXTRN"] if len(part.cards["EXTRN"]) else ["ASET", "QSET"]
    scalar = set(part.cards["SPOINT"]["id"].tolist())
    for name in tables:
        table = part.cards[name]
        for point, digits in zip(table["id"].tolist(), table["c"].astype(str)):
            text = "0" if point in scalar else digits
            pairs += [(int(point), int(c)) for c in sorted(text)]
    if tables != ["EXTRN"]:
        pairs = sorted(set(pairs))
    ids, components = np.array(pairs, np.int64).reshape(-1, 2).T
    return ids, components


def _row(
    matrix: NamedMatrix, freedoms: tuple[Int64, Int64], where: str
) -> dict[str, Any]:
    """One row of the table DMIG."""
    values, (points, components) = matrix.values, freedoms
    if values.shape != (len(points), len(points)):
        raise InputError(
            f"{where}: {matrix.name} is {values.shape[0]} x {values.shape[1]}, EXTRN "
            f"has {len(points)} freedoms"
        )
    values = _symmetric(matrix.name, values, where)
    i, j = np.nonzero(values)
    return {
        "form": 6,
        "rowids": points[i],
        "rowcs": components[i],
        "colids": points[j],
        "colcs": components[j],
        "values": values[i, j],
    }


def _symmetric(name: str, values: Any, where: str) -> Float64:
    if np.iscomplexobj(values):
        raise InputError(f"{where}: {name} is complex, expected real numbers")
    values = np.asarray(values, np.float64)
    size = np.abs(values).max(initial=0.0)
    lower = np.tril(values, -1)
    if not np.triu(values, 1).any():  # files may have one triangle
        return values + lower.T
    if np.abs(values - values.T).max(initial=0.0) > _UNEVEN * size:
        raise InputError(f"{where}: {name} is not symmetric")
    return 0.5 * (values + values.T)

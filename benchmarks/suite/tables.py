"""Result tables of OP2 and F06 files under common names, with their owners.

Our own results go through our OP2 file, so that both sides are read alike.
"""

import contextlib
import io
import logging
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

POINTS = {
    "displacements": "displacement",
    "spc_forces": "SPC force",
    "mpc_forces": "MPC force",
    "velocities": "velocity",
    "accelerations": "acceleration",
}
_ELEMENTS = ("force", "stress", "strain")
_MODES, _BUCKLING, _COMPLEX = 2, 8, 9  # analysis codes
Name = tuple[str, int]


@dataclass(frozen=True)
class Table:
    """One table of results.

    Attributes:
        owner: what each row belongs to: element, grid, layer.
        values: (t, n, c) states, rows, columns.
        columns: their names.
    """

    owner: list[tuple[Any, ...]]
    values: np.ndarray
    columns: tuple[str, ...]


def read_op2(path: Path) -> dict[Name, Table]:
    """Tables of an OP2 file by name and subcase.

    Frequencies (Hz) and load factors are (1, m, 1); load factors go by their order
    instead of their subcase. What belongs to modes is left out: shapes have any sign.

    Raises:
        ValueError: pyNastran cannot read it.
    """
    from pyNastran.op2.op2 import OP2

    logging.disable(logging.WARNING)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            model = OP2(debug=None)
            model.read_op2(str(path), build_dataframe=False)
    except Exception as error:
        raise ValueError(f"{path.name}: {type(error).__name__}: {error}") from None
    finally:
        logging.disable(logging.NOTSET)
    found: dict[Name, Table] = {}
    for title, tables in _tables(model):
        for key, table in tables.items():
            subcase = key[0] if isinstance(key, tuple) else key
            modal = getattr(table, "analysis_code", 1) in (_MODES, _BUCKLING, _COMPLEX)
            made = None if modal else _table(table)
            if made is not None:
                found.setdefault((title, int(subcase)), made)
    buckling = 0
    for key, table in model.eigenvectors.items():
        subcase = key[0] if isinstance(key, tuple) else key
        if getattr(table, "analysis_code", 0) == _BUCKLING:
            buckling += 1
            factor = np.asarray(table.eigrs, float)
            found.setdefault(("load factor", buckling), listed(factor))
            continue
        # Some files hold the circular frequency where cycles belong.
        square = np.asarray(getattr(table, "eigns", []), float)
        hertz = np.sign(square) * np.sqrt(np.abs(square)) / (2.0 * np.pi)
        found.setdefault(("frequency", int(subcase)), listed(hertz))
    return found


def listed(values: np.ndarray) -> Table:
    """(m,) frequencies or load factors."""
    owner = [(k,) for k in range(len(values))]
    return Table(owner, values.reshape(1, -1, 1), ("Hz",))


def _tables(model: Any) -> Iterator[tuple[str, dict]]:
    for name, title in POINTS.items():
        yield title, getattr(model, name)
    for kind in _ELEMENTS:
        group = getattr(model.op2_results, kind)
        for name in group.get_table_types(include_class=False):
            yield f"{kind} of {_card(name, kind)}", getattr(group, name)


def _card(name: str, kind: str) -> str:
    return name.removesuffix(f"_{kind}").upper().replace("_", " ")


def _table(table: Any) -> Table | None:
    """A table of numbers, real or complex; None: what it is is not compared."""
    data = getattr(table, "data", None)
    if data is None or data.ndim != 3:
        return None
    names = ("element_node", "element_layer", "element_layer_node", "node_gridtype")
    for name in (*names, "element"):
        owner = getattr(table, name, None)
        if owner is not None:
            break
    else:
        return None
    rows = np.asarray(owner).reshape(len(owner), -1)
    if rows.shape[0] != data.shape[1]:
        return None
    if name == "node_gridtype":
        rows = rows[:, :1]
    # States that a file holds twice count once.
    states = np.unique(np.asarray(table._times), return_index=True)[1]
    if len(states) != data.shape[0]:
        data = data[np.sort(states)]
    seen: dict[tuple, int] = {}
    keys = []
    for row in rows.tolist():
        key = tuple(row)
        seen[key] = seen.get(key, 0) + 1
        keys.append((*key, seen[key]))  # the fibres of one place follow each other
    number = complex if np.iscomplexobj(data) else float
    headers = tuple(table.get_headers())
    if len(headers) != data.shape[2]:  # plies of solids have others than it says
        headers = tuple(f"column {k + 1}" for k in range(data.shape[2]))
    return Table(keys, data.astype(number), headers)


_VECTOR = re.compile(r"^0?\s*(\d+)\s+[GS]\s+(.*)$")
_TITLES = {
    "DISPLACEMENTVECTOR": "displacement",
    "FORCESOFSINGLE-POINTCONSTRAINT": "SPC force",
    "FORCESOFMULTIPOINTCONSTRAINT": "MPC force",
}
_SIX = ("t1", "t2", "t3", "r1", "r2", "r3")


def read_f06(path: Path, *, buckling: bool = False) -> dict[Name, Table]:
    """Displacements, forces of constraint and frequencies of an F06 file.

    Args:
        path: the file.
        buckling: eigenvalues are load factors.
    """
    rows: dict[Name, dict[int, list[float]]] = {}
    roots: dict[int, dict[int, float]] = {}
    title, subcase, part = "", 1, 0
    column = 2 if buckling else 4
    for line in path.read_text(errors="replace").splitlines():
        packed = line[1:].replace(" ", "")
        if line.startswith("1"):
            part = 0
        if match := re.search(r"SUPERELEMENT\s+(\d+)", line):
            part = int(match[1])
        if match := re.search(r"SUBCASE\s+(\d+)\s*$", line):
            subcase = int(match[1])
        if part:
            title = ""
        elif packed.startswith("REALEIGENVALUES"):
            title = "frequency"
        elif any(packed.startswith(name) for name in _TITLES):
            title = next(v for k, v in _TITLES.items() if packed.startswith(k))
        elif line.startswith("1") or re.match(r"^0?\s+(?:[A-Z-] ){6,}", line):
            title = ""
        elif title == "frequency":
            words = line.split()
            if len(words) == 7 and words[0].isdigit():
                roots.setdefault(subcase, {})[int(words[0])] = _number(words[column])
        elif title and (match := _VECTOR.match(line)):
            own = rows.setdefault((title, subcase), {})
            values = [_number(word) for word in match[2].split()]
            own[int(match[1])] = (values + [0.0] * 6)[:6]
    found = {
        name: Table(
            [(grid, 1) for grid in own], np.array([list(own.values())], float), _SIX
        )
        for name, own in rows.items()
    }
    for k, (case, own) in enumerate(roots.items(), start=1):
        name = ("load factor", k) if buckling else ("frequency", case)
        found[name] = listed(np.array([own[k] for k in sorted(own)]))
    return found


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return float("nan")

"""F06 files of MYSTRAN: displacements, forces of constraint, eigenvalues."""

import re
from pathlib import Path

import numpy as np

from benchmarks.suite.tables import Name, Table, listed

_SIX = ("t1", "t2", "t3", "r1", "r2", "r3")
_TITLES = {
    "DISPLACEMENTS": "displacement",
    "SPCFORCES": "SPC force",
    "MPCFORCES": "MPC force",
    "REALEIGENVALUES": "roots",
}


def read_mystran(path: Path, *, buckling: bool = False) -> dict[Name, Table]:
    """Tables of statics by subcase, frequencies or load factors.

    Args:
        path: the file.
        buckling: eigenvalues are load factors.
    """
    rows: dict[Name, dict[int, list[float]]] = {}
    roots: list[float] = []
    title, subcase = "", 1
    for line in path.read_text(errors="replace").splitlines():
        packed = line.replace(" ", "")
        words = line.split()
        if match := re.match(r" OUTPUT FOR SUBCASE\s+(\d+)", line):
            subcase = int(match[1])
        elif "OUTPUT FOR EIGENVECTOR" in line:
            subcase = 0
        if packed in _TITLES:
            title = _TITLES[packed]
        elif re.match(r"\s*(?:[A-Z] ){4,}", line) or "-----" in line:
            title = ""
        elif title == "roots" and words and all(map(_is_number, words)):
            roots.append(float(words[2] if buckling else words[4]))
        elif title and subcase and len(words) == 8 and all(map(_is_number, words)):
            values = [float(word) for word in words[2:]]
            rows.setdefault((title, subcase), {})[int(words[0])] = values
    found = {
        name: Table(
            [(grid, 1) for grid in own], np.array([list(own.values())], float), _SIX
        )
        for name, own in rows.items()
    }
    if roots:
        name = "load factor" if buckling else "frequency"
        found[name, 1] = listed(np.array(roots))
    return found


def _is_number(word: str) -> bool:
    return re.fullmatch(r"[+-]?\d+(\.\d*(E[+-]?\d+)?)?", word) is not None

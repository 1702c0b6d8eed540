"""Interface grids as a user names them: a SET of the deck, a list, or the ASET."""

import re
from pathlib import Path

import numpy as np

from fem.deck.text.sections import split_sections
from fem.deck.text.source import read_source
from fem.errors import InputError
from fem.model.structure import Structure

_SET = re.compile(r"^\s*SET\s*(\d+)\s*=\s*(.*)$", re.IGNORECASE)


def interface_grids(text: str | None, structure: Structure) -> list[int]:
    """Grid ids.

    Args:
        text: `SET 2`, or ids with THRU, as in a SET: `1, 4 THRU 9`; None: the grids of
            the deck's ASET.
        structure: whose deck may name the set.

    Raises:
        InputError: no such set, no ASET, or what is no list of ids.
    """
    path = structure.deck.path
    if text is None:
        dof = structure.analysis_dof
        dof = dof[dof < 6 * len(structure.points.grid_id)]
        if len(dof) == 0:
            sets = " or ".join(f"'SET {number}'" for number in sorted(case_sets(path)))
            raise InputError(
                f"{path} has no ASET; give the interface: --interface with "
                + (f"{sets} of its case control or " if sets else "")
                + "ids as '11, 20 THRU 30'"
            )
        return structure.points.grid_id[np.unique(dof // 6)].tolist()
    match = re.fullmatch(r"\s*set\s*(\d+)\s*", text, re.IGNORECASE)
    if match is None:
        return _ids(text, "--interface")
    sets = case_sets(path)
    number = int(match[1])
    if number not in sets:
        known = ", ".join(map(str, sorted(sets))) or "none"
        raise InputError(f"--interface: no SET {number} in {path}; it has {known}")
    return _ids(sets[number], f"{path}: SET {number}")


def case_sets(path: Path) -> dict[int, str]:
    """The SETs of a deck's case control, as text."""
    found: dict[int, str] = {}
    current: int | None = None
    for line in split_sections(read_source(path).lines, str(path)).case_control:
        text = line.text.split("$")[0].rstrip()
        if match := _SET.match(text):
            current = int(match[1])
            found[current] = match[2]
        elif current is not None and found[current].rstrip().endswith(","):
            found[current] += " " + text.strip()
        else:
            current = None
    return found


def _ids(text: str, place: str) -> list[int]:
    ids: list[int] = []
    for part in filter(None, (p.strip() for p in re.split(r",", text))):
        span = re.fullmatch(r"(\d+)(?:\s+THRU\s+(\d+))?", part, re.IGNORECASE)
        if span is None:
            raise InputError(
                f"{place}: found '{part}', expected ids (11, 20 THRU 30) or SET 2"
            )
        ids += range(int(span[1]), int(span[2] or span[1]) + 1)
    return ids

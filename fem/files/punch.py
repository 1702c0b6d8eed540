"""PUNCH files: results of points and elements as cards of 80 columns.

Layout as Nastran writes it: `$` lines that say what follows, then 18 columns of id,
three numbers of 18 columns, a line number in columns 73 to 80, further lines with
`-CONT-`.
Elements have the words that they have in OP2 files.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TextIO

import h5py
import numpy as np
import numpy.typing as npt

from fem.arrays import Float64, Int64
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck
from fem.files.atomic import written_aside
from fem.files.complex_parts import HEADINGS, as_asked, form_of
from fem.files.op2 import element_layouts
from fem.files.op2_elements import Layout, words
from fem.files.reading import PointResult, Solution, solutions
from fem.model.structure import Structure

# Dataset -> request of case control and heading.
_POINTS = {
    "displacement": ("DISPLACEMENT", "DISPLACEMENTS"),
    "shape": ("DISPLACEMENT", "EIGENVECTOR"),
    "velocity": ("VELOCITY", "VELOCITY"),
    "acceleration": ("ACCELERATION", "ACCELERATION"),
    "applied_load": ("OLOAD", "OLOADS"),
    "spc_force": ("SPCFORCES", "SPCF"),
    "mpc_force": ("MPCFORCES", "MPCF"),
}
_ELEMENTS = {
    "element_force": ("FORCE", "ELEMENT FORCES"),
    "element_stress": ("STRESS", "ELEMENT STRESSES"),
    "element_strain": ("STRAIN", "ELEMENT STRAINS"),
}


def wants_punch(deck: Deck) -> bool:
    """Whether a request of any subcase names PUNCH."""
    return any(_asked(case) for case in deck.case_control)


def _asked(case: Subcase) -> set[str]:
    return {name for name, words in case.options.items() if "PUNCH" in words}


def write_punch(
    results: Path, structure: Structure, path: Path, *, everything: bool = False
) -> None:
    """Write what requests with PUNCH ask for.

    Args:
        results: HDF5 file of a run.
        structure: the model of the run.
        path: the file; it appears when it is complete.
        everything: all results of the file, whatever the requests say.
    """
    cases = {case.id: case for case in structure.deck.case_control}
    with (
        written_aside(path) as part,
        h5py.File(results) as source,
        part.open("w") as stream,
    ):
        out = _Cards(stream)
        for solution in solutions(source):
            case = cases.get(solution.subcase, structure.deck.case_control[0])
            own = None if everything else _asked(case)
            for k in range(len(solution.values)):
                _write_state(out, solution, structure, case, k, own)


def _write_state(
    out: "_Cards",
    solution: Solution,
    structure: Structure,
    case: Subcase,
    k: int,
    asked: set[str] | None,
) -> None:
    for name, (request, heading) in _POINTS.items():
        found = solution.point(name)
        if found is None or (asked is not None and request not in asked):
            continue
        form = form_of(case, request, found.grids.dtype)
        out.head(case, heading, _state(solution, k), form)
        _points(out, solution, found, k, form)
    for name, (request, heading) in _ELEMENTS.items():
        if asked is not None and request not in asked:
            continue
        for card, layout, result in element_layouts(solution, structure, name):
            form = form_of(case, request, result.dataset.dtype)
            out.head(case, heading, _state(solution, k), form)
            out.comment(f"$ELEMENT TYPE ={layout.type:12d}  {card}")
            values = as_asked(solution.state(result.dataset, k), form)
            _elements(out, layout, result.columns, result.id, values)


def _state(solution: Solution, k: int) -> str:
    value = float(solution.values[k])
    if solution.analysis == "modes":
        return f"$EIGENVALUE = {(2.0 * np.pi * value) ** 2:14.7E}  MODE ={k + 1:6d}"
    if solution.analysis == "buckling":
        return f"$EIGENVALUE = {value:14.7E}  MODE ={k + 1:6d}"
    if solution.analysis == "frequency":
        return f"$FREQUENCY = {value:16.7E}"
    return f"$TIME = {value:14.7E}" if solution.analysis == "transient" else ""


def _points(
    out: "_Cards", solution: Solution, found: PointResult, k: int, form: int
) -> None:
    values = as_asked(solution.state(found.grids, k), form)
    for grid, own in zip(found.grid_id, values):
        out.card(f"{grid:10d}       G", _reals(own))
    if found.scalars is not None:
        values = as_asked(solution.state(found.scalars, k), form)
        for point, value in zip(found.scalar_id, values):
            out.card(f"{point:10d}       S", _reals(value[None]))


def _reals(values: npt.NDArray) -> list[str]:
    """Words of numbers; of complex ones all first parts, then all second ones."""
    both = [values.real, values.imag] if np.iscomplexobj(values) else [values]
    return [f"{v:18.6E}" for part in both for v in part]


def _elements(
    out: "_Cards", layout: Layout, columns: Sequence[str], ids: Int64, values: Float64
) -> None:
    raw = words(layout, columns, values)
    for row, element in enumerate(ids):
        texts = [
            f"{raw[row, k]:18.6E}"
            if isinstance(cell, str | float)
            else f"{_whole(cell, row):>18}"
            for k, cell in enumerate(layout.cells)
        ]
        out.card(f"{element:10d}{'':8}", texts[1:])


def _whole(cell: Int64, row: int) -> str:
    """A word of a layout that is no real number."""
    whole = int(cell[min(row, len(cell) - 1)])
    text = whole.to_bytes(4, "little", signed=True)
    return text.decode() if text in (b"CEN/", b"GRID") else str(whole)


class _Cards:
    """Lines with numbers."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._count = 0

    def comment(self, text: str) -> None:
        """A line of words."""
        self._count += 1
        self._stream.write(f"{text[:72]:<72}{self._count:8d}\n")

    def head(self, case: Subcase, heading: str, state: str, form: int) -> None:
        """Writes the head of the following cards."""
        for name in ("title", "subtitle", "label"):
            self.comment(f"${name.upper():<8}= {getattr(case, name)}")
        self.comment(f"${heading}")
        self.comment(HEADINGS[form])
        self.comment(f"$SUBCASE ID ={case.id:12d}")
        if state:
            self.comment(state)

    def card(self, head: str, words: Sequence[str]) -> None:
        """An id and its values, three on a line."""
        for line in _threes(words):
            self.comment(f"{head:<18}{''.join(line)}")
            head = "-CONT-"


def _threes(words: Sequence[str]) -> Iterator[Sequence[str]]:
    for start in range(0, len(words), 3):
        yield words[start : start + 3]

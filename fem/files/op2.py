"""OP2 files for post-processors, from a result file and the structure it belongs to.

Displacements, velocities, accelerations, eigenvectors, forces of constraint, element
forces, stresses and strains. The records are written here, whole tables at a time:
pyNastran's writer cannot build shell and bush forces and loops over all elements; its
reader is the test.
Not in the file: energies, grid point forces, envelopes (the HDF5 file has them).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import numpy.typing as npt

from fem.arrays import Int64
from fem.deck.control.subcase import Subcase
from fem.deck.superelements.subcases import split_subcases
from fem.elements.connectivity import element_grids
from fem.files.atomic import written_aside
from fem.files.complex_parts import REAL, as_asked, form_of
from fem.files.op2_complex import complex_layout_of
from fem.files.op2_elements import (
    Elements,
    Layout,
    layout_of,
    plies_of,
    ply_words,
    words,
)
from fem.files.op2_records import (
    BUCKLING,
    DEVICE,
    FREQUENCY,
    MODAL,
    STATIC,
    TRANSIENT,
    Kind,
    Op2File,
    State,
)
from fem.files.reading import ElementResult, PointResult, Solution, solutions
from fem.model.structure import Structure

Words = npt.NDArray[np.float32]
Numbers = npt.NDArray[np.inexact]

_POINTS = {
    "displacement": ("OUGV1", 1, "DISPLACEMENT"),
    "shape": ("OUGV1", 7, "DISPLACEMENT"),
    "velocity": ("OVG1", 10, "VELOCITY"),
    "acceleration": ("OAG1", 11, "ACCELERATION"),
    "applied_load": ("OPG1", 2, "OLOAD"),
    "spc_force": ("OQG1", 3, "SPCFORCES"),
    "mpc_force": ("OQMG1", 39, "MPCFORCES"),
}
# Kind of result: table, table of plies, code, SCODE of both.
_ELEMENTS = {
    "element_force": ("OEF1X", "OEF1X", 4, 0, 0),
    "element_stress": ("OES1X1", "OES1C", 5, 1, 0),
    "element_strain": ("OSTR1X", "OSTR1C", 5, 11, 14),
}
_ANALYSES = {
    "static": STATIC,
    "modes": MODAL,
    "buckling": BUCKLING,
    "frequency": FREQUENCY,
    "transient": TRANSIENT,
}


@dataclass(frozen=True)
class _Series:
    """One kind of result over the states of a solution: words of state k."""

    kind: Kind
    words: Callable[[int], Words]


def write_op2(results: Path, structure: Structure, path: Path) -> list[str]:
    """Write what a result file holds as OP2.

    Args:
        results: HDF5 file of a run.
        structure: the model of the run.
        path: the file; it appears when it is complete.

    Returns:
        Tables of element results that have no place in an OP2 file.
    """
    left: list[str] = []
    cases = {case.id: case for case in structure.deck.case_control}
    with (
        written_aside(path) as part,
        h5py.File(results) as source,
        part.open("wb") as stream,
    ):
        file = Op2File(stream)
        for solution in solutions(source):
            states = _states(solution, structure)
            case = cases.get(solution.subcase, structure.deck.case_control[0])
            series = _point_series(solution, case)
            elements, missing = _element_series(solution, structure, case)
            left += missing
            _write(file, series + elements, states)
        file.close()
    return left


def _states(solution: Solution, structure: Structure) -> list[State]:
    titles = {case.id: case.title for case in structure.deck.case_control}
    solved, _ = split_subcases(structure.deck.case_control)
    case = solution.subcase or solved[0].id
    modal = solution.analysis == "modes"
    return [
        State(
            analysis=_ANALYSES[solution.analysis],
            subcase=case,
            number=k,
            value=float((2.0 * np.pi * value) ** 2 if modal else value),
            frequency=float(value) if modal else 0.0,
            title=titles.get(case, ""),
        )
        for k, value in enumerate(solution.values, start=1)
    ]


def _write(file: Op2File, series: list[_Series], states: list[State]) -> None:
    """Series of one table follow each other within it."""
    for table in dict.fromkeys(item.kind.table for item in series):
        file.begin_table(table)
        for item in series:
            if item.kind.table == table:
                for k, state in enumerate(states):
                    file.add(item.kind, state, item.words(k))
        file.end_table()


def _point_series(solution: Solution, case: Subcase) -> list[_Series]:
    series = []
    for name, (table, code, request) in _POINTS.items():
        result = solution.point(name)
        if result is None or not len(result.grid_id) + len(result.scalar_id):
            continue  # a table without rows is none
        form = form_of(case, request, result.grids.dtype)

        def words_of(k: int, result: PointResult = result, form: int = form) -> Words:
            grids = solution.state(result.grids, k)
            scalars = np.zeros((len(result.scalar_id), 6), grids.dtype)
            if result.scalars is not None:
                scalars[:, 0] = solution.state(result.scalars, k)
            grids, scalars = as_asked(grids, form), as_asked(scalars, form)
            return _point_words(result.grid_id, grids, result.scalar_id, scalars)

        numbers = 6 if form == REAL else 12
        kind = Kind(table=table, code=code, width=2 + numbers, parts=form)
        series.append(_Series(kind, words_of))
    return series


def _point_words(
    grid_id: Int64, grids: Numbers, scalar_id: Int64, scalars: Numbers
) -> Words:
    """Rows of ids, type (1: grid, 2: scalar point) and six values, by id.

    Of complex values all real parts come first.
    """
    ids = np.concatenate([grid_id, scalar_id])
    order = np.argsort(ids, kind="stable")
    values = np.concatenate([grids, scalars])[order]
    if np.iscomplexobj(values):
        values = np.concatenate([values.real, values.imag], axis=1)
    out = np.zeros((len(ids), 2 + values.shape[1]), "<f4")
    integers = out.view("<i4")
    integers[:, 0] = 10 * ids[order] + DEVICE
    integers[:, 1] = np.where(order < len(grid_id), 1, 2)
    out[:, 2:] = values
    return out


def _element_series(
    solution: Solution, structure: Structure, case: Subcase
) -> tuple[list[_Series], list[str]]:
    """Series of element results, and what has no place in the file."""
    series: list[_Series] = []
    left = [
        f"element_failure of {card}" for card in solution.elements("element_failure")
    ]
    for name, (table, ply_table, code, stress, ply_stress) in _ELEMENTS.items():
        request = name.removeprefix("element_").upper()
        for card, result in solution.elements(name).items():
            harmonic = np.issubdtype(result.dataset.dtype, np.complexfloating)
            if harmonic and plies_of(card):
                left.append(f"complex {name} of {card}")
                continue
            if plies := plies_of(card):
                kind = Kind(
                    table=ply_table,
                    code=code,
                    element=plies,
                    width=11,
                    stress=ply_stress,
                )
                series.append(_Series(kind, _plies(solution, result)))
                continue
            layout = _layout(structure, name, card, result)
            if layout is None:
                left.append(f"{name} of {card}")
                continue
            form = form_of(case, request, result.dataset.dtype)

            def words_of(
                k: int, result: ElementResult = result, layout=layout, form=form
            ) -> Words:
                values = as_asked(solution.state(result.dataset, k), form)
                return words(layout, result.columns, values)

            kind = Kind(
                table=table,
                code=code,
                element=layout.type,
                width=layout.width,
                stress=stress,
                parts=form,
            )
            series.append(_Series(kind, words_of))
    return series, left


def _layout(
    structure: Structure, name: str, card: str, result: ElementResult
) -> Layout | None:
    """Words of a table "element_force" ... of a card; None: there is no place."""
    grids = _grids_of(structure, card, result.id)
    elements = Elements(id=result.id, grids=grids, columns=result.columns)
    harmonic = np.issubdtype(result.dataset.dtype, np.complexfloating)
    arranged = complex_layout_of if harmonic else layout_of
    return arranged(card, name.removeprefix("element_"), elements)


def element_layouts(
    solution: Solution, structure: Structure, name: str
) -> Iterator[tuple[str, Layout, ElementResult]]:
    """Tables "element_force" ... of a solution that have words in Nastran's files."""
    for card, result in solution.elements(name).items():
        layout = None if plies_of(card) else _layout(structure, name, card, result)
        if layout is not None:
            yield card, layout, result


def _plies(solution: Solution, result: ElementResult) -> Callable[[int], Words]:
    own = sum(name.endswith("_p1") for name in result.columns)
    return lambda k: ply_words(result.id, solution.state(result.dataset, k), own)


def _grids_of(structure: Structure, card: str, ids: Int64) -> Int64:
    """(e, n) grid ids of elements; zero columns where they have none."""
    points = structure.points
    found: list[tuple[Int64, Int64]] = []
    for block in structure.blocks:
        grids = element_grids(points, block) if block.card == card else None
        if grids is not None:
            found.append((block.id, points.grid_id[grids]))
    widest = max((grids.shape[1] for _, grids in found), default=0)
    result = np.zeros((len(ids), widest), np.int64)
    for own, grids in found:
        chosen = np.isin(own, ids)
        at = np.searchsorted(ids, own[chosen])
        result[at, : grids.shape[1]] = grids[chosen]
    return result

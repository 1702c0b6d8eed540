"""Observers that write what the subcases of a transient ask for."""

from collections.abc import Iterator

import numpy as np
import scipy.sparse as sp

from fem.algebra.sparse_products import shape_of
from fem.deck.control.case_sets import Selection
from fem.deck.control.subcase import Subcase
from fem.elements.block import Kind
from fem.files.force_histories import (
    GridForceHistory,
    LoadHistory,
    constraint_force_history,
)
from fem.files.hdf5 import PointLayout, ResultFile
from fem.loads import (
    time_steps,
)
from fem.model.structure import Structure
from fem.recovery.elements import (
    ElementTable,
    element_tables,
    loaded_bar_tables,
    station_tables,
)
from fem.recovery.envelope import Envelope
from fem.recovery.grid_forces import constrained_grids, grid_balance, grids_of
from fem.recovery.table_response import TableResponse
from fem.response.direct import TransientLoad
from fem.response.observation import Observer, Quantity
from fem.solution.options import Options
from fem.solution.requests import (
    ELEMENT_RESULTS,
    detail_of,
    ids_of,
    wanted,
)
from fem.solution.transient_inputs import TransientInputs

_QUANTITIES: dict[str, Quantity] = {
    "DISPLACEMENT": "displacement",
    "VELOCITY": "velocity",
    "ACCELERATION": "acceleration",
}
_MOTION = tuple(_QUANTITIES)
# Quantities that nobody asked for are written up to this size.
_UNASKED_BYTES = 300e6


def transient_observers(
    model: Structure,
    cases: list[Subcase],
    expand: sp.csr_matrix,
    inputs: TransientInputs,
    results: ResultFile,
    options: Options,
) -> list[Observer]:
    """Writers of everything that the subcases ask for."""
    if inputs.element_loads is not None and options.bar_loads:
        options.console.say(
            "notice: results of bars and beams include what PLOAD1 does between their "
            "ends; Nastran's transient tables leave it out (so does --no-bar-loads)"
        )
    observers: list[Observer] = []
    for i, case in enumerate(cases):
        name = f"transient/{case.id}"
        for quantity in _MOTION:
            selection = _selection(model, case, quantity)
            if selection != "NONE":
                observers.append(
                    results.point_history(
                        f"{name}/{quantity.lower()}",
                        model.points,
                        selection,
                        _QUANTITIES[quantity],
                        expand,
                        i,
                    )
                )
        observers += _forces(model, case, i, expand, inputs.load, results, name)
        observers += _element_results(
            model, case, i, expand, inputs, results, options, name
        )
    return observers


def _selection(model: Structure, case: Subcase, quantity: str) -> Selection:
    """What to write of a quantity; where nobody asked, of the grids whose motion
    somebody asked for, or of all where that is small.
    """
    asked = case.outputs.get(quantity)
    if asked is not None:
        return asked
    others = [case.outputs[q] for q in _MOTION if q in case.outputs]
    sets = [selection for selection in others if not isinstance(selection, str)]
    if sets:
        return sets[0]
    steps = time_steps(model.deck, case)
    times = sum(count // stride + 1 for count, _, stride in steps)
    return "ALL" if 8.0 * times * model.points.size < _UNASKED_BYTES else "NONE"


def _element_results(
    model: Structure,
    case: Subcase,
    number: int,
    expand: sp.csr_matrix,
    inputs: TransientInputs,
    results: ResultFile,
    options: Options,
    name: str,
) -> Iterator[Observer]:
    """Histories of element results, and their envelopes."""
    detail = detail_of(model.deck, case)
    loads = inputs.element_loads if options.bar_loads else None
    factors = inputs.load.factors
    for request, kind in ELEMENT_RESULTS:

        def tables(selection: Selection, kind: Kind = kind) -> list[ElementTable]:
            return element_tables(
                model.points,
                model.blocks,
                kind,
                selection,
                detail=detail,
                loads=loads,
                moving=True,
            )

        chosen = tables(wanted(case, request))
        chosen += station_tables(
            model.points, model.blocks, kind, wanted(case, request), loads
        )
        if kind == "force":
            chosen += loaded_bar_tables(
                model.points, model.blocks, wanted(case, request), loads
            )
        for table in chosen:
            response = TableResponse(table, expand, number, factors)
            yield results.table_history(f"{name}/element_{kind}", response)
        if options.envelope and kind != "strain":
            for table in tables("ALL"):
                group = f"{name}/envelope/{kind}"
                yield Envelope(table, expand, group, number, factors)


def _forces(
    model: Structure,
    case: Subcase,
    number: int,
    expand: sp.csr_matrix,
    load: TransientLoad,
    results: ResultFile,
    name: str,
) -> Iterator[Observer]:
    """Histories of applied loads, forces of constraint and grid point forces."""
    points = model.points
    for request, kind in (("SPCFORCES", "spc"), ("MPCFORCES", "mpc")):
        if wanted(case, request) != "NONE":
            yield constraint_force_history(
                kind,
                results.file,
                f"{name}/{kind}_force",
                PointLayout(points, wanted(case, request)),
                model,
                expand,
                load,
                number,
            )
    if wanted(case, "OLOAD") != "NONE":
        layout = PointLayout(points, wanted(case, "OLOAD"))
        yield LoadHistory(results.file, f"{name}/applied_load", layout, load, number)
    if wanted(case, "GPFORCE") != "NONE":
        single, multi = constrained_grids(points, model.elimination)
        balance = grid_balance(
            points,
            model.blocks,
            loaded=grids_of(points, abs(load.pattern) @ np.ones(_patterns(load))),
            spc=single,
            mpc=multi,
            wanted=ids_of(wanted(case, "GPFORCE")),
        )
        group = results.grid_force_group(f"{name}/grid_point_force", balance)
        yield GridForceHistory(group, balance, model, expand, load, number)


def _patterns(load: TransientLoad) -> int:
    return shape_of(load.pattern)[1]

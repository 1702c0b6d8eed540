"""SOL 109 and 112: direct and modal transients with the results that are asked for.

Subcases that differ by loads and initial conditions only are integrated together.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np
import scipy.sparse as sp

from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.modes import Modes
from fem.algebra.sparse_products import shape_of
from fem.arrays import Float64
from fem.deck.control.case_sets import Selection
from fem.deck.control.subcase import Subcase
from fem.elements.block import Kind
from fem.errors import InputError
from fem.files.force_histories import (
    GridForceHistory,
    LoadHistory,
    constraint_force_history,
)
from fem.files.hdf5 import PointLayout, ResultFile
from fem.loads import (
    EnforcedMotion,
    dynamic_excitation,
    dynamic_motions,
    initial_conditions,
    nonlinear_load,
    table_notices,
    time_steps,
)
from fem.loads.element_loads import ElementLoads, side_by_side
from fem.model.structure import Structure, system_of
from fem.recovery.elements import (
    ElementTable,
    element_tables,
    loaded_bar_tables,
    station_tables,
)
from fem.recovery.envelope import Envelope
from fem.recovery.grid_forces import constrained_grids, grid_balance, grids_of
from fem.recovery.table_response import TableResponse
from fem.response.direct import NastranScheme, TransientLoad, direct_transient
from fem.response.modal import modal_transient, residual_vectors
from fem.response.observation import Observer, Quantity
from fem.solution.analysis_model import (
    AnalysisModel,
    analysis_model,
    in_modes,
    with_dynamic_input,
)
from fem.solution.enforced_motion import carried_shape
from fem.solution.holding import solve_or_hold
from fem.solution.modal_damping import modal_ratios
from fem.solution.modes import mode_table, modes_of, retained_modes
from fem.solution.moving_base import moving_base, say_of_motion, with_base
from fem.solution.options import Options
from fem.solution.requests import (
    ELEMENT_RESULTS,
    check_free,
    detail_of,
    ids_of,
    wanted,
)

_QUANTITIES: dict[str, Quantity] = {
    "DISPLACEMENT": "displacement",
    "VELOCITY": "velocity",
    "ACCELERATION": "acceleration",
}
_MOTION = tuple(_QUANTITIES)
# Quantities that nobody asked for are written up to this size.
_UNASKED_BYTES = 300e6


def solve_transients(
    structure: Structure,
    subcases: list[Subcase],
    results: ResultFile,
    options: Options,
) -> None:
    """Histories of transient subcases.

    Raises:
        InputError: loads, steps or damping tables that are not there; a massless
            mechanism, with its grids.
    """
    for _, group in groupby(subcases, key=_same_system):
        cases = list(group)
        model = structure.with_subcase(cases[0])
        for notice in model.damping_notices:
            options.console.say(f"warning: {notice}")
        if _is_modal(model):
            _modal(model, cases, results, options)
        else:
            _direct(model, cases, results, options)


def _same_system(c: Subcase) -> tuple[object, ...]:
    added = c.k2pp, c.b2pp, c.m2pp, c.tfl
    return system_of(c), added, c.tstep, c.method, c.sdamping, c.analysis


def _is_modal(model: Structure) -> bool:
    analysis = model.subcase.analysis.upper()
    return analysis == "MTRAN" or (not analysis and model.deck.sol == 112)


def _direct(
    model: Structure, cases: list[Subcase], results: ResultFile, options: Options
) -> None:
    check_free(model, 109)
    steps = _steps(model, cases, options)
    inputs = _inputs(model, cases)
    load_g = inputs.load
    say_of_motion(model, inputs.motions, options)

    def inform(text: str) -> None:
        size = results.size_bytes() / 1e6
        options.console.say(f"{text}, result file {size:.0f} MB")
        results.require_room()

    def run(model: Structure) -> tuple[Float64, list[Observer]]:
        results.discard(*(f"transient/{case.id}" for case in cases))
        reduced = analysis_model(model, solver=options.solver)
        reduced = with_dynamic_input(model, reduced)
        base = moving_base(model, inputs.motions, steps)
        load, expand = with_base(base, model, reduced, load_g)
        observers = _observers(model, cases, expand, inputs, results, options)
        start = [_start(model, reduced, x, options) for x in (inputs.u0, inputs.v0)]
        seen = observers if base is None else base.seen_by(observers)
        time = _integrate(
            model, cases, reduced, steps, load, start, seen, options, inform
        )
        return time, observers

    time, observers = solve_or_hold(model, run, options.console, SingularMatrixError)
    _finish(cases, time, observers, results)


def _integrate(
    model: Structure,
    cases: list[Subcase],
    reduced: AnalysisModel,
    steps: list[tuple[int, float, int]],
    load: TransientLoad,
    start: Sequence[Float64 | None],
    observers: Sequence[Observer],
    options: Options,
    inform: Callable[[str], None] | None = None,
) -> Float64:
    """Output times of a direct transient, loads that follow the motion included."""
    stiffness, mass, damping, kind = reduced.system
    following = nonlinear_load(model.deck, model.points, cases, reduced.rows)
    return direct_transient(
        stiffness,
        mass,
        damping,
        steps=steps,
        load=load,
        u0=start[0],
        v0=start[1],
        observers=observers,
        scheme=NastranScheme(following),
        kind=kind,
        solver=options.solver,
        threads=options.threads,
        progress=options.console.progress("direct transient"),
        inform=inform,
    ).time


def _modal(
    model: Structure, cases: list[Subcase], results: ResultFile, options: Options
) -> None:
    steps = _steps(model, cases, options)
    reduced, found = modes_of(model, options)
    modes = retained_modes(model.deck, found)
    if modes.count < found.count:
        options.console.say(f"{modes.count} of {found.count} modes are used")
    inputs = _inputs(model, cases)
    say_of_motion(model, inputs.motions, options)
    base = moving_base(model, inputs.motions, steps)
    if base is not None:
        shape = carried_shape(base.shape, model, reduced, modes, solver=options.solver)
        base = replace(base, shape=shape)
    load, expand = with_base(base, model, reduced, inputs.load)
    options.console.say(mode_table(modes))
    wanted = model.subcase.resvec or str(model.deck.param("RESVEC"))
    if not wanted.upper().startswith("NO"):
        count = modes.count
        modes = residual_vectors(
            reduced.stiffness, reduced.mass, modes, load.pattern, solver=options.solver
        )
        options.console.say(f"{modes.count - count} residual vectors")
    ratio = modal_ratios(model.deck, model.subcase, modes.frequency_hz)
    coupled = with_dynamic_input(model, in_modes(reduced, modes, ratio))
    start = [_start(model, reduced, x, options) for x in (inputs.u0, inputs.v0)]
    if coupled.direct is not None or any(case.nonlinear for case in cases):
        load, expand = with_base(base, model, coupled, inputs.load)
        observers = _observers(model, cases, expand, inputs, results, options)
        seen = observers if base is None else base.seen_by(observers)
        start = [
            _in_modes(model, reduced, modes, own, x)
            for own, x in zip(start, (inputs.u0, inputs.v0))
        ]
        time = _integrate(model, cases, coupled, steps, load, start, seen, options)
        _finish(cases, time, observers, results)
        return
    observers = _observers(model, cases, expand, inputs, results, options)
    time = modal_transient(
        modes,
        reduced.mass,
        reduced.damping,
        steps=steps,
        load=load,
        ratio=ratio,
        u0=start[0],
        v0=start[1],
        observers=observers if base is None else base.seen_by(observers),
        progress=options.console.progress("modal transient"),
    )
    _finish(cases, time, observers, results)


def _in_modes(
    model: Structure,
    reduced: AnalysisModel,
    modes: Modes,
    start: Float64 | None,
    given: Float64,
) -> Float64:
    """(c, e + m) initial values of extra points, and modal coordinates.

    Args:
        model, reduced, modes: what moves.
        start: (c, n) initial values of the analysis set; None: zero.
        given: (c, g) those of the g-set.
    """
    own = np.zeros((len(given), modes.count))
    if start is not None:
        own = (reduced.mass @ start.T).T @ modes.shape
    extra = model.points.extra_dof if model.dynamic_input is not None else []
    return np.hstack([given[:, extra], own])


def _steps(
    model: Structure, cases: list[Subcase], options: Options
) -> list[tuple[int, float, int]]:
    """Time steps; where tables of loads end before them is said."""
    steps = time_steps(model.deck, model.subcase)
    end = sum(count * step for count, step, _ in steps)
    notices = (table_notices(model.deck, case, end) for case in cases)
    for notice in dict.fromkeys(text for texts in notices for text in texts):
        options.console.say(f"notice: {notice}")
    return steps


@dataclass(frozen=True, kw_only=True)
class _Inputs:
    """Loads of all cases on the g-set, what moves, and initial states (c, g)."""

    load: TransientLoad
    motions: list[list[EnforcedMotion]]
    element_loads: ElementLoads | None
    u0: Float64
    v0: Float64


def _inputs(model: Structure, cases: list[Subcase]) -> _Inputs:
    mass = model.loaded_mass
    excitations = []
    for case in cases:
        if not case.dload and not case.ic:
            raise InputError(
                f"{model.deck.path}: subcase {case.id} selects neither DLOAD nor IC; "
                "there is nothing to solve"
            )
        excitations.append(
            dynamic_excitation(model.deck, model.points, case, mass, beside_motion=True)
            if case.dload
            else None
        )
    size = model.points.size
    patterns = [
        sp.csr_matrix((size, 0)) if e is None else e.pattern for e in excitations
    ]
    counts = [shape_of(pattern)[1] for pattern in patterns]
    ends = np.cumsum([0, *counts])

    def evaluate(time: Float64) -> Float64:
        factors = np.zeros((len(cases), ends[-1], len(time)))
        for i, excitation in enumerate(excitations):
            if excitation is not None:
                factors[i, ends[i] : ends[i + 1]] = excitation.evaluate(time)
        return factors

    on_elements = [None if e is None else e.element_loads for e in excitations]
    states = [initial_conditions(model.deck, model.points, case) for case in cases]
    return _Inputs(
        load=TransientLoad(sp.csr_matrix(sp.hstack(patterns)), evaluate),
        motions=[dynamic_motions(model.deck, model.points, case) for case in cases],
        element_loads=side_by_side(list(zip(on_elements, counts)))
        if any(loads is not None for loads in on_elements)
        else None,
        u0=np.array([u for u, _ in states]),
        v0=np.array([v for _, v in states]),
    )


def _start(
    model: Structure, reduced: AnalysisModel, state: Float64, options: Options
) -> Float64 | None:
    """Initial state (c, n) from that of the g-set (c, g).

    As in Nastran, values of freedoms that do not move by themselves are not used.
    """
    if not state.any():
        return None
    rows = reduced.rows
    given = np.flatnonzero(state.any(axis=0))
    known = np.union1d(rows, model.points.extra_dof)
    unused = [model.points.label(int(dof)) for dof in np.setdiff1d(given, known)]
    if unused:
        options.console.say(
            "warning: TIC is not used on constrained, dependent or omitted freedoms: "
            + ", ".join(unused[:10])
            + (f", ... ({len(unused)} in all)" if len(unused) > 10 else "")
        )
    start = np.zeros((len(state), len(reduced.mass.indptr) - 1))
    start[:, : len(rows)] = state[:, rows]
    return start


def _observers(
    model: Structure,
    cases: list[Subcase],
    expand: sp.csr_matrix,
    inputs: _Inputs,
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
    inputs: _Inputs,
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


def _finish(
    cases: list[Subcase],
    time: Float64,
    observers: Sequence[Observer],
    results: ResultFile,
) -> None:
    for case in cases:
        results.write(f"transient/{case.id}/time", time)
    for observer in observers:
        if isinstance(observer, Envelope):
            observer.write(results.file)

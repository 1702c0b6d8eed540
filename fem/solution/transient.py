"""SOL 109 and 112: direct and modal transients with the results that are asked for.

Subcases that differ by loads and initial conditions only are integrated together.
"""

from collections.abc import Sequence
from itertools import groupby

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.analysis_model import AnalysisModel, analysis_model
from fem.constraint_forces import SpcForceObserver
from fem.deck.case_control import Selection, Subcase
from fem.envelope import Envelope
from fem.errors import InputError
from fem.linear_solver import SingularMatrixError
from fem.loads import dynamic_excitation, initial_conditions, time_steps
from fem.modal_damping import modal_ratios
from fem.modal_transient import modal_transient, residual_vectors
from fem.observation import Observer
from fem.recovery import element_tables
from fem.results import PointLayout, ResultFile
from fem.solution.modes import mode_table, modes_of
from fem.solution.options import Options
from fem.sparse_products import shape_of
from fem.structure import Structure
from fem.time_grid import output_times, step_groups
from fem.transient import TransientLoad, direct_transient

Float64 = npt.NDArray[np.float64]

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
    matrices = (c.nsm, c.k2gg, c.m2gg, c.b2gg)
    return (c.spc, c.mpc, c.tstep, c.method, c.sdamping, c.analysis, *matrices)


def _is_modal(model: Structure) -> bool:
    analysis = model.subcase.analysis.upper()
    return analysis == "MTRAN" or (not analysis and model.deck.sol == 112)


def _direct(
    model: Structure, cases: list[Subcase], results: ResultFile, options: Options
) -> None:
    steps = time_steps(model.deck, model.subcase)
    load_g, u0, v0 = _inputs(model, cases)

    def reduce() -> AnalysisModel:
        return analysis_model(model, solver=options.solver)

    reduced = model.guarded(reduce, dynamic=True, error=SingularMatrixError)
    observers = _observers(model, cases, reduced, load_g, results, options)

    def run() -> Float64:
        return direct_transient(
            reduced.stiffness,
            reduced.mass,
            reduced.damping,
            steps=steps,
            load=TransientLoad(reduced.load(load_g.pattern), load_g.evaluate),
            u0=_start(model, reduced, u0, options),
            v0=_start(model, reduced, v0, options),
            observers=observers,
            solver=options.solver,
            threads=options.threads,
            progress=options.console.progress("direct transient"),
            inform=options.console.say,
        ).time

    time = model.guarded(run, dynamic=True, error=SingularMatrixError)
    _finish(cases, time, observers, results)


def _modal(
    model: Structure, cases: list[Subcase], results: ResultFile, options: Options
) -> None:
    steps = time_steps(model.deck, model.subcase)
    reduced, modes = modes_of(model, options)
    load_g, u0, v0 = _inputs(model, cases)
    load = TransientLoad(reduced.load(load_g.pattern), load_g.evaluate)
    options.console.say(mode_table(modes))
    wanted = model.subcase.resvec or str(model.deck.param("RESVEC"))
    if not wanted.upper().startswith("NO"):
        count = modes.count
        modes = residual_vectors(
            reduced.stiffness, reduced.mass, modes, load.pattern, solver=options.solver
        )
        options.console.say(f"{modes.count - count} residual vectors")
    observers = _observers(model, cases, reduced, load_g, results, options)
    time = modal_transient(
        modes,
        reduced.mass,
        reduced.damping,
        steps=steps,
        load=load,
        ratio=modal_ratios(model.deck, model.subcase, modes.frequency_hz),
        u0=_start(model, reduced, u0, options),
        v0=_start(model, reduced, v0, options),
        observers=observers,
        progress=options.console.progress("modal transient"),
    )
    _finish(cases, time, observers, results)


def _inputs(
    model: Structure, cases: list[Subcase]
) -> tuple[TransientLoad, Float64, Float64]:
    """Loads of all cases on the g-set, and initial states (c, g)."""
    mass = model.matrices.mass
    excitations = []
    for case in cases:
        if not case.dload and not case.ic:
            raise InputError(
                f"{model.deck.path}: subcase {case.id} selects neither DLOAD nor IC; "
                "there is nothing to solve"
            )
        excitations.append(
            dynamic_excitation(model.deck, model.points, case, mass)
            if case.dload
            else None
        )
    size = model.points.size
    patterns = [
        sp.csr_matrix((size, 0)) if e is None else e.pattern for e in excitations
    ]
    widths = np.cumsum([0, *(shape_of(pattern)[1] for pattern in patterns)])

    def evaluate(time: Float64) -> Float64:
        factors = np.zeros((len(cases), widths[-1], len(time)))
        for i, excitation in enumerate(excitations):
            if excitation is not None:
                factors[i, widths[i] : widths[i + 1]] = excitation.evaluate(time)
        return factors

    states = [initial_conditions(model.deck, model.points, case) for case in cases]
    load = TransientLoad(sp.csr_matrix(sp.hstack(patterns)), evaluate)
    return load, np.array([u for u, _ in states]), np.array([v for _, v in states])


def _start(
    model: Structure, reduced: AnalysisModel, state: Float64, options: Options
) -> Float64 | None:
    """Initial state (c, n) from that of the g-set (c, g).

    As in Nastran, values of freedoms that do not move by themselves are not used.
    """
    if not state.any():
        return None
    rows = model.analysis_dof if reduced.reduced else model.elimination.f
    given = np.flatnonzero(state.any(axis=0))
    unused = [model.points.label(int(dof)) for dof in np.setdiff1d(given, rows)]
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
    reduced: AnalysisModel,
    load: TransientLoad,
    results: ResultFile,
    options: Options,
) -> list[Observer]:
    """Writers of everything that the subcases ask for."""
    observers: list[Observer] = []
    for i, case in enumerate(cases):
        name = f"transient/{case.id}"
        for quantity in ("displacement", "velocity", "acceleration"):
            selection = _selection(model, case, quantity.upper())
            if selection != "NONE":
                observers.append(
                    results.point_history(
                        f"{name}/{quantity}",
                        model.points,
                        selection,
                        quantity,
                        reduced.expand,
                        i,
                    )
                )
        if case.outputs.get("SPCFORCES", "NONE") != "NONE":
            observers.append(_spc_forces(model, case, i, reduced, load, results, name))
        for request, kind in (("FORCE", "force"), ("STRESS", "stress")):
            selection = case.outputs.get(request, "NONE")
            for table in element_tables(model.points, model.blocks, kind, selection):
                observers.append(
                    results.table_history(
                        f"{name}/element_{kind}", table, reduced.expand, i
                    )
                )
            if options.envelope:
                observers += [
                    Envelope(table, reduced.expand, f"{name}/envelope/{kind}", i)
                    for table in element_tables(model.points, model.blocks, kind)
                ]
    return observers


def _selection(model: Structure, case: Subcase, quantity: str) -> Selection:
    """What to write of a quantity; all of it where nobody asked and it is small."""
    asked = case.outputs.get(quantity)
    if asked is not None:
        return asked
    steps = time_steps(model.deck, case)
    times = sum(count // stride + 1 for count, _, stride in steps)
    return "ALL" if 8.0 * times * model.points.size < _UNASKED_BYTES else "NONE"


def _spc_forces(
    model: Structure,
    case: Subcase,
    number: int,
    reduced: AnalysisModel,
    load: TransientLoad,
    results: ResultFile,
    name: str,
) -> Observer:
    """Writer of SPC forces (t, k, 6)."""
    layout = PointLayout(model.points, case.outputs["SPCFORCES"])
    layout.describe(results.file, f"{name}/spc_force")
    s = model.elimination.s
    column = np.full(model.points.size, -1)
    column[s] = np.arange(len(s))
    columns = column[layout.grid_dof]
    steps = time_steps(model.deck, case)
    times = _output_count(steps)
    dataset = results.file.create_dataset(
        f"{name}/spc_force", (times, len(layout.grid_id), 6), dtype="f8"
    )

    def sink(first: int, force: Float64) -> None:
        padded = np.hstack([force, np.zeros((len(force), 1))])
        dataset[first : first + len(force)] = layout.grids(padded[:, columns])

    return SpcForceObserver(model, reduced.expand, load, number, sink)


def _output_count(steps: Sequence[tuple[int, float, int]]) -> int:
    return len(output_times(step_groups(steps)))


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

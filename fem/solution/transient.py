"""SOL 109 and 112: direct and modal transients with the results that are asked for.

Subcases that differ by loads and initial conditions only are integrated together.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import groupby

from fem.algebra.linear_solver import SingularMatrixError
from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.files.hdf5 import ResultFile
from fem.loads import (
    nonlinear_load,
)
from fem.model.structure import Structure, system_of
from fem.recovery.envelope import Envelope
from fem.response.direct import NastranScheme, TransientLoad, direct_transient
from fem.response.modal import modal_transient
from fem.response.observation import Observer
from fem.solution.analysis_model import (
    AnalysisModel,
    analysis_model,
    in_modes,
    with_dynamic_input,
)
from fem.solution.enforced_motion import carried_shape
from fem.solution.holding import solve_or_hold
from fem.solution.modal_damping import modal_ratios
from fem.solution.modes import (
    is_modal,
    mode_table,
    modes_of,
    retained_modes,
    with_residual_vectors,
)
from fem.solution.moving_base import moving_base, say_of_motion, with_base
from fem.solution.options import Options
from fem.solution.requests import (
    check_free,
)
from fem.solution.transient_inputs import (
    announced_steps,
    initial_state,
    start_in_modes,
    transient_inputs,
)
from fem.solution.transient_results import transient_observers


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
        if is_modal(model, "MTRAN", 112):
            _modal(model, cases, results, options)
        else:
            _direct(model, cases, results, options)


def _same_system(c: Subcase) -> tuple[object, ...]:
    added = c.k2pp, c.b2pp, c.m2pp, c.tfl
    return system_of(c), added, c.tstep, c.method, c.sdamping, c.analysis


def _direct(
    model: Structure, cases: list[Subcase], results: ResultFile, options: Options
) -> None:
    check_free(model, 109)
    steps = announced_steps(model, cases, options)
    inputs = transient_inputs(model, cases)
    load_g = inputs.load
    say_of_motion(model, inputs.motions, options)

    def inform(text: str) -> None:
        size = results.size_bytes() / 1e6
        options.console.say(f"{text}, result file {size:.0f} MB")
        results.require_room()

    def run(model: Structure) -> tuple[Float64, list[Observer]]:
        results.discard(*(f"transient/{case.id}" for case in cases))
        reduced = analysis_model(model, solver=options.solver)
        reduced = with_dynamic_input(model, reduced, options.console.say)
        base = moving_base(model, inputs.motions, steps)
        load, expand = with_base(base, model, reduced, load_g)
        observers = transient_observers(model, cases, expand, inputs, results, options)
        start = [initial_state(model, reduced, x, options) for x in inputs.states]
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
    steps = announced_steps(model, cases, options)
    reduced, found = modes_of(model, options)
    modes = retained_modes(model.deck, found)
    if modes.count < found.count:
        options.console.say(f"{modes.count} of {found.count} modes are used")
    inputs = transient_inputs(model, cases)
    say_of_motion(model, inputs.motions, options)
    base = moving_base(model, inputs.motions, steps)
    if base is not None:
        shape = carried_shape(base.shape, model, reduced, modes, solver=options.solver)
        base = replace(base, shape=shape)
    load, expand = with_base(base, model, reduced, inputs.load)
    options.console.say(mode_table(modes))
    modes = with_residual_vectors(model, reduced, modes, load.pattern, options)
    ratio = modal_ratios(model.deck, model.subcase, modes.frequency_hz)
    coupled = with_dynamic_input(
        model, in_modes(reduced, modes, ratio), options.console.say
    )
    start = [initial_state(model, reduced, x, options) for x in inputs.states]
    if coupled.direct is not None or any(case.nonlinear for case in cases):
        load, expand = with_base(base, model, coupled, inputs.load)
        observers = transient_observers(model, cases, expand, inputs, results, options)
        seen = observers if base is None else base.seen_by(observers)
        start = [
            start_in_modes(model, reduced, modes, own, x)
            for own, x in zip(start, inputs.states)
        ]
        time = _integrate(model, cases, coupled, steps, load, start, seen, options)
        _finish(cases, time, observers, results)
        return
    observers = transient_observers(model, cases, expand, inputs, results, options)
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

"""What a transient starts from: steps, loads of all subcases, initial states."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.modes import Modes
from fem.algebra.sparse_products import shape_of
from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.errors import InputError
from fem.loads import (
    EnforcedMotion,
    dynamic_excitation,
    dynamic_motions,
    initial_conditions,
    table_notices,
    time_steps,
)
from fem.loads.element_loads import ElementLoads, side_by_side
from fem.model.structure import Structure
from fem.response.direct import TransientLoad
from fem.solution.analysis_model import (
    AnalysisModel,
    moving_extra_points,
)
from fem.solution.options import Options


def announced_steps(
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
class TransientInputs:
    """Loads, motions and initial state of a transient.

    Attributes:
        load: of all cases on the g-set.
        motions: what moves in each case.
        element_loads: what of the load acts on elements between grids.
        states: initial displacements and velocities, each (c, g).
    """

    load: TransientLoad
    motions: list[list[EnforcedMotion]]
    element_loads: ElementLoads | None
    states: tuple[Float64, Float64]


def transient_inputs(model: Structure, cases: list[Subcase]) -> TransientInputs:
    """Loads, motions and initial states of subcases.

    Raises:
        InputError: one of them has neither DLOAD nor IC; sets that are not there.
    """
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
    return TransientInputs(
        load=TransientLoad(sp.csr_matrix(sp.hstack(patterns)), evaluate),
        motions=[dynamic_motions(model.deck, model.points, case) for case in cases],
        element_loads=side_by_side(list(zip(on_elements, counts)))
        if any(loads is not None for loads in on_elements)
        else None,
        states=(np.array([u for u, _ in states]), np.array([v for _, v in states])),
    )


def initial_state(
    model: Structure, reduced: AnalysisModel, state: Float64, options: Options
) -> Float64 | None:
    """Initial state (c, n) from that of the g-set (c, g).

    As in Nastran, values of freedoms that do not move by themselves are not used.
    """
    if not state.any():
        return None
    rows = reduced.rows
    given = np.flatnonzero(state.any(axis=0))
    known = np.union1d(rows, moving_extra_points(model))
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


def start_in_modes(
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
    return np.hstack([given[:, moving_extra_points(model)], own])

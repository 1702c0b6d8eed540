"""The story of a run: model, solutions of the subcases, result file."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from time import perf_counter

import numpy as np

from fem.arrays import Float64
from fem.deck.control.case_control import read_case_control
from fem.deck.control.executive import read_executive
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck
from fem.deck.superelements.subcases import split_subcases
from fem.deck.text.sections import Sections, split_sections
from fem.deck.text.source import read_source
from fem.errors import InputError, by_kind
from fem.files.hdf5 import ResultFile
from fem.model.structure import Structure
from fem.solution.buckling import solve_buckling
from fem.solution.components import component_notices
from fem.solution.external import NOTICE, with_boundary_held
from fem.solution.frequency import solve_frequencies
from fem.solution.modes import solve_modes
from fem.solution.options import WRITTEN, Options
from fem.solution.override import asked_by, ways_on
from fem.solution.requests import check_requests
from fem.solution.static import solve_statics
from fem.solution.transient import solve_transients

_Solver = Callable[[Structure, list[Subcase], ResultFile, Options], None]

_SOLVERS: dict[int, _Solver] = {
    101: solve_statics,
    103: solve_modes,
    105: solve_buckling,
    108: solve_frequencies,
    109: solve_transients,
    111: solve_frequencies,
    112: solve_transients,
}
_TRANSIENT = frozenset({109, 112})
# Solutions of superelements as one model.
_WITHOUT_REDUCTION = frozenset({101, 105})
# Without what dynamic solutions add to the matrices.
_WITHOUT_MOTION = frozenset({101, 103, 105})
# What follows from the results of other subcases, and is not computed here.
_NOT_RUN = frozenset({"RANDOM"})


def run_deck(deck: Deck, path: Path, options: Options | None = None) -> Path:
    """Solve the subcases of a deck and write the result file.

    Args:
        deck: from `fem.read_deck`.
        path: of the HDF5 file.
        options: solver and console.

    Returns:
        The path.

    Raises:
        InputError: the deck asks for what is not there or cannot be solved; the
            message names cards, grids or subcases.
    """
    # What overflows is found where it is used, and named.
    with np.errstate(over="ignore", invalid="ignore"):
        return _run(deck, path, options or Options())


def _run(deck: Deck, path: Path, options: Options) -> Path:
    start = perf_counter()
    work = _by_solution(deck)
    _refuse_what_is_not_carried_out(deck, work)
    check_requests(deck, work)
    if any(case.extseout for case in deck.case_control):
        options.console.say(f"notice: {NOTICE}")
        deck = with_boundary_held(deck)
        work = _by_solution(deck)
    structure = Structure(deck, work[0][1][0])
    with ResultFile(path) as results:
        _introduce(structure, options)
        _say_what_is_not_run(deck, options)
        if {number for number, _ in work} - _WITHOUT_REDUCTION:
            for text in component_notices(structure):
                options.console.say(f"notice: {text}")
        results.write_model(structure)
        if options.envelope and not _TRANSIENT.intersection(n for n, _ in work):
            options.console.say(
                "notice: --envelope has no effect: no subcase is a transient (SOL 109, "
                "112); there are no extremes over time"
            )
        for number, subcases in work:
            _say_what_is_left_out(number, subcases, options)
            _SOLVERS[number](structure, subcases, results, options)
    options.console.say(f"{path} ({perf_counter() - start:.1f} s)")
    return path


def declared_solution(path: Path) -> int:
    """Number of the SOL statement of a deck, 0 where it has none that is known.

    Raises:
        InputError: the deck cannot be read that far.
    """
    sections = split_sections(read_source(path).lines, str(path))
    return read_executive(sections.executive).sol


def solution_problems(path: Path) -> list[str]:
    """Problem that no solution here is what a deck asks for, from its first sections.

    For decks with other problems, which do not matter then. Empty: there is one, or
    the deck cannot be read that far.
    """
    try:
        sections = split_sections(read_source(path).lines, str(path))
    except InputError:
        return []
    number = read_executive(sections.executive).sol
    cases = read_case_control(sections.case_control, refuse=False).subcases
    asked = {asked_by(case, number) for case in cases}
    if number and not asked & _SOLVERS.keys():
        return [_unsupported(path, number, cases)]
    return _heat(sections)


def _heat(sections: Sections) -> list[str]:
    """That a deck asks for temperatures: APP HEAT, PARAM,HEATSTAT,YES."""
    for lines, name, pattern in (
        (sections.executive, "APP HEAT", r"\s*APP\w*[\s,]+HEAT\b"),
        (sections.bulk, "PARAM,HEATSTAT", r"\s*PARAM[\s,*]+HEATSTAT[\s,]*Y"),
        (sections.case_control, "PARAM,HEATSTAT", r"\s*PARAM[\s,]+HEATSTAT[\s,]*Y"),
    ):
        for line in lines:
            if re.match(pattern, line.text, re.IGNORECASE):
                return [
                    f"{line.file}:{line.number}: {name}: heat transfer is not solved; "
                    "expected statics under given temperatures, TEMPERATURE(LOAD) "
                    "with TEMP or TEMPD"
                ]
    return []


def _unsupported(path: Path, number: int, cases: Sequence[Subcase]) -> str:
    return (
        f"{path}: SOL {number} is not supported; expected "
        f"{', '.join(map(str, _SOLVERS))}. What can be done: {ways_on(cases)}"
    )


def _by_solution(deck: Deck) -> list[tuple[int, list[Subcase]]]:
    """Subcases by the solution that they ask for, in order.

    Raises:
        InputError: a solution that is not supported, no subcases.
    """
    if not deck.sol:
        raise InputError(
            f"{deck.path}: no SOL statement; expected SOL "
            f"{', '.join(map(str, _SOLVERS))}, or --sol with one of them"
        )
    work: dict[int, list[Subcase]] = {}
    for subcase in split_subcases(deck.case_control)[0]:
        if subcase.analysis.upper() in _NOT_RUN:
            continue  # said by `_say_what_is_not_run`
        work.setdefault(asked_by(subcase, deck.sol), []).append(subcase)
    others = [number for number in work if number not in _SOLVERS]
    if others and len(others) == len(work):
        raise InputError(_unsupported(deck.path, others[0], deck.case_control))
    if not work:
        raise InputError(f"{deck.path}: no subcases")
    return [(number, cases) for number, cases in work.items() if number in _SOLVERS]


def _refuse_what_is_not_carried_out(
    deck: Deck, work: Sequence[tuple[int, Sequence[Subcase]]]
) -> None:
    """Refuse commands of case control that would change what is found.

    Raises:
        InputError: all of them.
    """
    problems = [text for case in deck.case_control for text in case.not_carried_out]
    problems += [
        f"{deck.path}: subcase {case.id}: SUBCOM, SYMCOM and REPCASE combine static "
        f"subcases, not those of SOL {number}"
        for number, cases in work
        for case in cases
        if case.combination and number != 101
    ]
    problems += [
        f"{deck.path}: subcase {case.id}: STATSUB is not supported in SOL {number}: "
        "there is no stiffness from a preload; --ignore CASE goes on without it"
        for number, cases in work
        for case in cases
        if (case.statsub or case.preload) and number != 105
    ]
    problems += [
        f"{deck.path}: subcase {case.id}: P2G is not supported in SOL {number}: loads "
        "that move are given by load cards; --ignore CASE goes on without it"
        for number, cases in work
        for case in cases
        if case.p2g and number not in _WITHOUT_REDUCTION | {103}
    ]
    if problems:
        raise InputError(problems)


def _say_what_is_not_run(deck: Deck, options: Options) -> None:
    others = split_subcases(deck.case_control)[1]
    if others:
        ids = ", ".join(str(case.id) for case in others)
        options.console.say(
            f"notice: subcases {ids} are for superelements: their METHOD and sets are "
            "used, their results come with the subcases of the residual structure"
        )
    for subcase in split_subcases(deck.case_control)[0]:
        number = asked_by(subcase, deck.sol)
        if number not in _SOLVERS and subcase.analysis.upper() not in _NOT_RUN:
            asked = f"ANALYSIS = {subcase.analysis}" if subcase.analysis else "it"
            options.console.say(
                f"warning: subcase {subcase.id} is not run: {asked} asks for what "
                f"SOL {number} does, which is not supported; the others are solved"
            )
    for subcase in deck.case_control:
        if subcase.analysis.upper() in _NOT_RUN:
            options.console.say(
                f"notice: subcase {subcase.id}, ANALYSIS = {subcase.analysis}, is not "
                "run: the other subcases do not depend on it"
            )


def _say_what_is_left_out(
    number: int, subcases: list[Subcase], options: Options
) -> None:
    asked = {
        quantity
        for subcase in subcases
        for quantity, selection in subcase.outputs.items()
        if selection != "NONE"
    }
    _say_what_does_not_act(number, subcases, options)
    # Modes have no loads: nothing is missed.
    missing = sorted(asked - WRITTEN[number] - {"OLOAD"})
    if missing:
        options.console.say(
            f"notice: output not written in SOL {number}: {', '.join(missing)}"
        )


def _say_what_does_not_act(
    number: int, subcases: list[Subcase], options: Options
) -> None:
    """Direct input of dynamic solutions, and nonlinear loads, in other solutions."""
    dynamic = ("k2pp", "b2pp", "m2pp", "tfl") if number in _WITHOUT_MOTION else ()
    following = () if number in _TRANSIENT else ("nonlinear",)
    given = [
        name.upper()
        for name in (*dynamic, *following)
        if any(getattr(case, name) for case in subcases)
    ]
    if given:
        options.console.say(
            f"notice: {', '.join(given)}: without effect in SOL {number}, as in Nastran"
        )


def _introduce(structure: Structure, options: Options) -> None:
    """Say what the model is."""
    console, points, weight = options.console, structure.points, structure.weight
    counts: dict[str, int] = {}
    for block in structure.blocks:
        counts[block.card] = counts.get(block.card, 0) + len(block.id)
    elements = ", ".join(f"{n} {card}" for card, n in sorted(counts.items()))
    console.say(
        f"{structure.deck.path.name}: {len(points.grid_id)} grids, {elements}; "
        f"{structure.size} free of {points.size} freedoms"
    )
    # Rounding of sums that cancel is no information, nor is the sign of a zero.
    x, y, z = _without_rounding(weight.center, np.abs(points.xyz).max(initial=0.0))
    i = _without_rounding(weight.inertia, np.abs(weight.inertia).max(initial=0.0))
    console.say(
        f"mass {weight.total:.7g}, center of gravity {x:.7g} {y:.7g} {z:.7g}, inertia "
        f"{i[0, 0]:.6g} {i[1, 1]:.6g} {i[2, 2]:.6g}, products {i[0, 1]:.5g} "
        f"{i[0, 2]:.5g} {i[1, 2]:.5g}"
    )
    cards = structure.deck.cards
    if count := sum(len(cards[name]) for name in ("MONPNT1", "MONPNT3")):
        console.say(
            f"notice: {count} monitor points are not evaluated here; landings, static "
            "conditions and campaigns do (drake-landing)"
        )
    for notice in by_kind(structure.notices):
        console.say(f"notice: {notice}")
    if options.quality and not structure.quality.empty:
        console.say(structure.quality.to_string(index=False, float_format="%.4g"))


def _without_rounding(values: Float64, scale: float) -> Float64:
    """Values without those that are rounding beside a scale."""
    return np.where(np.abs(values) > 1e-12 * scale, values, 0.0)

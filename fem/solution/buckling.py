"""SOL 105: static subcases, and the factors of their loads at which they buckle.

A subcase with METHOD buckles under the load of its STATSUB, by default of the first
static subcase, or of its own. With STATSUB(PRELOAD) that load stays as it is:
(K + K_d0 + λ K_d) x = 0.
"""

from collections.abc import Mapping, Sequence
from contextlib import ExitStack

import numpy as np
import scipy.sparse as sp

from fem.algebra.buckling import Buckling, BucklingSolver
from fem.algebra.linear_solver import SingularMatrixError
from fem.arrays import Float64, Int64
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck
from fem.deck.records import topologies
from fem.errors import InputError
from fem.files.hdf5 import ResultFile
from fem.model.differential import (
    COARSE,
    differential_stiffness,
    differential_work,
    half_of_the_work,
    unstiffened,
)
from fem.model.structure import Structure
from fem.recovery.grid_forces import strain_energy
from fem.solution.element_results import write_element_results
from fem.solution.options import Options
from fem.solution.requests import ids_of, wanted
from fem.solution.static import (
    StaticSolution,
    solve_statics,
    static_solutions,
)

_PRINTED = 40
_NEAREST = 4
_PRESSURES = ("PLOAD", "PLOAD2", "PLOAD4")


def solve_buckling(
    structure: Structure,
    subcases: list[Subcase],
    results: ResultFile,
    options: Options,
) -> None:
    """Static subcases as in SOL 101, then factors and shapes, `/buckling/<id>`.

    Raises:
        InputError: nothing that buckles or no load, a structure that moves freely.
    """
    buckled = [case for case in subcases if _buckles(case)]
    statics = [case for case in subcases if not _buckles(case)]
    if statics:
        solve_statics(structure, statics, results, options)
    loads = _loads_of(structure, buckled, options)
    for notice in _notices(structure):
        options.console.say(f"notice: {notice}")
    with _Solvers(options) as solvers:
        for case in buckled:
            _solve(structure.with_subcase(case), loads, results, options, solvers)


class _Solvers:
    """One solver for subcases that follow each other on the same stiffness."""

    def __init__(self, options: Options) -> None:
        self._options, self._open = options, ExitStack()
        self._last: tuple[sp.csr_matrix, BucklingSolver] | None = None

    def __enter__(self) -> "_Solvers":
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def of(self, stiffness: sp.csr_matrix) -> BucklingSolver:
        """The solver of a matrix, that of the subcase before where it is the same."""
        if self._last is None or self._last[0] is not stiffness:
            self._open.close()
            own = BucklingSolver(stiffness, solver=self._options.solver)
            self._last = stiffness, self._open.enter_context(own)
        return self._last[1]


def _buckles(case: Subcase) -> bool:
    """METHOD, unless ANALYSIS says statics (METHOD may stand above all subcases)."""
    return bool(case.method) and not case.analysis.upper().startswith("STATIC")


def _preloads(deck: Deck, case: Subcase) -> list[Subcase]:
    """Static subcases that a buckling subcase builds upon: what buckles comes first.

    Raises:
        InputError: there is none, or it is not static.
    """
    cases = {other.id: other for other in deck.case_control}
    statics = [c for c in deck.case_control if not _buckles(c)]
    chosen = case.statsub or (statics[0].id if statics else case.id)
    found = []
    for number in (chosen, case.preload):
        other = cases.get(number)
        if number and (other is None or (_buckles(other) and other is not case)):
            raise InputError(
                f"{deck.path}: subcase {case.id}: STATSUB = {number}, expected one of "
                f"the static subcases {[c.id for c in statics]}"
            )
        if other is not None:
            found.append(other)
    return found


def _loads_of(
    structure: Structure, buckled: Sequence[Subcase], options: Options
) -> dict[int, StaticSolution]:
    """Answers to all loads that buckling subcases build upon."""
    needed = {
        other.id: other for case in buckled for other in _preloads(structure.deck, case)
    }
    return static_solutions(structure, list(needed.values()), options)


def _notices(structure: Structure) -> list[str]:
    """What the differential stiffness leaves out."""
    found = []
    without = unstiffened(structure.blocks)
    if without:
        found.append(f"no differential stiffness of {', '.join(without)}")
    pressures = [c for c in _PRESSURES if not structure.deck.cards[c].empty]
    if pressures:
        found.append(
            f"buckling: loads keep their directions, also those of "
            f"{', '.join(pressures)} (no follower stiffness)"
        )
    return found


def _solve(
    model: Structure,
    loads: Mapping[int, StaticSolution],
    results: ResultFile,
    options: Options,
    solvers: _Solvers,
) -> None:
    case = model.subcase
    chosen = _preloads(model.deck, case)
    count, band = request(model.deck, case)

    def reduced(other: Subcase) -> sp.csr_matrix:
        state = loads[other.id]
        matrix = differential_stiffness(
            model.points,
            model.blocks,
            state.u_g,
            free=state.free,
            loads=state.element_loads,
        )
        return model.elimination.reduce(matrix)

    differential = reduced(chosen[0])
    stiffness = model.stiffness
    if len(chosen) > 1:
        stiffness = sp.csr_matrix(stiffness + reduced(chosen[1]))

    def solve() -> Buckling:
        return solvers.of(stiffness).factors(
            differential,
            count=count,
            band=band,
            progress=options.console.progress("buckling"),
        )

    found = model.guarded(solve, dynamic=False, error=SingularMatrixError)
    if not len(found.factor):
        text = f"notice: subcase {case.id}: no factor in the range that METHOD asks for"
        count, band = count or _NEAREST, (None, None)
        found = model.guarded(solve, dynamic=False, error=SingularMatrixError)
        options.console.say(f"{text}; the {len(found.factor)} nearest to zero follow")
    _write(model, found, results)
    count_of = _working_shells(model, found, loads[chosen[0].id].u_g)
    results.write(f"buckling/{case.id}/shells_with_half_of_the_work", count_of)
    options.console.say(factor_table(found, case.id, chosen[0].id))
    for notice in _coarse(count_of, case.id):
        options.console.say(f"notice: {notice}")


def _working_shells(model: Structure, found: Buckling, u_g: Float64) -> Int64:
    """(m,) shells that do half of the work of each mode; 0: others do most of it."""
    shapes = model.elimination.T @ found.shape
    ids, work = differential_work(model.points, model.blocks, u_g, shapes)
    work = np.maximum(np.sign(found.factor)[:, None] * work, 0.0)
    shells = topologies("surface")
    own = [block.id for block in model.blocks if block.card in shells]
    of_shells = np.isin(ids, np.concatenate([np.zeros(0, np.int64), *own]))
    most = work[:, of_shells].sum(axis=1) > 0.5 * work.sum(axis=1)
    return np.where(most, half_of_the_work(work[:, of_shells]), 0)


def _coarse(count: Int64, case: int) -> list[str]:
    """Which modes the mesh is too coarse for."""
    few = np.flatnonzero((count > 0) & (count < COARSE)) + 1
    if not len(few):
        return []
    more = f" and {len(few) - 10} more" if len(few) > 10 else ""
    named = ", ".join(map(str, few[:10].tolist())) + more
    return [
        f"subcase {case}, mode {named}: fewer than {COARSE} shells do half of the "
        "work: the mesh shows no half wave, and the factor is a hint only (a panel of "
        "4 by 4 CQUAD4 is 63 % high under shear, 4 % under compression)"
    ]


def request(
    deck: Deck, case: Subcase
) -> tuple[int | None, tuple[float | None, float | None]]:
    """How many factors between which limits the METHOD of a subcase asks for.

    EIGB gives the numbers of positive and negative roots apart; both together are the
    count. Where a card says nothing, the lowest one.
    """
    own = deck.cards["EIGB"]
    own = own[own["sid"] == case.method]
    if not own.empty:
        row = own.iloc[0]
        low, high = _limits(row["l1"], row["l2"])
        estimated = int(row["nep"])
        positive = int(row["ndp"]) or 3 * estimated
        negative = int(row["ndn"]) or 3 * estimated
        count = (0 if high is not None and high <= 0 else positive) + (
            0 if low is not None and low >= 0 else negative
        )
        return (count or None) if high is not None else (count or 1), (low, high)
    rows = deck.cards["EIGRL"]
    rows = rows[rows["sid"] == case.method]
    if rows.empty:
        known = sorted({*deck.cards["EIGRL"]["sid"], *deck.cards["EIGB"]["sid"]})
        raise InputError(
            f"{deck.path}: subcase {case.id}: METHOD = {case.method}, expected an "
            f"EIGRL or EIGB card: {known or 'none in the deck'}"
        )
    row = rows.iloc[0]
    low, high = _limits(row["v1"], row["v2"])
    if low is not None and high is not None and not low < high:
        raise InputError(
            f"{row['file']}:{row['line']}: EIGRL {row['sid']}: V1 {low:g} and V2 "
            f"{high:g} must ascend"
        )
    count = int(row["nd"]) or None
    if count is None and (low is None or high is None):
        count = None if high is not None and low is not None else 1
    return count, (low, high)


def _limits(low: float, high: float) -> tuple[float | None, float | None]:
    return (
        None if np.isnan(low) else float(low),
        None if np.isnan(high) else float(high),
    )


def _write(model: Structure, found: Buckling, results: ResultFile) -> None:
    case, name = model.subcase, f"buckling/{model.subcase.id}"
    shapes = largest_one(model.elimination.T @ found.shape)
    results.write(f"{name}/factor", found.factor)
    results.write(
        f"{name}/count",
        np.array([[c.limit, c.counted, c.found] for c in found.counts]).reshape(-1, 3),
    )
    asked = case.outputs
    results.write_points(
        f"{name}/shape", model.points, shapes.T, asked.get("DISPLACEMENT", "ALL")
    )
    if wanted(case, "ESE") != "NONE":
        energies = strain_energy(model.points, model.blocks, shapes)
        ids = ids_of(wanted(case, "ESE"))
        results.write_energies(f"{name}/strain_energy", energies, ids)
    if {wanted(case, "SPCFORCES"), wanted(case, "MPCFORCES")} != {"NONE"}:
        residual = model.matrices.stiffness @ shapes
        for quantity, label, force in (
            ("SPCFORCES", "spc_force", model.elimination.spc_force),
            ("MPCFORCES", "mpc_force", model.elimination.mpc_force),
        ):
            if wanted(case, quantity) != "NONE":
                results.write_points(
                    f"{name}/{label}",
                    model.points,
                    force(residual).T,
                    wanted(case, quantity),
                )
    write_element_results(model, case, shapes, results, name)


def largest_one(shapes: Float64) -> Float64:
    """Shapes (g, m) whose largest entry is one."""
    largest = np.abs(shapes).max(axis=0, initial=0.0)
    return shapes / np.where(largest > 0.0, largest, 1.0)


def factor_table(found: Buckling, case: int, load: int) -> str:
    """Factors in lines of text, with the counts that were made."""
    lines = [f"buckling, subcase {case}: factors of the load of subcase {load}"]
    if not len(found.factor):
        lines.append("  none in the range asked for")
    for k, value in enumerate(found.factor[:_PRINTED], start=1):
        lines.append(f"  mode {k:4d}  {value:14.7g}")
    if len(found.factor) > _PRINTED:
        lines.append(f"  ... up to {found.factor[-1]:.7g}")
    for sign, word in ((1.0, "load"), (-1.0, "reversed load")):
        own = sign * found.factor[sign * found.factor > 0.0]
        if len(own):
            lines.append(f"smallest factor of the {word}: {own.min():.7g}")
    lines += [str(count) for count in found.counts]
    return "\n".join(lines)

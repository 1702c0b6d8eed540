"""SOL 101: subcases with the same supports are solved as one block."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np
import scipy.sparse as sp
from scipy.linalg import qr

from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.statics import inertia_relief, solve_static
from fem.arrays import Float64
from fem.constraints.elimination import Elimination
from fem.deck.control.subcase import Subcase
from fem.errors import InputError
from fem.files.hdf5 import ResultFile
from fem.loads import enforced_displacements, static_element_loads, static_load
from fem.loads.element_loads import ElementLoads, below_each_other
from fem.loads.thermal import FreeMotions, free_motions, summed
from fem.model.direct_input import direct_load
from fem.model.mechanisms import describe
from fem.model.structure import Structure, system_of
from fem.recovery.grid_forces import strain_energy
from fem.solution.element_results import write_element_results, write_grid_forces
from fem.solution.equilibrium import UNBALANCED, unbalanced, write_resultants
from fem.solution.options import Options
from fem.solution.requests import ids_of


@dataclass(frozen=True)
class StaticSolution:
    """Answer of a subcase, (g,) each, and loads between grids.

    Attributes:
        u_g: displacements.
        residual: forces of constraint.
        load: applied.
        element_loads: of it, what acts on elements; None: nothing.
        free: what elements would do under temperatures and deformations.
    """

    u_g: Float64
    residual: Float64
    load: Float64
    element_loads: ElementLoads | None
    free: FreeMotions | None


def solve_statics(
    structure: Structure,
    subcases: list[Subcase],
    results: ResultFile,
    options: Options,
) -> None:
    """Displacements, constraint forces and element results of static subcases.

    Raises:
        InputError: no load, or a structure that moves freely; its grids are named.
    """
    solved = static_solutions(structure, subcases, options)
    for subcase in subcases:
        # A combination has the supports of its own: they sort the forces only.
        model = structure.with_subcase(subcase)
        found = (
            _combined(model, subcase, solved)
            if subcase.combination
            else solved[subcase.id]
        )
        _write(model, subcase, found, results)
        options.console.say(_summary(model, subcase, found.u_g, found.residual))
        left = unbalanced(model, found.load, found.residual)
        if left > UNBALANCED:
            options.console.say(
                f"warning: subcase {subcase.id}: loads and reactions balance to "
                f"{left:.1e} of the largest force alone: stiffness next to each other "
                "differs by more digits than numbers have; forces and stresses of the "
                "stiffest elements are that uncertain, or more"
            )


def static_solutions(
    structure: Structure, subcases: Sequence[Subcase], options: Options
) -> dict[int, StaticSolution]:
    """Answers of static subcases by their ids; combinations are left out.

    Raises:
        InputError: as `solve_statics`.
    """
    solved: dict[int, StaticSolution] = {}
    relief = bool(int(structure.deck.param("INREL")))
    single = (c for c in subcases if not c.combination)
    for group in _with_same_support(single, relief=relief):
        model = structure.with_subcase(group[0])
        free = [free_motions(model.deck, model.points, model.blocks, c) for c in group]
        load, eliminations = _loads(model, group, free, options)
        u_g, residual = _solve(model, load, eliminations, options)
        for i, subcase in enumerate(group):
            loads = static_element_loads(model.deck, model.points, subcase.load)
            vectors = u_g[:, i], residual[:, i], load[:, i]
            solved[subcase.id] = StaticSolution(*vectors, loads, free[i])
    return solved


def _combined(
    model: Structure, subcase: Subcase, solved: Mapping[int, StaticSolution]
) -> StaticSolution:
    """Sum of solutions with factors (SUBCOM, SYMCOM, REPCASE).

    Raises:
        InputError: a member was not solved as a static subcase.
    """
    absent = [i for i, _ in subcase.combination if i not in solved]
    if absent:
        raise InputError(
            f"{model.deck.path}: subcase {subcase.id} combines subcase {absent[0]}, "
            "which is not static"
        )
    parts = [(factor, solved[i]) for i, factor in subcase.combination]
    loads = [
        part.element_loads.times(factor)
        for factor, part in parts
        if part.element_loads is not None
    ]
    sums = (
        np.sum([factor * getattr(part, name) for factor, part in parts], axis=0)
        for name in ("u_g", "residual", "load")
    )
    free = summed([(factor, part.free) for factor, part in parts])
    return StaticSolution(*sums, below_each_other(loads) if loads else None, free)


def _summary(
    model: Structure, subcase: Subcase, u_g: Float64, residual: Float64
) -> str:
    """Largest translation with its place, sum of the forces of constraint."""
    grids = 6 * len(model.points.grid_id)
    moved = u_g[:grids].reshape(-1, 6)[:, :3].ravel()
    text = f"statics, subcase {subcase.id}: "
    if len(moved):
        at = int(np.argmax(np.abs(moved)))
        place = model.points.label(6 * (at // 3) + at % 3)
        text += f"largest displacement {moved[at]:.7g} at {place}, "
    force = model.elimination.spc_force(residual)
    basic = (model.points.basic_rotation() @ force)[:grids].reshape(-1, 6)
    # What is left of forces that cancel is rounding.
    total, size = basic[:, :3].sum(axis=0), np.abs(basic[:, :3]).sum(axis=0).max()
    x, y, z = np.where(np.abs(total) > 1e-9 * size, total, 0.0)
    return text + f"sum of SPC forces {x:.7g} {y:.7g} {z:.7g}"


def _with_same_support(
    subcases: Iterable[Subcase], *, relief: bool
) -> Iterator[list[Subcase]]:
    """Subcases that one factor of K serves; masses differ where nothing is relieved."""

    def system(case: Subcase) -> tuple:
        return system_of(case if relief else replace(case, massset=0))

    for _, group in groupby(subcases, key=system):
        yield list(group)


def _loads(
    model: Structure,
    group: list[Subcase],
    free: list[FreeMotions | None],
    options: Options,
) -> tuple[Float64, list[Elimination]]:
    """(g, c) loads, and the constraints with the enforced motion of each subcase.

    SPCD of freedoms that nothing constrains moves nothing, as in MSC Nastran (pyNastran
    models, buckling2_solid_shell_bar); that is said.
    """
    loads, eliminations = [], []
    for subcase, motions in zip(group, free):
        dof, value = enforced_displacements(model.deck, model.points, subcase.load)
        elimination = model.elimination
        held = np.isin(dof, elimination.s)
        if not held.all():
            loose = [model.points.label(int(d)) for d in dof[~held][:5]]
            options.console.say(
                f"warning: subcase {subcase.id}: SPCD of {', '.join(loose)} moves "
                "nothing: no SPC constrains that freedom"
            )
        if held.any():
            elimination = elimination.with_enforced(dof[held], value[held])
        if not (subcase.load or subcase.p2g or motions or elimination.enforced.any()):
            options.console.say(
                f"warning: subcase {subcase.id} selects no LOAD and enforces no "
                "displacement, temperatures move nothing: all its results are zero"
            )
        mass = model.with_subcase(subcase).loaded_mass if subcase.load else None
        load = (
            static_load(model.deck, model.points, subcase.load, mass)
            if subcase.load
            else np.zeros(model.points.size)
        )
        if subcase.p2g:
            ids = [case.id for case in model.deck.case_control]
            number = ids.index(subcase.id) + 1
            load += direct_load(model.deck, model.points, subcase.p2g, number)
        loads.append(load if motions is None else load + motions.load(model.points))
        eliminations.append(elimination)
    return np.stack(loads, axis=1), eliminations


def _solve(
    model: Structure,
    load: Float64,
    eliminations: list[Elimination],
    options: Options,
) -> tuple[Float64, Float64]:
    """(g, c) displacements and forces of constraint."""
    k_gg, T = model.matrices.stiffness, model.elimination.T
    u_0 = np.stack([elimination.u_0 for elimination in eliminations], axis=1)
    p_f = np.asfortranarray(T.T @ (load - k_gg @ u_0))
    relief = int(model.deck.param("INREL"))
    inertia = np.zeros_like(load)

    def solve() -> Float64:
        if relief >= 0:
            return _without_mechanisms(model, p_f, options)
        support = model.free_rows(model.support_dof, "SUPORT") if relief == -1 else None
        if support is not None and not len(support):
            raise InputError(
                f"{model.deck.path}: PARAM,INREL,-1 needs SUPORT; expected the "
                "freedoms that hold the structure determinately, or PARAM,INREL,-2"
            )
        try:
            result = inertia_relief(
                model.stiffness,
                model.mass,
                p_f,
                support=support,
                rigid_body=model.rigid_body,
                solver=options.solver,
            )
        except ValueError as error:
            raise InputError(f"{model.deck.path}: inertia relief: {error}") from None
        inertia[:] = _inertia_forces(model, result.motions @ result.acceleration)
        return result.displacement

    u_f = model.guarded(solve, dynamic=False, error=SingularMatrixError)
    u_g = T @ u_f + u_0
    return u_g, k_gg @ u_g - load - inertia


def _without_mechanisms(model: Structure, p_f: Float64, options: Options) -> Float64:
    """(f, c) displacements under loads (f, c).

    With PARAM,BAILOUT,-1 motions without stiffness are held where no load acts along
    them: forces and stresses do not depend on them. Displacements are those without
    such motions; where loads act along them, there is no answer.

    Raises:
        SingularMatrixError: the structure moves freely under its loads.
    """

    def solve(stiffness: sp.csr_matrix, load: Float64) -> Float64:
        return solve_static(
            stiffness, load, solver=options.solver, threads=options.threads
        )

    try:
        return solve(model.stiffness, p_f)
    except SingularMatrixError:
        if model.deck.number("BAILOUT") >= 0:
            raise
        found = model.mechanisms(solver=options.solver)
        motions = np.concatenate(
            [m.motions for m in found] or [np.zeros((len(p_f), 0))], axis=1
        )
        shares = np.abs(motions)
        rounding = shares < _ROUNDING * shares.max(axis=0, initial=0.0)
        moved = np.where(rounding, 0.0, motions)
        work, size = np.abs(moved.T @ p_f), np.abs(moved).T @ np.abs(p_f)
        if not found or (work > _UNLOADED * size).any():
            raise
    held = np.asarray(qr(motions.T, mode="r", pivoting=True)[-1])[: motions.shape[1]]
    keep = np.setdiff1d(np.arange(len(p_f)), held)
    u_f = np.zeros_like(p_f)
    u_f[keep] = solve(sp.csr_matrix(model.stiffness[keep][:, keep]), p_f[keep])
    for line in describe(found, model.label):
        options.console.say(
            f"warning: {line}; no load acts along it, and PARAM,BAILOUT,-1 goes on: "
            "displacements are those without it"
        )
    return u_f - motions @ np.linalg.lstsq(motions, u_f, rcond=None)[0]


# Work of loads along a motion, relative to that of their sizes, that is rounding.
_UNLOADED = 1e-8
# Share of a motion's largest freedom that is none of the motion.
_ROUNDING = 1e-10


def _inertia_forces(model: Structure, acceleration_f: Float64) -> Float64:
    """(g, c) inertia forces of accelerations (f, c)."""
    return -(model.matrices.mass @ (model.elimination.T @ acceleration_f))


def _write(
    model: Structure, subcase: Subcase, found: StaticSolution, results: ResultFile
) -> None:
    name, points, asked = f"static/{subcase.id}", model.points, subcase.outputs
    u_g, residual, load = found.u_g, found.residual, found.load
    spc_force = model.elimination.spc_force(residual)
    mpc_force = model.elimination.mpc_force(residual)
    results.write_points(
        f"{name}/displacement", points, u_g, asked.get("DISPLACEMENT", "ALL")
    )
    results.write_points(
        f"{name}/spc_force", points, spc_force, asked.get("SPCFORCES", "ALL")
    )
    write_resultants(model, u_g, load, residual, results, name)
    for quantity, label, vector in (
        ("MPCFORCES", "mpc_force", mpc_force),
        ("OLOAD", "applied_load", load),
    ):
        if asked.get(quantity, "NONE") != "NONE":
            results.write_points(f"{name}/{label}", points, vector, asked[quantity])
    if asked.get("GPFORCE", "NONE") != "NONE":
        forces = (load[:, None], spc_force[:, None], mpc_force[:, None])
        write_grid_forces(model, subcase, u_g[:, None], forces, results, name)
    if asked.get("ESE", "NONE") != "NONE":
        energies = strain_energy(points, model.blocks, u_g, found.free)
        results.write_energies(f"{name}/strain_energy", energies, ids_of(asked["ESE"]))
    write_element_results(
        model, subcase, u_g, results, name, found.element_loads, found.free
    )

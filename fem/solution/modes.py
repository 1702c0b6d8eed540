"""SOL 103: normal modes as EIGRL asks for them."""

from dataclasses import replace

import numpy as np
import pandas as pd
import scipy.sparse as sp

from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.modes import Modes, ModesError, normal_modes
from fem.algebra.participation import participation
from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck
from fem.errors import InputError
from fem.files.hdf5 import ResultFile
from fem.model.structure import Structure
from fem.model.weight import rigid_modes
from fem.recovery.grid_forces import strain_energy
from fem.response.modal import residual_vectors
from fem.solution.analysis_model import AnalysisModel, analysis_model
from fem.solution.eigrl import request
from fem.solution.element_results import write_element_results, write_grid_forces
from fem.solution.holding import solve_or_hold
from fem.solution.options import Options
from fem.solution.requests import check_free, ids_of
from fem.solution.requests import wanted as asked

_PRINTED = 60
# Words of RESVEC that are followed; names from memory of the guide. Those without a
# vector here (DAMPLOD, RVDOF, DYNRSP) are off in any case.
_RESVEC = frozenset("INRLOD NOINRL APPLOD NOAPPL NORVDOF NODAMP NODYNRSP".split())


def solve_modes(
    structure: Structure,
    subcases: list[Subcase],
    results: ResultFile,
    options: Options,
) -> None:
    """Frequencies and shapes; the first subcase's as `/modes`, others `/modes_<id>`.

    Raises:
        InputError: no METHOD, or a massless mechanism; its grids are named.
    """
    for i, subcase in enumerate(subcases):
        model = structure.with_subcase(subcase)
        reduced, modes = modes_of(model, options)
        name = "modes" if i == 0 else f"modes_{subcase.id}"
        _write(model, reduced, modes, results, name)
        options.console.say(mode_table(modes))


def is_modal(model: Structure, analysis: str, sol: int) -> bool:
    """Whether the subcase is solved in modes: its ANALYSIS, else the deck's SOL."""
    own = model.subcase.analysis.upper()
    return own == analysis or (not own and model.deck.sol == sol)


def with_residual_vectors(
    model: Structure,
    reduced: AnalysisModel,
    modes: Modes,
    pattern: sp.csr_matrix,
    options: Options,
) -> Modes:
    """The modes and, unless RESVEC says NO, residual vectors.

    As in MSC Nastran those of the loads (n, k) and of the inertia of the six rigid
    motions. These stand for low modes that METHOD leaves out, which would otherwise be
    part of the response to the load and lower its frequency (`pmultrand` of pyNastran:
    forces 45 times too small without them). RESVEC(NOAPPL), (NOINRL) leave one out;
    vectors of dampers (DAMPLOD) and of RVDOF are not made.
    """
    wanted = model.subcase.resvec or str(model.deck.param("RESVEC"))
    if wanted.upper().startswith("NO"):
        return modes
    words = model.subcase.options.get("resvec", ())
    if undone := [word for word in words if word not in _RESVEC]:
        options.console.say(
            f"notice: RESVEC({', '.join(undone)}) is not done: residual vectors are "
            "those of the loads and of the inertia of rigid motions"
        )
    loads = [] if "NOAPPL" in words else [pattern]
    if "NOINRL" not in words:
        rigid = rigid_modes(model.points, np.zeros(3))
        loads.append(reduced.load(sp.csr_matrix(model.matrices.mass @ rigid)))
    if not loads:
        return modes
    more = residual_vectors(
        *(reduced.stiffness, reduced.mass, modes, sp.hstack(loads)),
        solver=options.solver,
    )
    options.console.say(f"{more.count - modes.count} residual vectors")
    return more


def modes_of(model: Structure, options: Options) -> tuple[AnalysisModel, Modes]:
    """Modes that the METHOD of a structure's subcase asks for."""
    check_free(model, 103)
    card = eigrl(model.deck, model.subcase)
    count, band = request(card)
    report = options.console.progress("modes")

    def solve(model: Structure) -> tuple[AnalysisModel, Modes]:
        reduced = analysis_model(model, solver=options.solver)
        return reduced, normal_modes(
            reduced.stiffness,
            reduced.mass,
            count=count,
            band=band,
            rigid_body=reduced.rigid_body,
            solver=options.solver,
            progress=report,
        )

    try:
        return solve_or_hold(
            model, solve, options.console, (ModesError, SingularMatrixError)
        )
    except ModesError as error:
        raise InputError(f"{model.deck.path}: {error}") from None


def eigrl(deck: Deck, subcase: Subcase) -> pd.Series:
    """The EIGRL card that a subcase selects.

    Raises:
        InputError: it selects none, or one that is not there.
    """
    table = deck.cards["EIGRL"]
    found = table[table["sid"] == subcase.method]
    if found.empty:
        known = sorted(table["sid"].tolist()) or "none in the deck"
        raise InputError(
            f"{deck.path}: subcase {subcase.id}: METHOD = "
            f"{subcase.method or 'nothing'}, expected an EIGRL card: {known}"
        )
    return found.iloc[0]


def retained_modes(deck: Deck, modes: Modes) -> Modes:
    """Modes of a modal solution: PARAM LMODES, else those from LFREQ to HFREQ.

    Raises:
        InputError: none is left.
    """
    lowest = int(deck.param("LMODES"))
    hertz = modes.frequency_hz
    if lowest > 0:
        keep = np.arange(modes.count) < lowest
    else:
        low, high = deck.number("LFREQ"), deck.number("HFREQ")
        keep = (hertz >= low) & (hertz <= high)
    if not keep.any():
        raise InputError(
            f"{deck.path}: PARAM LFREQ, HFREQ or LMODES leave none of {modes.count} "
            "modes"
        )
    return replace(
        modes,
        frequency_hz=hertz[keep],
        shape=np.asfortranarray(modes.shape[:, keep]),
        rigid=int(np.sum(keep[: modes.rigid])),
    )


def scaled_shapes(shapes: Float64, norm: str) -> Float64:
    """Shapes (g, m) normalised as EIGRL's NORM says."""
    if not norm.upper().startswith("MAX") or shapes.size == 0:
        return shapes
    largest = np.abs(shapes).max(axis=0)
    return shapes / np.where(largest > 0.0, largest, 1.0)


def _write(
    model: Structure,
    reduced: AnalysisModel,
    modes: Modes,
    results: ResultFile,
    name: str,
) -> None:
    subcase, points = model.subcase, model.points
    norm = str(eigrl(model.deck, subcase)["norm"] or "MASS")
    shapes = scaled_shapes(reduced.expand @ modes.shape, norm)
    results.write(f"{name}/frequency_hz", modes.frequency_hz)
    mass = np.einsum("gm,gm->m", shapes, model.matrices.mass @ shapes)
    results.write(f"{name}/modal_mass", mass)
    results.write(
        f"{name}/sturm",
        np.array([[c.frequency_hz, c.counted, c.found] for c in modes.sturm]),
    )
    wanted = subcase.outputs
    results.write_points(
        f"{name}/shape", points, shapes.T, wanted.get("DISPLACEMENT", "ALL")
    )
    if subcase.meffmass >= 0:
        _write_participation(model, shapes, results, name)
    _write_forces(model, shapes, modes, results, name)
    if asked(subcase, "ESE") != "NONE":
        energies = strain_energy(points, model.blocks, shapes)
        results.write_energies(
            f"{name}/strain_energy", energies, ids_of(asked(subcase, "ESE"))
        )
    write_element_results(model, subcase, shapes, results, name)


def _write_participation(
    model: Structure, shapes: Float64, results: ResultFile, name: str
) -> None:
    """What MEFFMASS asks for; fixed freedoms take no part in the rigid motions.

    Raises:
        InputError: its grid is not there.
    """
    points, grid = model.points, model.subcase.meffmass
    if grid and not np.isin(grid, points.grid_id):
        raise InputError(
            f"{model.deck.path}: MEFFMASS(GRID={grid}): expected a grid of the deck"
        )
    about = points.xyz[points.rows(grid)] if grid else np.zeros(3)
    elimination = model.elimination
    motions = elimination.T @ rigid_modes(points, about)[elimination.f]
    found = participation(model.matrices.mass, shapes, motions)
    results.write(f"{name}/participation_factor", found.factor)
    results.write(f"{name}/effective_mass", found.effective)
    results.write(f"{name}/rigid_mass", found.rigid)


def _write_forces(
    model: Structure, shapes: Float64, modes: Modes, results: ResultFile, name: str
) -> None:
    """Forces of constraint and grid point forces of modes, as far as asked for."""
    subcase, matrices = model.subcase, model.matrices
    requests = ("SPCFORCES", "MPCFORCES", "GPFORCE")
    spc, mpc, grid = (asked(subcase, quantity) for quantity in requests)
    if spc == mpc == grid == "NONE":
        return
    residual = matrices.stiffness @ shapes
    residual -= (matrices.mass @ shapes) * modes.eigenvalue
    spc_force = model.elimination.spc_force(residual)
    mpc_force = model.elimination.mpc_force(residual)
    for selection, label, force in (
        (spc, "spc_force", spc_force),
        (mpc, "mpc_force", mpc_force),
    ):
        if selection != "NONE":
            results.write_points(f"{name}/{label}", model.points, force.T, selection)
    if grid != "NONE":
        forces = (np.zeros_like(shapes), spc_force, mpc_force)
        write_grid_forces(model, subcase, shapes, forces, results, name)


def mode_table(modes: Modes) -> str:
    """Frequencies in lines of text, with the counts that were made."""
    lines = [f"{modes.count} modes, {modes.rigid} of them rigid-body modes"]
    for i, hz in enumerate(modes.frequency_hz[:_PRINTED], start=1):
        lines.append(f"  mode {i:4d}  {hz:14.7g} Hz")
    if modes.count > _PRINTED:
        lines.append(f"  ... up to {modes.frequency_hz[-1]:.7g} Hz")
    lines += [f"Sturm sequence: {count}" for count in modes.sturm]
    return "\n".join(lines)

"""SOL 108 and 111: harmonic response, directly or in modes, as complex results.

Structural damping is used as it is (PARAM G, GE); viscous damping of elements and
B2GG; in modes SDAMPING as well, viscous, or structural with PARAM KDAMP -1.
Enforced motion is a load (`enforced_motion.py`); modal damping acts on what moves
relative to it.
"""

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from fem.algebra.frequency_response import (
    HarmonicMatrices,
    direct_response,
    modal_response,
)
from fem.algebra.linear_solver import SingularMatrixError
from fem.algebra.modes import Modes
from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.errors import InputError
from fem.files.hdf5 import ResultFile
from fem.loads.frequencies import frequencies
from fem.loads.harmonic import HarmonicExcitation, harmonic_excitation
from fem.model.structure import Structure
from fem.recovery.elements import element_tables
from fem.recovery.harmonic import harmonic_table
from fem.solution.analysis_model import (
    AnalysisModel,
    analysis_model,
    in_modes,
    with_dynamic_input,
)
from fem.solution.enforced_motion import BaseMotion, base_motion, unseen_motion
from fem.solution.frequency_dependence import FrequencyDependence
from fem.solution.modal_damping import modal_ratios
from fem.solution.modes import (
    is_modal,
    mode_table,
    modes_of,
    retained_modes,
    with_residual_vectors,
)
from fem.solution.options import Options
from fem.solution.requests import (
    ELEMENT_RESULTS,
    check_free,
    detail_of,
    wanted,
)

Complex128 = npt.NDArray[np.complex128]

_POWERS = {"DISPLACEMENT": 0, "VELOCITY": 1, "ACCELERATION": 2}


def solve_frequencies(
    structure: Structure,
    subcases: list[Subcase],
    results: ResultFile,
    options: Options,
) -> None:
    """Complex displacements and forces at frequencies, `/frequency/<id>`.

    Raises:
        InputError: loads or frequencies that are not there; a resonance without any
            damping at one of the frequencies.
    """
    for case in subcases:
        model = structure.with_subcase(case)
        check_free(model, 108)
        basis = _basis(model, options) if is_modal(model, "MFREQ", 111) else None
        hertz = frequencies(model.deck, case, None if basis is None else basis.elastic)
        excitation = harmonic_excitation(
            model.deck, model.points, case, hertz, model.loaded_mass
        )
        if notice := unseen_motion(model, excitation.motion):
            options.console.say(f"warning: {notice}")
        relative = str(model.deck.param("ENFMOTN")).upper().startswith("REL")
        if relative and excitation.motion.nnz:
            options.console.say(
                f"warning: subcase {case.id}: PARAM,ENFMOTN,REL asks for motions "
                "relative to the base; those written here are absolute"
            )
        if basis is None:
            u_g = _direct(model, hertz, excitation, options)
        else:
            u_g = _modal(model, basis, hertz, excitation, options)
        _write(model, hertz, excitation, u_g, results)
        options.console.say(_summary(model, hertz, u_g))


def _matrices(model: Structure, reduced: AnalysisModel) -> HarmonicMatrices:
    """Matrices of the analysis set with their damping.

    Rayleigh's, ALPHA1 M + ALPHA2 K, is viscous as in transients.
    """
    varying = FrequencyDependence.from_deck(model.deck, model.points, model.blocks)
    g, alpha1, alpha2 = (model.deck.number(name) for name in ("G", "ALPHA1", "ALPHA2"))
    given, expand = model.matrices, reduced.expand

    def own(matrix: sp.csr_matrix) -> sp.csr_matrix | None:
        return sp.csr_matrix(expand.T @ (matrix @ expand)) if matrix.nnz else None

    structural = own(given.structural_damping)
    if g:
        structural = _sum(structural, sp.csr_matrix(g * reduced.stiffness))
    stiffness, mass, viscous = reduced.stiffness, reduced.mass, own(given.damping)
    for factor, matrix in ((alpha1, mass), (alpha2, stiffness)):
        if factor:
            viscous = _sum(viscous, sp.csr_matrix(factor * matrix))
    if (more := reduced.direct) is not None:
        stiffness = sp.csr_matrix(stiffness + more.stiffness)
        mass = sp.csr_matrix(mass + more.mass)
        viscous = _sum(viscous, more.damping)
        structural = _sum(structural, more.structural)
    nominal = HarmonicMatrices(
        stiffness=stiffness,
        mass=mass,
        viscous=viscous,
        structural=structural,
        symmetric=more is None,
    )
    if varying is None:
        return nominal

    def at(hertz: float) -> HarmonicMatrices:
        change = varying.at(hertz)
        stiffness = sp.csr_matrix(expand.T @ (change.stiffness @ expand))
        loss = g * change.stiffness + change.structural_damping
        return replace(
            nominal,
            stiffness=sp.csr_matrix(nominal.stiffness + stiffness),
            viscous=_sum(
                nominal.viscous,
                own(sp.csr_matrix(change.damping + alpha2 * change.stiffness)),
            ),
            structural=_sum(nominal.structural, own(sp.csr_matrix(loss))),
        )

    return replace(nominal, varying=at)


def _sum(a: sp.csr_matrix | None, b: sp.csr_matrix | None) -> sp.csr_matrix | None:
    if a is None or b is None:
        return b if a is None else a
    return sp.csr_matrix(a + b)


def _direct(
    model: Structure,
    hertz: Float64,
    excitation: HarmonicExcitation,
    options: Options,
) -> Complex128:
    """(f, g) displacements."""

    def run(model: Structure) -> Complex128:
        reduced = analysis_model(model, solver=options.solver)
        reduced = with_dynamic_input(model, reduced, options.console.say)
        base = base_motion(model, excitation)
        load = _load(model, reduced, hertz, excitation, base)
        u = direct_response(
            _matrices(model, reduced),
            hertz,
            lambda k: load[:, k],
            solver=options.solver,
            progress=options.console.progress("direct frequency response"),
        )
        u_g = (reduced.expand @ u.T).T
        return u_g if base is None else u_g + base.displacement

    try:
        return run(model)
    except SingularMatrixError as error:
        held, notices = model.without_massless_motions()
        if held is model:
            raise InputError(f"{model.deck.path}: {_RESONANCE} ({error})") from None
        for notice in notices:
            options.console.say(f"notice: {notice}")
        return run(held)


def _load(
    model: Structure,
    reduced: AnalysisModel,
    hertz: Float64,
    excitation: HarmonicExcitation,
    base: BaseMotion | None,
) -> Complex128:
    """(n, f) loads on the analysis set, what moves the base among them."""
    load = reduced.load(excitation.pattern) @ excitation.factor
    if base is None:
        return load
    rate = 2j * np.pi * hertz[:, None]
    return load - reduced.expand.T @ _residual(model, rate, base.displacement).T


_RESONANCE = (
    "frequency response: without damping, a frequency is that of a mode; expected "
    "PARAM G, GE, dampers, or other frequencies"
)


@dataclass(frozen=True)
class _Basis:
    """Modes of the analysis set that the response is made of."""

    reduced: AnalysisModel
    modes: Modes

    @property
    def elastic(self) -> Float64:
        """(m,) Hz of those that are no rigid-body modes."""
        return self.modes.frequency_hz[self.modes.rigid :]


def _basis(model: Structure, options: Options) -> _Basis:
    reduced, found = modes_of(model, options)
    modes = retained_modes(model.deck, found)
    options.console.say(mode_table(modes))
    return _Basis(reduced, modes)


def _modal(
    model: Structure,
    basis: _Basis,
    hertz: Float64,
    excitation: HarmonicExcitation,
    options: Options,
) -> Complex128:
    """(f, g) displacements."""
    reduced, modes = basis.reduced, basis.modes
    pattern = reduced.load(excitation.pattern)
    base = base_motion(model, excitation)
    if base is not None:
        base = base.carried(model, reduced, modes, solver=options.solver)
        pattern = sp.csr_matrix(sp.hstack([pattern, base.inertia(model, reduced)]))
    modes = with_residual_vectors(model, reduced, modes, pattern, options)
    ratio = modal_ratios(model.deck, model.subcase, modes.frequency_hz)
    hysteretic = int(model.deck.number("KDAMP")) < 0
    coupled = with_dynamic_input(model, in_modes(reduced, modes), options.console.say)
    if coupled.direct is not None:
        matrices = _with_ratios(_matrices(model, coupled), modes, ratio, hysteretic)
        load = _load(model, coupled, hertz, excitation, base)
        try:
            u = direct_response(
                matrices, hertz, lambda k: load[:, k], solver=options.solver
            )
        except SingularMatrixError as error:
            raise InputError(f"{model.deck.path}: {_RESONANCE} ({error})") from None
        u_g = (coupled.expand @ u.T).T
        return u_g if base is None else u_g + base.displacement
    try:
        amplitude = modal_response(
            modes,
            _matrices(model, reduced),
            hertz,
            modes.shape.T @ _load(model, reduced, hertz, excitation, base),
            ratio=ratio,
            hysteretic=hysteretic,
        )
    except np.linalg.LinAlgError:
        raise InputError(f"{model.deck.path}: {_RESONANCE}") from None
    u_g = amplitude @ (reduced.expand @ modes.shape).T
    return u_g if base is None else u_g + base.displacement


def _with_ratios(
    matrices: HarmonicMatrices, modes: Modes, ratio: Float64, hysteretic: bool
) -> HarmonicMatrices:
    """Damping ratios of modes, which stand behind extra points, added."""
    if (varying := matrices.varying) is not None:
        nominal = replace(matrices, varying=None)
        return replace(
            _with_ratios(nominal, modes, ratio, hysteretic),
            varying=lambda f: _with_ratios(varying(f), modes, ratio, hysteretic),
        )
    square = modes.eigenvalue
    own = 2.0 * ratio * (square if hysteretic else np.sqrt(np.abs(square)))
    extra = len(matrices.mass.indptr) - 1 - modes.count
    added = sp.csr_matrix(sp.diags(np.concatenate([np.zeros(extra), own])))
    if hysteretic:
        return replace(matrices, structural=_sum(matrices.structural, added))
    return replace(matrices, viscous=_sum(matrices.viscous, added))


@dataclass(frozen=True)
class _Written:
    """Where complex results of a subcase go."""

    model: Structure
    results: ResultFile
    name: str

    def points(self, label: str, values: Complex128, quantity: str) -> None:
        """(f, g) values of the points that are asked for."""
        asked = wanted(self.model.subcase, quantity)
        if asked != "NONE":
            name = f"{self.name}/{label}"
            self.results.write_points(name, self.model.points, values, asked)


def _write(
    model: Structure,
    hertz: Float64,
    excitation: HarmonicExcitation,
    u_g: Complex128,
    results: ResultFile,
) -> None:
    case, name = model.subcase, f"frequency/{model.subcase.id}"
    results.write(f"{name}/frequency_hz", hertz)
    out = _Written(model, results, name)
    rate = 2j * np.pi * hertz[:, None]
    motions = [q for q in _POWERS if wanted(case, q) != "NONE"]
    if not motions:
        results.write_points(f"{name}/displacement", model.points, u_g, "ALL")
    for quantity in motions:
        values = rate ** _POWERS[quantity] * u_g
        out.points(quantity.lower(), values, quantity)
    load = (excitation.pattern @ excitation.factor).T
    out.points("applied_load", load, "OLOAD")
    if {wanted(case, "SPCFORCES"), wanted(case, "MPCFORCES")} != {"NONE"}:
        residual = _residual(model, rate, u_g) - load
        spc = model.elimination.spc_force(residual.T).T
        out.points("spc_force", spc, "SPCFORCES")
        mpc = model.elimination.mpc_force(residual.T).T
        out.points("mpc_force", mpc, "MPCFORCES")
    detail = detail_of(model.deck, case)
    varying = FrequencyDependence.from_deck(model.deck, model.points, model.blocks)
    for request, kind in ELEMENT_RESULTS:
        if kind == "failure":  # has no phase
            continue
        for table in element_tables(
            model.points,
            model.blocks,
            kind,
            wanted(case, request),
            detail=detail,
            moving=True,
        ):
            linear = table.harmonic(u_g, rate)
            if varying is not None and table.table in varying.cards:
                linear = varying.linear(table, kind, detail, hertz, u_g)
            harmonic, values = harmonic_table(table, linear)
            results.write_table(f"{name}/element_{kind}", harmonic, values)


def _residual(model: Structure, rate: Complex128, u_g: Complex128) -> Complex128:
    """(f, g) forces of inertia, damping and stiffness."""
    m = model.matrices
    g, alpha1, alpha2 = (model.deck.number(name) for name in ("G", "ALPHA1", "ALPHA2"))
    force = (1.0 + 1j * g + rate * alpha2) * (m.stiffness @ u_g.T).T
    force += 1j * (m.structural_damping @ u_g.T).T
    force += (rate**2 + rate * alpha1) * (m.mass @ u_g.T).T
    force += rate * (m.damping @ u_g.T).T
    varying = FrequencyDependence.from_deck(model.deck, model.points, model.blocks)
    if varying is not None:
        for k, w in enumerate(rate[:, 0]):
            own, u = varying.at(w.imag / (2.0 * np.pi)), u_g[k]
            force[k] += (1.0 + 1j * g + w * alpha2) * (own.stiffness @ u)
            force[k] += w * (own.damping @ u)
            force[k] += 1j * (own.structural_damping @ u)
    return force


def _summary(model: Structure, hertz: Float64, u_g: Complex128) -> str:
    """The largest translation, at which frequency and where."""
    grids = len(model.points.grid_id)
    moved = np.abs(u_g[:, : 6 * grids]).reshape(len(hertz), grids, 6)[:, :, :3]
    text = f"frequency response, subcase {model.subcase.id}: {len(hertz)} frequencies"
    if not moved.size:
        return text
    k, grid, component = np.unravel_index(int(moved.argmax()), moved.shape)
    place = model.points.label(int(6 * grid + component))
    return (
        f"{text}, largest displacement {moved.max():.7g} at {hertz[k]:.7g} Hz, {place}"
    )

"""Modal transient response, exact for loads that are linear between time steps.

    q'' + C q' + Λ q = Φᵀ P(t),   u = Φ q

C is the projection of the damping matrix, full where the damping is not proportional,
plus modal damping ratios. The modes may be completed by residual vectors: the static
response to the load patterns that the modes lack, mass-orthogonal to them.

Reference: MSC Nastran Dynamic Analysis User's Guide, modal transient, residual vectors.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.algebra.linear_solver import SolverName, factorize
from fem.algebra.modes import Modes
from fem.algebra.orthonormal import orthonormal_rest
from fem.algebra.statics import determinate_rows
from fem.arrays import Float64
from fem.response.observation import Observer, Quantity
from fem.response.propagator import propagator_of
from fem.response.system import TransientLoad
from fem.response.time_grid import StepGroup, output_times, step_groups, window_length


def residual_vectors(
    stiffness: sp.csr_matrix,
    mass: sp.csr_matrix,
    modes: Modes,
    patterns: sp.spmatrix | sp.sparray | Float64,
    *,
    solver: SolverName | None = None,
) -> Modes:
    """Modes completed by the static response to load patterns.

    Args:
        stiffness, mass: (f, f) K and M.
        modes: all rigid-body modes must be among them.
        patterns: (f, k) load distributions.

    Returns:
        The modes and up to k more, mass-normalised, orthogonal to all others, with the
        frequencies that Rayleigh's quotient gives them.
    """
    loads = patterns.toarray() if sp.issparse(patterns) else np.asarray(patterns)
    loads = loads[:, np.any(loads != 0.0, axis=0)]
    if loads.shape[1] == 0:
        return modes
    static = static_response(stiffness, mass, modes, loads, solver=solver)
    phi = modes.shape
    basis = orthonormal_rest(static, phi, mass)
    if basis.shape[1] == 0:
        return modes
    energy = basis.T @ (stiffness @ basis)
    omega2, rotation = np.linalg.eigh(0.5 * (energy + energy.T))
    return replace(
        modes,
        frequency_hz=np.append(
            modes.frequency_hz, np.sqrt(np.abs(omega2)) / (2.0 * np.pi)
        ),
        shape=np.hstack([phi, basis @ rotation]),
    )


def static_response(
    stiffness: sp.csr_matrix,
    mass: sp.csr_matrix,
    modes: Modes,
    loads: Float64,
    *,
    solver: SolverName | None = None,
) -> Float64:
    """(f, k) response to loads (f, k), for a free structure balanced by its inertia.

    Args:
        stiffness, mass: (f, f) K and M.
        modes: all rigid-body modes must be among them.
        loads: (f, k).
        solver: as in `fem.algebra.linear_solver.factorize`.
    """
    if modes.rigid == 0:
        with factorize(stiffness, solver=solver) as factor:
            return factor.solve(loads)
    rigid = modes.shape[:, : modes.rigid]
    balanced = loads - (mass @ rigid) @ (rigid.T @ loads)
    held = determinate_rows(rigid)
    keep = np.setdiff1d(np.arange(len(loads)), held)
    response = np.zeros_like(balanced)
    inner = sp.csr_matrix(stiffness[keep][:, keep])
    with factorize(inner, solver=solver) as factor:
        response[keep] = factor.solve(balanced[keep])
    return response


class _ModalChunk:
    """Chunk of modal coordinates; see `fem.response.observation.Chunk`."""

    def __init__(
        self,
        first: int,
        time: Float64,
        coordinates: dict[Quantity, Float64],
        project: Callable[[sp.csr_matrix | None], Float64],
    ) -> None:
        self.first = first
        self.time = time
        self._coordinates = coordinates
        self._project = project

    def get(self, quantity: Quantity, operator: sp.csr_matrix | None = None) -> Float64:
        """Response through an operator; see `Chunk`."""
        return self._coordinates[quantity] @ self._project(operator).T


class _Projection:
    """Shapes seen through operators; the few operators of a run are remembered."""

    def __init__(self, shape: Float64) -> None:
        self._shape = shape
        # Operators are kept with their products, so that an id is never used twice.
        self._known: dict[int, tuple[sp.csr_matrix, Float64]] = {}

    def __call__(self, operator: sp.csr_matrix | None) -> Float64:
        if operator is None:
            return self._shape
        if id(operator) not in self._known:
            self._known[id(operator)] = (operator, operator @ self._shape)
        return self._known[id(operator)][1]


def modal_transient(
    modes: Modes,
    mass: sp.spmatrix | sp.sparray,
    damping: Damping | sp.spmatrix | sp.sparray | None = None,
    *,
    steps: Iterable[tuple[int, float] | tuple[int, float, int]],
    load: TransientLoad | None = None,
    ratio: Float64 | float = 0.0,
    u0: Float64 | None = None,
    v0: Float64 | None = None,
    observers: Sequence[Observer] = (),
    progress: Callable[[int, int], None] | None = None,
) -> Float64:
    """Integrate the modal equations exactly.

    Args:
        modes: mass-normalised, completed by `residual_vectors` where wanted.
        mass: (f, f) M, for the projection of the initial state.
        damping: B in any form; its part proportional to K must be given as
            `Damping.stiffness_factor`.
        steps: rows (count, step in s, output stride).
        load: patterns and functions of time, linear between the steps.
        ratio: modal damping ratios ζ, one or (m,), in addition to B.
        u0, v0: (f,) or (c, f) initial state.
        observers: receive the response, as in `direct_transient`.
        progress: called with (done, all) steps.

    Returns:
        (t,) output times, s.
    """
    m = sp.csr_matrix(mass)
    groups = step_groups(steps)
    time = output_times(groups)
    phi, omega2 = modes.shape, modes.eigenvalue
    c_matrix = modal_damping(modes, damping) + np.diag(
        2.0 * np.broadcast_to(ratio, modes.count) * np.sqrt(np.abs(omega2))
    )
    pattern = None if load is None else (load.pattern.T @ phi).T
    state = _initial_state(phi, m, load, u0, v0)
    for observer in observers:
        observer.begin(time, len(state), len(phi))
    projection = _Projection(phi)
    done, total = 0, sum(group.count for group in groups)
    for group in groups:
        propagator = propagator_of(omega2, c_matrix, group.step)
        forces = _modal_forces(load, pattern, group, len(state), modes.count)
        chunk_steps: list[int] = []
        kept: list[tuple[Float64, Float64]] = []
        emitted = 0
        wanted = set(group.outputs.tolist())
        limit = 8 * window_length(len(state), modes.count)
        for n in range(group.count + 1):
            if n in wanted:
                chunk_steps.append(n)
                kept.append((state, forces[n]))
            if kept and (len(kept) == limit or n == group.count):
                chunk = _ModalChunk(
                    group.first_output + emitted,
                    group.time(chunk_steps),
                    _coordinates(kept, omega2, c_matrix),
                    projection,
                )
                for observer in observers:
                    observer.observe(chunk)
                emitted += len(kept)
                chunk_steps, kept = [], []
            if n < group.count:
                state = propagator.step(state, forces[n], forces[n + 1])
                done += 1
                if progress is not None:
                    progress(done, total)
    return time


def modal_damping(
    modes: Modes, damping: Damping | sp.spmatrix | sp.sparray | None
) -> Float64:
    """(m, m) projection Φᵀ B Φ of a damping matrix."""
    if damping is None:
        return np.zeros((modes.count, modes.count))
    if not isinstance(damping, Damping):
        damping = Damping(other=sp.csr_matrix(damping))
    return damping.projected(
        modes.shape, np.diag(modes.eigenvalue), np.eye(modes.count)
    )


def _initial_state(
    phi: Float64,
    mass: sp.csr_matrix,
    load: TransientLoad | None,
    u0: Float64 | None,
    v0: Float64 | None,
) -> Float64:
    """(c, 2, m) modal coordinates and rates."""
    rows = [None if x is None else np.atleast_2d(x) for x in (u0, v0)]
    counts = [len(row) for row in rows if row is not None]
    if load is not None:
        counts.append(len(load.factors(np.zeros(1))))
    cases = max(counts, default=1)
    state = np.zeros((cases, 2, phi.shape[1]))
    for i, row in enumerate(rows):
        if row is not None:
            state[:, i] = (mass @ row.T).T @ phi
    return state


def _modal_forces(
    load: TransientLoad | None,
    pattern: Float64 | None,
    group: StepGroup,
    cases: int,
    modes: int,
) -> Float64:
    """(steps + 1, c, m) loads in modal coordinates."""
    time = group.time(np.arange(group.count + 1))
    if load is None or pattern is None:
        return np.zeros((len(time), cases, modes))
    factors = load.factors(time)
    factors = np.broadcast_to(factors, (cases, *factors.shape[1:]))
    return np.einsum("mk,ckt->tcm", pattern, factors, optimize=True)


def _coordinates(
    kept: list[tuple[Float64, Float64]], omega2: Float64, damping: Float64
) -> dict[Quantity, Float64]:
    """(t, c, m) modal coordinates, rates and, by the equation of motion, q''."""
    states = np.array([state for state, _ in kept])
    forces = np.array([force for _, force in kept])
    q, rate = states[:, :, 0], states[:, :, 1]
    return {
        "displacement": q,
        "velocity": rate,
        "acceleration": forces - rate @ damping.T - q * omega2,
    }

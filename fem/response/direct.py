"""Direct transient response: M u'' + B u' + K u = P(t), one factor per step size.

Several load cases are integrated together, as one block of right-hand sides, which is
several times cheaper per case than one after the other. Histories are kept only where
an observer asks for them. Observers work in a second thread while the next steps are
solved.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from time import perf_counter, process_time

import numpy as np
import scipy.sparse as sp

from fem.algebra.damping import Damping
from fem.algebra.extension import CondensedProduct
from fem.algebra.linear_solver import Factorization, Kind, SolverName
from fem.arrays import Float64
from fem.response.generalized_alpha import GeneralizedAlpha
from fem.response.nastran_scheme import NastranScheme
from fem.response.observation import Observer, total_memory
from fem.response.observer_thread import Beside
from fem.response.system import TransientLoad, TransientSystem, sampled_load
from fem.response.time_grid import output_times, step_groups

__all__ = [
    "GeneralizedAlpha",
    "NastranScheme",
    "TransientLoad",
    "TransientRun",
    "direct_transient",
    "sampled_load",
]

Progress = Callable[[int, int], None]


@dataclass(frozen=True, kw_only=True)
class TransientRun:
    """How a transient went.

    Attributes:
        time: (t,) output times, s.
        steps: time steps taken.
        cases: load cases integrated together.
        nnz_factor: entries of the (last) factor.
        factor_seconds, step_seconds: wall time of all factorisations, of all steps.
        factor_processor: processor time of all factorisations, s.
    """

    time: Float64
    steps: int
    cases: int
    nnz_factor: int
    factor_seconds: float
    step_seconds: float
    factor_processor: float = 0.0


def direct_transient(
    stiffness: sp.spmatrix | sp.sparray,
    mass: sp.spmatrix | sp.sparray,
    damping: Damping | sp.spmatrix | sp.sparray | None = None,
    *,
    steps: Iterable[tuple[int, float] | tuple[int, float, int]],
    load: TransientLoad | None = None,
    u0: Float64 | None = None,
    v0: Float64 | None = None,
    observers: Sequence[Observer] = (),
    scheme: NastranScheme | GeneralizedAlpha | None = None,
    kind: Kind = "spd",
    solver: SolverName | None = None,
    threads: int | None = None,
    mass_product: CondensedProduct | None = None,
    progress: Progress | None = None,
    inform: Callable[[str], None] | None = None,
) -> TransientRun:
    """Integrate the equation of motion of the free set.

    Args:
        stiffness, mass: (n, n) K and M, sparse; symmetric, but for kind "general". M
            may be singular and K too (free-flying structures), not both for one motion.
        damping: B as a matrix, or with its proportional part apart (faster).
        steps: rows (count, step in s, output stride) as on TSTEP.
        load: patterns and functions of time; None: no load.
        u0, v0: (n,) or (c, n) initial displacements and velocities; None: zero.
        observers: receive the response, e.g. `Observation`.
        scheme: Nastran's by default.
        kind: of the matrices, as in `fem.algebra.linear_solver.factorize`.
        solver, threads: as in `fem.algebra.linear_solver.factorize`.
        mass_product: products with `mass` that cost less, see `Structure`.
        progress: called after each step with (done, all).
        inform: receives a line on size and memory before the steps begin.

    Returns:
        Times and cost; the response itself is in the observers.

    Raises:
        SingularMatrixError: a motion without mass and stiffness.
        ValueError: arguments that do not fit each other.
    """
    scheme = scheme or NastranScheme()
    system = TransientSystem.assemble(
        stiffness,
        mass,
        damping,
        load,
        solver=solver,
        threads=threads,
        mass_product=mass_product,
        kind=kind,
    )
    groups = step_groups(steps)
    time = output_times(groups)
    cases = _cases(load, u0, v0)
    total = sum(group.count for group in groups)
    for observer in observers:
        observer.begin(time, cases, system.size)
    clock = _Clock()
    run = _Run(scheme, system, cases, time, total, observers, clock, inform, progress)

    with Beside(observers) as beside:
        scheme.integrate(
            system,
            load,
            groups,
            _state(u0, cases, system.size, "u0"),
            _state(v0, cases, system.size, "v0"),
            beside.emit,
            run.tick,
            run.announce,
        )
    clock.end_steps()
    return TransientRun(
        time=time,
        steps=total,
        cases=cases,
        nnz_factor=run.nnz_factor,
        factor_seconds=clock.factor_seconds,
        step_seconds=clock.step_seconds,
        factor_processor=clock.factor_processor,
    )


def _cases(load: TransientLoad | None, u0: Float64 | None, v0: Float64 | None) -> int:
    """Number of load cases; single ones are repeated for all."""
    counts = {len(np.atleast_2d(x)) for x in (u0, v0) if x is not None}
    if load is not None:
        counts.add(len(load.factors(np.zeros(1))))
    counts.discard(1)
    if len(counts) > 1:
        raise ValueError(f"load and initial state have {sorted(counts)} cases")
    return counts.pop() if counts else 1


def _state(x: Float64 | None, cases: int, size: int, name: str) -> Float64:
    if x is None:
        return np.zeros((cases, size))
    rows = np.atleast_2d(np.asarray(x, dtype=float))
    if rows.shape[1] != size:
        raise ValueError(f"{name} has {rows.shape[1]} freedoms, expected {size}")
    return np.broadcast_to(rows, (cases, size)).copy()


class _Clock:
    """Wall time of factorisations and of steps, told apart by events."""

    def __init__(self) -> None:
        self.factor_seconds = 0.0
        self.step_seconds = 0.0
        self.factor_processor = 0.0
        self._factor_start: float | None = perf_counter()
        self._step_start: float | None = None
        self._processor_start = process_time()

    def end_factor(self) -> None:
        now = perf_counter()
        if self._step_start is not None:
            # A further group: the time since its last step went into the new factor.
            self._factor_start, self._step_start = self._step_start, None
        if self._factor_start is not None:
            self.factor_seconds += now - self._factor_start
            self.factor_processor += process_time() - self._processor_start
        self._factor_start, self._step_start = None, now

    def end_steps(self) -> None:
        now = perf_counter()
        if self._step_start is not None:
            self.step_seconds += now - self._step_start
        self._step_start, self._processor_start = now, process_time()


@dataclass
class _Run:
    """Progress and announcements of a run."""

    scheme: NastranScheme | GeneralizedAlpha
    system: TransientSystem
    cases: int
    time: Float64
    total: int
    observers: Sequence[Observer]
    clock: _Clock
    inform: Callable[[str], None] | None
    progress: Progress | None
    nnz_factor: int = 0
    done: int = 0

    def tick(self) -> None:
        self.clock.end_steps()
        self.done = min(self.done + 1, self.total)
        if self.progress is not None:
            self.progress(self.done, self.total)

    def announce(self, factor: Factorization) -> None:
        self.clock.end_factor()
        self.nnz_factor = factor.nnz_factor
        if self.inform is None:
            return
        size = self.system.size
        kept = total_memory(self.observers, len(self.time), self.cases, size)
        vectors = self.scheme.working_vectors(self.cases, size)
        working = 8 * size * self.cases * vectors
        self.inform(
            f"direct transient: {self.total} steps, {size} freedoms, {self.cases} load "
            f"case{'s' if self.cases > 1 else ''}; memory: factor "
            f"{factor.memory_bytes / 1e6:.0f} MB, working vectors "
            f"{working / 1e6:.0f} MB, histories {kept / 1e6:.0f} MB"
        )

"""Nastran's direct transient integrator, arranged for few passes over memory.

With A = M/h² + B/(2h) + K/3:

    A u(n+1) = [P(n+1) + P(n) + P(n-1)]/3
             + [2M/h² - K/3] u(n) + [-M/h² + B/(2h) - K/3] u(n-1)

Both brackets contain A, so that K never multiplies a vector:

    A [u(n+1) + u(n) + u(n-1)] = P̄ + (3/h²) M u(n) + B w,  w = u(n)/(2h) + u(n-1)/h

and with B = a K + b M + B', K = κ [A - (1/h² + b/(2h)) M - B'/(2h)] and
κ = 1/(1/3 + a/(2h)), the proportional part of B needs no product either. A step costs
one solve, one product with M (diagonal where it is lumped) and one with B'.

Start: u(-1) = u0 - v0 h, P(-1) = K u(-1) + B v0, and P(0) := K u0 + B v0 (the load
given at t = 0 is not used). Velocities and accelerations are central differences; one
step beyond the end gives those of the last time, and the velocity at t = 0 is v0.

Change of step size h1 -> h2 after step N: with v = [u(N) - u(N-1)]/h1 and
a = [u(N) - 2 u(N-1) + u(N-2)]/h1², the new start is u(-1) = u(N) - h2 v + h2² a/2,
P(-1) = M a + B (v - h2 a) + K u(-1), and P(0) is the load at that time.

Reference: NASTRAN Theoretical Manual, section 11.4, and the published source of
NASTRAN-95 (module TRD).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.algebra.linear_solver import Factorization
from fem.arrays import Float64
from fem.response.observation import Chunk, DifferenceChunk
from fem.response.system import TransientLoad, TransientSystem
from fem.response.time_grid import StepGroup, window_length

# Rows of the window that stay when it moves on: u(n-2), u(n-1), u(n).
_KEPT = 3


@dataclass(frozen=True)
class _Step:
    """One step of size h: factors of the products, see the module's text."""

    system: TransientSystem
    factor: Factorization
    h: float

    def advance(
        self,
        u: Float64,
        before: Float64,
        load: Float64,
        out: Float64,
        extra: Float64 | None,
    ) -> None:
        """u(n+1) into `out` from u(n), u(n-1) (c, n) and mean load factors (c, k)."""
        system, h = self.system, self.h
        a, b = system.damping.stiffness_factor, system.damping.mass_factor
        share = a / (1.0 / 3.0 + a / (2.0 * h))
        w = u / (2.0 * h)
        w += before / h
        right = u * (3.0 / (h * h))
        on_mass = b - share * (1.0 / (h * h) + b / (2.0 * h))
        if on_mass != 0.0:
            right += on_mass * w
        right = system.mass_product.dot(right)
        system.add_other(right, 1.0 - share / (2.0 * h), w)
        system.add_load(right, load)
        if extra is not None:
            right += extra
        np.subtract(self.factor.solve(right.T).T, u, out=out)
        out -= before
        if share != 0.0:
            w *= share
            out += w


@dataclass(frozen=True)
class NastranScheme:
    """The scheme of SOL 109: unconditionally stable, second order, without damping."""

    def matrix_factors(
        self, system: TransientSystem, h: float
    ) -> tuple[float, float, float]:
        """Factors of K, M and B' in the matrix of one step."""
        b = system.damping
        return (
            1.0 / 3.0 + b.stiffness_factor / (2.0 * h),
            1.0 / (h * h) + b.mass_factor / (2.0 * h),
            1.0 / (2.0 * h),
        )

    def working_vectors(self, cases: int, size: int) -> int:
        """Vectors per load case that are in memory at a time."""
        return window_length(cases, size) + _KEPT + 6

    def integrate(
        self,
        system: TransientSystem,
        load: TransientLoad | None,
        groups: list[StepGroup],
        u0: Float64,
        v0: Float64,
        emit: Callable[[Chunk], None],
        tick: Callable[[], None],
        announce: Callable[[Factorization], None],
    ) -> None:
        """Integrate from u0, v0 (c, n); see `fem.response.direct.direct_transient`."""
        past: Float64 | None = None
        for group in groups:
            start = self._start(system, group, groups, past, u0, v0)
            factors = _mean_factors(load, group, len(u0), start.uses_first_load)
            matrix = self.matrix_factors(system, group.step)
            with system.factorize(*matrix, len(u0)) as factor:
                announce(factor)
                step = _Step(system, factor, group.step)
                past = _run_group(step, group, start, factors, emit, tick)

    def _start(
        self,
        system: TransientSystem,
        group: StepGroup,
        groups: list[StepGroup],
        past: Float64 | None,
        u0: Float64,
        v0: Float64,
    ) -> "_Start":
        h = group.step
        if past is None:
            first = system.stiffness_times(u0) + system.damping_times(v0)
            before = first - h * system.stiffness_times(v0)
            return _Start(u0, u0 - h * v0, (before + first) / 3.0, first / 3.0, v0)
        old = groups[groups.index(group) - 1].step
        v = (past[2] - past[1]) / old
        a = (past[2] - 2.0 * past[1] + past[0]) / old**2
        u_before = past[2] - h * v + 0.5 * h * h * a
        before = (
            system.mass_product.dot(a)
            + system.damping_times(v - h * a)
            + system.stiffness_times(u_before)
        )
        return _Start(past[2], u_before, before / 3.0, None, None)


@dataclass(frozen=True)
class _Start:
    """Start of a group: u(0), u(-1), loads added to the first two steps, given v(0)."""

    u: Float64
    before: Float64
    first_extra: Float64
    second_extra: Float64 | None
    velocity: Float64 | None

    @property
    def uses_first_load(self) -> bool:
        return self.second_extra is None

    def extra(self, step: int) -> Float64 | None:
        """Load vectors beyond the factors, None where there are none."""
        vector = (self.first_extra, self.second_extra, None)[min(step, 2)]
        return vector if vector is not None and vector.any() else None


def _mean_factors(
    load: TransientLoad | None, group: StepGroup, cases: int, uses_first: bool
) -> Float64:
    """Load factors (steps, c, k) averaged over three neighbouring times."""
    time = group.time(np.arange(group.count + 2))
    if load is None:
        return np.zeros((group.count + 1, cases, 0))
    values = load.factors(time)
    values = np.broadcast_to(values, (cases, *values.shape[1:])).copy()
    if not uses_first:
        values[:, :, 0] = 0.0
    sums = values[:, :, 1:] + values[:, :, :-1]
    sums[:, :, 1:] += values[:, :, :-2]
    return np.moveaxis(sums / 3.0, -1, 0)


def _run_group(
    step: _Step,
    group: StepGroup,
    start: _Start,
    factors: Float64,
    emit: Callable[[Chunk], None],
    tick: Callable[[], None],
) -> Float64:
    """Run one group; the displacements at its last three steps (3, c, n)."""
    cases, size = start.u.shape
    length = window_length(cases, size) + _KEPT
    window = np.zeros((length, cases, size))
    window[1], window[2] = start.before, start.u
    outputs = group.outputs
    first_step, filled = -2, 3  # the step in row 0, and rows in use
    done = 0
    # The last group takes one more step, for the last central difference.
    for n in range(group.count + int(group.last)):
        if filled == length:
            done = _flush(window, first_step, filled, outputs, done, group, start, emit)
            window[:_KEPT] = window[-_KEPT:].copy()
            first_step += length - _KEPT
            filled = _KEPT
        step.advance(
            window[filled - 1],
            window[filled - 2],
            factors[n],
            window[filled],
            start.extra(n),
        )
        filled += 1
        tick()
    _flush(window, first_step, filled, outputs, done, group, start, emit)
    return window[filled - _KEPT : filled].copy()


def _flush(
    window: Float64,
    first_step: int,
    filled: int,
    outputs: npt.NDArray[np.intp],
    done: int,
    group: StepGroup,
    start: _Start,
    emit: Callable[[Chunk], None],
) -> int:
    """Hand out the outputs that have both neighbours; how many are done then."""
    ready = int(np.searchsorted(outputs, first_step + filled - 1))
    if ready == done:
        return done
    steps = outputs[done:ready]
    velocity = start.velocity if done == 0 else None
    emit(
        DifferenceChunk(
            group.first_output + done,
            group.time(steps),
            window[:filled],
            steps - first_step,
            group.step,
            velocity,
        )
    )
    return ready

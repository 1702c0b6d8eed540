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
from typing import Protocol

import numpy as np

from fem.algebra.linear_solver import Factorization
from fem.algebra.sparse_products import weighted_sum
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
    right: Float64
    solved: Float64

    def advance(
        self,
        u: Float64,
        before: Float64,
        load: Float64,
        out: Float64,
        extra: Float64 | None,
    ) -> None:
        """u(n+1) into `out` from u(n), u(n-1) (c, n) and mean load factors (c, k).

        The window, `right` and `solved` are all that is written or read, once each.
        """
        system, h, right = self.system, self.h, self.right
        a, b = system.damping.stiffness_factor, system.damping.mass_factor
        share = a / (1.0 / 3.0 + a / (2.0 * h))
        on_mass = b - share * (1.0 / (h * h) + b / (2.0 * h))
        system.mass_product.of_sum(
            (3.0 / (h * h) + on_mass / (2.0 * h), u), (on_mass / h, before), out=right
        )
        if system.other_product is not None:
            w = np.empty_like(right)
            weighted_sum((0.5 / h, u), (1.0 / h, before), out=w)
            system.add_other(right, 1.0 - share / (2.0 * h), w)
        system.add_load(right, load)
        if extra is not None:
            right += extra
        self.factor.solve(right.T, out=self.solved.T)
        weighted_sum(
            (1.0, self.solved),
            (share / (2.0 * h) - 1.0, u),
            (share / h - 1.0, before),
            out=out,
        )


class StateLoad(Protocol):
    """A load that depends on the motion."""

    def __call__(self, u: Float64, before: Float64, h: float) -> Float64:
        """(c, n) loads from u(n), u(n-1) (c, n) and the step, s."""
        ...


@dataclass(frozen=True)
class NastranScheme:
    """The scheme of SOL 109: unconditionally stable, second order, without damping.

    Attributes:
        state_load: N(u(n), u(n-1)), a load of the step to u(n+1) that is not averaged;
            with it there is no stability that would not depend on the step.
    """

    state_load: StateLoad | None = None

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
        return 2 * (window_length(cases, size) + _KEPT) + 6

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
                right, solved = np.empty_like(start.u), np.empty_like(start.u)
                step = _Step(system, factor, group.step, right, solved)
                loads = _Loads(factors, start, self.state_load)
                past = _run_group(step, group, start, loads, emit, tick)

    def _start(
        self,
        system: TransientSystem,
        group: StepGroup,
        groups: list[StepGroup],
        past: Float64 | None,
        u0: Float64,
        v0: Float64,
    ) -> "_Start":
        """u(-1) and the loads of the times before, as the module's text has them.

        The loads P(-1) and, at the very start, P(0) are no patterns times factors: they
        are what balances the given motion, so that it goes on without a jerk. They act
        in the means of the first two steps, hence the thirds.
        """
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
    """Start of a group of equal steps.

    Attributes:
        u, before: (c, n) u(0) and u(-1).
        first_extra, second_extra: (c, n) loads added to the first two steps.
        velocity: (c, n) v(0) where it was given; else it is a central difference.
    """

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


@dataclass(frozen=True)
class _Loads:
    """Mean load factors (steps, c, k) of a group, and what acts beside them."""

    factors: Float64
    start: _Start
    state_load: StateLoad | None

    def beside(self, n: int, u: Float64, before: Float64, h: float) -> Float64 | None:
        """(c, n) loads of a step beyond patterns times factors."""
        extra = self.start.extra(n)
        if self.state_load is None:
            return extra
        found = self.state_load(u, before, h)
        return found if extra is None else found + extra


def _mean_factors(
    load: TransientLoad | None, group: StepGroup, cases: int, uses_first: bool
) -> Float64:
    """Load factors (steps, c, k) averaged over three neighbouring times.

    The first step has no time before: what acts there, and at the very start what acts
    at t = 0, is in `_Start`.
    """
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
    loads: "_Loads",
    emit: Callable[[Chunk], None],
    tick: Callable[[], None],
) -> Float64:
    """Run one group; the displacements at its last three steps (3, c, n)."""
    windows = _Windows(group, start, emit)
    # The last group takes one more step, for the last central difference.
    for n in range(group.count + int(group.last)):
        before, u, out = windows.next_rows()
        step.advance(
            u, before, loads.factors[n], out, loads.beside(n, u, before, step.h)
        )
        tick()
    windows.hand_out()
    return windows.last.copy()


class _Windows:
    """Displacements of consecutive steps, handed out whenever their memory is full.

    There are two windows: one is observed while the other is filled.
    """

    def __init__(
        self, group: StepGroup, start: _Start, emit: Callable[[Chunk], None]
    ) -> None:
        self._group, self._velocity, self._emit = group, start.velocity, emit
        cases, size = start.u.shape
        length = window_length(cases, size) + _KEPT
        self._window, self._observed = np.zeros((2, length, cases, size))
        self._window[1], self._window[2] = start.before, start.u
        self._first_step, self._filled = -2, _KEPT  # the step in row 0, rows in use
        self._outputs, self._done = group.outputs, 0
        self._chunk: DifferenceChunk | None = None

    @property
    def last(self) -> Float64:
        """(3, c, n) displacements at the last three steps."""
        return self._window[self._filled - _KEPT : self._filled]

    def next_rows(self) -> tuple[Float64, Float64, Float64]:
        """u(n-1), u(n), and the row for u(n+1)."""
        if self._filled == len(self._window):
            self.hand_out()
            last = self.last
            self._window, self._observed = self._observed, self._window
            self._window[:_KEPT] = last
            self._first_step += self._filled - _KEPT
            self._filled = _KEPT
        self._filled += 1
        before, u, out = self.last
        return before, u, out

    def hand_out(self) -> None:
        """Hand out the outputs that have both neighbours.

        The window that was handed out before is free afterwards, see `Beside`.
        """
        group, done = self._group, self._done
        end = self._first_step + self._filled - 1
        ready = int(np.searchsorted(self._outputs, end))
        if ready == done:
            self._chunk = None
            return
        steps = self._outputs[done:ready]
        self._chunk = DifferenceChunk(
            group.first_output + done,
            group.time(steps),
            self._window[: self._filled],
            steps - self._first_step,
            group.step,
            self._velocity if done == 0 else None,
            None if self._chunk is None else (self._chunk, _KEPT),
        )
        self._done = ready
        self._emit(self._chunk)

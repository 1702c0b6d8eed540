"""The generalised-alpha method: second order, with chosen damping of high frequencies.

    M a(n+1-αm) + B v(n+1-αf) + K u(n+1-αf) = P(n+1-αf)

with Newmark's β and γ. rho_inf is the spectral radius at infinite frequency: 1 keeps
all energy, 0 annihilates the highest modes in one step.

Solved for a(n+1) with S = μ M + ν B' + σ K. As in Nastran's scheme here, the products
with K are expressed by S, so that a step costs one solve and products with M and B'.

Reference: J. Chung, G. M. Hulbert, "A time integration algorithm for structural
dynamics with improved numerical dissipation", J. Appl. Mech. 60, 1993.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fem.algebra.linear_solver import Factorization
from fem.arrays import Float64
from fem.response.observation import Chunk, Quantity, StateChunk
from fem.response.system import TransientLoad, TransientSystem
from fem.response.time_grid import StepGroup, window_length

# Share of K that makes a singular mass matrix definite when the start is computed.
_START_STIFFNESS = 1e-10


@dataclass(frozen=True)
class GeneralizedAlpha:
    """Scheme of Chung and Hulbert.

    Attributes:
        rho_inf: spectral radius at infinite frequency, 0 to 1.
    """

    rho_inf: float = 0.8

    def __post_init__(self) -> None:
        if not 0.0 <= self.rho_inf <= 1.0:
            raise ValueError(f"rho_inf is {self.rho_inf}, expected 0 to 1")

    @property
    def parameters(self) -> tuple[float, float, float, float]:
        """αm, αf, β, γ."""
        alpha_m = (2.0 * self.rho_inf - 1.0) / (self.rho_inf + 1.0)
        alpha_f = self.rho_inf / (self.rho_inf + 1.0)
        beta = 0.25 * (1.0 - alpha_m + alpha_f) ** 2
        return alpha_m, alpha_f, beta, 0.5 - alpha_m + alpha_f

    def matrix_factors(
        self, system: TransientSystem, h: float
    ) -> tuple[float, float, float]:
        """Factors σ, μ, ν of K, M and B' in the matrix of one step."""
        alpha_m, alpha_f, beta, gamma = self.parameters
        damping = (1.0 - alpha_f) * gamma * h
        return (
            (1.0 - alpha_f) * beta * h * h + damping * system.damping.stiffness_factor,
            1.0 - alpha_m + damping * system.damping.mass_factor,
            damping,
        )

    def working_vectors(self, cases: int, size: int) -> int:
        """Vectors per load case that are in memory at a time."""
        return 6 * window_length(cases, size) + 8

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
        u, v = u0.copy(), v0.copy()
        a = _initial_acceleration(system, load, u, v, groups[0].step)
        for group in groups:
            factors = _factors(load, group, len(u))
            sigma, mu, nu = self.matrix_factors(system, group.step)
            a_old = a
            with system.factorize(sigma, mu, nu, len(u)) as factor:
                announce(factor)
                sink = _Sink(group, emit, *u.shape)
                for n in range(group.count):
                    a_new = self._acceleration(
                        system, factor, group.step, (u, v, a), factors[n : n + 2]
                    )
                    given = n == 0 and group is groups[0]
                    sink.take(n, u, v, a if given else self._on_time(a, a_new))
                    u, v = self._advance(group.step, u, v, a, a_new)
                    a_old, a = a, a_new
                    tick()
                if group.last:
                    sink.take(group.count, u, v, 2.0 * a - self._on_time(a, a_old))
                sink.flush()

    def _on_time(self, a: Float64, neighbour: Float64) -> Float64:
        """Acceleration at t(n) from a(n) and a(n+1).

        The method's a(n) belongs to the time t(n) + (αm - αf) h; taken at t(n) it would
        be accurate to first order only.
        """
        alpha_m, alpha_f, _, _ = self.parameters
        return a + (alpha_f - alpha_m) * (neighbour - a)

    def _advance(
        self, h: float, u: Float64, v: Float64, a: Float64, a_new: Float64
    ) -> tuple[Float64, Float64]:
        """Newmark's formulas."""
        _, _, beta, gamma = self.parameters
        u = u + h * v + h * h * ((0.5 - beta) * a + beta * a_new)
        return u, v + h * ((1.0 - gamma) * a + gamma * a_new)

    def _acceleration(
        self,
        system: TransientSystem,
        factor: Factorization,
        h: float,
        state: tuple[Float64, Float64, Float64],
        factors: Float64,
    ) -> Float64:
        """a(n+1) from the balance at the intermediate time.

        x and y are displacement and velocity there without the part of a(n+1). With
        B = k K + m M + B', K (x + k y) = σ K z = S z - μ M z - ν B' z: solved for
        a(n+1) + z, the balance has products with M and B' alone.
        """
        alpha_m, alpha_f, beta, gamma = self.parameters
        sigma, mu, nu = self.matrix_factors(system, h)
        u, v, a = state
        x = u + (1.0 - alpha_f) * (h * v + h * h * (0.5 - beta) * a)
        y = v + (1.0 - alpha_f) * h * (1.0 - gamma) * a
        z = (x + system.damping.stiffness_factor * y) / sigma
        right = system.mass_product.dot(
            mu * z - alpha_m * a - system.damping.mass_factor * y
        )
        system.add_other(right, 1.0, nu * z - y)
        system.add_load(right, (1.0 - alpha_f) * factors[1] + alpha_f * factors[0])
        return factor.solve(right.T).T - z


def _factors(load: TransientLoad | None, group: StepGroup, cases: int) -> Float64:
    """Load factors (steps + 1, c, k)."""
    time = group.time(np.arange(group.count + 1))
    if load is None:
        return np.zeros((len(time), cases, 0))
    values = load.factors(time)
    return np.moveaxis(np.broadcast_to(values, (cases, *values.shape[1:])), -1, 0)


def _initial_acceleration(
    system: TransientSystem,
    load: TransientLoad | None,
    u: Float64,
    v: Float64,
    h: float,
) -> Float64:
    """a(0) of the equation of motion.

    M may be singular: forces on massless freedoms are left out, and a trace of K lets
    these freedoms follow their neighbors.
    """
    right = -system.stiffness_times(u) - system.damping_times(v)
    if load is not None:
        factors = load.factors(np.zeros(1))[:, :, 0]
        system.add_load(right, np.broadcast_to(factors, (len(u), factors.shape[1])))
    if not right.any():
        return right
    right[:, system.mass.diagonal() == 0.0] = 0.0
    with system.factorize(_START_STIFFNESS * h * h, 1.0, 0.0) as factor:
        return factor.solve(right.T).T


class _Sink:
    """Collects the output steps of one group into chunks."""

    def __init__(
        self, group: StepGroup, emit: Callable[[Chunk], None], cases: int, size: int
    ) -> None:
        self._group = group
        self._emit = emit
        self._wanted = set(group.outputs.tolist())
        # One set is observed while the other is filled.
        shape = (3, window_length(cases, size), cases, size)
        self._arrays, self._observed = np.zeros(shape), np.zeros(shape)
        self._steps: list[int] = []
        self._done = 0

    def take(self, step: int, u: Float64, v: Float64, a: Float64) -> None:
        if step not in self._wanted:
            return
        at = len(self._steps)
        self._arrays[0, at], self._arrays[1, at], self._arrays[2, at] = u, v, a
        self._steps.append(step)
        if len(self._steps) == self._arrays.shape[1]:
            self.flush()

    def flush(self) -> None:
        if not self._steps:
            return
        m = len(self._steps)
        arrays: dict[Quantity, npt.NDArray[np.float64]] = {
            "displacement": self._arrays[0, :m],
            "velocity": self._arrays[1, :m],
            "acceleration": self._arrays[2, :m],
        }
        first = self._group.first_output + self._done
        self._emit(StateChunk(first, self._group.time(self._steps), arrays))
        self._arrays, self._observed = self._observed, self._arrays
        self._done += m
        self._steps = []

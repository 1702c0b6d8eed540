"""Constrained freedoms that move in a transient: TLOAD1, TLOAD2 by DISP, VELO, ACCE.

With u = T u_f + Psi s(t) the free set moves under

    -T^T (M Psi s'' + B Psi s' + K Psi s)

beside its loads. In a direct transient Psi leaves the free freedoms at rest, in modes
it is the static response to the motion (then T^T K Psi = 0), as in frequency responses.
At the steps s is exact for accelerations and velocities that are linear between them;
derivatives of displacements are central differences, as those of the scheme.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from fem.algebra.sparse_products import shape_of
from fem.arrays import Float64
from fem.loads import EnforcedMotion
from fem.model.structure import Structure
from fem.response.observation import QUANTITIES, Chunk, Observer, Quantity
from fem.response.system import TransientLoad
from fem.response.time_grid import step_groups
from fem.solution.analysis_model import AnalysisModel
from fem.solution.enforced_motion import moved_shape, unseen_motion
from fem.solution.options import Options


@dataclass(frozen=True, kw_only=True)
class MovingBase:
    """Motions Psi s(t) of the g-set, for load cases that are solved together.

    Attributes:
        shape: (g, m) Psi.
        case: (m,) load case of each motion.
        cases: number of load cases.
        time: (t,) all steps, and one beyond the last.
        history: (3, m, t) s, s' and s''.
    """

    shape: sp.csr_matrix
    case: tuple[int, ...]
    cases: int
    time: Float64
    history: Float64

    def at(self, time: Float64) -> Float64:
        """(3, c, m, t) s and its derivatives."""
        found = np.zeros((3, self.cases, len(self.case), len(time)))
        for k, case in enumerate(self.case):
            for order in range(3):
                found[order, case, k] = np.interp(
                    time, self.time, self.history[order, k]
                )
        return found

    def loaded(
        self, load: TransientLoad, model: Structure, reduced: AnalysisModel
    ) -> TransientLoad:
        """Loads of the free set (n, k) with those that the motion is."""
        matrices = model.matrices
        damping = model.damping_g.matrix(matrices.stiffness, matrices.mass)
        own = [
            -reduced.load(sp.csr_matrix(matrix @ self.shape))
            for matrix in (matrices.stiffness, damping, matrices.mass)
        ]

        def evaluate(time: Float64) -> Float64:
            given = load.factors(time)
            given = np.broadcast_to(given, (self.cases, *given.shape[1:]))
            return np.concatenate([given, *self.at(time)], axis=1)

        return TransientLoad(sp.csr_matrix(sp.hstack([load.pattern, *own])), evaluate)

    def expand(self, reduced: AnalysisModel) -> sp.csr_matrix:
        """(g, n + m) the g-set from what is integrated and the motions."""
        return sp.csr_matrix(sp.hstack([reduced.expand, self.shape]))

    def seen_by(self, observers: Sequence[Observer]) -> list[Observer]:
        """Observers whose operators go by `expand`."""
        return [_Moved(observer, self) for observer in observers]


class _Moved:
    """An observer of the free set and the motions; see `Observer`."""

    def __init__(self, observer: Observer, base: MovingBase) -> None:
        self._observer, self._base = observer, base
        self._moved = np.zeros((3, 0, 0, 0))
        self._parts: dict[int, tuple[sp.csr_matrix, sp.csr_matrix, sp.csr_matrix]] = {}

    def begin(self, time: Float64, cases: int, size: int) -> None:
        """Motions at all output times."""
        self._moved = self._base.at(time)
        self._observer.begin(time, cases, size + len(self._base.case))

    def observe(self, chunk: Chunk) -> None:
        """Hand the chunk on with the motions."""
        at = slice(chunk.first, chunk.first + len(chunk.time))
        moved = self._moved[..., at]
        self._observer.observe(_MovedChunk(chunk, moved, self._parts))

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """Memory of the observer."""
        return self._observer.memory_bytes(times, cases, size + len(self._base.case))


class _MovedChunk:
    """A chunk with motions (3, c, m, t) behind its freedoms; see `Chunk`."""

    def __init__(self, chunk: Chunk, moved: Float64, parts: dict) -> None:
        self.first, self.time = chunk.first, chunk.time
        self._chunk, self._moved, self._parts = chunk, moved, parts

    def get(self, quantity: Quantity, operator: sp.csr_matrix | None = None) -> Float64:
        """Response through an operator (r, n + m)."""
        moved = np.moveaxis(self._moved[QUANTITIES.index(quantity)], -1, 0)
        if operator is None:
            return np.concatenate([self._chunk.get(quantity), moved], axis=2)
        if id(operator) not in self._parts:
            n = shape_of(operator)[1] - moved.shape[2]
            own, rest = sp.csr_matrix(operator[:, :n]), sp.csr_matrix(operator[:, n:])
            self._parts[id(operator)] = operator, own, rest
        _, own, rest = self._parts[id(operator)]
        return self._chunk.get(quantity, own) + moved @ rest.T.toarray()


def moving_base(
    model: Structure,
    motions: Sequence[Sequence[EnforcedMotion]],
    steps: Sequence[tuple[int, float, int]],
) -> MovingBase | None:
    """Motions of all load cases; None: nothing moves.

    Args:
        model: with the SPC that hold what is moved.
        motions: of each load case.
        steps: rows (count, step in s, output stride).

    Raises:
        InputError: freedoms are moved that no SPC holds.
    """
    listed = [(i, motion) for i, own in enumerate(motions) for motion in own]
    if not listed:
        return None
    patterns = np.stack([motion.pattern for _, motion in listed], axis=1)
    shape = moved_shape(model, sp.csr_matrix(patterns))
    if shape is None:
        return None
    groups = step_groups(steps)
    time = [group.time(np.arange(group.count)) for group in groups]
    time.append(groups[-1].time([groups[-1].count, groups[-1].count + 1]))
    nodes = np.concatenate(time)
    return MovingBase(
        shape=shape,
        case=tuple(i for i, _ in listed),
        cases=len(motions),
        time=nodes,
        history=np.stack([_history(motion, nodes) for _, motion in listed], axis=1),
    )


def with_base(
    base: MovingBase | None,
    model: Structure,
    reduced: AnalysisModel,
    load_g: TransientLoad,
) -> tuple[TransientLoad, sp.csr_matrix]:
    """Loads of the free set, and how the g-set follows what observers see."""
    load = TransientLoad(reduced.load(load_g.pattern), load_g.evaluate)
    if base is None:
        return load, reduced.expand
    return base.loaded(load, model, reduced), base.expand(reduced)


def say_of_motion(
    model: Structure, motions: Sequence[Sequence[EnforcedMotion]], options: Options
) -> None:
    """Says that PARAM,ENFMOTN,REL is not followed, and what direct input leaves out."""
    patterns = [motion.pattern for own in motions for motion in own]
    if not patterns:
        return
    if notice := unseen_motion(model, sp.csr_matrix(np.stack(patterns, axis=1))):
        options.console.say(f"warning: {notice}")
    if str(model.deck.param("ENFMOTN")).upper().startswith("REL"):
        options.console.say(
            "warning: PARAM,ENFMOTN,REL asks for motions relative to the base; those "
            "written here are absolute"
        )


def _history(motion: EnforcedMotion, time: Float64) -> Float64:
    """(3, t) displacement, velocity, acceleration at the steps."""
    given = motion.function(time)
    h = np.diff(time)
    u0, v0 = motion.start
    if motion.order == 0:
        return np.stack([given, *_differences(given, time)])
    if motion.order == 1:
        moved = u0 + _sum(0.5 * h * (given[1:] + given[:-1]))
        return np.stack([moved, given, _differences(given, time)[0]])
    velocity = v0 + _sum(0.5 * h * (given[1:] + given[:-1]))
    part = h * velocity[:-1] + h * h * (2.0 * given[:-1] + given[1:]) / 6.0
    return np.stack([u0 + _sum(part), velocity, given])


def _sum(parts: Float64) -> Float64:
    return np.concatenate([[0.0], np.cumsum(parts)])


def _differences(value: Float64, time: Float64) -> tuple[Float64, Float64]:
    """First and second derivatives at unequal steps; at the ends those beside them."""
    h = np.diff(time)
    slope = np.diff(value) / h
    first = (h[:-1] * slope[1:] + h[1:] * slope[:-1]) / (h[:-1] + h[1:])
    second = 2.0 * np.diff(slope) / (h[:-1] + h[1:])
    ends = np.concatenate([[slope[0]], first, [slope[-1]]])
    return ends, np.concatenate([second[:1], second, second[-1:]])

"""Which elastic modes matter for what the monitoring points feel in a landing.

A mode matters if gear pulses excite it and a monitoring point sees it. With q_i(t) the
modal accelerations under the expected pulses (`pulses`), computed exactly for pulses
that are linear between samples, and φ_pi the shapes at output p, the acceleration that
a set C of left-out modes takes away from output p has the mean square

    e_p² = Σ_{i,j in C} φ_pi φ_pj G_ij,    G_ij = mean of q_i q_j over time,

interference of close modes included. Modes are left out one by one, each time the one
that costs least; the order in which they go, reversed, is the order of relevance. A
measure of the fourth power keeps the worst point in view. The same sums tell the
truncation error of any set of modes before a landing is run.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.oscillators import modal_accelerations
from drake_landing.airframe.pulses import GearPulses

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class ModalModel:
    """Rigid and elastic modes, mass-normalised, as a landing excites and sees them.

    Attributes:
        frequency_hz: (n,); 0 for rigid-body modes.
        damping: (n,) φᵀ B φ of each mode, 1/s.
        monitor: (p, 3, n) shapes of the monitoring points.
        attachment: node -> (6, n) shapes of an attachment node.
    """

    frequency_hz: Float64
    damping: Float64
    monitor: Float64
    attachment: Mapping[int, Float64]

    @property
    def elastic(self) -> Mask:
        """(n,)"""
        return np.asarray(self.frequency_hz > 0.0)

    def of(self, modes: Int64) -> "ModalModel":
        """Some of the modes."""
        return ModalModel(
            frequency_hz=self.frequency_hz[modes],
            damping=self.damping[modes],
            monitor=self.monitor[:, :, modes],
            attachment={n: shape[:, modes] for n, shape in self.attachment.items()},
        )

    def with_more(self, other: "ModalModel") -> "ModalModel":
        """These modes and the elastic ones of another model of the same structure."""
        more = other.elastic

        def joined(a: Float64, b: Float64) -> Float64:
            return np.concatenate([a, b[..., more]], axis=-1)

        return ModalModel(
            frequency_hz=joined(self.frequency_hz, other.frequency_hz),
            damping=joined(self.damping, other.damping),
            monitor=joined(self.monitor, other.monitor),
            attachment={
                node: joined(shape, other.attachment[node])
                for node, shape in self.attachment.items()
            },
        )

    def mixed(self, frequency_hz: Float64, mix: Float64) -> "ModalModel":
        """Rigid-body modes and combinations of the elastic ones.

        Args:
            frequency_hz: (k,) of the combinations.
            mix: (e, k) orthonormal, shapes are elastic modes times mix.
        """
        rigid, elastic = ~self.elastic, self.elastic

        def turned(shape: Float64) -> Float64:
            return np.concatenate(
                [shape[..., rigid], shape[..., elastic] @ mix], axis=-1
            )

        damping = np.einsum("ek,e,ek->k", mix, self.damping[elastic], mix)
        return ModalModel(
            frequency_hz=np.concatenate([self.frequency_hz[rigid], frequency_hz]),
            damping=np.concatenate([self.damping[rigid], damping]),
            monitor=turned(self.monitor),
            attachment={n: turned(shape) for n, shape in self.attachment.items()},
        )


@dataclass(frozen=True, kw_only=True)
class Relevance:
    """Modes of a model in the order of their relevance, with what leaving out costs.

    Attributes:
        points: names of the monitoring points.
        elastic: (m,) positions of the candidate elastic modes in the model.
        order: (m,) positions in the model, most relevant first.
        gram: (n, n) G of the modal accelerations under all pulses together.
        monitor: (p, 3, n) shapes of the monitoring points.
    """

    points: tuple[str, ...]
    elastic: Int64
    order: Int64
    gram: Float64
    monitor: Float64

    @classmethod
    def rank(
        cls, model: ModalModel, points: Sequence[str], pulses: Sequence[GearPulses]
    ) -> "Relevance":
        """Ranks all elastic modes of a model.

        Args:
            model: its rigid-body modes and candidates.
            points: names, in the order of `model.monitor`.
            pulses: of all gears.
        """
        single = [modal_pulse(model, [pulse]) for pulse in pulses]
        together = _gram(np.sum(single, axis=0))
        # Gears that touch down at other instants than expected interfere otherwise:
        # the pulses one by one have a say, too.
        apart = np.sum([_gram(a) for a in single], axis=0)
        blank = cls(
            points=tuple(points),
            elastic=np.flatnonzero(model.elastic),
            order=np.zeros(0, dtype=np.int64),
            gram=together,
            monitor=model.monitor,
        )
        order = blank._ranked([together, apart])
        return cls(**{**vars(blank), "order": order})

    @cached_property
    def size(self) -> Float64:
        """(p,) root mean square of each point's acceleration, all modes, m/s²."""
        return self._rms(self.gram, np.ones(len(self.gram), bool))

    def error(self, modes: Int64) -> Float64:
        """Expected truncation error of a set of elastic modes.

        Args:
            modes: (k,) positions in the model.

        Returns:
            (p,) rms of what is missing over the rms of the acceleration, each of the
            vector, of each monitoring point.
        """
        return self._rms(self.gram, self._missing(modes)) / self.size

    def count_for(self, error: float) -> int:
        """Least number of most relevant modes with an expected error, at every point.

        All candidates if even they do not reach it.
        """
        low, high = 0, len(self.order)
        while low < high:
            middle = (low + high) // 2
            if self.error(self.order[:middle]).max() <= error:
                high = middle
            else:
                low = middle + 1
        return low

    def _missing(self, modes: Int64) -> Mask:
        missing = np.zeros(len(self.gram), bool)
        missing[self.elastic] = True
        missing[modes] = False
        return missing

    def _mean_square(self, gram: Float64, these: Mask) -> Float64:
        """(p, 3)"""
        shape = self.monitor[:, :, these]
        part = gram[np.ix_(these, these)]
        return np.maximum(np.einsum("pai,ij,paj->pa", shape, part, shape), 0.0)

    def _rms(self, gram: Float64, these: Mask) -> Float64:
        return np.sqrt(self._mean_square(gram, these).sum(axis=1))

    def _ranked(self, grams: Sequence[Float64]) -> Int64:
        """Backward elimination."""
        n = len(self.gram)
        every = np.ones(n, bool)
        shape = self.monitor.reshape(-1, n)
        states = [
            _Elimination(
                shape, gram, np.repeat(self._mean_square(gram, every).sum(1), 3)
            )
            for gram in grams
        ]
        alive = np.zeros(n, bool)
        alive[self.elastic] = True
        order = np.empty(len(self.elastic), dtype=np.int64)
        for place in range(len(order) - 1, -1, -1):
            cost = np.sum([state.cost() for state in states], axis=0)
            cost[~alive] = np.inf
            gone = int(np.argmin(cost))
            for state in states:
                state.leave_out(gone)
            alive[gone] = False
            order[place] = gone
        return order


class _Elimination:
    """Mean square of what is missing at each output, as modes are left out.

    Args:
        shape: (o, n) modes at the outputs.
        gram: (n, n).
        scale: (o,) mean square that the outputs are compared with.
    """

    def __init__(self, shape: Float64, gram: Float64, scale: Float64) -> None:
        self._shape, self._gram, self._scale = shape, gram, scale[:, None]
        self._own = shape**2 * np.diag(gram)
        self._with_missing = np.zeros_like(shape)
        self._missing = np.zeros((len(shape), 1))

    def _next(self) -> Float64:
        """(o, n) mean square if mode n went, too."""
        return self._missing + self._own + 2.0 * self._with_missing

    def cost(self) -> Float64:
        """(n,) fourth power of the errors, summed over the points."""
        per_output = self._next() / self._scale
        per_point = per_output.reshape(-1, 3, per_output.shape[1]).sum(axis=1)
        return (per_point**2).sum(axis=0)

    def leave_out(self, mode: int) -> None:
        self._missing = self._next()[:, [mode]]
        self._with_missing += self._shape * self._shape[:, [mode]] * self._gram[mode]


def modal_pulse(model: ModalModel, pulses: Sequence[GearPulses]) -> Float64:
    """(t, n) modal accelerations under pulses."""
    force = np.sum(
        [
            load @ model.attachment[int(node)]
            for pulse in pulses
            for node, load in zip(pulse.node_id, pulse.load)
        ],
        axis=0,
    )
    return modal_accelerations(model.frequency_hz, model.damping, force, pulses[0].step)


def response(model: ModalModel, pulses: Sequence[GearPulses]) -> Float64:
    """(t, p, 3) accelerations of the monitoring points under all pulses together."""
    return np.einsum(
        "tn,pan->tpa", modal_pulse(model, pulses), model.monitor, optimize=True
    )


def _gram(accelerations: Float64) -> Float64:
    return accelerations.T @ accelerations / len(accelerations)

"""Modes made for gear pulses: few shapes that move as the gears make the airframe move.

Eigenmodes are shapes of the free structure; a gear excites hundreds of them a little.
Here the candidates are combined instead of picked: the motions that the pulses cause,
one kind of load after the other, in time and at a comb of frequencies, span a space
whose most energetic directions (singular vectors, kinetic energy as the measure) are a
Galerkin basis. Made diagonal again, it is a modal body like any other: shapes
orthogonal to rigid motions, frequencies within those of the candidates, so that an
explicit integrator meets nothing stiffer than they are.

The comb weighs frequencies as a sudden load does, by 1/f. It keeps the space from
depending on the very instants of the pulses.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.pulses import GearPulses
from drake_landing.airframe.relevance import ModalModel, modal_pulse

Float64 = npt.NDArray[np.float64]

# Hz: fine where modes are lightly damped, coarser above.
_COMB = np.concatenate([np.linspace(1.0, 60.0, 90), np.linspace(61.5, 200.0, 90)])
# Kinds of load: drag and side force with their moments, vertical force, moments alone.
_KINDS = ((0, 4, 5), (1, 3, 5), (2,), (3, 4, 5))


def pulse_directions(model: ModalModel, pulses: Sequence[GearPulses]) -> Float64:
    """Directions of the candidates' motion under gear pulses, most energetic first.

    Args:
        model: rigid-body modes and n candidates.
        pulses: of all gears.

    Returns:
        (n, n) orthonormal columns: combinations of the candidates.
    """
    elastic = model.elastic
    kinds = [_only(pulse, kind) for pulse in pulses for kind in _KINDS]
    kinds = [kind for kind in kinds if kind.load.any()]
    in_time = np.vstack([modal_pulse(model, [kind])[:, elastic] for kind in kinds])
    at_comb = np.vstack([_comb_response(model, kind) for kind in kinds])
    samples = np.vstack([in_time / _size(in_time), at_comb / _size(at_comb)])
    # Right singular vectors from the small Gram matrix; few are wanted.
    _, vectors = np.linalg.eigh(samples.T @ samples)
    return np.asarray(vectors[:, ::-1], dtype=np.float64)


def galerkin_modes(model: ModalModel, directions: Float64) -> tuple[Float64, Float64]:
    """The modes of a model that moves in some directions only.

    Args:
        model: rigid-body modes and n candidates.
        directions: (n, k) orthonormal columns.

    Returns:
        Frequencies (k,), Hz, ascending; and mix (n, k), orthonormal columns: shapes are
        candidates (elastic ones of the model) times mix.
    """
    omega2 = (2.0 * np.pi * model.frequency_hz[model.elastic]) ** 2
    values, turn = np.linalg.eigh(directions.T @ (omega2[:, None] * directions))
    mix = np.asarray(directions @ turn, dtype=np.float64)
    return np.sqrt(values) / (2.0 * np.pi), mix


def _size(samples: Float64) -> float:
    return float(np.linalg.norm(samples)) or 1.0


def _only(pulse: GearPulses, components: Sequence[int]) -> GearPulses:
    load = np.zeros_like(pulse.load)
    load[:, :, components] = pulse.load[:, :, components]
    return replace(pulse, load=load)


def _comb_response(model: ModalModel, pulse: GearPulses) -> Float64:
    """(2 c, n) real and imaginary accelerations at the frequencies of the comb."""
    elastic = model.elastic
    omega2 = (2.0 * np.pi * model.frequency_hz[elastic]) ** 2
    damping = model.damping[elastic]
    rows = []
    for part in _patterns(model, pulse):
        w = (2.0 * np.pi * _COMB)[:, None]
        answer = -(w**2) / (omega2 + 1j * w * damping - w**2) / _COMB[:, None]
        rows += [answer.real * part, answer.imag * part]
    return np.vstack(rows)


def _patterns(model: ModalModel, pulse: GearPulses) -> list[Float64]:
    """Modal forces of each component at its largest, gears of the pulse together."""
    patterns = []
    for component in range(6):
        largest = np.abs(pulse.load[:, :, component]).max(axis=1)
        if not largest.any():
            continue
        at = np.abs(pulse.load[:, :, component]).argmax(axis=1)
        force = sum(
            pulse.load[k, at[k], component] * model.attachment[int(node)][component]
            for k, node in enumerate(pulse.node_id)
        )
        patterns.append(np.asarray(force)[model.elastic])
    return patterns

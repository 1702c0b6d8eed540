"""What the modes that are left out cost, and what choice would cost little.

Accelerations: the response to the gears' expected pulses of the modes that are in,
against that of all shapes that gear loads excite; rms of what is missing over rms.

Gear loads: the modes left out answer loads at the attachments almost statically. Their
share of the flexibility there, ΔC = Σ φ φᵀ/ω² of all less that of the modes that are
in, lets an attachment yield by ΔC F too little. A gear that closes by s (stroke and
tire) under its load F_g meets an airframe that is closer by that much: to first order
its load is wrong by ΔC F · F_g/s. That is a share ΔC F / s of its own load, which says
nothing where a gear is hardly loaded (both are nought for a nose gear in the air): the
error is taken over the gear's load, or over a tenth of the largest where that is more.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.pulses import GearPulses
from drake_landing.airframe.relevance import ModalModel, response

Float64 = npt.NDArray[np.float64]

WANTED = 0.05
_LEAST_LOAD = 0.1  # of the largest load of a gear
_LEAST_HZ = 0.5  # below it a shape is no vibration but rounding


def point_errors(
    all_shapes: ModalModel, chosen: ModalModel, pulses: Sequence[GearPulses]
) -> Float64:
    """(p,) expected error at the monitoring points, rms of the vector over rms."""
    whole = response(all_shapes, pulses)
    missing = response(chosen, pulses) - whole
    return np.sqrt((missing**2).sum((0, 2)) / (whole**2).sum((0, 2)))


def frequency_for(all_shapes: ModalModel, pulses: Sequence[GearPulses]) -> float | None:
    """Frequency (Hz, rounded up) below which all modes keep the error at all points.

    The error is `WANTED`.

    None: even all shapes but the highest do not.
    """
    elastic = np.unique(np.ceil(all_shapes.frequency_hz[all_shapes.elastic] / 5) * 5)
    low, high = 0, len(elastic)
    while low < high:
        middle = (low + high) // 2
        if (
            point_errors(all_shapes, below(all_shapes, elastic[middle]), pulses).max()
            <= WANTED
        ):
            high = middle
        else:
            low = middle + 1
    return float(elastic[low]) if low < len(elastic) - 1 else None


def below(model: ModalModel, hz: float) -> ModalModel:
    """Rigid-body modes and those below a frequency."""
    return model.of(np.flatnonzero(model.frequency_hz < hz))


def load_errors(
    all_shapes: ModalModel,
    chosen: ModalModel,
    loads: dict[int, Float64],
    closing: dict[int, float],
    largest: dict[int, float],
) -> dict[int, float]:
    """Expected error of the vertical gear loads, over the load.

    Args:
        all_shapes, chosen: at all attachment nodes, B.
        loads: node -> (t, 6) force and moment on the airframe, B.
        closing: node of a gear -> largest closure of stroke and tire along `up`, m.
        largest: node of a gear -> its largest vertical load, N; 0: it never touches.

    Returns:
        Node of a gear that touches -> share of its load, or of a tenth of the largest.
    """
    nodes = [n for n in loads if n in all_shapes.attachment]
    missing = _flexibility(all_shapes, nodes) - _flexibility(chosen, nodes)
    load = np.hstack([loads[n] for n in nodes])
    yielded = (load @ missing.T).reshape(len(load), len(nodes), 6)
    least = _LEAST_LOAD * max(largest.values(), default=0.0)
    found = {}
    for node, s in closing.items():
        if largest[node] <= 0.0 or s <= 0.0:
            continue
        motion = np.linalg.norm(yielded[:, nodes.index(node), :3], axis=1)
        found[node] = float(motion.max() / s) * min(largest[node] / least, 1.0)
    return found


def _flexibility(model: ModalModel, nodes: Sequence[int]) -> Float64:
    """(6 k, 6 k) of the elastic modes."""
    counts = model.frequency_hz > _LEAST_HZ
    shape = np.vstack([model.attachment[n] for n in nodes])[:, counts]
    return (shape / (2.0 * np.pi * model.frequency_hz[counts]) ** 2) @ shape.T

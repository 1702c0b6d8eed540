"""When a landing has shown its extremes: how long a run goes on.

A swing is the period of the lowest elastic mode. An extreme of a quantity is late if it
falls in the last swing and exceeds what came before: a longer run might find more. A
landing has settled when nothing that is logged has a late extreme and no wheel is on
its way down to the runway.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from pydrake.systems.framework import Context

from drake_landing.landing.diagram import LandingDiagram

Float64 = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

LIMIT = 5.0  # s, of a run that ends by itself
_LEAST = 0.3  # s
_SHORTEST, _LONGEST = 0.1, 1.0  # s, of a swing
_GAIN = 0.01  # by which an extreme must exceed what came before
_SMALL = 0.05  # of the largest of its kind: smaller ones do not count


@dataclass(frozen=True, kw_only=True)
class Settling:
    """How a run finds its own end.

    Attributes:
        swing: s.
        at_least: s.
    """

    swing: float
    at_least: float = 0.0

    @property
    def first(self) -> float:
        """When it is looked for the first time, s."""
        return min(max(self.at_least, 2.0 * self.swing, _LEAST), LIMIT)


def swing_of(lowest_hz: float) -> float:
    """Period of the lowest elastic mode within sensible bounds, s."""
    period = 1.0 / lowest_hz if lowest_hz > 0.0 else 0.0
    return float(np.clip(period, _SHORTEST, _LONGEST))


def late(time: Float64, values: Float64, swing: float) -> Mask:
    """Which of several histories of one kind have an extreme in the last swing.

    Args:
        time: (t,) s, ascending.
        values: (t, k); those far below the largest do not count.
        swing: s.

    Returns:
        (k,)
    """
    last = time > time[-1] - swing
    if last.all() or not values.size:
        return np.ones(values.shape[1], bool)
    counts = np.abs(values).max(axis=0) > _SMALL * np.abs(values).max()
    found = np.zeros(values.shape[1], bool)
    size = np.abs(values).max(axis=0)
    for sign in (1.0, -1.0):
        before = (sign * values[~last]).max(axis=0)
        after = (sign * values[last]).max(axis=0)
        # The lesser of the two extremes counts where it is of any size.
        found |= (after > before + _GAIN * size) & (after > _SMALL * size)
    return counts & found


def has_settled(landing: LandingDiagram, context: Context, swing: float) -> bool:
    """Whether the logs up to now show a landing that is over."""
    time = landing.loggers["plant.state"].FindLog(context).sample_times()
    for values in _kinds(landing, context):
        if values.size and late(time, values, swing).any():
            return False
    return not _comes_down(landing, context, time, swing)


def _kinds(landing: LandingDiagram, context: Context) -> Iterator[Float64]:
    """(t, k) histories, kind by kind."""

    def signal(port: str) -> Float64:
        return landing.loggers[port].FindLog(context).data().T

    loads = signal("attachment.load_in_airframe_axes")
    loads = (loads - loads[0]).reshape(len(loads), -1, 2, 3)
    points = signal("airframe.monitor_acceleration").reshape(len(loads), -1, 2, 3)
    for part in (loads[:, :, 0], loads[:, :, 1], points[:, :, 0]):
        yield part.reshape(len(loads), -1)
    yield signal("airframe.modal_amplitudes")
    struts = [signal(f"strut_{g.name}.strut")[:, :1] for g in landing.gears]
    yield np.hstack(struts)


def _comes_down(
    landing: LandingDiagram, context: Context, time: Float64, swing: float
) -> bool:
    """Whether a wheel in the air will touch within the limit as it now moves."""
    log = landing.loggers["plant.state"].FindLog(context).data().T
    since = int(np.searchsorted(time, time[-1] - swing))
    plant = landing.plant
    own = plant.CreateDefaultContext()

    def heights(state: Float64) -> dict[str, float]:
        plant.SetPositionsAndVelocities(own, state)
        return {
            wheel: plant.EvalBodyPoseInWorld(own, body).translation()[2]
            - gear.tire_of(wheel).radius
            for gear in landing.gears
            for wheel, body in landing.bodies[gear.name].wheels.items()
        }

    before, now = heights(log[since]), heights(log[-1])
    for wheel, height in now.items():
        contact = landing.loggers[f"tire_{wheel}.contact"].FindLog(context).data()
        if contact[0, since:].max() > 0.0:
            continue
        rate = (height - before[wheel]) / (time[-1] - time[since])
        if height + rate * (LIMIT - time[-1]) < 0.0:
            return True
    return False

"""What a time step costs: the peaks that the direct transient will miss, beforehand.

The gears' expected pulses act on the shapes that they excite in the full model. Its
accelerations at the monitoring points come twice: exactly, and by the scheme with the
step of the case, the loads handed over to its grid as the landing's will be. The error
is that of an extreme (the largest or the smallest value of a component) over the peak
of that component.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.pulses import GearPulses
from drake_landing.airframe.relevance import ModalModel, modal_accelerations
from drake_landing.case.schema import Case
from drake_landing.landing.handover import resample, time_grid
from drake_landing.transient.response import SCHEMES
from fem.algebra.damping import Damping
from fem.errors import InputError
from fem.response.direct import direct_transient
from fem.response.observation import Observation
from fem.response.system import sampled_load

Float64 = npt.NDArray[np.float64]

WARNED, REFUSED = 0.02, 0.10  # of the peak
_SMALL = 0.05  # of the largest peak: smaller components do not count
STEPS = (5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5)  # s, that may be proposed


class StepRefused(InputError):
    """The step costs more than the case accepts.

    Attributes:
        found: the expected error.
        explanation: what else there is to say of the case; empty: nothing yet.
    """

    def __init__(
        self, problems: str | Iterable[str], found: "StepError", explanation: str = ""
    ) -> None:
        super().__init__(problems)
        self.found, self.explanation = found, explanation


@dataclass(frozen=True, kw_only=True)
class StepError:
    """Expected error of the extremes that a step causes.

    Attributes:
        step: s.
        error: of the worst component, over its peak.
        where: that component, such as `tip, z`.
        stands_in: the pulses are those of a touchdown, and the aircraft rolls: neither
            warned of nor refused.
        enough: the largest of common steps with an error below `WARNED`, s; the step
            itself where it has; None: none has.
    """

    step: float
    error: float
    where: str
    enough: float | None
    stands_in: bool = False

    def __str__(self) -> str:
        text = (
            f"step of {self.step:g} s: peak accelerations expected to be "
            f"{_percent(self.error)} off ({self.where})"
        )
        if self.stands_in:
            return f"{text} if it touched down; less as it rolls"
        if self.error <= WARNED:
            return text
        if self.enough is None:
            return f"{text}; no step of {STEPS[-1]:g} s or more brings that below 2 %"
        return f"{text}; {self.enough:g} s would bring that below 2 %"

    @property
    def _warns(self) -> bool:
        return self.error > WARNED and not self.stands_in

    @property
    def remarks(self) -> tuple[str, ...]:
        """Where it is worth a warning."""
        return (f"transient.step: a {self}",) if self._warns else ()


def step_error(
    model: ModalModel,
    pulses: Sequence[GearPulses],
    points: Sequence[str],
    step: float,
    scheme: str = "nastran",
) -> StepError:
    """The expected error of a step.

    Args:
        model: rigid-body modes and what the loads excite.
        pulses: of all gears.
        points: names of the monitoring points.
        step: s.
        scheme: a key of `SCHEMES`.
    """
    exact = _exact(model, pulses, min([pulses[0].step, *STEPS]))

    def error(h: float) -> tuple[float, str]:
        return _worst(exact, _by_scheme(model, pulses, h, scheme), points)

    found, where = error(step)
    smaller = (h for h in STEPS if h < step and error(h)[0] <= WARNED)
    enough = step if found <= WARNED else next(smaller, None)
    return StepError(step=step, error=found, where=where, enough=enough)


def expected_step_error(
    case: Case, aircraft: Aircraft, model: ModalModel, pulses: Sequence[GearPulses]
) -> StepError:
    """Of the step of a case.

    Args:
        case: its step and scheme.
        aircraft: of the case.
        model: of `load_model`.
        pulses: of `expected_pulses`.

    Raises:
        StepRefused: it is above `REFUSED` and above what the case accepts.
    """
    found = step_error(
        model,
        pulses,
        list(aircraft.monitoring),
        case.transient.step,
        case.transient.scheme,
    )
    if aircraft.scenario.start != "touchdown":
        return replace(found, stands_in=True)
    accepted = case.transient.accept
    if found.error > max(REFUSED, accepted / 100.0):
        raise StepRefused(
            f"transient.step: found a {found}; expected at most "
            f"{max(100 * REFUSED, accepted):g} %, a smaller step, or 'accept: "
            f"{np.ceil(100 * found.error):.0f}' (%) beside the step",
            found,
        )
    return found


def _percent(share: float) -> str:
    return f"{share:.1%}" if share < 0.1 else f"{share:.0%}"


def _worst(exact: Float64, found: Float64, points: Sequence[str]) -> tuple[float, str]:
    """The largest error of an extreme, and its component; (t, p, 3) each."""
    peak = np.abs(exact).max(axis=0)
    extremes = [np.stack([a.max(axis=0), a.min(axis=0)]) for a in (exact, found)]
    missed = np.abs(extremes[1] - extremes[0]).max(axis=0)
    counts = peak > _SMALL * peak.max()
    error = np.where(counts, missed / np.where(counts, peak, 1.0), 0.0)
    p, axis = np.unravel_index(int(np.argmax(error)), error.shape)
    where = f"{points[p].replace('_', ' ')}, {'xyz'[axis]}"
    return float(error[p, axis]), where


def _force(model: ModalModel, pulses: Sequence[GearPulses]) -> Float64:
    """(t, n) modal forces."""
    loads = [
        load @ model.attachment[int(node)]
        for pulse in pulses
        for node, load in zip(pulse.node_id, pulse.load)
    ]
    return np.sum(loads, axis=0)


def _exact(model: ModalModel, pulses: Sequence[GearPulses], step: float) -> Float64:
    """(t, p, 3) for pulses that are linear between their samples."""
    force = _force(model, pulses)
    h = pulses[0].step
    coarse = h * np.arange(len(force))
    fine = h / max(round(h / step), 1)
    time = fine * np.arange((len(force) - 1) * round(h / fine) + 1)
    between = np.stack([np.interp(time, coarse, f) for f in force.T], axis=1)
    modal = modal_accelerations(model.frequency_hz, model.damping, between, fine)
    return np.einsum("tn,pan->tpa", modal, model.monitor, optimize=True)


def _by_scheme(
    model: ModalModel, pulses: Sequence[GearPulses], step: float, scheme: str
) -> Float64:
    """(t, p, 3) as the direct transient computes them."""
    force, h = _force(model, pulses), pulses[0].step
    coarse = h * np.arange(len(force))
    grid = time_grid(step, float(coarse[-1]))
    loads = resample(coarse, force, grid)
    ahead = np.append(grid, grid[-1] + step * np.array([1.0, 2.0]))
    held = np.concatenate([loads, loads[-1:], loads[-1:]])
    n = len(model.frequency_hz)
    monitor = model.monitor.reshape(-1, n)
    watched = Observation("acceleration", sp.csr_matrix(monitor))
    direct_transient(
        sp.diags_array((2.0 * np.pi * model.frequency_hz) ** 2),
        sp.eye_array(n),
        Damping(other=sp.csr_matrix(sp.diags_array(model.damping))),
        steps=[(len(grid) - 1, step)],
        load=sampled_load(sp.eye_array(n), ahead, held.T),
        observers=[watched],
        scheme=SCHEMES[scheme](),
    )
    return watched.values[:, 0].reshape(len(grid), -1, 3)

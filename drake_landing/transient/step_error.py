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
from drake_landing.airframe.load_shapes import LoadModel
from drake_landing.airframe.oscillators import modal_accelerations
from drake_landing.airframe.pulses import GearPulses
from drake_landing.airframe.relevance import ModalModel
from drake_landing.case.schema import Case
from drake_landing.landing.handover import resample, time_grid
from drake_landing.transient.response import SCHEMES
from drake_landing.transient.step_cause import StepCause, component_at
from fem.algebra.damping import Damping
from fem.errors import InputError
from fem.model.structure import Structure
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
        cause: what most of it comes from; None: it is small.
        about: where `enough` is None, the step that would do by the error's square
            law, s.
        stands_in: the pulses are those of a touchdown, and the aircraft rolls: neither
            warned of nor refused.
        enough: the largest of common steps with an error below `WARNED`, s; the step
            itself where it has; None: none has.
    """

    step: float
    error: float
    where: str
    enough: float | None
    cause: StepCause | None = None
    about: float | None = None
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
        if self.enough is not None:
            return f"{text}; {self.enough:g} s would bring that below 2 %"
        about = f"; about {self.about:.1g} s would" if self.about else ""
        return f"{text}; {STEPS[-1]:g} s does not bring that below 2 %{about}"

    @property
    def _warns(self) -> bool:
        return self.error > WARNED and not self.stands_in

    @property
    def remarks(self) -> tuple[str, ...]:
        """Warnings, where the error is worth one."""
        why = f": {self.cause}" if self.cause else ""
        return (f"transient.step: a {self}{why}",) if self._warns else ()

    @property
    def remedies(self) -> str:
        """Changes that a user can make, in words."""
        step = self.enough or self.about
        smaller = f"'step: {step:.1g}'" if step else "a smaller step"
        accept = f"'accept: {np.ceil(100 * self.error):.0f}' (%) beside the step"
        if self.cause is None or self.cause.slower > 0.5 * self.error:
            return f"{smaller}; or {accept}"
        point = self.where.split(",")[0]
        return (
            f"{smaller}; or {accept}, where that motion is no matter (the report has "
            f"peaks without it, low-passed); or another grid for the point '{point}'; "
            "or airframe.damping, which such motions have in truth"
        )


def step_error(
    model: LoadModel,
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

    def error(h: float) -> _Extreme:
        return _worst(exact, _by_scheme(model, pulses, h, scheme), model)

    found = error(step)
    name = f"{points[found.point].replace('_', ' ')}, {'xyz'[found.axis]}"
    good = StepError(step=step, error=found.error, where=name, enough=step)
    if found.error <= WARNED:
        return good
    h, smallest = step, found
    for h in (h for h in STEPS if h < step):
        smallest = error(h)
        if smallest.error <= WARNED:
            break
    enough = smallest.error <= WARNED
    return replace(
        good,
        enough=h if enough else None,
        about=None if enough else h * float(np.sqrt(WARNED / smallest.error)),
        cause=_cause(
            model, exact, _by_scheme(model, pulses, step, scheme), found, step
        ),
    )


def expected_step_error(
    case: Case,
    aircraft: Aircraft,
    structure: Structure,
    model: LoadModel,
    pulses: Sequence[GearPulses],
) -> StepError:
    """Error to expect of the transient's step in a case.

    Args:
        case: its step and scheme.
        aircraft, structure: of the case.
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
    if cause := found.cause:
        component = component_at(structure, case, cause.grid)
        found = replace(found, cause=replace(cause, component=component))
    accepted = case.transient.accept
    if found.error > max(REFUSED, accepted / 100.0):
        raise StepRefused(
            f"transient.step: found a {found}: {found.cause}. Expected at most "
            f"{max(100 * REFUSED, accepted):g} %: {found.remedies}",
            found,
        )
    return found


def _percent(share: float) -> str:
    return f"{share:.1%}" if share < 0.1 else f"{share:.0%}"


@dataclass(frozen=True, kw_only=True)
class _Extreme:
    """The error of an extreme over its peak, and where: point, axis 0 to 2."""

    error: float
    point: int
    axis: int


def _worst(exact: Float64, found: Float64, model: ModalModel) -> _Extreme:
    """The largest error of an extreme; (t, n) modal accelerations each."""
    exact, found = (
        np.einsum("tn,pan->tpa", modal, model.monitor, optimize=True)
        for modal in (exact, found)
    )
    peak = np.abs(exact).max(axis=0)
    missed = np.abs(_extremes(found) - _extremes(exact)).max(axis=0)
    counts = peak > _SMALL * peak.max()
    error = np.where(counts, missed / np.where(counts, peak, 1.0), 0.0)
    p, axis = np.unravel_index(int(np.argmax(error)), error.shape)
    return _Extreme(error=float(error[p, axis]), point=int(p), axis=int(axis))


def _cause(
    model: LoadModel, exact: Float64, found: Float64, worst: _Extreme, step: float
) -> StepCause:
    """The shape that adds most to an error, slower ones before it.

    Args:
        model: shapes by ascending frequency.
        exact, found: (t, n) modal accelerations.
        worst: the error.
        step: s.
    """
    seen = model.monitor[worst.point, worst.axis]
    extremes = [_extremes(np.cumsum(modal * seen, axis=1)) for modal in (exact, found)]
    missed = np.abs(extremes[1] - extremes[0]).max(axis=0)
    error = missed / np.abs(extremes[0][:, -1]).max()
    shape = int(np.argmax(np.diff(error, prepend=0.0)))
    f = float(model.frequency_hz[shape])
    return StepCause(
        frequency_hz=f,
        steps=1.0 / (f * step) if f else np.inf,
        grid=int(model.seat[shape]),
        share=float(model.share[shape]),
        slower=float(error[shape - 1]) if shape else 0.0,
    )


def _extremes(values: Float64) -> Float64:
    """(2, ...) largest and smallest over time, the first axis."""
    return np.stack([values.max(axis=0), values.min(axis=0)])


def _force(model: ModalModel, pulses: Sequence[GearPulses]) -> Float64:
    """(t, n) modal forces."""
    loads = [
        load @ model.attachment[int(node)]
        for pulse in pulses
        for node, load in zip(pulse.node_id, pulse.load)
    ]
    return np.sum(loads, axis=0)


def _exact(model: ModalModel, pulses: Sequence[GearPulses], step: float) -> Float64:
    """(t, n) modal accelerations under the curve that `_by_scheme` takes its loads of.

    Linear between samples alone, a pulse would have kinks, and stiff motions would feel
    them; no step of the scheme could then come near.
    """
    force, h = _force(model, pulses), pulses[0].step
    coarse = h * np.arange(len(force))
    fine = h / max(round(h / step), 1)
    loads = resample(coarse, force, time_grid(fine, float(coarse[-1])))
    return modal_accelerations(model.frequency_hz, model.damping, loads, fine)


def _by_scheme(
    model: ModalModel, pulses: Sequence[GearPulses], step: float, scheme: str
) -> Float64:
    """(t, n) modal accelerations as the direct transient computes them."""
    force, h = _force(model, pulses), pulses[0].step
    coarse = h * np.arange(len(force))
    grid = time_grid(step, float(coarse[-1]))
    loads = resample(coarse, force, grid)
    ahead = np.append(grid, grid[-1] + step * np.array([1.0, 2.0]))
    held = np.concatenate([loads, loads[-1:], loads[-1:]])
    n = len(model.frequency_hz)
    watched = Observation("acceleration", sp.csr_matrix(sp.eye_array(n)))
    direct_transient(
        sp.diags_array((2.0 * np.pi * model.frequency_hz) ** 2),
        sp.eye_array(n),
        Damping(other=sp.csr_matrix(sp.diags_array(model.damping))),
        steps=[(len(grid) - 1, step)],
        load=sampled_load(sp.eye_array(n), ahead, held.T),
        observers=[watched],
        scheme=SCHEMES[scheme](),
    )
    return watched.values[:, 0]

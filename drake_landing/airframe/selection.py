"""Modes of a basis chosen or made for gear pulses, and the error to be expected."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.basis import Basis, residual_basis
from drake_landing.airframe.pulse_modes import galerkin_modes, pulse_directions
from drake_landing.airframe.pulses import GearPulses, touchdown_pulses
from drake_landing.airframe.relevance import ModalModel, Relevance, response
from drake_landing.cache import Cache
from drake_landing.case.airframe import Airframe
from drake_landing.case.axes import gear_in_A, rotation_AB
from drake_landing.case.mode_selection import Selection
from drake_landing.case.scenario import Scenario
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_RIGID = 6
# Factors on sink rate and speed. Shapes that are made for pulses answer these too well:
# others tell what error to expect.
_TRIALS = ((0.8, 0.9), (1.2, 1.1))
# Directions that shapes are picked from, per shape: 1 combines best where nearly all of
# the motion is wanted, more where only what the monitoring points feel is.
_WAYS = (1.0, 1.15, 1.3, 1.45)


@dataclass(frozen=True, kw_only=True)
class Choice:
    """Elastic modes of a multibody model.

    Attributes:
        source: the candidates.
        modes: (k,) which of them; or
        mix: (n, k) how they are combined, orthonormal columns.
        model: rigid-body modes and these at the nodes.
        expected: (p,) error to be expected at the monitoring points because modes are
            left out or a reduction lies before: rms of what is missing over that of
            the acceleration vector.
    """

    source: Basis = field(repr=False)
    modes: Int64 | None = None
    mix: Float64 | None = field(default=None, repr=False)
    model: ModalModel
    expected: Float64

    @property
    def frequency_hz(self) -> Float64:
        """(k,)"""
        return self.model.frequency_hz[self.model.elastic]

    @property
    def basis(self) -> Basis:
        """Shapes of the whole structure, made anew each time: they are large."""
        if self.mix is None:
            assert self.modes is not None
            return self.source.chosen(self.modes)
        return replace(
            self.source,
            frequency_hz=self.frequency_hz,
            shape=np.ascontiguousarray(self.source.shape @ self.mix),
        )

    @property
    def count(self) -> int:
        """Number of elastic modes."""
        return len(self.frequency_hz)

    @property
    def highest_hz(self) -> float:
        """Hz; 0 for a rigid airframe."""
        return float(self.frequency_hz.max(initial=0.0))


@dataclass(frozen=True, kw_only=True)
class Candidates:
    """All modes of a basis, known at the nodes of an aircraft, and gear pulses.

    Attributes:
        basis: elastic modes.
        model: rigid-body modes and all of these.
        reference: what errors are expected against: the full model's candidates and the
            static residual vectors of what lies above them.
        pulses: expected loads of the gears.
        trials: those of other landings, which tell what error to expect.
        relevance: order of the modes; positions count the rigid-body modes first.
    """

    basis: Basis
    model: ModalModel
    reference: ModalModel
    pulses: list[GearPulses]
    trials: tuple[list[GearPulses], ...]
    relevance: Relevance

    @classmethod
    def from_basis(
        cls,
        structure: Structure,
        basis: Basis,
        airframe: Airframe,
        aircraft: Aircraft,
        scenario: Scenario,
        cache: Cache | None = None,
    ) -> "Candidates":
        """Candidates that the modes of a basis give.

        Args:
            structure: the full model.
            basis: the candidates.
            airframe: its axes.
            aircraft: gears and monitoring points.
            scenario: sink rate, speeds, angles.
            cache: where residual vectors may be found.
        """
        model = modal_model(structure, basis, aircraft)

        def pulses_of(sink: float, speed: float) -> list[GearPulses]:
            other = {
                "sink_rate": sink * scenario.sink_rate,
                "forward_speed": speed * scenario.forward_speed,
            }
            changed = scenario.model_copy(update=other)
            return expected_pulses(structure, airframe, aircraft, changed)

        pulses = pulses_of(1.0, 1.0)
        above = residual_basis(structure, basis, aircraft.attachment_nodes, cache=cache)
        return cls(
            basis=basis,
            model=model,
            reference=model.with_more(modal_model(structure, above, aircraft)),
            pulses=pulses,
            trials=tuple(pulses_of(*factors) for factors in _TRIALS),
            relevance=Relevance.rank(model, tuple(aircraft.monitoring), pulses),
        )

    def with_reduced_basis(
        self, structure: Structure, basis: Basis, aircraft: Aircraft
    ) -> "Candidates":
        """Modes of a reduced model under the same pulses, errors against these here.

        Args:
            structure: the full model.
            basis: of the reduced one.
            aircraft: gears and monitoring points.
        """
        model = modal_model(structure, basis, aircraft)
        return replace(
            self,
            basis=basis,
            model=model,
            relevance=Relevance.rank(model, self.relevance.points, self.pulses),
        )

    def choose(self, select: Selection) -> Choice:
        """The modes of a selection of any kind."""
        if select.kind == "pulses":
            made = [self._made(int(select.value), way) for way in _WAYS]
            return min(made, key=lambda choice: choice.expected.max())
        modes = self._picked(select)
        model = self.model.of(np.concatenate([np.arange(_RIGID), modes]))
        return Choice(
            source=self.basis,
            modes=modes - _RIGID,
            model=model,
            expected=self._expected(model),
        )

    def _made(self, count: int, way: float) -> Choice:
        """Shapes combined for the pulses: of more than are wanted the most relevant."""
        directions = self._directions[:, : round(way * count)]
        frequency, mix = galerkin_modes(self.model, directions)
        model = self.model.mixed(frequency, mix)
        if len(frequency) > count:
            points = self.relevance.points
            modes = np.sort(Relevance.rank(model, points, self.pulses).order[:count])
            model = model.of(np.concatenate([np.arange(_RIGID), modes]))
            mix = mix[:, modes - _RIGID]
        return Choice(
            source=self.basis, mix=mix, model=model, expected=self._expected(model)
        )

    def _picked(self, select: Selection) -> Int64:
        frequency, order = self.basis.frequency_hz, self.relevance.order
        match select.kind:
            case "count":
                chosen = self.relevance.elastic[: int(select.value)]
            case "below":
                chosen = self.relevance.elastic[frequency < select.value]
            case "relevance":
                chosen = order[: int(select.value)]
            case "error":
                chosen = order[: self.relevance.count_for(select.value / 100.0)]
            case _:
                chosen = self.relevance.elastic
        return np.sort(chosen)

    @cached_property
    def _directions(self) -> Float64:
        """(n, n) of the motion under the pulses, most energetic first."""
        return pulse_directions(self.model, self.pulses)

    @cached_property
    def _felt(self) -> list[Float64]:
        """(t, p, 3) accelerations of the reference in each trial."""
        return [response(self.reference, pulses) for pulses in self.trials]

    def _expected(self, model: ModalModel) -> Float64:
        """(p,) root mean square over the trials of a model's error in each."""
        errors = [
            ((response(model, pulses) - whole) ** 2).sum((0, 2))
            / (whole**2).sum((0, 2))
            for pulses, whole in zip(self.trials, self._felt)
        ]
        return np.sqrt(np.mean(errors, axis=0))


def expected_pulses(
    structure: Structure, airframe: Airframe, aircraft: Aircraft, scenario: Scenario
) -> list[GearPulses]:
    """Pulses of the gears of an aircraft in a scenario."""
    R_AB = rotation_AB(airframe.axes)
    points = structure.points
    return touchdown_pulses(
        [gear_in_A(gear, R_AB) for gear in aircraft.gears],
        scenario,
        p_AN={
            node: R_AB @ points.xyz[points.rows(node)]
            for node in aircraft.attachment_nodes
        },
        mass=structure.rigid_mass.total,
        p_AG=R_AB @ structure.rigid_mass.center,
        R_AB=R_AB,
    )


def modal_model(structure: Structure, basis: Basis, aircraft: Aircraft) -> ModalModel:
    """Rigid-body modes and all modes of a basis at the nodes of an aircraft."""
    rigid = basis.rigid_modes(structure.mass)

    def at(nodes: list[int], components: tuple[int, ...]) -> Float64:
        rows = structure.operator(nodes, components, frame="basic")
        motion = np.hstack([rows @ rigid, rows @ basis.shape])
        return motion.reshape(len(nodes), len(components), -1)

    omega2 = (2.0 * np.pi * basis.frequency_hz) ** 2
    b = structure.damping
    damping = b.stiffness_factor * omega2 + b.mass_factor
    if b.other is not None:
        damping = damping + np.einsum("fi,fi->i", basis.shape, b.other @ basis.shape)
    nodes = sorted(set(aircraft.attachment_nodes))
    shapes = at(nodes, (1, 2, 3, 4, 5, 6))
    return ModalModel(
        frequency_hz=np.concatenate([np.zeros(_RIGID), basis.frequency_hz]),
        damping=np.concatenate([np.zeros(_RIGID), damping]),
        monitor=at(list(aircraft.monitoring.values()), (1, 2, 3)),
        attachment=dict(zip(nodes, shapes)),
    )


def select_modes(candidates: Candidates, select: Selection) -> Basis:
    """Modes that a case selects for gear pulses, with a notice of what to expect."""
    choice = candidates.choose(select)
    return replace(
        choice.basis,
        notices=(*choice.basis.notices, _expectation(candidates, choice, select)),
    )


def _expectation(candidates: Candidates, choice: Choice, select: Selection) -> str:
    told = ", ".join(
        f"{point.replace('_', ' ')} {e:.1%}"
        for point, e in zip(candidates.relevance.points, choice.expected)
    )
    how = "combined from" if select.kind == "pulses" else "selected by relevance among"
    text = (
        f"{choice.count} modes up to {choice.highest_hz:.0f} Hz, {how} "
        f"{len(candidates.basis.frequency_hz)} candidates; expected truncation error "
        f"(rms of the acceleration): {told}"
    )
    if select.kind == "error":
        short = bool(choice.expected.max() > select.value / 100.0)
    else:
        short = choice.count < select.value
    return text + ("; raise airframe.candidates for more" if short else "")

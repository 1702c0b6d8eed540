"""Modes of a basis chosen or made for gear pulses, and the error to be expected."""

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from drake_landing.axes import gear_in_A, rotation_AB
from drake_landing.basis import Basis
from drake_landing.case import Airframe, Selection
from drake_landing.inputs import Aircraft
from drake_landing.pulse_modes import pulse_modes
from drake_landing.pulses import GearPulses, touchdown_pulses
from drake_landing.relevance import ModalModel, Relevance, response
from drake_landing.scenario import Scenario
from fem.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_RIGID = 6
# Pulse modes answer their own pulses too well: others tell what error to expect.
_OTHER_SINK, _OTHER_SPEED = 0.8, 0.9


@dataclass(frozen=True, kw_only=True)
class Choice:
    """Elastic modes of a multibody model.

    Attributes:
        basis: their shapes.
        model: rigid-body modes and these at the nodes.
        expected: (p,) truncation error to be expected at the monitoring points: rms of
            what is missing over that of the acceleration vector.
    """

    basis: Basis
    model: ModalModel
    expected: Float64

    @property
    def count(self) -> int:
        """Number of elastic modes."""
        return len(self.basis.frequency_hz)

    @property
    def highest_hz(self) -> float:
        """0 for a rigid airframe."""
        return float(self.basis.frequency_hz.max(initial=0.0))


@dataclass(frozen=True, kw_only=True)
class Candidates:
    """All modes of a basis, known at the nodes of an aircraft, and gear pulses.

    Attributes:
        basis: elastic modes.
        model: rigid-body modes and all of these.
        pulses: expected loads of the gears.
        other_pulses: of another landing.
        relevance: order of the modes; positions count the rigid-body modes first.
    """

    basis: Basis
    model: ModalModel
    pulses: list[GearPulses]
    other_pulses: list[GearPulses]
    relevance: Relevance

    @classmethod
    def of(
        cls,
        structure: Structure,
        basis: Basis,
        airframe: Airframe,
        aircraft: Aircraft,
        scenario: Scenario,
    ) -> "Candidates":
        """Of a basis of a structure.

        Args:
            structure: the full model.
            basis: the candidates.
            airframe: its axes.
            aircraft: gears and monitoring points.
            scenario: sink rate, speeds, angles.
        """
        model = modal_model(structure, basis, aircraft)
        pulses = expected_pulses(structure, airframe, aircraft, scenario)
        other = scenario.model_copy(
            update={
                "sink_rate": _OTHER_SINK * scenario.sink_rate,
                "forward_speed": _OTHER_SPEED * scenario.forward_speed,
            }
        )
        return cls(
            basis=basis,
            model=model,
            pulses=pulses,
            other_pulses=expected_pulses(structure, airframe, aircraft, other),
            relevance=Relevance.of(model, tuple(aircraft.monitoring), pulses),
        )

    def choose(self, select: Selection) -> Choice:
        """The modes of a selection of any kind."""
        if select.kind == "pulses":
            return self._made(int(select.value))
        modes = self._picked(select)
        basis = self.basis.chosen(modes - _RIGID)
        every = np.concatenate([np.arange(_RIGID), modes])
        return Choice(
            basis=basis,
            model=self.model.of(every),
            expected=self.relevance.error(modes),
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

    def _made(self, count: int) -> Choice:
        frequency, mix = pulse_modes(self.model, self.pulses, count)
        basis = replace(
            self.basis,
            frequency_hz=frequency,
            shape=np.ascontiguousarray(self.basis.shape @ mix),
        )
        model = self.model.mixed(frequency, mix)
        whole = response(self.model, self.other_pulses)
        lost = response(model, self.other_pulses) - whole
        expected = np.sqrt((lost**2).sum((0, 2)) / (whole**2).sum((0, 2)))
        return Choice(basis=basis, model=model, expected=expected)


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
        mass=structure.weight.total,
        p_AG=R_AB @ structure.weight.center,
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

"""Modes of a basis chosen by relevance, and the truncation error to be expected."""

import numpy as np
import numpy.typing as npt

from drake_landing.axes import gear_in_A, rotation_AB
from drake_landing.basis import Basis
from drake_landing.case import Airframe, Selection
from drake_landing.inputs import Aircraft
from drake_landing.pulses import touchdown_pulses
from drake_landing.relevance import ModalModel, Relevance
from drake_landing.scenario import Scenario
from fem.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_RIGID = 6


def relevance_of(
    structure: Structure,
    basis: Basis,
    airframe: Airframe,
    aircraft: Aircraft,
    scenario: Scenario,
) -> Relevance:
    """Modes of a basis by relevance; its positions count rigid-body modes first.

    Args:
        structure: the full model.
        basis: the candidates.
        airframe: its axes.
        aircraft: gears and monitoring points.
        scenario: sink rate, speeds, angles.
    """
    model = modal_model(structure, basis, aircraft)
    R_AB = rotation_AB(airframe.axes)
    points = structure.points
    pulses = touchdown_pulses(
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
    return Relevance.of(model, tuple(aircraft.monitoring), pulses)


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


def select_modes(basis: Basis, relevance: Relevance, select: Selection) -> Basis:
    """The modes of `relevance N` or `relevance error <= x %`, ascending.

    Raises:
        ValueError: another kind of selection.
    """
    if select.kind == "relevance":
        count = min(int(select.value), len(relevance.order))
    elif select.kind == "error":
        count = relevance.count_for(select.value / 100.0)
    else:
        raise ValueError(f"selection '{select}' is not by relevance")
    modes = relevance.order[:count]
    return basis.chosen(modes - _RIGID, [_expectation(basis, relevance, modes, select)])


def _expectation(
    basis: Basis, relevance: Relevance, modes: Int64, select: Selection
) -> str:
    error = relevance.error(modes)
    told = ", ".join(
        f"{point.replace('_', ' ')} {e:.1%}"
        for point, e in zip(relevance.points, error)
    )
    last = basis.frequency_hz[modes - _RIGID].max(initial=0.0)
    text = (
        f"{len(modes)} of {len(relevance.order)} candidate modes, up to {last:.0f} "
        "Hz, selected by relevance; expected truncation error (rms of the "
        f"acceleration): {told}"
    )
    if select.kind == "relevance":
        short = len(modes) < select.value
    else:
        short = bool(error.max() > select.value / 100.0)
    return text + ("; raise airframe.candidates for more" if short else "")

"""The airframes of a study: one per topology, with all candidate modes and their order.

Topologies that tie the gears to other nodes without changing stiffness or mass have the
same matrices: their modes are found in the cache, and one factorisation serves all.
"""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt

from drake_landing.airframe import check_nodes, modal_body
from drake_landing.axes import rotation_AB
from drake_landing.basis import Basis, elastic_basis
from drake_landing.cache import Cache, content_key
from drake_landing.case import Case, Selection
from drake_landing.inputs import Aircraft, prepare_aircraft
from drake_landing.progress import Reporter
from drake_landing.relevance import ModalModel, Relevance
from drake_landing.selection import modal_model, relevance_of
from drake_landing.studies.plan import Plan
from fem.deck.reader import read_deck
from fem.structure import Structure
from systems.modal_body import ModalBody

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_RIGID = 6


@dataclass(frozen=True, kw_only=True)
class StudyAirframe:
    """A full model and its candidate modes.

    Attributes:
        case: shared by the runs.
        aircraft: deck, gears, nodes.
        structure: the full model.
        basis: candidate modes.
        relevance: their order; positions count the rigid-body modes first.
        model: rigid-body and candidate modes at the nodes.
    """

    case: Case
    aircraft: Aircraft
    structure: Structure
    basis: Basis
    relevance: Relevance
    model: ModalModel

    @cached_property
    def matrix_key(self) -> str:
        """Content of K, M and B."""
        s = self.structure
        b = s.damping
        return content_key(
            *(s.stiffness, s.mass, b.stiffness_factor, b.mass_factor, b.other)
        )

    def modes(self, select: Selection) -> Int64:
        """Positions in `model` of the elastic modes of a selection, ascending."""
        frequency, order = self.basis.frequency_hz, self.relevance.order
        match select.kind:
            case "count":
                chosen = np.arange(min(int(select.value), len(frequency)))
            case "below":
                chosen = np.flatnonzero(frequency < select.value)
            case "relevance":
                chosen = order[: int(select.value)] - _RIGID
            case "error":
                count = self.relevance.count_for(select.value / 100.0)
                chosen = order[:count] - _RIGID
            case _:
                chosen = np.arange(len(frequency))
        return np.sort(chosen) + _RIGID

    def body(self, modes: Int64) -> ModalBody:
        """The modal body with some of the modes."""
        nodes = {*self.aircraft.monitoring.values(), *self.aircraft.attachment_nodes}
        return modal_body(
            self.structure,
            self.basis.chosen(modes - _RIGID),
            sorted(nodes),
            rotation_AB(self.case.airframe.axes),
        )


def study_airframe(
    plan: Plan, topology: str, folder: Path, cache: Cache, progress: Reporter
) -> StudyAirframe:
    """Writes the deck of a topology, assembles it, solves for the candidates.

    Args:
        plan: of the study.
        topology: one of its topologies.
        folder: for the deck.
        cache: where modes may be found.
        progress: told the modes found.
    """
    case = plan.case(topology)
    aircraft = prepare_aircraft(case, folder)
    structure = Structure.from_deck(read_deck(aircraft.deck))
    check_nodes(structure, aircraft)
    basis = elastic_basis(
        structure,
        case.airframe,
        list(aircraft.nodes),
        lambda done, wanted: progress.share(done / max(wanted, 1), f"{done} modes"),
        cache=cache,
    )
    return StudyAirframe(
        case=case,
        aircraft=aircraft,
        structure=structure,
        basis=basis,
        relevance=relevance_of(
            structure, basis, case.airframe, aircraft, case.scenario
        ),
        model=modal_model(structure, basis, aircraft),
    )

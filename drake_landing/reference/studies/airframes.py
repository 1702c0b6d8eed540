"""The airframes of a study: one per topology, with all candidate modes and their order.

Topologies that tie the gears to other nodes without changing stiffness or mass have the
same matrices: their modes are found in the cache, and one factorisation serves all.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.basis import elastic_basis
from drake_landing.airframe.body import check_nodes, modal_body
from drake_landing.airframe.selection import Candidates, Choice
from drake_landing.cache import Cache, content_key
from drake_landing.case.airframe import Basis
from drake_landing.case.axes import rotation_AB
from drake_landing.case.schema import Case
from drake_landing.process.aircraft import prepare_aircraft
from drake_landing.progress import Reporter
from drake_landing.reference.studies.plan import FULL_MODES, NAMES, Plan, RunName
from fem.model.structure import Structure
from systems.airframe.modal_body import ModalBody


@dataclass(frozen=True, kw_only=True)
class StudyAirframe:
    """A full model, its candidate modes, and those of reduced ones.

    Attributes:
        case: shared by the runs.
        aircraft: deck, gears, nodes.
        structure: the full model.
        candidates: modes of the full model and their order.
        reduced: basis -> modes of the model reduced to the interface.
    """

    case: Case
    aircraft: Aircraft
    structure: Structure
    candidates: Candidates
    reduced: Mapping[Basis, Candidates]

    def of_basis(self, basis: Basis) -> Candidates:
        """Candidates of the full model or of a reduced one."""
        return self.candidates if basis == FULL_MODES else self.reduced[basis]

    def choose(self, name: RunName) -> Choice:
        """The modes of a run."""
        return self.of_basis(name.basis).choose(name.parsed)

    @cached_property
    def matrix_key(self) -> str:
        """Content of K, M and B."""
        s = self.structure
        b = s.damping
        return content_key(
            *(s.stiffness, s.mass, b.stiffness_factor, b.mass_factor, b.other)
        )

    def body(self, choice: Choice) -> ModalBody:
        """The modal body with chosen modes."""
        nodes = {*self.aircraft.monitoring.values(), *self.aircraft.attachment_nodes}
        return modal_body(
            self.structure,
            choice.basis,
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
    structure = aircraft.structure()
    check_nodes(structure, aircraft)
    nodes = list(aircraft.nodes)

    def told(done: int, wanted: int) -> None:
        progress.share(done / max(wanted, 1), f"{done} modes")

    basis = elastic_basis(structure, case.airframe, nodes, told, cache=cache)
    candidates = Candidates.from_basis(
        structure, basis, case.airframe, aircraft, case.scenario, cache
    )
    reduced = {}
    for name in plan.reductions:
        progress.stage(f"{NAMES[name]} reduction to {len(nodes)} grids, its modes")
        settings = case.airframe.model_copy(update={"basis": name})
        basis = elastic_basis(structure, settings, nodes, cache=cache)
        reduced[name] = candidates.with_reduced_basis(structure, basis, aircraft)
    return StudyAirframe(
        case=case,
        aircraft=aircraft,
        structure=structure,
        candidates=candidates,
        reduced=reduced,
    )

"""From a deck to the modal body of the multibody model.

Mass properties and damping are taken from the same matrices that the direct transient
uses, so that both models are one. Elastic modes of a free structure are orthogonal to
its rigid motions: mean axes.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.basis import Basis, elastic_basis, with_residual_vectors
from drake_landing.airframe.free_flight import check_mass
from drake_landing.airframe.selection import Candidates, select_modes
from drake_landing.airframe.skeleton import Skeleton, element_edges, element_faces
from drake_landing.airframe.supports import supports_of
from drake_landing.cache import Cache
from drake_landing.case.airframe import Airframe
from drake_landing.case.axes import rotation_AB
from drake_landing.case.scenario import Scenario
from drake_landing.progress import Reporter, Silent
from fem.errors import InputError
from fem.geometry.points import Points
from fem.geometry.rigid_motion import rigid_motion
from fem.model.structure import Structure
from fem.model.weight import rigid_mass_properties
from systems.airframe.modal_body import ModalBody

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

_MOST_LINES = 2000


@dataclass(frozen=True, kw_only=True)
class AirframeModel:
    """The finite-element model and what was made of it.

    Attributes:
        structure: the full model.
        basis: its elastic modes.
        body: the modal body, in the axes A (see `axes`).
        R_AB: (3, 3).
    """

    structure: Structure
    basis: Basis
    body: ModalBody
    R_AB: Float64 = field(repr=False)

    @property
    def grids(self) -> int:
        """Number of grids of the deck."""
        return len(self.structure.points.grid_id)

    @property
    def highest_hz(self) -> float:
        """Hz, of the elastic modes; 0 for a rigid airframe."""
        return float(self.body.frequency[-1]) if self.body.n else 0.0

    @property
    def notices(self) -> tuple[str, ...]:
        """Remarks on the model that the user should read."""
        of_model = (*self.structure.notices, *self.structure.damping_notices)
        return (*of_model, *self.basis.notices)

    def displacement_axes(self, grids: Int64) -> Float64:
        """(k, 3, 3) R_BD of grids."""
        return self.structure.points.rotation[self.structure.points.rows(grids)]

    @cached_property
    def skeleton(self) -> Skeleton:
        """The airframe as lines and skin, with the modes of the body."""
        points = self.structure.points
        edges = element_edges(self.structure.deck.cards, points.grid_id)
        plain = Skeleton(
            p=points.xyz @ self.R_AB.T,
            shape=np.zeros((len(points.grid_id), 3, 0)),
            edges=edges,
            faces=element_faces(self.structure.deck.cards, points.grid_id),
        )
        rows, thinned = plain.thinned(_MOST_LINES)
        shape = _shapes(self.structure, points.grid_id[rows], self.basis, self.R_AB)
        return replace(thinned, shape=shape[:, :3])


def load_airframe(
    airframe: Airframe,
    aircraft: Aircraft,
    progress: Reporter | None = None,
    scenario: Scenario | None = None,
    cache: Cache | None = None,
    structure: Structure | None = None,
) -> AirframeModel:
    """Reads the deck, solves for the modes, makes the modal body.

    Args:
        airframe: of the case.
        aircraft: its deck and nodes.
        progress: told the modes found.
        scenario: what the gears' pulses are expected from, where relevance selects.
        cache: where modes of the same matrices may be found.
        structure: the deck's, where it has been read already.

    Raises:
        InputError: everything that is wrong with the deck or the nodes.
    """
    tell = progress or Silent()
    structure = structure or aircraft.structure()
    check_nodes(structure, aircraft)
    check_mass(structure)
    basis = elastic_basis(
        structure,
        airframe,
        list(aircraft.nodes),
        lambda done, wanted: tell.share(done / max(wanted, 1), f"{done} modes"),
        cache=cache,
    )
    if airframe.select.by_relevance:
        if scenario is None:
            raise ValueError(f"select '{airframe.select}' needs a scenario")
        candidates = Candidates.from_basis(
            structure, basis, airframe, aircraft, scenario, cache
        )
        basis = select_modes(candidates, airframe.select)
    if airframe.residual_vectors:
        basis = with_residual_vectors(structure, basis, aircraft.attachment_nodes)
    R_AB = rotation_AB(airframe.axes)
    body = modal_body(structure, basis, aircraft.multibody_nodes, R_AB)
    return AirframeModel(structure=structure, basis=basis, body=body, R_AB=R_AB)


def check_nodes(structure: Structure, aircraft: Aircraft) -> None:
    """Every grid that the case names is there and moves with the structure.

    Raises:
        InputError: those that do not, each with the field that names it.
    """
    points, deck = structure.points, aircraft.deck
    known = np.isin(list(aircraft.nodes), points.grid_id)
    problems = [
        f"{field}: found grid {node}, which is not in {deck}; nearest are "
        f"{_near(points, node)}"
        for (node, field), there in zip(aircraft.nodes.items(), known)
        if not there
    ]
    if problems:
        cut = [text for text in structure.deck.notices if "ENDDATA" in text]
        raise InputError([*problems, *cut])
    loose = _loose(structure, aircraft.nodes)
    if loose:
        why = "it is constrained, or not connected to any element"
        if supports := supports_of(structure):
            why = f"{supports.story}; {supports.remedy}"
        raise InputError(
            f"{aircraft.nodes[node]}: grid {node} of {deck} does not move with the "
            f"structure: {why}"
            for node in loose
        )


def rigid_airframe(
    structure: Structure, nodes: Iterable[int], R_AB: Float64
) -> ModalBody:
    """The airframe without elastic modes, A; arguments as in `modal_body`."""
    basis = Basis(
        frequency_hz=np.zeros(0),
        shape=np.zeros((structure.size, 0)),
        rigid=structure.rigid_body,
        freedoms=structure.size,
    )
    return modal_body(structure, basis, nodes, R_AB)


def modal_body(
    structure: Structure, basis: Basis, nodes: Iterable[int], R_AB: Float64
) -> ModalBody:
    """The modal body in the axes A.

    Args:
        structure: the full model.
        basis: its elastic modes.
        nodes: grids that the multibody model needs.
        R_AB: (3, 3).
    """
    ids = np.array(sorted(set(nodes)), dtype=np.int64)
    mass, p_BG, inertia = mass_properties(structure)
    shape = _shapes(structure, ids, basis, R_AB)
    modal_mass = np.einsum("fi,fi->i", basis.shape, structure.mass @ basis.shape)
    points = structure.points
    return ModalBody(
        mass=mass,
        p_BG=R_AB @ p_BG,
        inertia_G=R_AB @ inertia @ R_AB.T,
        frequency=basis.frequency_hz,
        modal_mass=modal_mass,
        modal_damping=modal_damping(structure, basis),
        node_id=ids,
        p_BN=points.xyz[points.rows(ids)] @ R_AB.T,
        translation=np.ascontiguousarray(shape[:, :3]),
        rotation=np.ascontiguousarray(shape[:, 3:]),
    )


def mass_properties(structure: Structure) -> tuple[float, Float64, Float64]:
    """Mass (kg), center of gravity (3,) and inertia about it (3, 3), basic axes.

    They are those of the mass matrix of the free set, hence of the direct transient.
    """
    rigid = structure.rigid_body
    mass, offset, inertia = rigid_mass_properties(rigid.T @ (structure.mass @ rigid))
    return mass, structure.rigid_mass.center + offset, inertia


def modal_damping(structure: Structure, basis: Basis) -> Float64:
    """(n, n) projection of the B that the direct transient uses."""
    shape = basis.shape
    stiffness = shape.T @ (structure.stiffness @ shape)
    return structure.damping.projected(
        shape, stiffness, shape.T @ (structure.mass @ shape)
    )


def _shapes(structure: Structure, grids: Int64, basis: Basis, R_AB: Float64) -> Float64:
    """(k, 6, n) translations and rotations of grids in A."""
    motion = structure.operator(grids, frame="basic") @ basis.shape
    motion = motion.reshape(len(grids), 2, 3, -1)
    return np.einsum("ab,ksbn->ksan", R_AB, motion).reshape(len(grids), 6, -1)


def _loose(structure: Structure, nodes: Iterable[int]) -> list[int]:
    """Grids that do not follow the rigid motion of the structure."""
    ids = np.array(sorted(nodes), dtype=np.int64)
    moved = structure.operator(ids, frame="basic") @ structure.rigid_body
    moved = moved.reshape(len(ids), 6, 6)
    return ids[
        np.abs(moved[:, :, :] - _rigid(structure, ids)).max((1, 2)) > 1e-6
    ].tolist()


def _rigid(structure: Structure, ids: Int64) -> Float64:
    """(k, 6, 6) motion of grids by unit rigid motions, basic axes."""
    points = structure.points
    arm = points.xyz[points.rows(ids)] - structure.rigid_mass.center
    return rigid_motion(arm)


def _near(points: Points, node: int) -> str:
    ids = points.grid_id[np.argsort(np.abs(points.grid_id - node), kind="stable")[:3]]
    return ", ".join(map(str, sorted(ids.tolist())))

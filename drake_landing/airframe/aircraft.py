"""What a case says of the aircraft, complete."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from drake_landing.case.lift import Lift
from drake_landing.case.scenario import Scenario
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.parametric import ParametricAircraft
from fem.arrays import Float64
from fem.deck.deck import Deck
from fem.deck.deck_files import deck_files
from fem.deck.reader import read_deck
from fem.errors import InputError
from fem.model.structure import Structure

if TYPE_CHECKING:
    from drake_landing.places import Places


@dataclass(frozen=True, kw_only=True)
class Aircraft:
    """All that a case says of the aircraft.

    Attributes:
        name: for tables and titles.
        topology: label of the gear attachment.
        deck: bulk-data file of the airframe.
        gears: in the axes of the deck.
        monitoring: point -> grid id.
        interface: grids that a reduction keeps, beside attachment and monitoring.
        scenario: of the case, with the nodes that carry the lift.
        units: of the deck; what `structure` gives is SI.
        notices: what the user should know.
        read: how the file becomes a deck; matrices come with all their digits.
        steady: (f, 1) loads of steady flight at 1 g, as the case gives them, or of a
            built-in model in a mass case; None: those of the parametric aircraft.
        check: raises where the structure is not as the case wants it: a mass case.
        parametric: who wrote the deck, where it is not the user's own.
    """

    name: str
    topology: str
    deck: Path
    gears: tuple[LandingGear, ...]
    monitoring: Mapping[str, int]
    scenario: Scenario
    interface: tuple[int, ...] = ()
    units: str = "SI"
    notices: tuple[str, ...] = ()
    read: Callable[[Path], Deck] = read_deck
    parametric: ParametricAircraft | None = None
    steady: Callable[[Structure], Float64] | None = None
    check: Callable[[Structure], None] | None = None

    def structure(self) -> Structure:
        """The airframe's finite-element model.

        Raises:
            InputError: everything that is wrong with its deck.
        """
        structure = Structure.from_deck(self.read(self.deck))
        if structure.dynamic_input is not None:
            raise InputError(
                f"{self.deck}: K2PP, B2PP, M2PP and TFL belong to dynamic solutions of "
                "the deck's own, a landing has the matrices of the structure; expected "
                "K2GG, B2GG, M2GG, or CASE in airframe.ignore to fly without them"
            )
        if self.check is not None:
            self.check(structure)
        return structure

    @property
    def files(self) -> tuple[Path, ...]:
        """The deck and what it includes or assigns, each once, the deck first."""
        return deck_files(self.deck)

    @property
    def steady_load(self) -> Callable[[Structure], Float64] | None:
        """Loads (g,), N, on a structure in steady flight at 1 g, where known."""
        if self.steady is None and self.parametric is not None:
            return self.parametric.steady_load
        return self.steady

    def known_places(self, structure: Structure) -> Places | None:
        """Places to look at that the aircraft's generator knows."""
        if self.parametric is None or self.parametric.places is None:
            return None
        return self.parametric.places(structure)

    @property
    def attachment_nodes(self) -> tuple[int, ...]:
        """Grids of all gears."""
        return tuple(node for gear in self.gears for node in gear.attachments.values())

    @property
    def lift_nodes(self) -> tuple[int, ...]:
        """Grids that carry the lift; none where it balances the weight unseen."""
        lift = self.scenario.lift
        return lift.nodes if isinstance(lift, Lift) else ()

    @property
    def further_lift_nodes(self) -> dict[int, str]:
        """Grids of tail and engines that carry loads -> field of the case."""
        lift = self.scenario.lift
        found = lift.further_nodes if isinstance(lift, Lift) else {}
        return {node: f"scenario.lift.{field}" for node, field in found.items()}

    @property
    def multibody_nodes(self) -> list[int]:
        """Grids that the multibody model knows, ascending."""
        monitored = self.monitoring.values()
        others = self.further_lift_nodes
        return sorted({*monitored, *self.attachment_nodes, *self.lift_nodes, *others})

    @property
    def nodes(self) -> dict[int, str]:
        """Grids that must exist -> field of the case that names them."""
        wanted = dict.fromkeys(self.lift_nodes, "scenario.lift.nodes")
        wanted |= self.further_lift_nodes
        for name, grid in self.monitoring.items():
            wanted[grid] = f"airframe.monitoring.{name}"
        for gear in self.gears:
            wanted[gear.attachment_node] = f"gears.{gear.name}.attachment_node"
            for hold in gear.further_attachments:
                field = f"gears.{gear.name}.further_attachments.{hold.name}.node"
                wanted[hold.node] = field
        return {**dict.fromkeys(self.interface, "airframe.interface"), **wanted}

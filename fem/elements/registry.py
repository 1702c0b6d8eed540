"""The element blocks of a deck, by the readers that the records of the cards name."""

from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING

from fem.deck.records import CARDS
from fem.elements.block import ElementBlock
from fem.elements.connectors.reader import connector_notices
from fem.elements.lines.beam_reader import beam_notices
from fem.elements.nonstructural_mass import add_nonstructural_mass
from fem.elements.scalars.gap import gap_notices
from fem.elements.shells.material_axes import steep_systems
from fem.elements.solids.notices import solid_notices
from fem.errors import Problems
from fem.geometry.points import Points
from fem.properties.shells import strength_notices

if TYPE_CHECKING:
    from fem.deck.deck import Deck

Reader = Callable[["Deck", Points], "Sequence[ElementBlock]"]


@cache
def readers() -> dict[str, Reader]:
    """Card -> function that makes the blocks of its table, by name.

    CONROD comes with CROD, the scalar elements 1 and 2 with their first, 3 and 4 share
    their tables.

    Raises:
        ImportError, AttributeError: a record names no function (an error in the
            program).
    """
    found: dict[str, Reader] = {}
    for name, card in sorted(CARDS.items()):
        if card.element and card.element.reader:
            module, function = card.element.reader.split(":")
            found[name] = getattr(import_module(f"fem.elements.{module}"), function)
    return found


def read_elements(deck: "Deck", points: Points, *, nsm: int = 0) -> list[ElementBlock]:
    """All elements of a deck.

    Args:
        deck: the deck.
        points: its points.
        nsm: set of non-structural mass that case control selects, 0 for none.

    Raises:
        InputError: what is wrong with any element, of all types together.
    """
    blocks: list[ElementBlock] = []
    problems = Problems()
    for reader in readers().values():
        with problems.gathered():
            blocks += reader(deck, points)
    problems.report()
    return add_nonstructural_mass(deck, blocks, nsm)


def element_notices(deck: "Deck", points: Points) -> list[str]:
    """What the cards ask for and the elements do not model, or take another way."""
    return [
        *beam_notices(deck),
        *strength_notices(deck),
        *solid_notices(deck),
        *gap_notices(deck),
        *connector_notices(deck),
        *steep_systems(deck, points),
    ]

"""The cards that are used, one record each.

A further card is one record in the module of its kind; a further element is a record
and the module with its formulas that the record names. See docs/design.md.
"""

from collections.abc import Iterator

from fem.deck.records import (
    connectors,
    constraints,
    dynamic_loads,
    lines,
    masses,
    materials,
    others,
    points,
    scalars,
    shells,
    solids,
    static_loads,
)
from fem.deck.records.card import Card, Op2, Result, Topology

# In the order of the documentation.
_ROOMS = (
    points,
    constraints,
    masses,
    lines,
    scalars,
    connectors,
    shells,
    solids,
    materials,
    static_loads,
    dynamic_loads,
    others,
)
CARDS: dict[str, Card] = {
    card.name: card for module in _ROOMS for card in module.RECORDS
}
TABLES: dict[str, Card] = {name: card for name, card in CARDS.items() if card.has_table}


def table_of(name: str) -> str:
    """The table that a card joins."""
    return CARDS[name].table or name if name in CARDS else name


def topologies(*kinds: str) -> dict[str, Topology]:
    """Topology of the cards with tables whose elements are of these kinds."""
    return {
        name: card.topology
        for name, card in TABLES.items()
        if card.topology and card.topology.kind in kinds
    }


def targets_of(target: str) -> tuple[str, ...]:
    """Tables that a reference of a record may point to."""
    if target == "POINT":
        return "GRID", "SPOINT"
    if target == "FREEDOM":
        return "GRID", "SPOINT", "EPOINT"
    if target == "SURFACE":
        return tuple(topologies("surface"))
    if target == "FACES":
        return tuple(topologies("surface", "solid"))
    return (target,)


def results() -> Iterator[tuple[Card, Result]]:
    """All tables of results, with their cards."""
    for card in CARDS.values():
        if card.element:
            for result in card.element.results:
                yield card, result


__all__ = [
    "CARDS",
    "TABLES",
    "Card",
    "Op2",
    "Result",
    "Topology",
    "results",
    "table_of",
    "targets_of",
    "topologies",
]

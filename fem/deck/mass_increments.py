"""Mass increments: what BEGIN MASSID = n sections add to the mass of a deck.

Of such a section the elements count, with their properties and materials; they connect
the points of the main bulk data (MSC Nastran's guide, MASSSET in case control).
"""

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from fem.deck.cards.masses import massset
from fem.deck.catalogue import WITHOUT_EFFECT
from fem.deck.deck import Deck
from fem.deck.records import CARDS, Card, table_of, targets_of
from fem.deck.text.fields import Fields
from fem.deck.text.lexer import RawCard, read_cards
from fem.deck.text.sections import split_sections
from fem.deck.text.source import read_source

POINTS = ("GRID", "SPOINT", "CORD")
"""Tables that sections of increments take from the main bulk data."""


@cache
def cards_that_count() -> frozenset[str]:
    """Elements, and whatever these refer to but points and frames."""
    tables = {
        table_of(name)
        for name, card in CARDS.items()
        if card.element or (card.group == "Masses" and _first(card) == "eid")
    }
    waiting = sorted(tables)
    while waiting:
        record = CARDS[waiting.pop()]
        for item in record.columns.values():
            for target in (t for word in item.targets for t in targets_of(word)):
                if target not in tables and target not in POINTS:
                    tables.add(target)
                    waiting.append(target)
    return frozenset(name for name, card in CARDS.items() if _table(name) in tables)


def _first(card: Card) -> str:
    return next(iter(card.columns), "")


def _table(name: str) -> str:
    filled = CARDS[name].fills
    return table_of(filled[0] if filled else name)


def set_aside(
    cards: Sequence[RawCard], number: int, notices: list[str]
) -> list[RawCard]:
    """Cards of a section that make masses; others that are known are named once."""
    used = [
        card
        for card in cards
        if card.name in cards_that_count()
        or (card.name not in CARDS and card.name not in {"PARAM", *WITHOUT_EFFECT})
    ]
    kept = set(map(id, used))
    counts: dict[str, int] = {}
    for card in cards:
        if id(card) not in kept:
            counts[card.name] = counts.get(card.name, 0) + 1
    if counts:
        listed = ", ".join(f"{name} ({n})" for name, n in sorted(counts.items()))
        notices.append(
            f"BEGIN MASSID = {number}: no part of a mass increment, not used: {listed}"
        )
    return used


def check_combinations(deck: Deck) -> list[str]:
    """Increments that a MASSSET names and the deck does not have."""
    table = deck.cards["MASSSET"]
    problems = []
    for _, row in table.iterrows():
        place = f"{row['file']}:{row['line']}: MASSSET {row['sid']}"
        if row["sid"] in deck.increments:
            problems.append(
                f"{place}: BEGIN MASSID = {row['sid']} has the same number, expected "
                "unique ones"
            )
        known = ", ".join(map(str, sorted(deck.increments))) or "none"
        problems += [
            f"{place}: BEGIN MASSID = {n} is not in the deck; it has {known}"
            for n in row["massids"]
            if n and n not in deck.increments
        ]
    return problems


def names_of_combinations(
    combinations: Mapping[int, Sequence[int]], labels: Mapping[int, str]
) -> dict[int, str]:
    """MASSSET -> the labels of its increments, where all have one.

    Args:
        combinations: MASSSET -> its increments, 0 for the base.
        labels: increment -> LABEL of its section.
    """
    return {
        number: " + ".join(labels[n] for n in own)
        for number, members in combinations.items()
        if (own := [n for n in members if n]) and all(labels.get(n) for n in own)
    }


def masssets_of(deck: Path) -> dict[str, int]:
    """Name -> MASSSET of a deck, without reading the rest of it.

    Names are `MASSSET 11`, and the labels of its increments where no other has them.
    """
    sections = split_sections(read_source(deck).lines, str(deck))
    sets = {}
    for card in read_cards(sections.bulk).cards:
        if card.name == "MASSSET":
            row = massset(Fields(card))[0]
            sets[row["sid"]] = row["massids"]
    labels = {n: increment.label for n, increment in sections.increments.items()}
    names = names_of_combinations(sets, labels)
    found = {f"MASSSET {n}": n for n in sets}
    for n, name in names.items():
        if list(names.values()).count(name) == 1:
            found[name] = n
    return found

"""Loads in a file of their own, for a deck that is read already."""

from dataclasses import replace
from pathlib import Path

from fem.deck.card_tables import make_tables
from fem.deck.checks import check
from fem.deck.deck import Deck
from fem.deck.text.lexer import RawCard, read_cards
from fem.deck.text.source import read_source
from fem.errors import InputError

CARDS = ("FORCE", "MOMENT")


def loads_of_file(deck: Deck, path: Path, sid: int | None) -> tuple[Deck, int]:
    """The deck with the forces and moments of a file instead of its own.

    Args:
        deck: whose grids and frames the cards name.
        path: of the file; its numbers stay as they are.
        sid: of the set that is wanted, None: all of it, whatever its numbers.

    Returns:
        The deck, and the number of the set.

    Raises:
        InputError: other cards, unknown grids, no such set, no load.
    """
    if not path.is_file():
        raise InputError(f"{path}: found no such file")
    bulk = read_cards(read_source(path).lines)
    problems = [*bulk.problems]
    groups: dict[str, list[RawCard]] = {}
    for card in bulk.cards:
        if card.name in CARDS:
            groups.setdefault(card.name, []).append(card)
        else:
            problems.append(
                f"{card.place}: found {card.name}, expected FORCE and MOMENT alone"
            )
    tables = make_tables(groups, lambda card, extract: [], problems, [])
    own = {name: tables[name] for name in CARDS}
    found = replace(deck, cards={**deck.cards, **own})
    if not problems:
        problems += check(found, partial=True)
    sets = sorted({int(i) for table in own.values() for i in table["sid"]})
    if not problems and not sets:
        problems.append(f"{path}: holds no FORCE and no MOMENT")
    elif not problems and sid is not None and sid not in sets:
        known = ", ".join(map(str, sets))
        problems.append(f"{path}: found no load set {sid}, expected one of {known}")
    if problems:
        raise InputError(problems)
    if sid is None:
        sid = sets[0]
        own = {name: table.assign(sid=sid) for name, table in own.items()}
        found = replace(deck, cards={**deck.cards, **own})
    return found, sid

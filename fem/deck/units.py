"""A deck in SI: every field times the units that its dimension is made of.

Only what makes the model is converted: loads are left out, since they belong to
solutions of the deck's own. Dimensions stand in the records of the cards.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pandas as pd

from fem.deck.cards.conversions import Context, Units, listed
from fem.deck.deck import Deck
from fem.deck.records import CARDS, TABLES, Card
from fem.errors import InputError, Problems, nearest

_POUND_FORCE = 4.4482216152605  # N
_INCH = 0.0254  # m

SYSTEMS: dict[str, Units] = {
    "SI": Units(1.0, 1.0),
    "mm-t-N": Units(1e-3, 1e3),
    "in-lbf": Units(_INCH, _POUND_FORCE / _INCH),  # mass in lbf s²/in
}


def units_of(name: str) -> Units:
    """A system of units by its name.

    Raises:
        InputError: no such system.
    """
    if name not in SYSTEMS:
        raise InputError(
            f"units: found '{name}', expected one of {', '.join(SYSTEMS)}"
            + nearest(name, list(SYSTEMS))
        )
    return SYSTEMS[name]


def in_si(deck: Deck, units: Units) -> Deck:
    """The deck in SI, without its loads.

    Raises:
        InputError: cards whose dimension depends on what they are used for, and here
            is not unique; all of them.
    """
    if units == SYSTEMS["SI"]:
        return deck
    problems = Problems()
    cord = deck.cards["CORD"]
    frames = dict(zip(cord["cid"], cord["type"]))
    cards: dict[str, pd.DataFrame] = {}
    for name, table in deck.cards.items():
        with problems.gathered():
            cards[name] = _converted(TABLES[name], table, units, frames, deck.cards)
    problems.report()
    increments = {n: in_si(part, units) for n, part in deck.increments.items()}
    return replace(deck, cards=cards, increments=increments)


def _converted(
    card: Card,
    table: pd.DataFrame,
    units: Units,
    frames: Mapping[int, str],
    tables: Mapping[str, pd.DataFrame],
) -> pd.DataFrame:
    if table.empty:
        return table
    if card.load:
        return table.iloc[:0]
    if not is_convertible(card):
        raise InputError(
            f"{card.name}: has no conversion of units; give the deck in SI"
        )
    table = table.copy()
    for item in card.columns.values():
        if item.dimension:
            table[item.name] = _times(table[item.name], units.factor(item.dimension))
    if card.convert:
        extents = {name: other.extent for name, other in CARDS.items()}
        card.convert(table, units, Context(card.name, frames, tables, extents))
    return table


def is_convertible(card: Card) -> bool:
    """Whether a record says what becomes of real numbers in other units."""
    fields = card.columns.values()
    reals = any(item.kind in "fu" for item in fields)
    return not reals or card.convert is not None or any(i.dimension for i in fields)


def _times(column: pd.Series, factor: float) -> pd.Series:
    if column.dtype != object:
        return column * factor
    return listed(column, [np.asarray(v, float) * factor for v in column])

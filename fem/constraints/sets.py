"""Sets of constraint cards with their unions (SPCADD, MPCADD), sets of freedoms."""

from typing import TYPE_CHECKING

import numpy as np

from fem.arrays import Int64
from fem.deck.references import table
from fem.errors import Problems
from fem.geometry.points import Points

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def member_sets(deck: "Deck", card: str, sid: int) -> list[int]:
    """Ids of the sets that `sid` stands for: itself or those of its ADD card.

    Sets that are not there constrain nothing; the deck's notices name them.

    Args:
        deck: the deck.
        card: "SPC" or "MPC".
        sid: the set that case control selects.
    """
    unions = table(deck, f"{card}ADD")
    chosen = unions[unions["sid"] == sid]
    return [int(s) for members in chosen["sets"] for s in members] or [sid]


def freedoms_of(
    deck: "Deck", points: Points, card: str, sid: int | None = None
) -> Int64:
    """Rows of the g-set that ASET, QSET or SUPORT cards name, ascending.

    Args:
        deck, points: the model.
        card: name.
        sid: set, for cards that have one.

    Raises:
        InputError: points that are not defined.
    """
    named = table(deck, card)
    if sid is not None:
        named = named[named["sid"] == sid]
    rows: list[Int64] = []
    problems = Problems()
    for point, digits in zip(named["id"], named["c"]):
        components = [int(c) for c in str(digits) if c.isdigit()] or [0]
        with problems.gathered(card):
            rows.append(points.dof(int(point), components))
    problems.report()
    return np.unique(np.concatenate(rows)) if rows else np.zeros(0, dtype=np.int64)

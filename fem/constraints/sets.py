"""Sets of constraint cards and their unions (SPCADD, MPCADD)."""

from typing import TYPE_CHECKING

from fem.errors import InputError
from fem.tables import table

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def member_sets(deck: "Deck", card: str, sid: int) -> list[int]:
    """Ids of the sets that `sid` stands for: itself or those of its ADD card.

    Args:
        deck: the deck.
        card: "SPC" or "MPC".
        sid: the set that case control selects.

    Raises:
        InputError: the set, or a set that it adds, does not exist.
    """
    rows, unions = table(deck, card), table(deck, f"{card}ADD")
    present = set(rows["sid"].astype(int))
    chosen = unions[unions["sid"] == sid]
    sets = [int(s) for members in chosen["sets"] for s in members] or [sid]
    absent = [s for s in sets if s not in present]
    if absent:
        known = sorted(present | set(unions["sid"].astype(int)))
        raise InputError(
            f"{card} set {s} is not in the deck; it has {known or 'none'}"
            for s in absent
        )
    return sets

"""The sets behind DLOAD and EXCITEID: factors, static loads, delays."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.arrays import Float64
from fem.errors import InputError
from fem.geometry.points import Points
from fem.loads.static import CARDS, combined_sets

if TYPE_CHECKING:
    from fem.deck.deck import Deck

TLOADS = ("TLOAD1", "TLOAD2")
# Kinds of enforced motion: which derivative of the displacement is given.
MOTIONS = {"DISP": 0, "VELO": 1, "ACCE": 2}


def load_factors(deck: "Deck", dload: int, names: tuple[str, str]) -> dict[int, float]:
    """Sets of dynamic loads that DLOAD stands for, and their factors.

    Args:
        deck: the deck.
        dload: number of DLOAD, or of a load itself.
        names: cards of the loads.

    Raises:
        InputError: sets that are not there.
    """
    factors = combined_sets(deck.cards["DLOAD"], dload)
    known = {sid for name in names for sid in deck.cards[name]["sid"]}
    absent = sorted(set(factors) - known)
    if absent:
        raise InputError(
            f"{deck.path}: DLOAD {dload}: {lid} is no {names[0]} or {names[1]}"
            for lid in absent
        )
    return factors


def static_sets(deck: "Deck", loadset: int, excite: int) -> list[int]:
    """Static load sets behind an EXCITEID."""
    if loadset:
        lseq = deck.cards["LSEQ"]
        chosen = lseq[(lseq["sid"] == loadset) & (lseq["exciteid"] == excite)]
        return [int(lid) for lid in chosen["lid"] if lid]
    names = (*CARDS, "LOAD")
    used = any((deck.cards[name]["sid"] == excite).any() for name in names)
    return [excite] if used else []


def split_by_delay(
    deck: "Deck", points: Points, row: pd.Series, pattern: Float64
) -> list[tuple[float, npt.NDArray[np.bool_]]]:
    """Delays of a pattern, and the rows (size,) that each holds for."""
    delays = of_freedoms(deck, points, row, "delay", "DELAY", "t")
    used = np.flatnonzero(pattern)
    return [(delay, delays == delay) for delay in np.unique(delays[used]).tolist()]


def of_freedoms(
    deck: "Deck", points: Points, row: pd.Series, field: str, card: str, value: str
) -> Float64:
    """(size,) delays or phases of a dynamic load: one number, or by freedom of a card.

    Raises:
        InputError: the set of the card is not there.
    """
    found = np.full(points.size, float(row[field]))
    sid = int(row[f"{field}id"])
    if sid:
        table = deck.cards[card]
        cards = table[table["sid"] == sid]
        if cards.empty:
            raise InputError(
                f"{row['file']}:{row['line']}: {card} {sid} is not defined"
            )
        dof = points.dof(cards["id"].to_numpy(np.int64), cards["c"].to_numpy(np.int64))
        found[dof] = cards[value].to_numpy(np.float64)
    return found

"""What a subcase asks for, in the terms of the recovery."""

import numpy as np
import numpy.typing as npt

from fem.deck.case_control import Selection, Subcase
from fem.deck.deck import Deck
from fem.elements.block import Detail, Kind

ELEMENT_RESULTS: tuple[tuple[str, Kind], ...] = (
    ("FORCE", "force"),
    ("STRESS", "stress"),
    ("STRAIN", "strain"),
)
_CORNERS = frozenset({"BILIN", "CORNER", "CUBIC", "SGAGE"})


def detail_of(deck: Deck, subcase: Subcase) -> Detail:
    """Where results of shells are wanted.

    As in Nastran, one of FORCE, STRESS and STRAIN in the first subcase decides for all
    whether quadrilaterals have results at their corners.
    """
    first = deck.case_control[0]
    words = {
        word for name, _ in ELEMENT_RESULTS for word in first.options.get(name, ())
    }
    return Detail(
        corner=bool(words & _CORNERS),
        fibre="FIBER" in subcase.options.get("STRAIN", ()),
    )


def wanted(subcase: Subcase, quantity: str) -> Selection:
    """What a subcase asks for of a quantity."""
    return subcase.outputs.get(quantity, "NONE")


def ids_of(selection: Selection) -> npt.NDArray[np.int64] | None:
    """Ids of a selection, None for all."""
    if isinstance(selection, str):
        return None if selection == "ALL" else np.zeros(0, np.int64)
    return np.fromiter(selection, np.int64)

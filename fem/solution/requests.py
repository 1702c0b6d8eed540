"""What a subcase asks for, in the terms of the recovery."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from fem.deck.checks import FREQUENCIES
from fem.deck.control.case_sets import Selection
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck
from fem.elements.block import Detail, Kind
from fem.errors import InputError, Problems
from fem.model.structure import Structure

ELEMENT_RESULTS: tuple[tuple[str, Kind], ...] = (
    ("FORCE", "force"),
    ("STRESS", "stress"),
    ("STRAIN", "strain"),
    ("STRESS", "failure"),
)
_CORNERS = frozenset({"BILIN", "CORNER", "CUBIC", "SGAGE"})


def detail_of(deck: Deck, subcase: Subcase) -> Detail:
    """Points at which results of shells are wanted.

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
    """Selection of a quantity that a subcase asks for."""
    return subcase.outputs.get(quantity, "NONE")


def ids_of(selection: Selection) -> npt.NDArray[np.int64] | None:
    """Ids of a selection, None for all."""
    if isinstance(selection, str):
        return None if selection == "ALL" else np.zeros(0, np.int64)
    return np.fromiter(selection, np.int64)


def check_requests(deck: Deck, work: Sequence[tuple[int, Sequence[Subcase]]]) -> None:
    """Refuse subcases that lack what their solution needs, before anything is computed.

    Args:
        deck: the deck.
        work: solutions with their subcases.

    Raises:
        InputError: each thing that is missing, with what the deck has to offer.
    """
    problems = Problems()
    for number, subcases in work:
        if number == 105 and not any(subcase.method for subcase in subcases):
            problems.append(
                f"{deck.path}: SOL 105 needs a subcase with METHOD (which factors); "
                "expected the number of an EIGRL or EIGB card"
            )
        for subcase in subcases:
            for command, cards, why in _NEEDED.get(number, ()):
                if not getattr(subcase, command.lower()):
                    known = sorted(
                        {int(i) for card in cards for i in deck.cards[card]["sid"]}
                    )
                    offer = (
                        f"expected {command} = {' or '.join(map(str, known[:8]))}"
                        if known
                        else f"and the deck has no {' or '.join(cards)} card"
                    )
                    problems.append(
                        f"{deck.path}: subcase {subcase.id}: SOL {number} needs "
                        f"{command} in the case control ({why}); {offer}"
                    )
    problems.report()


_NEEDED = {
    103: (("METHOD", ("EIGRL",), "which modes"),),
    108: (
        ("FREQUENCY", FREQUENCIES, "the frequencies"),
        ("DLOAD", ("RLOAD1", "RLOAD2"), "the loads"),
    ),
    109: (("TSTEP", ("TSTEP",), "the time steps"),),
    111: (
        ("METHOD", ("EIGRL",), "which modes"),
        ("FREQUENCY", FREQUENCIES, "the frequencies"),
        ("DLOAD", ("RLOAD1", "RLOAD2"), "the loads"),
    ),
    112: (
        ("METHOD", ("EIGRL",), "which modes"),
        ("TSTEP", ("TSTEP",), "the time steps"),
    ),
}


def check_free(structure: Structure, number: int) -> None:
    """Refuse dynamics of a structure that cannot move.

    Raises:
        InputError: every freedom is constrained.
    """
    if not structure.size:
        raise InputError(
            f"{structure.deck.path}: subcase {structure.subcase.id}: SOL {number}: "
            "every freedom is constrained; nothing can move"
        )

"""A deck's subcases solved as another solution than the deck's own (`--sol`).

Aeroelastic and optimization decks hold a model that can be solved for statics or modes;
their case control has most of what that needs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import pandas as pd

from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck
from fem.errors import InputError

ANALYSES: Mapping[str, int] = {
    "STATICS": 101,
    "STATIC": 101,
    "MODES": 103,
    "BUCK": 105,
    "BUCKLING": 105,
    "DFREQ": 108,
    "MFREQ": 111,
    "DTRAN": 109,
    "MTRAN": 112,
}
"""What ANALYSIS of a subcase may say, and the solution that it means."""

_NONLINEAR = frozenset({106, 129, 153, 159, 400, 401, 402, 600, 601, 701})
"""Solutions whose ANALYSIS names a step of a nonlinear one, STATICS too."""

SUPPORTED = (101, 103, 105, 108, 109, 111, 112)

_NEED_MODES = frozenset({103, 111, 112})
_COUNT = 16  # modes where the deck has no EIGRL: six of a free body and ten


def asked_by(case: Subcase, number: int) -> int:
    """The solution that a subcase of SOL `number` asks for."""
    if number in _NONLINEAR:
        return number
    return ANALYSES.get(case.analysis.upper(), number)


def ways_on(subcases: Sequence[Subcase]) -> str:
    """Ways to use subcases of a solution that is not supported (`--sol`)."""
    offers = []
    for number in SUPPORTED:
        said = [c for c in subcases if ANALYSES.get(c.analysis.upper()) == number]
        if said:
            offers.append(f"--sol {number} solves {_named(said)} as ANALYSIS says")
    told = {offer.split()[1] for offer in offers}
    loaded = [case for case in subcases if case.load or case.temperature]
    if loaded and "101" not in told:
        offers.append(f"--sol 101 solves {_named(loaded)} as statics")
    if "103" not in told:
        offers.append("--sol 103 finds the modes of the model")
    return "; ".join(offers)


def as_solution(deck: Deck, number: int) -> tuple[Deck, list[str]]:
    """The deck with its subcases as those of another solution.

    Subcases whose ANALYSIS says another solution are left out, unless all do, and so
    are those without load where statics have others. Modes are asked for once where
    subcases hold the model alike; without METHOD those of the first EIGRL, or of an
    EIGRL that is added.

    Args:
        deck: as read.
        number: one of `SUPPORTED`.

    Returns:
        The deck and what was done, in words.

    Raises:
        InputError: no such solution.
    """
    if number not in SUPPORTED:
        raise InputError(
            f"--sol: found {number}, expected {', '.join(map(str, SUPPORTED))}"
        )
    cases = _chosen(deck.case_control, number)
    kept = [
        replace(case, analysis="", not_carried_out=(), statsub=0, preload=0)
        if number != 105
        else replace(case, analysis="", not_carried_out=())
        for case in cases
    ]
    told = [f"{_named(cases)} of SOL {deck.sol or '(none)'} solved as SOL {number}"]
    if left := [case for case in deck.case_control if case not in cases]:
        told.append(f"{_named(left)} left out")
    cards = dict(deck.cards)
    if number in _NEED_MODES and not all(case.method for case in kept):
        method, text = _method(cards)
        kept = [case if case.method else replace(case, method=method) for case in kept]
        told.append(text)
    return replace(deck, sol=number, case_control=tuple(kept), cards=cards), told


def _chosen(cases: Sequence[Subcase], number: int) -> list[Subcase]:
    means = [ANALYSES.get(case.analysis.upper(), 0) for case in cases]
    fitting = [case for case, n in zip(cases, means) if n == number]
    fitting = fitting or [c for c in cases if not c.analysis] or list(cases)
    if number == 101:
        return [c for c in fitting if c.load or c.temperature] or fitting
    return _once(fitting) if number == 103 else fitting


def _once(cases: Sequence[Subcase]) -> list[Subcase]:
    """The first of those that hold and weigh the model alike."""
    first: dict[tuple[object, ...], Subcase] = {}
    for case in cases:
        held = (case.spc, case.mpc, case.suport1, case.method, case.massset, case.nsm)
        first.setdefault(held, case)
    return list(first.values())


def _method(cards: dict[str, pd.DataFrame]) -> tuple[int, str]:
    """The number of an EIGRL, added to the cards where there is none; in words."""
    table = cards["EIGRL"]
    if len(table):
        number = int(table["sid"].iloc[0])
        return number, f"METHOD = {number}, the deck's first EIGRL"
    of_kind = {"i": 0, "f": np.nan}
    blank = {n: of_kind.get(t.kind, "") for n, t in table.dtypes.items()}
    row = pd.DataFrame([blank | {"sid": 1, "nd": _COUNT}])
    cards["EIGRL"] = row.astype(table.dtypes.to_dict())
    return 1, f"the {_COUNT} lowest modes, as the deck has no EIGRL"


def _named(cases: Sequence[Subcase]) -> str:
    numbers = [case.id for case in cases]
    shown = ", ".join(map(str, numbers[:8])) + ", ..." * (len(numbers) > 8)
    return f"subcase{'s' * (len(numbers) > 1)} {shown}"

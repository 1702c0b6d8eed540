"""Kinds of input that are damaged, each with good files and what must come of them."""

import random
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from benchmarks.fuzz import campaigns, cases, cpacs, decks, matrices
from benchmarks.fuzz.outcome import Outcome


@dataclass(frozen=True)
class Kind:
    """Files of one kind.

    Attributes:
        seeds: writes good files into a folder.
        damage: writes a damaged copy of one to a place beside it.
        outcome: takes it; how that ended, and what is wrong with it.
    """

    seeds: Callable[[Path], list[Path]]
    damage: Callable[[Path, random.Random, Path], None]
    outcome: Callable[[Path], tuple[Outcome, str]]


KINDS = {
    "matrices": Kind(matrices.seeds, matrices.damaged, matrices.outcome),
    "cases": Kind(cases.seeds, cases.damaged, cases.outcome),
    "decks": Kind(decks.seeds, decks.damaged, decks.outcome),
    "cpacs": Kind(cpacs.seeds, cpacs.damaged, cpacs.outcome),
    "campaigns": Kind(campaigns.seeds, campaigns.damaged, campaigns.outcome),
}

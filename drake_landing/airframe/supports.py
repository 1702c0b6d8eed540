"""What the deck's own SPC hold: decks often stand on some for their own solution, and
an airframe must fly.
"""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fem.arrays import Int64
from fem.constraints.autospc import grouped
from fem.deck.deck import Deck
from fem.model.structure import Structure

_NAME = re.compile(r"^\s*(SPC1|SPCADD|SPC)\b", re.I | re.M)
_STIFF = 1e-9  # of the stiffness of all that moves: above rounding
_SHOWN = 8


@dataclass(frozen=True)
class Supports:
    """Freedoms of the structure that are constrained to the ground.

    Attributes:
        spc: set that the case control selects; 0 where only PS fields of grids hold.
        grids: which freedoms, in words.
        cards: of that set, by which a case can leave it out.
    """

    spc: int
    grids: str
    cards: tuple[str, ...]

    @property
    def story(self) -> str:
        """Which set holds what."""
        by = f"SPC = {self.spc}" if self.spc else "the PS field of GRID"
        return f"{by} holds {self.grids}"

    @property
    def remedy(self) -> str:
        """How the airframe comes free."""
        if not self.cards:
            return "take it out"
        return f"airframe.ignore: [{', '.join(self.cards)}] in the case goes on without"


def supports_of(structure: Structure) -> Supports | None:
    """Freedoms that SPC and PS hold against stiffness; None where there are none.

    Freedoms that AUTOSPC constrains, and others without stiffness, are no supports.
    """
    held = _held(structure)
    if not len(held):
        return None
    names = [structure.points.label(int(d)) for d in held]
    spc = structure.subcase.spc
    cards = _cards(structure.deck) if spc else ()
    return Supports(spc=spc, grids=grouped(names, _SHOWN), cards=cards)


def _cards(deck: Deck) -> tuple[str, ...]:
    """SPC, SPC1 and SPCADD as the deck writes them: both of the first are one table."""
    found = set()
    for table in ("SPC", "SPCADD"):
        for file, rows in deck.cards[table].groupby("file"):
            lines = Path(str(file)).read_bytes().decode("latin-1").splitlines()
            text = "\n".join(lines[line - 1] for line in rows["line"].unique())
            found |= {name.upper() for name in _NAME.findall(text)}
    return tuple(sorted(found))


def _held(structure: Structure) -> Int64:
    """Rows of the g-set that are fixed and have stiffness, of their own or by rigid
    elements."""
    elimination, found = structure.elimination, structure.autospc
    own = np.ones(len(elimination.s), bool)
    if found is not None:
        own = ~np.isin(elimination.s, found.dof)
    S = elimination.S[:, own]
    stiffness = structure.matrices.stiffness
    stiff = np.asarray(S.multiply(stiffness @ S).sum(axis=0)).ravel()
    least = _STIFF * float(stiffness.diagonal().max(initial=0.0))
    return elimination.s[own][stiff > least]

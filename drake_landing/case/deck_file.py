"""Whether the deck of a case is there: known before anything costly is loaded."""

from pathlib import Path

from drake_landing.case.airframe import Airframe
from fem.errors import InputError, nearest


def deck_file(airframe: Airframe) -> Path | None:
    """The deck that a case names; None: it has a built-in model or matrices.

    Raises:
        InputError: what is there in its place, and what may be meant.
    """
    deck = airframe.deck
    if deck is None or deck.is_file():
        return deck
    raise InputError(f"airframe.deck: {_instead(deck)}")


def _instead(deck: Path) -> str:
    if not deck.parent.is_dir():
        return f"found {deck}, expected a file; the folder does not exist"
    if deck.is_dir():
        return f"found {deck}, a folder; expected a file"
    others = sorted(p.name for p in deck.parent.iterdir() if p.is_file())
    return f"found {deck}, no such file" + nearest(deck.name, others)

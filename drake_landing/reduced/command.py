"""`drake-landing reduce`: from a deck to a checked reduced model in three formats."""

from pathlib import Path

from drake_landing.cache import Cache
from drake_landing.reduced.interface import interface_grids
from drake_landing.reduced.make import METHODS, Method
from drake_landing.reduced.report import report_text, write_report
from drake_landing.reduced.stored import checked_reduction
from fem.deck.reader import read_deck
from fem.errors import InputError, nearest
from fem.model.structure import Structure


def reduce_deck(
    deck: Path,
    out: Path,
    *,
    basis: str,
    interface: str | None,
    highest_hz: float,
    count: int,
    compare_hz: float,
) -> str:
    """Reduces a deck, checks and writes the result, and returns the report.

    Raises:
        InputError: the deck, the interface or an option is at fault.
    """
    structure = Structure.from_deck(read_deck(deck))
    model, checks = checked_reduction(
        structure,
        interface_grids(interface, structure),
        _method(basis),
        highest_hz=highest_hz,
        count=count,
        compare_hz=compare_hz,
        cache=Cache.of_user(),
    )
    out.mkdir(parents=True, exist_ok=True)
    files = write_report(out, model, checks)
    text = report_text(model, checks)
    return f"{text}\nwritten: {', '.join(map(str, files))}"


def _method(basis: str) -> Method:
    for method in METHODS:
        if method == basis:
            return method
    raise InputError(
        f"--basis: found '{basis}', expected one of {', '.join(METHODS)}"
        + nearest(basis, METHODS)
    )

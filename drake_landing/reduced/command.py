"""`drake-landing reduce`: from a deck to a checked reduced model in three formats."""

from pathlib import Path

from drake_landing.reduced.checks import check_reduction
from drake_landing.reduced.interface import interface_grids
from drake_landing.reduced.make import METHODS, Method, reduce_structure
from drake_landing.reduced.report import report_text, write_report
from fem.deck.reader import read_deck
from fem.errors import InputError, nearest
from fem.structure import Structure


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
    reduced = reduce_structure(
        structure,
        interface_grids(interface, structure),
        _method(basis),
        highest_hz=highest_hz,
        count=count,
    )
    checks = check_reduction(structure, reduced, compare_hz)
    out.mkdir(parents=True, exist_ok=True)
    files = write_report(out, reduced.model, checks)
    text = report_text(reduced.model, checks)
    return f"{text}\nwritten: {', '.join(map(str, files))}"


def _method(basis: str) -> Method:
    for method in METHODS:
        if method == basis:
            return method
    raise InputError(
        f"--basis: found '{basis}', expected one of {', '.join(METHODS)}"
        + nearest(basis, METHODS)
    )

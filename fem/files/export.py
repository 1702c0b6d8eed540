"""Further files of a run: OP2, ParaView, a listing like F06, PUNCH."""

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

from fem.deck.deck import Deck
from fem.deck.listing_tables import tables_of
from fem.files.atomic import write_aside
from fem.files.listing import listing
from fem.files.op2 import write_op2
from fem.files.paraview import write_paraview
from fem.files.punch import wants_punch, write_punch
from fem.model.structure import Structure


def wants_op2(deck: Deck) -> bool:
    """Whether a deck asks for an OP2 file: PARAM POST below zero."""
    return int(deck.param("POST")) < 0


def export(
    results: Path,
    deck: Deck,
    *,
    op2: bool,
    paraview: bool,
    say: Callable[[str], None],
    f06: bool = False,
    punch: bool = False,
) -> list[Path]:
    """Write the files that are wanted beside a result file.

    Args:
        results: HDF5 file of a run.
        deck: its deck.
        op2: write `<results>.op2`.
        paraview: write `<results>_<solution>.vtkhdf`.
        say: told the files, and what has no place in them.
        f06: write the listing `<results>.f06`.
        punch: write all results as `<results>.pch`; requests with PUNCH write theirs
            without it.

    Returns:
        The files.
    """
    punch_asked = wants_punch(deck)
    if not (op2 or paraview or f06 or punch or punch_asked):
        return []
    structure = Structure(deck)
    written: list[Path] = []
    if op2:
        path = results.with_suffix(".op2")
        left = write_op2(results, structure, path)
        written.append(path)
        if left:
            say(f"notice: not in {path.name}, see {results.name}: {', '.join(left)}")
    if paraview:
        written += write_paraview(results, structure, results.parent)
    if f06:
        written.append(_listing(results, structure))
    if punch or punch_asked:
        path = results.with_suffix(".pch")
        write_punch(results, structure, path, everything=punch)
        written.append(path)
    for path in written:
        say(str(path))
    return written


def _listing(results: Path, structure: Structure) -> Path:
    """Summary tables, then the tables of points and elements by pyNastran."""
    with TemporaryDirectory() as folder:
        op2 = Path(folder, "results.op2")
        write_op2(results, structure, op2)
        text = listing(results, structure) + tables_of(op2)
    path = results.with_suffix(".f06")
    write_aside(path, lambda to: to.write_text(text, encoding="utf-8") and None)
    return path

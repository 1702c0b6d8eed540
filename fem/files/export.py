"""Further files of a run for other programs: OP2, ParaView."""

from collections.abc import Callable
from pathlib import Path

from fem.deck.deck import Deck
from fem.files.op2 import write_op2
from fem.files.paraview import write_paraview
from fem.model.structure import Structure


def wants_op2(deck: Deck) -> bool:
    """Whether a deck asks for an OP2 file: PARAM POST below zero."""
    return int(deck.param("POST")) < 0


def export(
    results: Path, deck: Deck, *, op2: bool, paraview: bool, say: Callable[[str], None]
) -> list[Path]:
    """Write the files that are wanted beside a result file.

    Args:
        results: HDF5 file of a run.
        deck: its deck.
        op2: write `<results>.op2`.
        paraview: write `<results>_<solution>.vtkhdf`.
        say: told the files, and what has no place in them.

    Returns:
        The files.
    """
    if not (op2 or paraview):
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
    for path in written:
        say(str(path))
    return written

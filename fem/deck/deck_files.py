"""All files that a deck consists of."""

from pathlib import Path

from fem.deck.control.executive import read_executive
from fem.deck.superelements.matrices import assigned_files
from fem.deck.text.sections import split_sections
from fem.deck.text.source import found_file, read_source


def deck_files(path: Path) -> tuple[Path, ...]:
    """The deck, its INCLUDEs, and the matrices that it assigns; each once.

    Raises:
        InputError: one of them cannot be read.
    """
    lines = read_source(path).lines
    executive = read_executive(split_sections(lines, str(path)).executive)
    names = dict.fromkeys(line.file for line in lines)
    assigned = [found_file(name, path) for name in assigned_files(executive).values()]
    return tuple(dict.fromkeys([*map(Path, names), *assigned]))

"""Text that fits the terminal it is printed on."""

import re
import sys
from shutil import get_terminal_size
from textwrap import wrap

from fem.errors import visible

_VALUE = re.compile(r"\s*\S+(?: \S+)*\s{2,}(?=\S)")  # what stands before a value


def show(text: str) -> None:
    """Prints lines; on a terminal those that are too long go on below their values."""
    text = visible(text)
    width = get_terminal_size().columns if sys.stdout.isatty() else None
    print(fitted(text, width) if width else text)


def fitted(text: str, width: int) -> str:
    """Lines of at most `width` characters; what follows hangs below the value.

    A value is what two spaces separate from its name: `damping   none: neither ...`.
    """
    return "\n".join(part for line in text.split("\n") for part in _parts(line, width))


def _parts(line: str, width: int) -> list[str]:
    if len(line) <= width:
        return [line]
    head = _VALUE.match(line)
    indent = len(head[0]) if head else len(line) - len(line.lstrip()) + 2
    indent = indent if indent <= width // 2 else 4
    return wrap(
        line,
        width,
        subsequent_indent=" " * indent,
        break_on_hyphens=False,
        break_long_words=False,
    )

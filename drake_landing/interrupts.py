"""What Ctrl-C leaves, said before the command ends."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def told_when_interrupted(kept: Callable[[], str]) -> Iterator[None]:
    """On an interrupt a line on standard error: what is kept, and how to go on.

    Args:
        kept: makes the line, at the moment of the interrupt; the interrupt goes on.
    """
    try:
        yield
    except KeyboardInterrupt:
        print(kept(), file=sys.stderr)
        raise

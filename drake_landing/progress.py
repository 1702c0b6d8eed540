"""Progress of long work: a bar on a terminal, plain lines elsewhere.

Work is a sequence of stages; a stage may report which share of it is done.
"""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol, TextIO

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from fem.errors import visible

_PLAIN_INTERVAL = 5.0  # s between lines of one stage


class Reporter(Protocol):
    """Listener to the progress of the process."""

    def stage(self, text: str) -> None:
        """The next stage begins; the one before is complete."""
        ...

    def share(self, done: float, text: str = "") -> None:
        """Share of the stage that is done, 0 to 1, and a short remark."""
        ...


class Silent:
    """Tells nothing."""

    def stage(self, text: str) -> None:
        """Nothing."""

    def share(self, done: float, text: str = "") -> None:
        """Nothing."""


class PlainLines:
    """One line per stage, and now and then one about its share."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._start = self._last = time.monotonic()

    def stage(self, text: str) -> None:
        """One line with the elapsed time."""
        self._last = time.monotonic()
        line = f"[{self._last - self._start:6.1f} s] {visible(text)}"
        print(line, file=self._stream)
        self._stream.flush()

    def share(self, done: float, text: str = "") -> None:
        """A line every few seconds."""
        if time.monotonic() - self._last > _PLAIN_INTERVAL:
            self.stage(f"  {done:4.0%} {text}".rstrip())


class TerminalBar:
    """One bar per stage."""

    def __init__(self, progress: Progress) -> None:
        self._progress = progress
        self._task = None

    def stage(self, text: str) -> None:
        """Completes the bar before and begins one."""
        self.finish()
        self._task = self._progress.add_task(text, total=1.0, remark="")

    def share(self, done: float, text: str = "") -> None:
        """Moves the bar."""
        if self._task is not None:
            self._progress.update(self._task, completed=done, remark=text)

    def finish(self) -> None:
        """Completes the last bar."""
        self.share(1.0)


@contextmanager
def reporter(stream: TextIO | None = None) -> Iterator[Reporter]:
    """A bar if the stream (standard error) is a terminal, else plain lines."""
    out: TextIO = sys.stderr if stream is None else stream
    if not out.isatty():
        yield PlainLines(out)
        return
    columns = (
        TextColumn("{task.description:<44}"),
        BarColumn(bar_width=30),
        TimeElapsedColumn(),
        TextColumn("{task.fields[remark]}"),
    )
    with Progress(*columns, console=Console(file=out)) as progress:
        bar = TerminalBar(progress)
        yield bar
        bar.finish()


@contextmanager
def told_when_interrupted(kept: Callable[[], str]) -> Iterator[None]:
    """Prints a line when interrupted: what is kept, and how to go on.

    Args:
        kept: makes the line, at the moment of the interrupt, which goes on.
    """
    try:
        yield
    except KeyboardInterrupt:
        print(kept(), file=sys.stderr)
        raise

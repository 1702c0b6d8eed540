"""How a deck is run, and who is told about it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

from fem.algebra.linear_solver import SolverName


class Console(Protocol):
    """Receives what a run has to say."""

    def say(self, text: str) -> None:
        """A line, or several."""
        ...

    def progress(self, task: str) -> Callable[[int, int], None]:
        """A progress display for a task; called with (done, all)."""
        ...


class Quiet:
    """Says nothing."""

    def say(self, text: str) -> None:
        """Drop the text."""

    def progress(self, task: str) -> Callable[[int, int], None]:
        """A display that shows nothing."""
        return lambda done, total: None


@dataclass(frozen=True, kw_only=True)
class Options:
    """Options of a run.

    Attributes:
        solver: sparse solver; None: PARDISO where it is installed.
        threads: its threads; None: the environment's number, else all cores.
        envelope: in transients, extremes of all element results over time.
        bar_loads: results of bars and beams in transients include what PLOAD1 does
            between their ends, as they do in statics. Nastran's include it at the
            stations of CBARAO only; without, its other tables are met.
        quality: print the worst shapes of elements as a table.
        console: who is told.
    """

    solver: SolverName | None = None
    threads: int | None = None
    envelope: bool = False
    bar_loads: bool = True
    quality: bool = False
    console: Console = field(default_factory=Quiet)


_ELEMENTS = frozenset({"FORCE", "STRESS", "STRAIN"})
_CONSTRAINTS = frozenset({"SPCFORCES", "MPCFORCES", "GPFORCE"})
_MOTION = frozenset({"DISPLACEMENT", "VELOCITY", "ACCELERATION"})
# What case control may ask for and each solution writes.
WRITTEN: dict[int, frozenset[str]] = {
    101: _ELEMENTS | _CONSTRAINTS | {"DISPLACEMENT", "OLOAD", "ESE"},
    103: _ELEMENTS | _CONSTRAINTS | {"DISPLACEMENT", "ESE"},
    105: _ELEMENTS | {"DISPLACEMENT", "SPCFORCES", "MPCFORCES", "ESE"},
    109: _ELEMENTS | _CONSTRAINTS | _MOTION | {"OLOAD"},
}
WRITTEN[112] = WRITTEN[109]
WRITTEN[108] = _MOTION | {"SPCFORCES", "MPCFORCES", "OLOAD"} | _ELEMENTS
WRITTEN[111] = WRITTEN[108]

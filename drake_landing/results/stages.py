"""Stages of a run: told as they begin, measured as they end."""

import resource
import sys
import time as clock
from collections.abc import Mapping
from dataclasses import dataclass

import pandas as pd

from drake_landing.progress import Reporter, Silent
from fem.response.observation import Chunk, Observer

_PER_GB = 1e9 if sys.platform == "darwin" else 1e6  # of what the system tells


@dataclass(frozen=True, kw_only=True)
class Spent:
    """What a stage took: wall and processor time (s)."""

    wall: float = 0.0
    processor: float = 0.0

    def __add__(self, other: "Spent") -> "Spent":
        return Spent(
            wall=self.wall + other.wall, processor=self.processor + other.processor
        )

    def __sub__(self, other: "Spent") -> "Spent":
        return Spent(
            wall=self.wall - other.wall, processor=self.processor - other.processor
        )

    @classmethod
    def now(cls) -> "Spent":
        """Both clocks."""
        return cls(wall=clock.perf_counter(), processor=clock.process_time())

    @classmethod
    def of_thread(cls) -> "Spent":
        """Processor time of this thread alone, whose wall time is another's, too."""
        return cls(processor=clock.thread_time())


class Stages:
    """Tells the stages and measures them.

    Attributes:
        progress: hears of the stages.
        spent: stage -> what it took; ended stages only.
        memory: stage -> peak memory of the process at its end, GB.
    """

    def __init__(self, progress: Reporter | None = None) -> None:
        self.progress = progress or Silent()
        self.spent: dict[str, Spent] = {}
        self.memory: dict[str, float] = {}
        self._name, self._start = "", Spent()

    def begin(self, name: str, told: str = "") -> None:
        """Ends the stage before and begins one; `told` says more on the progress."""
        self.end()
        self._name, self._start = name, Spent.now()
        self.progress.stage(f"{name} {told}".rstrip())

    def end(self) -> None:
        """Ends the stage."""
        if self._name:
            before = self.spent.get(self._name, Spent())
            self.spent[self._name] = before + (Spent.now() - self._start)
            self.memory[self._name] = peak_memory_gb()
        self._name = ""

    def split(self, parts: Mapping[str, Spent]) -> None:
        """Books parts of the stage that runs under their own names."""
        for name, spent in parts.items():
            self.spent[name] = self.spent.get(name, Spent()) + spent
            self.memory[name] = peak_memory_gb()
            self._start = self._start + spent

    @property
    def seconds(self) -> dict[str, float]:
        """Stage -> wall time, s."""
        return {name: spent.wall for name, spent in self.spent.items()}

    def table(self) -> pd.DataFrame:
        """Rows `stage, wall, share, processor, memory_gb`, and their total."""
        wall = sum(spent.wall for spent in self.spent.values())
        rows = [
            [
                name,
                spent.wall,
                spent.wall / wall if wall else 0.0,
                spent.processor,
                self.memory[name],
            ]
            for name, spent in self.spent.items()
        ]
        processor = sum(spent.processor for spent in self.spent.values())
        highest = max(self.memory.values(), default=0.0)
        rows.append(["all", wall, 1.0, processor, highest])
        heads = ["stage", "wall", "share", "processor", "memory_gb"]
        return pd.DataFrame(rows, columns=heads)


class Timed:
    """An observer whose processor time is taken; it works beside the steps."""

    def __init__(self, observer: Observer) -> None:
        self._observer = observer
        self.spent = Spent()

    def begin(self, time, cases: int, size: int) -> None:
        """See `Observer`."""
        self._observer.begin(time, cases, size)

    def observe(self, chunk: Chunk) -> None:
        """See `Observer`."""
        start = Spent.of_thread()
        self._observer.observe(chunk)
        self.spent = self.spent + (Spent.of_thread() - start)

    def memory_bytes(self, times: int, cases: int, size: int) -> int:
        """See `Observer`."""
        return self._observer.memory_bytes(times, cases, size)


def peak_memory_gb() -> float:
    """Largest memory that the process has held, GB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / _PER_GB

"""Observers in a thread of their own, beside the steps that follow."""

from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Self

from fem.response.observation import Chunk, Observer


class Beside:
    """Hands chunks to observers while the integrator goes on; a context manager.

    Solves and products of arrays leave Python's lock alone, so that a second core takes
    the observers. They are called in order, one chunk at a time: the arrays of a chunk
    may be written again as soon as the next chunk has been handed over.

    Args:
        observers: each hears of every chunk.
    """

    def __init__(self, observers: Sequence[Observer]) -> None:
        self._observers = observers
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="observers")
        self._pending: Future[None] | None = None

    def emit(self, chunk: Chunk) -> None:
        """Begins to observe a chunk when the one before is done.

        Raises:
            Exception: whatever an observer raised over the chunk before.
        """
        self.wait()
        self._pending = self._thread.submit(self._observe, chunk)

    def wait(self) -> None:
        """Until nothing is under way; raises as `emit` does."""
        pending, self._pending = self._pending, None
        if pending is not None:
            pending.result()

    def _observe(self, chunk: Chunk) -> None:
        for observer in self._observers:
            observer.observe(chunk)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, *_: object) -> None:
        try:
            if kind is None:
                self.wait()
        finally:
            self._thread.shutdown()

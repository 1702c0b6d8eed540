"""Tasks on a Dask cluster: the local machine's processes, or any scheduler's workers.

A task leaves its result in files; the engine only counts. A worker that dies, or a
scheduler that goes away, costs the tasks that were under way: these are submitted again
where workers are left, or by the next run, which finds the files of all others.
"""

import errno
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeGuard, TypeVar

from drake_landing.progress import Reporter
from fem.errors import InputError

T = TypeVar("T")

_THREADS = {
    name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
}
_RETRIES = 2  # of a task whose worker was lost
_UNDER_WAY = 512  # tasks that the scheduler knows
_WITHOUT_WORKERS = 300.0  # s, after which it is given up that one comes back
_PAUSE = 0.02  # s between two looks at what is done


@dataclass(frozen=True, kw_only=True)
class Pool:
    """Place where tasks run: processes of this machine, or a scheduler.

    Attributes:
        scheduler: `local`, `here` (this process, one after another), or the address
            of a Dask scheduler, tcp://host:8786.
        workers: processes of a local cluster; None: one per core.
        memory_gb: limit of each, beyond which it is restarted; 0: none.
    """

    scheduler: str = "local"
    workers: int | None = None
    memory_gb: float = 0.0


class NoWorkers(RuntimeError):
    """All workers have gone, and none comes back."""

    for_users = True


@contextmanager
def engine(pool: Pool) -> Iterator["Engine"]:
    """A cluster for as long as it is needed.

    Raises:
        InputError: no scheduler answers at the address.
    """
    if pool.scheduler == "here":
        yield Engine(None)
        return
    # Heavy, and needed by campaigns only.
    from dask.config import set as configured
    from distributed import Client, LocalCluster

    quiet = {
        "distributed.worker.memory.target": False,
        "distributed.worker.memory.spill": False,
        "distributed.nanny.pre-spawn-environ": {**_THREADS, "MALLOC_ARENA_MAX": "2"},
        # It looks at the stack of the task a hundred times a second, in its way.
        "distributed.worker.profile.enabled": False,
        "distributed.logging.distributed": "error",
    }
    with configured(quiet):
        if pool.scheduler == "local":
            cluster = LocalCluster(
                n_workers=pool.workers or os.cpu_count() or 1,
                threads_per_worker=1,
                processes=True,
                memory_limit=int(pool.memory_gb * 1e9) or 0,
                # It has a server for its state in any case: here, at any port.
                dashboard_address="127.0.0.1:0",
                scheduler_kwargs={"dashboard": False},
                silence_logs=50,
            )
            with cluster, Client(cluster) as client:
                yield Engine(client)
            return
        try:
            client = Client(pool.scheduler, timeout=20)
        except (OSError, ValueError) as error:
            raise InputError(
                f"--scheduler: found {pool.scheduler}, expected local, or the address "
                f"of a Dask scheduler that answers ({error})"
            ) from None
        with client:
            yield Engine(client)


class Engine:
    """Runs tasks and hands over what they return, in the order of completion.

    Args:
        client: of a cluster; None: this process.
    """

    def __init__(self, client: Any) -> None:
        self._client = client

    def run(
        self,
        function: Callable[[T], Any],
        tasks: Sequence[T],
        lost: Callable[[T, str], None],
        progress: Reporter,
    ) -> Iterator[Any]:
        """Results of all tasks.

        Args:
            function: of a module, no closure.
            tasks: picklable.
            lost: hears of a task that no worker survived, and why.
            progress: told the share that is done.
        """
        total = len(tasks)
        for done, result in enumerate(self._results(function, tasks, lost), start=1):
            progress.share(done / total, f"{done} of {total}")
            if result is not None:
                yield result

    def _results(
        self,
        function: Callable[[T], Any],
        tasks: Sequence[T],
        lost: Callable[[T, str], None],
    ) -> Iterator[Any]:
        if self._client is None:
            yield from self._here(function, tasks, lost)
            return
        from distributed import as_completed

        def submit(task: T) -> Any:
            future = self._client.submit(function, task, pure=False, retries=_RETRIES)
            task_of[future] = task
            return future

        task_of: dict[Any, T] = {}
        waiting = iter(tasks)
        # The scheduler's memory grows with the tasks it knows: it is given some at a
        # time.
        under_way = as_completed([submit(t) for t in islice(waiting, _UNDER_WAY)])
        for future in self._completed(under_way):
            under_way.update([submit(t) for t in islice(waiting, 1)])
            task = task_of.pop(future)
            if future.status == "finished":
                yield future.result()
            else:
                error = future.exception() if future.status == "error" else None
                if no_space(error):
                    raise error
                lost(task, _why(error or future.status))
                yield None
            future.release()

    def _completed(self, under_way: Any) -> Iterator[Any]:
        """Futures as they are done.

        Raises:
            NoWorkers: there is no worker any more, and none comes back.
        """
        looked = seen = time.monotonic()
        while under_way.count():
            batch = under_way.next_batch(block=False)
            yield from batch
            now = time.monotonic()
            if batch:
                seen = now
            elif now - looked > 0.1 * _WITHOUT_WORKERS:
                looked = now
                if self._client.scheduler_info()["workers"]:
                    seen = now
                elif now - seen > _WITHOUT_WORKERS:
                    raise NoWorkers(
                        f"no worker for {_WITHOUT_WORKERS:.0f} s: they end as they "
                        "start (memory, an installation that changed?); what is done "
                        "is kept, the same command goes on"
                    )
            if not batch:
                time.sleep(_PAUSE)

    @staticmethod
    def _here(
        function: Callable[[T], Any],
        tasks: Sequence[T],
        lost: Callable[[T, str], None],
    ) -> Iterator[Any]:
        for task in tasks:
            try:
                yield function(task)
            except Exception as error:
                if no_space(error):
                    raise
                lost(task, _why(error))
                yield None


def no_space(error: object) -> TypeGuard[OSError]:
    """Whether the disk is full: no case can leave its result until there is room."""
    return isinstance(error, OSError) and error.errno in (errno.ENOSPC, errno.EDQUOT)


def _why(error: object) -> str:
    """What is told of a task without a result."""
    text = str(error).strip() or type(error).__name__
    return (
        f"no worker survived it: {text}" if "Killed" in type(error).__name__ else text
    )

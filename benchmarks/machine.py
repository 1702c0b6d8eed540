"""What the machine gives: read bandwidth of its memory, memory in use, its kind."""

import os
import platform
import resource
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from time import perf_counter, process_time

import numpy as np


@dataclass(frozen=True)
class Bandwidth:
    """Bytes per second that can be read from memory.

    Attributes:
        wall: by the wall clock, with all the threads that were asked for.
        process: per second of processor time of one thread: what counts on a machine
            that is shared.
    """

    wall: float
    process: float


def read_bandwidth(threads: int, *, rounds: int = 8, megabytes: int = 512) -> Bandwidth:
    """Best of several rounds of reading an array that no cache holds."""
    arrays = np.array_split(np.ones(megabytes * 125_000), threads)
    size = 8.0 * sum(len(a) for a in arrays)
    wall = process = np.inf
    with ThreadPoolExecutor(threads) as pool:
        for _ in range(rounds):
            start, used = perf_counter(), process_time()
            list(pool.map(lambda a: float(a @ a), arrays))
            wall = min(wall, perf_counter() - start)
            process = min(process, process_time() - used)
    return Bandwidth(wall=size / wall, process=size / process)


def peak_memory() -> float:
    """Largest resident memory of this process so far, bytes."""
    return 1024.0 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def load() -> float:
    """Processes that wanted to run during the last minute."""
    return os.getloadavg()[0]


def description() -> str:
    """Kind of machine, in general words."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    kind = platform.machine() or "unknown"
    return f"a machine ({kind}) with {os.cpu_count()} cores and {memory:.0f} GiB"

"""One thread for the small matrices of a simulation."""

from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits


@contextmanager
def single_threaded_blas() -> Iterator[None]:
    """Inside, numpy's matrix products use one thread.

    A system's callback multiplies matrices of tens of rows ten thousand times; waking
    other threads for that costs more than the product, and takes them from whoever
    shares the machine. No environment variable is needed, and what comes afterwards
    (PARDISO above all) has its threads back.
    """
    with threadpool_limits(limits=1, user_api="blas"):
        yield

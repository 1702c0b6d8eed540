"""What a VectorLogSink has logged, as a table over time."""

from collections.abc import Sequence

import pandas as pd
from pydrake.systems.framework import Context
from pydrake.systems.primitives import VectorLogSink

from drake_landing.landing.handover import distinct_instants


def log_table(
    logger: VectorLogSink, context: Context, columns: Sequence[str]
) -> pd.DataFrame:
    """The samples of a logger after a run.

    Args:
        logger: as LogVectorOutput returns it.
        context: the root context of the run.
        columns: one name for each element of the logged port.

    Returns:
        One row per sample, the time (s) as index. Where an event left samples a
        rounding error apart, the last of them stays. Tables of loggers that publish
        at every step of one run share their index.

    Raises:
        ValueError: the number of columns is not the size of the port.
    """
    log = logger.FindLog(context)
    size = log.data().shape[0]
    if len(columns) != size:
        raise ValueError(
            f"log {logger.get_name()!r}: {len(columns)} columns, expected {size}, the "
            "size of the port"
        )
    keep = distinct_instants(log.sample_times())
    index = pd.Index(log.sample_times()[keep], name="time")
    return pd.DataFrame(log.data().T[keep], index=index, columns=list(columns))

"""What an EIGRL card asks for."""

import numpy as np
import pandas as pd

from fem.errors import InputError


def request(card: pd.Series) -> tuple[int | None, tuple[float | None, float | None]]:
    """Count and band of an EIGRL card.

    Raises:
        InputError: neither ND nor V2, or limits that do not ascend.
    """
    low = None if np.isnan(card["v1"]) else float(card["v1"])
    high = None if np.isnan(card["v2"]) else float(card["v2"])
    count = int(card["nd"]) or None
    where = f"{card['file']}:{card['line']}: EIGRL {card['sid']}"
    if low is not None and high is not None and not low < high:
        raise InputError(f"{where}: V1 {low:g} and V2 {high:g} must ascend")
    if high is not None and high <= 0.0:
        raise InputError(f"{where}: V2 is {high:g} Hz, expected a positive frequency")
    if count is None and high is None:
        # As Nastran: without a limit and a count, the lowest mode is meant.
        count = 1
    return count, (low, high)

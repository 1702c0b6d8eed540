"""Modal damping ratios from SDAMPING and TABDMP1."""

import numpy as np

from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.deck.deck import Deck
from fem.errors import InputError


def modal_ratios(deck: Deck, subcase: Subcase, frequency_hz: Float64) -> Float64:
    """(m,) damping ratios ζ of modes; zero where the subcase selects no SDAMPING.

    Values between the points of the table are interpolated, beyond them extrapolated
    from the last two, as Nastran does.

    Raises:
        InputError: the table is not there, or its type is unknown.
    """
    if not subcase.sdamping:
        return np.zeros(len(frequency_hz))
    table = deck.cards["TABDMP1"]
    found = table[table["tid"] == subcase.sdamping]
    if found.empty:
        raise InputError(
            f"{deck.path}: subcase {subcase.id}: SDAMPING = {subcase.sdamping}, "
            f"expected a TABDMP1: {sorted(table['tid'].tolist()) or 'none in the deck'}"
        )
    row = found.iloc[0]
    values = _interpolated(np.asarray(row["fs"]), np.asarray(row["gs"]), frequency_hz)
    kind = str(row["type"] or "G").upper()
    if kind == "G":
        return 0.5 * values
    if kind == "CRIT":
        return values
    if kind == "Q":
        return 0.5 / np.where(values > 0.0, values, np.inf)
    raise InputError(
        f"{row['file']}:{row['line']}: TABDMP1 {row['tid']}: type {kind}, expected G, "
        "CRIT or Q"
    )


def _interpolated(x: Float64, y: Float64, at: Float64) -> Float64:
    """Linear between the points and beyond the first and last two."""
    if len(x) == 1:
        return np.full(len(at), float(y[0]))
    i = np.clip(np.searchsorted(x, at) - 1, 0, len(x) - 2)
    step = np.where(x[i + 1] > x[i], x[i + 1] - x[i], 1.0)
    return y[i] + (at - x[i]) / step * (y[i + 1] - y[i])

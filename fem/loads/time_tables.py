"""Functions of time that cards give: TABLED1 to TABLED4, and the pulse of TLOAD2."""

from typing import TYPE_CHECKING

import pandas as pd

from fem.deck.references import where
from fem.errors import InputError
from fem.loads.time_functions import Pulse, Scaled, Series, Table, TimeFunction

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def time_function(deck: "Deck", name: str, row: pd.Series) -> TimeFunction:
    """Time function of a row of TLOAD1 or TLOAD2.

    Raises:
        InputError: as for `table_function`; T1, T2 or B of TLOAD2 out of range.
    """
    if name == "TLOAD1":
        return table_function(deck, int(row["tid"]))
    if not row["t2"] > row["t1"]:
        raise InputError(
            f"{where(name, row)}: T1 {row['t1']:g}, T2 {row['t2']:g} must ascend"
        )
    if row["b"] < 0.0:
        raise InputError(f"{where(name, row)}: B {row['b']:g}, expected 0 or more")
    return Pulse(
        start=float(row["t1"]),
        end=float(row["t2"]),
        frequency=float(row["f"]),
        phase=float(row["p"]),
        growth=float(row["c"]),
        power=float(row["b"]),
    )


def table_function(deck: "Deck", tid: int) -> TimeFunction:
    """TABLED1 to TABLED4 of that id.

    Raises:
        InputError: it does not exist, or has a logarithm of what is not positive.
    """
    others = deck.cards["TABLED2"]
    others = others[others["tid"] == tid]
    if not others.empty:
        return _shifted(others.iloc[0])
    tables = deck.cards["TABLED1"]
    found = tables[tables["tid"] == tid]
    if found.empty:
        raise InputError(f"{deck.path}: TABLED1 {tid} is not defined")
    row = found.iloc[0]
    for axis, values in (("xaxis", row["xs"]), ("yaxis", row["ys"])):
        if row[axis] == "LOG" and not (values > 0.0).all():
            raise InputError(
                f"{where('TABLED1', row)}: {axis.upper()} LOG needs positive values"
            )
    return Table(
        x=row["xs"],
        y=row["ys"],
        log_x=row["xaxis"] == "LOG",
        log_y=row["yaxis"] == "LOG",
        flat=bool(row["extrap"]),
    )


def _shifted(row: pd.Series) -> TimeFunction:
    """TABLED2, TABLED3 or TABLED4."""
    if row["kind"] == 4:
        table = Series(terms=row["ys"], lowest=row["xs"][0], highest=row["xs"][1])
        return Scaled(table, float(row["x1"]), float(row["x2"]))
    table = Table(x=row["xs"], y=row["ys"], flat=bool(row["extrap"]))
    return Scaled(table, float(row["x1"]), float(row["x2"]))

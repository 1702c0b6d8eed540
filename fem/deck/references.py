"""Joining card tables: references from one card to another, with complete messages."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.deck.records import TABLES, table_of
from fem.errors import InputError

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def table(deck: "Deck", card: str) -> pd.DataFrame:
    """The table of a card; empty with its columns where the deck has none."""
    found = deck.cards.get(card)
    if found is not None:
        return found
    return pd.DataFrame(columns=[*TABLES[card].columns, "file", "line"])


def column(rows: pd.DataFrame, name: str) -> npt.NDArray[np.float64]:
    """A column of numbers, blanks as zero."""
    return np.nan_to_num(rows[name].to_numpy(float))


def where(card: str, row: pd.Series) -> str:
    """Name of a card for messages: "wing.bdf:12: CBAR 5"."""
    place = f"{row['file']}:{row['line']}: " if row.get("file") else ""
    return f"{place}{card} {row[id_column(card)]}"


def id_column(card: str) -> str:
    """Name of the column with the id of a card: "eid", "pid", "sid" ..."""
    return next(iter(TABLES[table_of(card)].columns))


def refer(
    rows: pd.DataFrame, card: str, column: str, targets: pd.DataFrame, kind: str
) -> pd.DataFrame:
    """For each row the target row whose id equals `rows[column]`.

    Args:
        rows: referring cards.
        card: their name, for messages.
        column: the referring column.
        targets: the table that is referred to.
        kind: its card, "PBAR".

    Returns:
        One target row for each row, in their order, index 0 ... n-1.

    Raises:
        InputError: absent targets, one line per absent id with its first user.
    """
    key = id_column(kind)
    known = targets.drop_duplicates(key, keep="last").set_index(key, drop=False)
    wanted = rows[column].to_numpy()
    absent = ~np.isin(wanted, known.index.to_numpy())
    if absent.any():
        raise InputError(_absent(rows[absent], card, column, known.index, kind))
    return known.loc[wanted].reset_index(drop=True)


def _absent(
    rows: pd.DataFrame, card: str, column: str, known: Iterable[int], kind: str
) -> list[str]:
    problems = []
    for wanted, users in rows.groupby(column, sort=True):
        near = sorted(known, key=lambda i: abs(int(i) - int(str(wanted))))[:3]
        others = f" and {len(users) - 1} more" if len(users) > 1 else ""
        expected = (
            f"; the nearest are {sorted(near)}" if near else "; the deck has none"
        )
        problems.append(
            f"{where(card, users.iloc[0])}{others}: {kind} {wanted} is not defined"
            f"{expected}"
        )
    return problems

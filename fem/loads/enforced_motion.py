"""Motion of constrained freedoms by dynamic loads of TYPE DISP, VELO or ACCE."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64
from fem.constraints.spc import freedoms
from fem.deck.control.subcase import Subcase
from fem.deck.references import where
from fem.errors import InputError
from fem.geometry.points import Points
from fem.loads.dynamic_sets import (
    MOTIONS,
    TLOADS,
    load_factors,
    split_by_delay,
    static_sets,
)
from fem.loads.time_functions import Delayed, TimeFunction
from fem.loads.time_tables import time_function

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class EnforcedMotion:
    """Motion of constrained freedoms: a pattern times a function or its integrals.

    Attributes:
        pattern: (size,) displacement frames.
        function: of time, the derivative of that order.
        order: 0 displacement, 1 velocity, 2 acceleration.
        start: displacement and velocity at t = 0 where these follow by integration.
    """

    pattern: Float64
    function: TimeFunction
    order: int
    start: tuple[float, float]


def dynamic_motions(
    deck: "Deck", points: Points, subcase: Subcase
) -> list[EnforcedMotion]:
    """Motions by TLOAD1 and TLOAD2 of TYPE DISP, VELO or ACCE in a subcase.

    Raises:
        InputError: no SPCD of EXCITEID, undefined sets or tables.
    """
    factors = load_factors(deck, subcase.dload, TLOADS) if subcase.dload else {}
    found = []
    for name in TLOADS:
        rows = deck.cards[name]
        rows = rows[rows["sid"].isin(factors) & rows["type"].isin(list(MOTIONS))]
        for _, row in rows.iterrows():
            function = time_function(deck, name, row)
            spatial = motion_of(deck, points, subcase, name, row)
            spatial = factors[row["sid"]] * spatial
            for delay, chosen in split_by_delay(deck, points, row, spatial):
                found.append(
                    EnforcedMotion(
                        pattern=np.where(chosen, spatial, 0.0),
                        function=Delayed(function, delay) if delay else function,
                        order=MOTIONS[row["type"]],
                        start=(float(row["us0"]), float(row["vs0"])),
                    )
                )
    return found


def motion_of(
    deck: "Deck", points: Points, subcase: Subcase, name: str, row: pd.Series
) -> Float64:
    """Motion (size,) of constrained freedoms that EXCITEID stands for: SPCD cards.

    Without any of that number (or of that LSEQ's), the SPC cards of that number with
    values, the older way.

    Raises:
        InputError: there are none.
    """
    excite = int(row["exciteid"])
    sets = [excite]
    if subcase.loadset:
        sets += static_sets(deck, subcase.loadset, excite)
    total = np.zeros(points.size)
    for card in ("SPCD", "SPC"):
        rows = deck.cards[card]
        rows = rows[rows["sid"].isin(sets) & (rows["d"] != 0.0)]
        if not rows.empty:
            np.add.at(total, *freedoms(rows, card, points))
            return total
    raise InputError(
        f"{where(name, row)}: TYPE {row['type']}: EXCITEID {excite} has no SPCD with "
        "a value; expected the freedoms that are moved"
    )

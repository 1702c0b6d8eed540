"""Static load vectors of a load set, and the combinations of LOAD cards."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64, Int64
from fem.constraints.spc import freedoms
from fem.deck.references import where
from fem.errors import InputError
from fem.geometry.points import Points
from fem.loads.bar_loads import bar_loads, loads_of_bars
from fem.loads.concentrated import CONCENTRATED
from fem.loads.element_loads import ElementLoads, below_each_other
from fem.loads.inertial import ACCELERATIONS, accelerations, spinning_masses
from fem.loads.pressure import pload, pload2, pload4
from fem.loads.ring_loads import ploadx, ploadx1

if TYPE_CHECKING:
    from fem.deck.deck import Deck


_ON_ELEMENTS = {
    "PLOAD": pload,
    "PLOAD1": bar_loads,
    "PLOAD2": pload2,
    "PLOAD4": pload4,
    "PLOADX": ploadx,
    "PLOADX1": ploadx1,
}
CARDS = (*CONCENTRATED, *_ON_ELEMENTS, *ACCELERATIONS)


def combined_sets(table: pd.DataFrame, sid: int) -> dict[int, float]:
    """Sets and factors of LOAD or DLOAD cards of a number, else that number itself."""
    cards = table[table["sid"] == sid]
    if cards.empty:
        return {sid: 1.0}
    factors: dict[int, float] = {}
    for _, row in cards.iterrows():
        for scale, lid in zip(row["scales"], row["lids"]):
            factors[lid] = factors.get(lid, 0.0) + row["s"] * scale
    return factors


def load_factors(deck: "Deck", sid: int) -> dict[int, float]:
    """Sets and their factors that a set stands for: itself, or those of a LOAD card.

    Sets of a LOAD card that are not there load nothing; `check_selected` says so.

    Raises:
        InputError: the set is empty, or a LOAD card combines itself.
    """
    factors = combined_sets(deck.cards["LOAD"], sid)
    known = {
        number: factor
        for number, factor in factors.items()
        if any((deck.cards[name]["sid"] == number).any() for name in _SETS)
    }
    if not known:
        absent = ", ".join(map(str, factors))
        nested = not factors.keys().isdisjoint(deck.cards["LOAD"]["sid"].tolist())
        what = "combines sets itself" if nested else "is not defined"
        raise InputError(
            f"{deck.path}: load set {absent} {what}"
            + (f" (LOAD {sid})" if sid not in factors else "")
        )
    return known


_SETS = (*CARDS, "SPCD")


def static_load(
    deck: "Deck",
    points: Points,
    sid: int,
    mass_gg: sp.spmatrix | sp.sparray | None = None,
) -> Float64:
    """Load vector (size,) of the g-set in the displacement frames.

    Args:
        deck: the deck.
        points: its points.
        sid: a load set or a LOAD card.
        mass_gg: (size, size) mass, PARAM WTMASS included; GRAV, ACCEL, ACCEL1 and
            RFORCE need it.

    Raises:
        InputError: an undefined set or impossible loads.
    """
    total = np.zeros(points.size)
    field = np.zeros(points.size)
    for number, factor in load_factors(deck, sid).items():
        for name in CARDS:
            rows = deck.cards[name]
            rows = rows[rows["sid"] == number]
            if rows.empty:
                continue
            if name in ACCELERATIONS:
                field += factor * accelerations(points, name, rows)
                if name == "RFORCE":
                    total += factor * spinning_masses(deck, points, rows)
            else:
                dof, values = _terms(deck, points, name, rows)
                if not np.isfinite(values).all():
                    raise InputError(_not_finite(deck, points, name, rows))
                np.add.at(total, dof, factor * values)
    if field.any():
        if mass_gg is None:
            raise ValueError("GRAV, ACCEL, ACCEL1 and RFORCE need the mass matrix")
        total += sp.csr_matrix(mass_gg) @ field
    bad = np.flatnonzero(~np.isfinite(total))
    if len(bad):
        raise InputError(
            f"{deck.path}: load set {sid}: the load at {points.label(int(bad[0]))} is "
            f"{total[bad[0]]:g}, expected factors and loads whose sum is a number"
        )
    return total


def _not_finite(
    deck: "Deck", points: Points, name: str, rows: pd.DataFrame
) -> list[str]:
    """The cards whose loads are no numbers."""
    found = []
    for i in range(len(rows)):
        row = rows.iloc[[i]].reset_index(drop=True)
        if not np.isfinite(_terms(deck, points, name, row)[1]).all():
            found.append(
                f"{where(name, row.iloc[0])}: its load is beyond the range of double "
                "precision (1e308)"
            )
    return found[:20]


def static_element_loads(deck: "Deck", points: Points, sid: int) -> ElementLoads | None:
    """Loads of a load set that act on elements between grids; None: there are none.

    Args:
        deck, points, sid: as for `static_load`, whose vector contains them.
    """
    if not sid or deck.cards["PLOAD1"].empty:
        return None
    parts = []
    for number, factor in load_factors(deck, sid).items():
        rows = deck.cards["PLOAD1"]
        rows = rows[rows["sid"] == number]
        if not rows.empty:
            parts.append(loads_of_bars(deck, points, rows).times(factor))
    return below_each_other(parts) if parts else None


def _terms(
    deck: "Deck", points: Points, name: str, rows: pd.DataFrame
) -> tuple[Int64, Float64]:
    if name in CONCENTRATED:
        return CONCENTRATED[name](points, rows)
    return _ON_ELEMENTS[name](deck, points, rows)


def enforced_displacements(
    deck: "Deck", points: Points, sid: int
) -> tuple[Int64, Float64]:
    """Rows of the g-set and displacements that SPCD cards of a load set give.

    Cards of the selected set itself count as they are, beside a LOAD card of its number
    (MSC's demonstration problem ab4). The rows must be constrained by the SPC set of
    the subcase, too.
    """
    if not sid:
        return np.zeros(0, np.int64), np.zeros(0)
    total: dict[int, float] = {}
    for number, factor in (load_factors(deck, sid) | {sid: 1.0}).items():
        rows = deck.cards["SPCD"]
        rows = rows[rows["sid"] == number]
        for dof, value in zip(*freedoms(rows, "SPCD", points)):
            total[int(dof)] = total.get(int(dof), 0.0) + factor * float(value)
    dofs = sorted(total)
    return np.array(dofs, np.int64), np.array([total[d] for d in dofs], float)

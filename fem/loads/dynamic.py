"""Dynamic excitation: load patterns times functions of time, initial state, steps."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64
from fem.deck.control.subcase import Subcase
from fem.deck.references import where
from fem.errors import InputError
from fem.geometry.points import Points
from fem.loads.concentrated import CONCENTRATED
from fem.loads.dynamic_sets import (
    MOTIONS,
    TLOADS,
    load_factors,
    split_by_delay,
    static_sets,
)
from fem.loads.element_loads import ElementLoads, below_each_other, side_by_side
from fem.loads.static import static_element_loads, static_load
from fem.loads.time_functions import Delayed, Table, TimeFunction
from fem.loads.time_tables import table_function, time_function

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass(frozen=True, kw_only=True)
class Excitation:
    """P(t) = sum of patterns times functions, g-set, displacement frames.

    Attributes:
        pattern: (size, k) sparse.
        functions: k functions of time.
        element_loads: what of the patterns acts on elements between grids; None:
            nothing.
    """

    pattern: sp.csr_matrix
    functions: tuple[TimeFunction, ...]
    element_loads: ElementLoads | None = None

    def evaluate(self, time: npt.ArrayLike) -> Float64:
        """Factors (k, t) at times (t,) s."""
        time = np.asarray(time, dtype=np.float64)
        if not self.functions:
            return np.zeros((0, len(time)))
        return np.stack([function(time) for function in self.functions])


def dynamic_excitation(
    deck: "Deck",
    points: Points,
    subcase: Subcase,
    mass_gg: sp.spmatrix | sp.sparray | None = None,
    *,
    beside_motion: bool = False,
) -> Excitation:
    """Excitation that a subcase selects with DLOAD (and LOADSET).

    EXCITEID means DAREA cards and, with LOADSET, the static loads that LSEQ names,
    without it the static load set of that number.

    Args:
        deck, points: the model.
        subcase: what is selected; DLOAD 0 means no load.
        mass_gg: as for `static_load`.
        beside_motion: leaves out enforced motion, which `dynamic_motions` has.

    Raises:
        InputError: enforced motion (TYPE other than LOAD), undefined sets or tables.
    """
    columns: list[Float64] = []
    functions: list[TimeFunction] = []
    on_elements: list[tuple[ElementLoads | None, int]] = []
    factors = load_factors(deck, subcase.dload, TLOADS) if subcase.dload else {}
    for name in TLOADS:
        rows = deck.cards[name]
        for _, row in rows[rows["sid"].isin(factors)].iterrows():
            if beside_motion and row["type"] in MOTIONS:
                continue
            if row["type"] != "LOAD":
                raise InputError(
                    f"{where(name, row)}: TYPE {row['type']} (enforced motion) is not "
                    "supported here, expected LOAD"
                )
            function = time_function(deck, name, row)
            spatial = factors[row["sid"]] * pattern_of(
                deck, points, subcase, name, row, mass_gg
            )
            loads = _element_loads(deck, points, subcase, row)
            if loads is not None:
                loads = loads.times(factors[row["sid"]])
            for delay, chosen in split_by_delay(deck, points, row, spatial):
                columns.append(np.where(chosen, spatial, 0.0))
                functions.append(Delayed(function, delay) if delay else function)
                if loads is None:
                    on_elements.append((None, 1))
                else:
                    at_grids = chosen[loads.dof][:, :, None]
                    on_elements.append((loads.times(at_grids), 1))
    pattern = np.stack(columns, axis=1) if columns else np.zeros((points.size, 0))
    return Excitation(
        pattern=sp.csr_matrix(pattern),
        functions=tuple(functions),
        element_loads=side_by_side(on_elements)
        if any(loads is not None for loads, _ in on_elements)
        else None,
    )


def table_notices(deck: "Deck", subcase: Subcase, end: float) -> list[str]:
    """Notices of tables that end before the run does, at `end` (s).

    As in Nastran, the line through the last two points goes on, before the table and
    after it; with a delay, the table is asked for times before it.
    """
    if not subcase.dload:
        return []
    factors = load_factors(deck, subcase.dload, TLOADS)
    rows = deck.cards["TLOAD1"]
    notices = []
    for _, row in rows[rows["sid"].isin(factors)].iterrows():
        table = table_function(deck, int(row["tid"]))
        delays = {float(row["delay"])}
        if int(row["delayid"]):
            cards = deck.cards["DELAY"]
            delays |= set(cards[cards["sid"] == row["delayid"]]["t"].astype(float))
        for delay in sorted(delays):
            if not isinstance(table, Table):
                continue
            beyond = table.continued(-delay, end - delay)
            if beyond:
                given = " and ".join(f"{v:.6g} at {t + delay:.6g} s" for t, v in beyond)
                late = f" (delayed by {delay:.6g} s)" if delay else ""
                notices.append(
                    f"{where('TLOAD1', row)}: TABLED1 {int(row['tid'])}{late} covers "
                    f"{table.x[0] + delay:.6g} to {table.x[-1] + delay:.6g} s of a run "
                    f"from 0 to {end:.6g} s; beyond, the line of the points at that "
                    f"end goes on, as in Nastran: it gives {given}; for zero there, "
                    "add points with zero at that end"
                )
    return notices


def pattern_of(
    deck: "Deck",
    points: Points,
    subcase: Subcase,
    name: str,
    row: pd.Series,
    mass_gg: sp.spmatrix | sp.sparray | None,
) -> Float64:
    """Spatial distribution (size,) that EXCITEID stands for."""
    excite = int(row["exciteid"])
    lids = static_sets(deck, subcase.loadset, excite)
    darea = deck.cards["DAREA"]
    # Without LOADSET it is one of the loads of the static set.
    darea = darea[(darea["sid"] == excite) & bool(subcase.loadset)]
    if darea.empty and not lids:
        raise InputError(
            f"{where(name, row)}: EXCITEID {excite} has no DAREA"
            + (f" and no LSEQ in LOADSET {subcase.loadset}" if subcase.loadset else "")
            + ", no static load of that number"
        )
    total = np.zeros(points.size)
    np.add.at(total, *CONCENTRATED["DAREA"](points, darea))
    for lid in lids:
        total += static_load(deck, points, lid, mass_gg)
    return total


def _element_loads(
    deck: "Deck", points: Points, subcase: Subcase, row: pd.Series
) -> ElementLoads | None:
    """What of `pattern_of` acts on elements between grids."""
    parts = [
        static_element_loads(deck, points, lid)
        for lid in static_sets(deck, subcase.loadset, int(row["exciteid"]))
    ]
    parts = [part for part in parts if part is not None]
    return below_each_other(parts) if parts else None


def initial_conditions(
    deck: "Deck", points: Points, subcase: Subcase
) -> tuple[Float64, Float64]:
    """Displacements and velocities (size,) at t = 0 that IC selects, else zero."""
    u0, v0 = np.zeros(points.size), np.zeros(points.size)
    if subcase.ic:
        table = deck.cards["TIC"]
        rows = table[table["sid"] == subcase.ic]
        if rows.empty:
            raise InputError(f"{deck.path}: TIC {subcase.ic} is not defined")
        dof = points.dof(rows["id"].to_numpy(np.int64), rows["c"].to_numpy(np.int64))
        u0[dof], v0[dof] = rows["u0"].to_numpy(float), rows["v0"].to_numpy(float)
    return u0, v0


def time_steps(deck: "Deck", subcase: Subcase) -> list[tuple[int, float, int]]:
    """Rows (count, step in s, output stride) of the TSTEP that a subcase selects.

    Raises:
        InputError: it selects none, or one that is not there.
    """
    table = deck.cards["TSTEP"]
    found = table[table["sid"] == subcase.tstep]
    if found.empty:
        raise InputError(
            f"{deck.path}: subcase {subcase.id}: TSTEP = {subcase.tstep or 'nothing'}, "
            f"expected one of {sorted(table['sid']) or 'none in the deck'}"
        )
    row = found.iloc[0]
    return list(zip(row["counts"], row["steps"], row["outputs"]))

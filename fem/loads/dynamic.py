"""Dynamic excitation: load patterns times functions of time, initial state, steps."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd
import scipy.sparse as sp

from fem.arrays import Float64
from fem.constraints.spc import freedoms
from fem.deck.control.subcase import Subcase
from fem.deck.references import where
from fem.errors import InputError
from fem.geometry.points import Points
from fem.loads.concentrated import CONCENTRATED
from fem.loads.element_loads import ElementLoads, below_each_other, side_by_side
from fem.loads.static import CARDS, static_element_loads, static_load
from fem.loads.time_functions import (
    Delayed,
    Pulse,
    Scaled,
    Series,
    Table,
    TimeFunction,
)

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
    factors = load_factors(deck, subcase.dload, _TLOADS) if subcase.dload else {}
    for name in _TLOADS:
        rows = deck.cards[name]
        for _, row in rows[rows["sid"].isin(factors)].iterrows():
            if beside_motion and row["type"] in MOTIONS:
                continue
            if row["type"] != "LOAD":
                raise InputError(
                    f"{where(name, row)}: TYPE {row['type']} (enforced motion) is not "
                    "supported here, expected LOAD"
                )
            function = _function(deck, name, row)
            spatial = factors[row["sid"]] * pattern_of(
                deck, points, subcase, name, row, mass_gg
            )
            loads = _element_loads(deck, points, subcase, row)
            if loads is not None:
                loads = loads.times(factors[row["sid"]])
            for delay, chosen in _split(deck, points, row, spatial):
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


_TLOADS = ("TLOAD1", "TLOAD2")


def load_factors(deck: "Deck", dload: int, names: tuple[str, str]) -> dict[int, float]:
    """Sets of dynamic loads that DLOAD stands for, and their factors.

    Args:
        deck: the deck.
        dload: number of DLOAD, or of a load itself.
        names: cards of the loads.

    Raises:
        InputError: sets that are not there.
    """
    table = deck.cards["DLOAD"]
    cards = table[table["sid"] == dload]
    factors: dict[int, float] = {}
    for _, row in cards.iterrows():
        for scale, lid in zip(row["scales"], row["lids"]):
            factors[lid] = factors.get(lid, 0.0) + row["s"] * scale
    if cards.empty:
        factors[dload] = 1.0
    known = {sid for name in names for sid in deck.cards[name]["sid"]}
    absent = sorted(set(factors) - known)
    if absent:
        raise InputError(
            f"{deck.path}: DLOAD {dload}: {lid} is no {names[0]} or {names[1]}"
            for lid in absent
        )
    return factors


def _function(deck: "Deck", name: str, row: pd.Series) -> TimeFunction:
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


def table_notices(deck: "Deck", subcase: Subcase, end: float) -> list[str]:
    """What tables give where a run up to `end` (s) goes beyond them.

    As in Nastran, the line through the last two points goes on, before the table and
    after it; with a delay, the table is asked for times before it.
    """
    if not subcase.dload:
        return []
    factors = load_factors(deck, subcase.dload, _TLOADS)
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


# Kinds of enforced motion: which derivative of the displacement is given.
MOTIONS = {"DISP": 0, "VELO": 1, "ACCE": 2}


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
    """What TLOAD1 and TLOAD2 of TYPE DISP, VELO or ACCE move in a subcase.

    Raises:
        InputError: no SPCD of EXCITEID, undefined sets or tables.
    """
    factors = load_factors(deck, subcase.dload, _TLOADS) if subcase.dload else {}
    found = []
    for name in _TLOADS:
        rows = deck.cards[name]
        rows = rows[rows["sid"].isin(factors) & rows["type"].isin(list(MOTIONS))]
        for _, row in rows.iterrows():
            function = _function(deck, name, row)
            spatial = motion_of(deck, points, subcase, name, row)
            spatial = factors[row["sid"]] * spatial
            for delay, chosen in _split(deck, points, row, spatial):
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
        lseq = deck.cards["LSEQ"]
        chosen = lseq[(lseq["sid"] == subcase.loadset) & (lseq["exciteid"] == excite)]
        sets += [int(lid) for lid in chosen["lid"] if lid]
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
    lids = _static_sets(deck, subcase.loadset, excite)
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
    """What of `_pattern` acts on elements between grids."""
    parts = [
        static_element_loads(deck, points, lid)
        for lid in _static_sets(deck, subcase.loadset, int(row["exciteid"]))
    ]
    parts = [part for part in parts if part is not None]
    return below_each_other(parts) if parts else None


def _static_sets(deck: "Deck", loadset: int, excite: int) -> list[int]:
    """Static load sets behind an EXCITEID."""
    if loadset:
        lseq = deck.cards["LSEQ"]
        chosen = lseq[(lseq["sid"] == loadset) & (lseq["exciteid"] == excite)]
        return [int(lid) for lid in chosen["lid"] if lid]
    names = (*CARDS, "LOAD")
    used = any((deck.cards[name]["sid"] == excite).any() for name in names)
    return [excite] if used else []


def _split(
    deck: "Deck", points: Points, row: pd.Series, pattern: Float64
) -> list[tuple[float, npt.NDArray[np.bool_]]]:
    """Delays of a pattern, and the rows (size,) that each holds for."""
    delays = of_freedoms(deck, points, row, "delay", "DELAY", "t")
    used = np.flatnonzero(pattern)
    return [(delay, delays == delay) for delay in np.unique(delays[used]).tolist()]


def of_freedoms(
    deck: "Deck", points: Points, row: pd.Series, field: str, card: str, value: str
) -> Float64:
    """(size,) delays or phases of a dynamic load: one number, or by freedom of a card.

    Raises:
        InputError: the set of the card is not there.
    """
    found = np.full(points.size, float(row[field]))
    sid = int(row[f"{field}id"])
    if sid:
        table = deck.cards[card]
        cards = table[table["sid"] == sid]
        if cards.empty:
            raise InputError(
                f"{row['file']}:{row['line']}: {card} {sid} is not defined"
            )
        dof = points.dof(cards["id"].to_numpy(np.int64), cards["c"].to_numpy(np.int64))
        found[dof] = cards[value].to_numpy(np.float64)
    return found


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

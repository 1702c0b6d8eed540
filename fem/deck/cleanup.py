"""What is taken out of the tables before they are checked, each with a notice."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cache

import numpy as np
import pandas as pd

from fem.arrays import Int64
from fem.deck.control.subcase import Subcase
from fem.deck.records import CARDS, TABLES, targets_of
from fem.deck.text.lexer import RawCard
from fem.deck.text.values import Malformed, integer

Tables = dict[str, pd.DataFrame]

SCALAR_ELEMENTS = tuple(
    f"{kind}{form}" for kind in ("CELAS", "CDAMP", "CMASS") for form in "12"
)
_WITH_DIRECTION = ("CQUAD4", "CTRIA3", "CQUADR", "CTRIAR", "CQUAD8", "CTRIA6")
_REPEATABLE = ("GRID", "SPOINT", "CORD")


def clean(tables: Tables, ignored: Sequence[RawCard], notices: list[str]) -> None:
    """Change the tables in place.

    Args:
        tables: all tables of a deck.
        ignored: cards that the user wants ignored.
        notices: what was taken out is appended.
    """
    for name in _REPEATABLE:
        _drop_repetitions(tables, name, notices)
    _add_scalar_points(tables, notices)
    for name in ("SPC", "ASET", "CSET", "QSET", "OMIT"):
        _unroll(tables, name, "g" if name == "SPC" else "id", notices)
    for name, column, targets in _loaded_elements():
        _unroll_elements(tables, name, column, targets, notices)
    both = [t for t in (tables["ASET"], tables["CSET"]) if len(t)]
    if both:
        tables["ASET"] = pd.concat(both, ignore_index=True)
    _drop_idle_directions(tables, notices)
    _drop_loads_on(_element_ids(ignored), tables, notices)


def drop_unused_equations(
    tables: Tables, subcases: Sequence[Subcase], notices: list[str]
) -> None:
    """Take MPC that no subcase selects out, where they name points that are not there.

    Nastran looks at the sets that are selected only.
    """
    table = tables["MPC"]
    if table.empty:
        return
    chosen = {case.mpc for case in subcases}
    added = tables["MPCADD"]
    for sid, sets in zip(added["sid"].tolist(), added["sets"]):
        if sid in chosen:
            chosen |= {int(i) for i in sets}
    points = {*tables["GRID"]["id"].tolist(), *tables["SPOINT"]["id"].tolist()}
    absent = [not points.issuperset(map(int, grids)) for grids in table["grids"]]
    unused = np.array(absent, bool) & ~table["sid"].isin(list(chosen)).to_numpy(bool)
    if unused.any():
        sids = ", ".join(map(str, sorted(set(table["sid"][unused].tolist()))))
        notices.append(
            f"MPC {sids}: selected by no subcase; left out, as points of it are absent"
        )
        tables["MPC"] = table[~unused].reset_index(drop=True)


def ids(tables: Mapping[str, pd.DataFrame], names: Iterable[str], column: str) -> Int64:
    """Integers of one column of several tables."""
    found = [
        tables[name][column].to_numpy(np.int64) for name in names if len(tables[name])
    ]
    return np.concatenate([np.zeros(0, np.int64), *found])


def _drop_repetitions(tables: Tables, name: str, notices: list[str]) -> None:
    """Points and frames may be given twice if both cards say the same."""
    table = tables[name]
    if table.empty:
        return
    compared = table.drop(columns=["file", "line"])
    if "ps" in compared:  # "0" and blank constrain nothing
        compared = compared.assign(ps=compared["ps"].replace("0", ""))
    again = compared.duplicated(keep="first").to_numpy()
    if again.any():
        notices.append(f"{int(again.sum())} repeated {name} cards that are alike")
        tables[name] = table[~again].reset_index(drop=True)


def _add_scalar_points(tables: Tables, notices: list[str]) -> None:
    """Scalar points that only their use on scalar elements defines (component 0)."""
    known = ids(tables, ("GRID", "SPOINT", "EPOINT"), "id")
    found: dict[int, tuple[str, int]] = {}
    for name in SCALAR_ELEMENTS:
        table = tables[name]
        for end in "12" if len(table) else "":
            used = table[(table[f"c{end}"] == 0) & (table[f"g{end}"] > 0)]
            used = used[~used[f"g{end}"].isin(known)]
            for point, file, line in zip(used[f"g{end}"], used["file"], used["line"]):
                found.setdefault(int(point), (file, int(line)))
    if not found:
        return
    points = sorted(found)
    rows = [(*found[point], point) for point in points]
    new = pd.DataFrame(rows, columns=["file", "line", "id"])
    tables["SPOINT"] = pd.concat([tables["SPOINT"], new], ignore_index=True)
    shown = ", ".join(map(str, points[:8])) + (", ..." if len(points) > 8 else "")
    notices.append(
        f"{len(points)} scalar points are defined by scalar elements that use them: "
        + shown
    )


def _unroll(tables: Tables, name: str, column: str, notices: list[str]) -> None:
    """Ranges to the points that exist; points that a THRU skips over need not."""
    table = tables[name]
    if "thru" not in table:
        return
    known = np.unique(ids(tables, ("GRID", "SPOINT"), "id"))
    single = table["thru"].isna().to_numpy()
    points, rows = [table[column].to_numpy(np.int64)[single]], [np.flatnonzero(single)]
    for row in np.flatnonzero(~single):
        inside = table["thru"][row].among(known)
        points.append(inside)
        rows.append(np.full(len(inside), row))
        if not len(inside):
            place = f"{table['file'][row]}:{table['line'][row]}"
            notices.append(f"{place}: {name}: none of the points of its range exists")
    order = np.concatenate(rows)
    sort = np.argsort(order, kind="stable")
    unrolled = table.iloc[order[sort]].drop(columns="thru").reset_index(drop=True)
    unrolled[column] = np.concatenate(points)[sort]
    tables[name] = unrolled


def _unroll_elements(
    tables: Tables, name: str, column: str, targets: list[str], notices: list[str]
) -> None:
    """Ranges of loads to the elements that exist, or to their ends where none does."""
    table = tables[name]
    if "thru" not in table:
        return
    known = np.unique(ids(tables, targets, "eid"))
    loaded, gaps = [], 0
    for single, ranges in zip(table[column], table["thru"]):
        parts = [single]
        for part in ranges:
            inside = part.among(known)
            gaps += len(inside) and part.last - part.first + 1 - len(inside)
            parts.append(inside if len(inside) else np.unique([part.first, part.last]))
        loaded.append(np.unique(np.concatenate(parts)).astype(np.int64))
    if gaps:
        notices.append(
            f"{name}: {gaps} of the ids between THRU are no elements that it loads; "
            "passed over"
        )
    kept = table.drop(columns="thru")
    kept[column] = pd.Series(loaded, index=kept.index, dtype=object)
    tables[name] = kept


def _drop_idle_directions(tables: Tables, notices: list[str]) -> None:
    """Absent systems as material directions of sheets that are alike in all of them."""
    for name in _WITH_DIRECTION:
        table = tables[name]
        if not (table["mcid"] > 0).any():
            continue
        idle = (table["mcid"] > 0) & ~table["mcid"].isin(tables["CORD"]["cid"])
        idle &= table["pid"].isin(_isotropic_sheets(tables))
        if idle.any():
            absent = sorted(set(table["mcid"][idle].tolist()))
            shown = ", ".join(map(str, absent[:8])) + (", ..." * (len(absent) > 8))
            notices.append(
                f"{name}: coordinate systems {shown} of MCID are not defined; their "
                "materials are isotropic, which need none"
            )
            tables[name] = table.assign(mcid=table["mcid"].mask(idle, -1))


def _isotropic_sheets(tables: Tables) -> pd.Series:
    """Ids of the PSHELL whose materials are isotropic, all of them."""
    sheet, isotropic = tables["PSHELL"], {0, -1, *tables["MAT1"]["mid"].tolist()}
    alike = sheet[[f"mid{k}" for k in range(1, 5)]].isin(isotropic).all(axis=1)
    return pd.Series(sheet["pid"][alike])


def _element_ids(cards: Sequence[RawCard]) -> Int64:
    found = set()
    for card in cards:
        try:
            found.add(integer(card.field(1)))
        except Malformed:
            continue
    return np.array(sorted(found), dtype=np.int64)


def _drop_loads_on(eids: Int64, tables: Tables, notices: list[str]) -> None:
    """Loads on ignored elements go with them."""
    for name, column, targets in _loaded_elements():
        table = tables[name]
        if table.empty or not len(eids):
            continue
        lost = eids[~np.isin(eids, ids(tables, targets, "eid"))]
        keep = np.array([not np.isin(value, lost).any() for value in table[column]])
        if not keep.all():
            tables[name] = table[keep].reset_index(drop=True)
            count = int((~keep).sum())
            notices.append(f"{count} {name} on ignored elements are left out")


@cache
def _loaded_elements() -> Sequence[tuple[str, str, list[str]]]:
    """Loads, their columns of elements, and the tables that these may be in."""
    return [
        (name, item.name, targets)
        for name, card in TABLES.items()
        for item in card.columns.values()
        if card.load
        and (targets := [t for word in item.targets for t in targets_of(word)])
        and all(CARDS[t].element for t in targets)
    ]

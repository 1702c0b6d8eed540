"""CBEAM cards to blocks: prismatic and tapered beams, each with and without warping."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Bool, Float64, Int64
from fem.deck.references import column, refer, table, where
from fem.elements.lines.beam import Beam
from fem.elements.lines.beam_sections import is_uniform, read_sections, read_stations
from fem.elements.lines.beam_warping import WarpingBeam
from fem.elements.lines.orientation import place_lines
from fem.elements.lines.pins import pin_flags
from fem.errors import InputError
from fem.geometry.points import Points, grid_freedoms
from fem.properties.materials import isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck


def read_cbeam(deck: "Deck", points: Points) -> list[Beam]:
    """The CBEAM blocks of a deck.

    Raises:
        InputError: undefined properties, materials or grids, impossible geometry.
    """
    rows = table(deck, "CBEAM").sort_values("eid", ignore_index=True)
    if rows.empty:
        return []
    pbeam = refer(rows, "CBEAM", "pid", table(deck, "PBEAM"), "PBEAM")
    properties = table(deck, "PBEAM")
    prismatic = [int(p["pid"]) for _, p in properties.iterrows() if is_uniform(p)]
    uniform = rows["pid"].isin(prismatic).to_numpy()
    warping = _warps(rows, pbeam)
    return [
        _block(deck, points, rows[part], pbeam[part], bool(warping[part][0]))
        for part in (
            uniform & ~warping,
            ~uniform & ~warping,
            uniform & warping,
            ~uniform & warping,
        )
        if part.any()
    ]


def beam_notices(deck: "Deck") -> list[str]:
    """Notices of what PBEAM asks for and is not modeled, or does nothing."""
    rows, properties = table(deck, "CBEAM"), table(deck, "PBEAM")
    free = rows.loc[~_ends(rows).any(axis=1), "pid"]
    notices = []
    for _, row in properties.iterrows():
        if _has_cw(row) and (free == row["pid"]).any():
            notices.append(
                f"{where('PBEAM', row)}: CW does nothing for CBEAM without SA and SB: "
                "their ends warp freely"
            )
        if np.nan_to_num(row["s1"]) or np.nan_to_num(row["s2"]):
            notices.append(f"{where('PBEAM', row)}: shear relief S1, S2 is ignored")
    return notices


def _ends(rows: pd.DataFrame) -> Int64:
    """(e, 2) SA and SB, 0 for none."""
    return rows[["sa", "sb"]].to_numpy(np.int64).reshape(-1, 2)


def _has_cw(row: pd.Series) -> bool:
    return bool(np.nan_to_num(row["cwa"]) or np.nan_to_num(row["cwb"]))


def _warps(rows: pd.DataFrame, pbeam: pd.DataFrame) -> Bool:
    """(e,) whether an end has a warping freedom and the section a coefficient.

    Raises:
        InputError: coefficients that are not positive at both ends.
    """
    cw = np.stack([column(pbeam, name) for name in ("cwa", "cwb")], axis=1)
    found = _ends(rows).any(axis=1) & (cw != 0.0).any(axis=1)
    bad = found & ~(cw > 0.0).all(axis=1)
    if bad.any():
        raise InputError(
            f"{where('PBEAM', row)}: CW(A) {row['cwa']:g}, CW(B) {row['cwb']:g}, "
            "expected both > 0, or both 0"
            for _, row in pbeam[bad].drop_duplicates("pid").iterrows()
        )
    return found


def _block(
    deck: "Deck",
    points: Points,
    rows: pd.DataFrame,
    pbeam: pd.DataFrame,
    warping: bool,
) -> Beam:
    rows, pbeam = rows.reset_index(drop=True), pbeam.reset_index(drop=True)
    ends = points.rows(rows[["ga", "gb"]].to_numpy(np.int64))
    dof = grid_freedoms(ends)
    released = np.hstack([pin_flags([str(p) for p in rows[c]]) for c in ("pa", "pb")])
    common = {
        "card": "CBEAM",
        "id": rows["eid"].to_numpy(np.int64),
        "pid": rows["pid"].to_numpy(np.int64),
        "geometry": place_lines(rows, "CBEAM", points),
        "section": read_sections(pbeam),
        "stations": read_stations(pbeam),
        "material": isotropic(deck, pbeam, "PBEAM"),
    }
    if not warping:
        return Beam(**common, dof=dof, released=released)
    of_warping, towards = _warping_freedoms(points, _ends(rows))
    return WarpingBeam(
        **common,
        dof=np.hstack([dof, of_warping.reshape(-1, 6)]),
        released=np.hstack([released, _ends(rows) == 0]),
        towards=towards,
    )


def _warping_freedoms(points: Points, ids: Int64) -> tuple[Int64, Float64]:
    """(e, 2, 3) rows of the g-set and directions of component 1 of points (e, 2)."""
    first = points.dof(ids, 1)
    dof = np.stack([first, np.full_like(first, -1), np.full_like(first, -1)], axis=2)
    towards = np.zeros(dof.shape)
    towards[ids > 0] = [1.0, 0.0, 0.0]
    grid = (ids > 0) & (first < 6 * len(points.grid_id))
    dof[grid] = first[grid][:, None] + np.arange(3)
    towards[grid] = points.rotation[first[grid] // 6][:, :, 0]
    return dof, towards

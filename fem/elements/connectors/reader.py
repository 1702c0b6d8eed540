"""CFAST and CWELD cards to connectors."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.references import column, refer, table, where
from fem.elements.connectors.connector import Connectors, weld_stiffness
from fem.elements.connectors.feet import Foot, merged
from fem.elements.connectors.piercing import Placed, place_connectors
from fem.elements.lines.line_geometry import axes_about, axes_from_vector
from fem.elements.scalars.bush import relative_motion
from fem.errors import InputError
from fem.geometry.points import Points
from fem.properties.materials import isotropic

if TYPE_CHECKING:
    from fem.deck.deck import Deck

_SHORT = 1e-6  # of the diameter: feet that coincide
_NOTHING = 1e-13  # of the largest coefficient


def read_cfast(deck: "Deck", points: Points) -> list[Connectors]:
    """The CFAST blocks of a deck, one for each number of freedoms.

    Raises:
        InputError: undefined references, sides that are not pierced, axes that are not
            defined.
    """
    rows = fasteners(deck)
    if rows.empty:
        return []
    values = refer(rows, "CFAST", "pid", table(deck, "PFAST"), "PFAST")
    diameter = column(values, "d")
    placed = place_connectors(deck, points, rows, "CFAST", diameter)
    k = [column(values, f"k{kind}{i}") for kind in "tr" for i in (1, 2, 3)]
    axis = _axis(placed, diameter)
    return _blocks(
        "CFAST",
        rows,
        placed,
        axes=_fastener_axes(points, rows, values, placed, axis),
        k=np.stack(k, axis=1),
        m=column(values, "mass"),
        ge=column(values, "ge"),
    )


def read_cweld(deck: "Deck", points: Points) -> list[Connectors]:
    """The CWELD blocks of a deck, one for each number of freedoms.

    Raises:
        InputError: undefined references, sides that are not pierced.
    """
    rows = welds(deck)
    if rows.empty:
        return []
    values = refer(rows, "CWELD", "pid", table(deck, "PWELD"), "PWELD")
    material = isotropic(deck, values, "PWELD")
    diameter = column(values, "d")
    placed = place_connectors(deck, points, rows, "CWELD", diameter)
    axis, length = _axis(placed, diameter), _lengths(placed)
    effective = _effective_length(deck, rows, values, placed, length)
    return _blocks(
        "CWELD",
        rows,
        placed,
        axes=_relative_axes("CWELD", points, rows, rows["mcid"], placed, axis),
        k=weld_stiffness(material.e, material.g, diameter, effective),
        m=np.zeros(len(rows)),  # as Nastran; RHO counts for nothing
        ge=material.ge,
    )


def fasteners(deck: "Deck") -> pd.DataFrame:
    """CFAST rows by id, with the columns that CWELD has."""
    rows = table(deck, "CFAST").sort_values("eid", ignore_index=True)
    nothing = np.zeros(0, np.int64)
    return rows.assign(gas=[nothing] * len(rows), gbs=[nothing] * len(rows))


def welds(deck: "Deck") -> pd.DataFrame:
    """CWELD rows by id."""
    return table(deck, "CWELD").sort_values("eid", ignore_index=True)


# Connectors with the function of their rows and their property.
CONNECTORS = {"CFAST": (fasteners, "PFAST"), "CWELD": (welds, "PWELD")}


def connector_notices(deck: "Deck") -> list[str]:
    """How connectors are modelled."""
    counts = {name: len(table(deck, name)) for name in ("CFAST", "CWELD")}
    if not any(counts.values()):
        return []
    names = ", ".join(f"{name} ({n})" for name, n in counts.items() if n)
    return [
        f"{names}: linear springs between points that follow the corners of the shells "
        "(translations only; ZOFFS counts for nothing), welds without mass, "
        "approximately as Nastran; grids GA and GB that nothing else uses follow the "
        "surface"
    ]


def _axis(placed: Placed, diameter: Float64) -> Float64:
    """(e, 3) from A to B; the normal of a side where these coincide."""
    found = np.stack([b.place - a.place for a, b in placed.feet])
    for i, (a, b) in enumerate(placed.feet):
        if np.linalg.norm(found[i]) < _SHORT * diameter[i]:
            found[i] = a.normal if a.normal.any() else b.normal
            if not found[i].any():
                found[i] = (1.0, 0.0, 0.0)  # of two grids: a weld turned anyhow
    return found


def _lengths(placed: Placed) -> Float64:
    return np.array([float(np.linalg.norm(b.place - a.place)) for a, b in placed.feet])


def _fastener_axes(
    points: Points,
    rows: pd.DataFrame,
    values: pd.DataFrame,
    placed: Placed,
    axis: Float64,
) -> Float64:
    """(e, 3, 3): along the fastener, with y near that of MCID; MFLAG 1: those of MCID.

    Raises:
        InputError: MCID whose y axis lies along the fastener.
    """
    mcid = values["mcid"].to_numpy(np.int64)
    absolute = (values["mflag"] == 1).to_numpy() & (mcid >= 0)
    relative = values["mcid"].where(~absolute, -1)
    axes = _relative_axes("CFAST", points, rows, relative, placed, axis)
    axes[absolute] = _triads(points, mcid, placed)[absolute]
    return axes


def _relative_axes(
    card: str,
    points: Points,
    rows: pd.DataFrame,
    systems: pd.Series,
    placed: Placed,
    axis: Float64,
) -> Float64:
    """(e, 3, 3): along the connector, with y near that of MCID, -1: of a basic axis.

    Raises:
        InputError: MCID whose y axis lies along the connector.
    """
    mcid = systems.to_numpy(np.int64)
    chosen = mcid >= 0
    axes = axes_about(axis)
    vector = _triads(points, mcid, placed)[chosen][:, :, 1]
    axes[chosen] = axes_from_vector(axis[chosen], vector)
    bad = np.isnan(axes).any(axis=(1, 2))
    if bad.any():
        raise InputError(
            f"{where(card, rows.iloc[i])}: the y axis of MCID {mcid[i]} lies along "
            f"it, expected another direction{' or MFLAG 1' * (card == 'CFAST')}"
            for i in np.flatnonzero(bad)
        )
    return axes


def _triads(points: Points, mcid: Int64, placed: Placed) -> Float64:
    """(e, 3, 3) axes of coordinate systems at feet A."""
    place = np.stack([a.place for a, _ in placed.feet])
    return points.frames.triads(np.maximum(mcid, 0), place)


def _effective_length(
    deck: "Deck",
    rows: pd.DataFrame,
    values: pd.DataFrame,
    placed: Placed,
    length: Float64,
) -> Float64:
    """(e,) mean thickness of both sides for SPOT, else L within its bounds."""
    diameter = column(values, "d")
    low, high = column(values, "ldmin") * diameter, column(values, "ldmax") * diameter
    found = np.clip(length, low, high)
    spot = (values["type"] == "SPOT").to_numpy() & (placed.elements >= 0).all(axis=1)
    thick = _thicknesses(deck)
    pid = placed.surfaces.pid
    for i in np.flatnonzero(spot):
        both = [thick.get(int(pid[k]), np.nan) for k in placed.elements[i]]
        found[i] = np.mean(both)
    bad = ~(found > 0.0)
    if bad.any():
        raise InputError(
            f"{where('CWELD', rows.iloc[i])}: its effective length is {found[i]:g}, "
            "expected thicknesses of both sides, or a positive LDMIN"
            for i in np.flatnonzero(bad)
        )
    return found


def _thicknesses(deck: "Deck") -> dict[int, float]:
    """Thickness of shells by property."""
    plain, layered = table(deck, "PSHELL"), table(deck, "PCOMP")
    found = dict(zip(plain["pid"].astype(int), plain["t"].astype(float)))
    for pid, ts in zip(layered["pid"].astype(int), layered["ts"]):
        found[pid] = float(np.sum(ts))
    return found


def _blocks(
    card: str,
    rows: pd.DataFrame,
    placed: Placed,
    *,
    axes: Float64,
    k: Float64,
    m: Float64,
    ge: Float64,
) -> list[Connectors]:
    """Connectors by their number of freedoms."""
    place = np.array([(a.place, b.place) for a, b in placed.feet])
    arm = 0.5 * (place[:, 1] - place[:, 0])
    between = relative_motion(axes, arm, -arm)
    length = 2.0 * np.linalg.norm(arm, axis=1)
    own = [_of_feet(between[i], *pair) for i, pair in enumerate(placed.feet)]
    counts = np.array([len(dof) for dof, _, _ in own])
    eid = rows["eid"].to_numpy(np.int64)
    blocks = []
    for count in np.unique(counts):
        at = np.flatnonzero(counts == count)
        dof, motion, feet = (np.stack(part) for part in zip(*(own[i] for i in at)))
        blocks.append(
            Connectors(
                card=card,
                id=eid[at],
                dof=dof,
                motion=motion,
                feet=feet,
                k=k[at],
                length=length[at],
                m=m[at],
                ge=ge[at],
            )
        )
    return blocks


def _of_feet(between: Float64, a: Foot, b: Foot) -> tuple[Int64, Float64, Float64]:
    """Freedoms (n,), relative motion (6, n), translations of both feet (6, n)."""
    dof = np.concatenate([a.dof, b.dof])
    motion = np.hstack([between[:, :6] @ a.motion, between[:, 6:] @ b.motion])
    shift = np.zeros((6, len(dof)))
    shift[:3, : len(a.dof)], shift[3:, len(a.dof) :] = a.motion[:3], b.motion[:3]
    unique, both = merged(dof, np.vstack([motion, shift]))
    # Rounding of points on edges: grids that do not count.
    both[np.abs(both) < _NOTHING * np.abs(both).max(axis=1, keepdims=True)] = 0.0
    return unique, both[:6], both[6:]

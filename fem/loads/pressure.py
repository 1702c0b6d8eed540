"""PLOAD, PLOAD2, PLOAD4: pressure on areas, on shells and on faces of solids.

Positive pressure acts along the normal of a shell (right-hand rule round its grids)
and into a solid, unless PLOAD4 gives a direction.
"""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from fem.arrays import Float64, Int64
from fem.deck.grids import grids_of
from fem.deck.records import Topology, topologies
from fem.deck.references import where
from fem.errors import InputError, Problems
from fem.geometry.points import Points, grid_freedoms
from fem.loads.faces import Faces, face_forces

if TYPE_CHECKING:
    from fem.deck.deck import Deck


@dataclass
class _Collected:
    """Loaded faces, gathered card by card."""

    corners: list[Int64] = field(default_factory=list)
    middles: list[Int64] = field(default_factory=list)
    pressure: list[Float64] = field(default_factory=list)
    direction: list[Float64] = field(default_factory=list)

    def add(self, corners, middles, pressure, direction) -> None:
        for name, value in zip(
            ("corners", "middles", "pressure", "direction"),
            (corners, middles, pressure, direction),
        ):
            getattr(self, name).append(np.atleast_2d(value))

    def faces(self, n: int) -> Faces:
        ids = np.zeros((0, n), np.int64)
        return Faces(
            corners=np.concatenate([ids, *self.corners]),
            middles=np.concatenate([ids, *self.middles]),
            pressure=np.concatenate([np.zeros((0, n)), *self.pressure]),
            direction=np.concatenate([np.zeros((0, 3)), *self.direction]),
        )


def pload(deck: "Deck", points: Points, rows: pd.DataFrame) -> tuple[Int64, Float64]:
    """Rows of the g-set (n,) and forces (n,) of PLOAD cards: areas between grids."""
    corners = rows[["g1", "g2", "g3", "g4"]].to_numpy(np.int64)
    pressure = rows["p"].to_numpy(np.float64)
    found = {3: _Collected(), 4: _Collected()}
    for n, chosen in ((3, corners[:, 3] == 0), (4, corners[:, 3] != 0)):
        grids = corners[chosen, :n]
        along = np.full((len(grids), 3), np.nan)
        sizes = np.repeat(pressure[chosen, None], n, axis=1)
        found[n].add(grids, np.zeros_like(grids), sizes, along)
    return _forces(points, found)


def pload2(deck: "Deck", points: Points, rows: pd.DataFrame) -> tuple[Int64, Float64]:
    """Rows of the g-set (n,) and forces (n,) of PLOAD2 cards."""
    rows = rows.assign(
        **{f"p{k}": rows["p"] for k in (1, 2, 3, 4)},
        **dict.fromkeys(("cid", "g1", "g34"), 0),
        **dict.fromkeys(("n1", "n2", "n3"), 0.0),
        sorl="SURF",
    )
    return _pressure(deck, points, rows, "PLOAD2")


def pload4(deck: "Deck", points: Points, rows: pd.DataFrame) -> tuple[Int64, Float64]:
    """Rows of the g-set and values of PLOAD4 cards.

    Raises:
        InputError: edge loads (SORL LINE), grids that belong to no face.
    """
    lines = rows[rows["sorl"] != "SURF"]
    if len(lines):
        raise InputError(
            f"{where('PLOAD4', row)}: SORL {row['sorl']} is not supported, "
            "expected SURF"
            for _, row in lines.iterrows()
        )
    return _pressure(deck, points, rows, "PLOAD4")


def _pressure(
    deck: "Deck", points: Points, rows: pd.DataFrame, card: str
) -> tuple[Int64, Float64]:
    loads = _per_element(rows)
    found = {3: _Collected(), 4: _Collected()}
    for name, shape in topologies("surface").items():
        elements, own = _matching(deck.cards[name], loads)
        _add_shells(elements, shape, own, points, found[shape.corners])
    problems = Problems()
    for name, shape in topologies("solid").items():
        elements, own = _matching(deck.cards[name], loads)
        if len(elements):
            solids = _Solids(name, shape, elements)
            _add_solids(solids, own, points, found, problems, card)
    problems.report()
    return _forces(points, found)


def _forces(points: Points, found: dict[int, _Collected]) -> tuple[Int64, Float64]:
    """Forces on all faces as terms of the g-set."""
    parts = [face_forces(points, found[n].faces(n)) for n in (3, 4)]
    at = np.concatenate([part[0] for part in parts])
    forces = np.concatenate([part[1] for part in parts])
    local = np.einsum("nji,nj->ni", points.rotation[at], forces)
    return grid_freedoms(at, 3), local.ravel()


def _per_element(rows: pd.DataFrame) -> pd.DataFrame:
    """One row per loaded element, `eid`."""
    counts = [len(eids) for eids in rows["eids"]]
    loads = rows.loc[rows.index.repeat(counts)].reset_index(drop=True)
    return loads.assign(eid=np.concatenate(list(rows["eids"])).astype(np.int64))


def _matching(
    table: pd.DataFrame, loads: pd.DataFrame
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Elements of a table and the loads on them, row by row."""
    eids = table["eid"].to_numpy(np.int64)
    if not len(eids):
        return table, loads.iloc[:0]
    order = np.argsort(eids)
    wanted = loads["eid"].to_numpy()
    at = np.searchsorted(eids[order], wanted)
    at[at == len(eids)] = 0
    hit = eids[order][at] == wanted
    return table.iloc[order[at[hit]]], loads.iloc[np.flatnonzero(hit)]


def _add_shells(
    elements: pd.DataFrame,
    shape: Topology,
    loads: pd.DataFrame,
    points: Points,
    found: _Collected,
) -> None:
    if elements.empty:
        return
    grids, n = grids_of(elements, shape), shape.corners
    corners, middles = grids[:, :n], np.zeros((len(grids), n), np.int64)
    middles[:, : grids.shape[1] - n] = grids[:, n : 2 * n]
    pressure = loads[[f"p{k + 1}" for k in range(n)]].to_numpy(np.float64)
    center = points.xyz[points.rows(corners)].mean(axis=1)
    found.add(corners, middles, pressure, _directions(loads, points, center))


def _directions(loads: pd.DataFrame, points: Points, at: Float64) -> Float64:
    """(n, 3) unit vectors of the loads, NaN where none is given."""
    vectors = loads[["n1", "n2", "n3"]].to_numpy(np.float64)
    cid = loads["cid"].to_numpy(np.int64)
    basic = points.frames.vectors_to_basic(cid, vectors, at)
    length = np.linalg.norm(basic, axis=1, keepdims=True)
    safe = np.where(length > 0.0, length, 1.0)
    return np.where(length > 0.0, basic / safe, np.nan)


@dataclass(frozen=True)
class _Solids:
    """Loaded elements of one card."""

    card: str
    shape: Topology
    rows: pd.DataFrame


def _add_solids(
    solids: _Solids,
    loads: pd.DataFrame,
    points: Points,
    found: dict[int, _Collected],
    problems: list[str],
    card: str,
) -> None:
    shape = solids.shape
    nodes_of = grids_of(solids.rows, shape)
    centers = points.xyz[points.rows(nodes_of[:, : shape.corners])].mean(axis=1)
    directions = _directions(loads, points, centers)
    given = loads[["g1", "g34"]].to_numpy(np.int64)
    pressures = loads[["p1", "p2", "p3", "p4"]].to_numpy(np.float64)
    for k, nodes in enumerate(nodes_of):
        face = _face(shape, nodes, *given[k].tolist())
        if face is None:
            row = loads.iloc[k]
            problems.append(
                f"{where(card, row)}: grids {given[k, 0]}, {given[k, 1]} name no face "
                f"of {solids.card} {row['eid']}"
            )
            continue
        face = _inward(face, nodes, int(given[k, 0]), centers[k], points)
        middles = [
            _middle(shape, nodes, a, b) for a, b in zip(face, face[1:] + face[:1])
        ]
        n = len(face)
        found[n].add(nodes[list(face)], middles, pressures[k, :n], directions[k])


def _face(shape: Topology, nodes: Int64, g1: int, g34: int) -> tuple[int, ...] | None:
    """The face that PLOAD4 means by G1 and G3 or G4."""
    corners = nodes[: shape.corners].tolist()
    if g1 not in corners or (g34 and g34 not in corners):
        return None
    a = corners.index(g1)
    b = corners.index(g34) if g34 else -1
    for face in shape.faces:
        if a not in face:
            continue
        if len(face) == 4:
            chosen = b in face and abs(face.index(a) - face.index(b)) == 2
        elif shape.triangles == "opposite":
            chosen = b >= 0 and b not in face
        elif shape.triangles == "alone":
            chosen = b < 0
        else:
            base = set(shape.faces[0])
            chosen = b in face and {a, b} <= base and _next_to(a, b)
        if chosen:
            return face
    return None


def _next_to(a: int, b: int) -> bool:
    """Whether two corners of a pyramid's base share an edge."""
    return (a - b) % 4 in (1, 3)


def _inward(
    face: tuple[int, ...], nodes: Int64, g1: int, center: Float64, points: Points
) -> tuple[int, ...]:
    """The face from G1 on, in the sense whose normal points into the element."""
    xyz = points.xyz[points.rows(nodes[list(face)])]
    normal = np.cross(xyz[1] - xyz[0], xyz[2] - xyz[0])
    if normal @ (center - xyz.mean(axis=0)) < 0.0:
        face = face[::-1]
    first = [int(nodes[k]) for k in face].index(g1)
    return face[first:] + face[:first]


def _middle(shape: Topology, nodes: Int64, a: int, b: int) -> int:
    """Grid id of the mid-side between two corners, 0 if there is none."""
    index = shape.middle(a, b)
    return int(nodes[index]) if index < len(nodes) else 0

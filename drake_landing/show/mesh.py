"""What a deck looks like: faces and lines between grids, by component."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.show.comments import component_names, read_names
from fem.deck.grids import corners_of
from fem.deck.records import topologies
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

RIGID = "rigid elements"


@dataclass(frozen=True, kw_only=True)
class Component:
    """A named part of the mesh.

    Attributes:
        name: for the legend.
        quads: (q, 4), triangles: (t, 3), lines: (l, 2) rows of the grids.
    """

    name: str
    quads: Int64
    triangles: Int64
    lines: Int64

    @property
    def grids(self) -> Int64:
        """Rows of the grids it uses, ascending."""
        return np.unique(np.concatenate([self.quads, self.triangles, self.lines], None))


@dataclass(frozen=True, kw_only=True)
class DrawnMesh:
    """A deck to be drawn.

    Attributes:
        p: (g, 3) positions of the grids, basic frame, m.
        components: large ones first; rigid elements last.
        grid_component: (g,) index of the component of a grid, -1 for none.
    """

    p: Float64
    components: tuple[Component, ...]
    grid_component: Int64


def drawn_mesh(structure: Structure) -> DrawnMesh:
    """Faces and lines of a structure by component."""
    cards, grid_id = structure.deck.cards, structure.points.grid_id
    faces = pd.concat([*_flat(cards), _outer_faces(cards)])
    if len(faces):
        names = read_names(faces.file.unique())
        faces["name"] = component_names(names, faces)
    else:
        faces["name"] = []
    parts = [
        _component(str(name), list(part.nodes), grid_id)
        for name, part in faces.groupby("name", sort=True)
    ]
    parts.sort(key=lambda c: -(len(c.quads) + len(c.triangles) + 0.01 * len(c.lines)))
    owner = np.full(len(grid_id), -1)
    for k in reversed(range(len(parts))):
        owner[parts[k].grids] = k
    rigid = _component(RIGID, _spiders(cards), grid_id)
    if len(rigid.lines):
        parts.append(rigid)
    return DrawnMesh(
        p=structure.points.xyz,
        components=tuple(parts),
        grid_component=_through_rigid(owner, rigid.lines),
    )


def _through_rigid(owner: Int64, lines: Int64) -> Int64:
    """Grids without elements belong where a rigid element ties them."""
    owner = owner.copy()
    for pairs in 2 * (lines, lines[:, ::-1]):  # twice: along two in a chain
        loose = (owner[pairs[:, 0]] < 0) & (owner[pairs[:, 1]] >= 0)
        owner[pairs[loose, 0]] = owner[pairs[loose, 1]]
    return owner


def _table(card: str, rows: pd.DataFrame, nodes: list[tuple[int, ...]]) -> pd.DataFrame:
    pid = rows.pid if "pid" in rows else np.zeros(len(rows), np.int64)
    return pd.DataFrame(
        {"card": card, "pid": pid, "file": rows.file, "line": rows.line}
    ).assign(nodes=pd.Series(nodes, index=rows.index, dtype=object))


def _flat(cards: Mapping[str, pd.DataFrame]) -> Iterator[pd.DataFrame]:
    """Shells and lines; not those to the ground or to scalar points."""
    for card, (rows, corners) in corners_of(cards, "surface", "line", "spring").items():
        between = (corners > 0).all(axis=1)
        yield _table(card, rows[between], _tuples(corners[between]))


def _tuples(corners: Int64) -> list[tuple[int, ...]]:
    return list(map(tuple, corners.tolist()))


def _outer_faces(cards: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """Faces of solids that belong to one element alone."""
    tables = [_table("", pd.DataFrame(columns=["file", "line"]), [])]
    for card, (rows, corners) in corners_of(cards, "solid").items():
        for face in topologies("solid")[card].faces:
            tables.append(_table(card, rows, _tuples(corners[:, face])))
    table = pd.concat(tables)
    key = table.nodes.map(lambda nodes: tuple(sorted(nodes)))
    return table.loc[~key.duplicated(keep=False)]


def _spiders(cards: Mapping[str, pd.DataFrame]) -> list[tuple[int, ...]]:
    lines = [(r.gn, int(g)) for r in cards["RBE2"].itertuples() for g in r.gms]
    lines += [(r.refgrid, int(g)) for r in cards["RBE3"].itertuples() for g in r.grids]
    lines += [(r.ga, r.gb) for r in cards["RBAR"].itertuples()]
    return lines


def _component(name: str, nodes: list[tuple[int, ...]], grid_id: Int64) -> Component:
    """From grid ids; lines to scalar points are left out."""
    by_count: dict[int, Int64] = {}
    for count in (2, 3, 4):
        ids = np.array([n for n in nodes if len(n) == count], np.int64)
        ids = ids.reshape(-1, count)
        ids = ids[np.isin(ids, grid_id).all(axis=1)]
        by_count[count] = np.searchsorted(grid_id, ids)
    return Component(
        name=name, quads=by_count[4], triangles=by_count[3], lines=by_count[2]
    )

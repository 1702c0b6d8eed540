"""Generated decks: regular meshes as bulk data in text."""

from collections.abc import Iterable
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from fem.deck.records.solids import HEXA, PENTA, PYRAMID, TETRA

# Corners of the edges of each solid, in the order of its mid-sides.
EDGES = {
    "CHEXA": HEXA.edges,
    "CPENTA": PENTA.edges,
    "CPYRAM": PYRAMID.edges,
    "CTETRA": TETRA.edges,
}
Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]


def real(value: float) -> str:
    """A number as a Nastran real field of up to 16 characters, with its point."""
    if value == 0.0:
        return "0."
    text = f"{value:.10g}"
    mantissa, _, exponent = text.partition("e")
    if "." not in mantissa:
        mantissa += "."
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa


class Bulk:
    """Bulk data that is being written; grids and elements count from 1."""

    def __init__(self, text: str = "") -> None:
        self.lines = [text] if text else []
        self.grid_count = 0
        self.element_count = 0

    def add(self, *fields: object) -> None:
        """A card in free fields, continued where it is long."""
        texts = [real(f) if isinstance(f, float) else str(f) for f in fields]
        head, data = texts[0], texts[1:]
        for start in range(0, max(len(data), 1), 8):
            name = head if start == 0 else "+"
            self.lines.append(",".join([name, *data[start : start + 8]]))

    def grids(self, xyz: Float64, *, cd: int = 0) -> None:
        """Grids at positions (g, 3)."""
        for x, y, z in xyz.tolist():
            self.grid_count += 1
            self.lines.append(f"GRID*,{self.grid_count},,{real(x)},{real(y)}")
            self.lines.append(f"*,{real(z)},{cd or ''}")

    def elements(self, card: str, pid: int, conn: Int64, *more: object) -> None:
        """Elements between grids (e, n), which count from 0 here."""
        for nodes in (conn + 1).tolist():
            self.element_count += 1
            self.add(card, self.element_count, pid, *nodes, *more)

    def fix(self, components: str, grids: npt.ArrayLike, *, sid: int = 1) -> None:
        """SPC1 of grids: a mask (g,) or positions that count from 0."""
        chosen = np.asarray(grids)
        if chosen.dtype == bool:
            chosen = np.flatnonzero(chosen)
        ids = (np.atleast_1d(chosen) + 1).tolist()
        for start in range(0, len(ids), 6):
            self.add("SPC1", sid, components, *ids[start : start + 6])

    def forces(
        self,
        sid: int,
        grids: npt.ArrayLike,
        direction: Iterable[float],
        share: npt.ArrayLike,
        *,
        card: str = "FORCE",
    ) -> None:
        """Forces (or moments) of shares along a direction at grids (from 0)."""
        d = [float(x) for x in direction]
        for grid, value in zip(np.atleast_1d(grids), np.atleast_1d(share)):
            self.add(card, sid, int(grid) + 1, "", float(value), *d)

    def deck(self, sol: int, case: str) -> str:
        """The whole deck."""
        bulk = "\n".join(self.lines)
        return f"SOL {sol}\nCEND\n{case}\nBEGIN BULK\n{bulk}\nENDDATA\n"


def rectangle(nx: int, ny: int) -> tuple[Float64, Int64]:
    """Unit square: points (g, 2), x slowest, and quadrilaterals (e, 4)."""
    x, y = np.meshgrid(np.linspace(0, 1, nx + 1), np.linspace(0, 1, ny + 1))
    i, j = (a.ravel() for a in np.meshgrid(range(nx), range(ny), indexing="ij"))
    first = i * (ny + 1) + j
    conn = np.stack([first, first + ny + 1, first + ny + 2, first + 1], axis=1)
    return np.stack([x.T.ravel(), y.T.ravel()], axis=1), conn


def box(nx: int, ny: int, nz: int) -> tuple[Float64, Int64]:
    """Unit cube: points (g, 3), layer by layer, and bricks (e, 8)."""
    flat, quads = rectangle(nx, ny)
    heights = np.linspace(0, 1, nz + 1)
    points = np.concatenate([np.c_[flat, np.full(len(flat), z)] for z in heights])
    layers = [quads + k * len(flat) for k in range(nz + 1)]
    bricks = [np.c_[below, above] for below, above in pairwise(layers)]
    return points, np.concatenate(bricks)


def with_mid_sides(card: str, xyz: Float64, conn: Int64) -> tuple[Float64, Int64]:
    """Nodes at the middles of the edges of solids, and the longer connections."""
    pairs = np.sort(conn[:, np.array(EDGES[card])], axis=2)
    unique, inverse = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    nodes = np.vstack([xyz, xyz[unique].mean(axis=1)])
    return nodes, np.c_[conn, len(xyz) + inverse.reshape(len(conn), -1)]


def triangles(quads: Int64) -> Int64:
    """Each quadrilateral cut along its diagonal 1-3."""
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def edge_shares(count: int) -> Float64:
    """(count,) shares of a uniform load on an edge of that many grids."""
    weight = np.ones(count)
    weight[[0, -1]] = 0.5
    return weight / weight.sum()

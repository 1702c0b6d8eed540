"""Coordinate systems: rectangular, cylindrical and spherical frames, chained.

A frame has an origin and three rectangular axes in the basic frame. Cylindrical
coordinates are (r, theta, z), spherical ones (r, theta, phi) with theta measured from
the z axis; angles in degrees, as Nastran has them. The displacement axes of C and S
frames turn with the position of the point. On the z axis, where they are not defined,
the rectangular axes serve, as Nastran's guide says.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
import pandas as pd

from fem.arrays import Float64, Int64
from fem.errors import InputError, Problems

Kind = Literal["R", "C", "S"]

# A point this near to the z axis, as share of its distance from the origin, lies on it.
_ON_AXIS = 1e-12


@dataclass(frozen=True)
class Frame:
    """One coordinate system.

    Attributes:
        kind: rectangular, cylindrical or spherical.
        origin: (3,) in the basic frame.
        axes: (3, 3), columns are the x, y, z axes in the basic frame.
    """

    kind: Kind
    origin: Float64
    axes: Float64

    def to_basic(self, x: npt.ArrayLike) -> Float64:
        """Basic positions (..., 3) of points given by this frame's coordinates."""
        return self.origin + rectangular(self.kind, np.asarray(x, float)) @ self.axes.T

    def triads(self, xyz: npt.ArrayLike) -> Float64:
        """(..., 3, 3) axes of this frame at basic positions (..., 3), as columns."""
        local = (np.asarray(xyz, float) - self.origin) @ self.axes
        return self.axes @ local_triads(self.kind, local)

    def on_axis(self, xyz: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """(...,) basic positions (..., 3) on the z axis of a C or S frame."""
        local = (np.asarray(xyz, float) - self.origin) @ self.axes
        if self.kind == "R":
            return np.zeros(local.shape[:-1], bool)
        return ~_off_axis(local)


BASIC = Frame("R", np.zeros(3), np.eye(3))


def rectangular(kind: Kind, x: Float64) -> Float64:
    """Rectangular coordinates (..., 3) from R, C or S coordinates (degrees).

    >>> rectangular("C", np.array([2.0, 90.0, 5.0])).round(12).tolist()
    [0.0, 2.0, 5.0]
    """
    if kind == "R":
        return x
    r, theta = x[..., 0], np.radians(x[..., 1])
    if kind == "C":
        return np.stack([r * np.cos(theta), r * np.sin(theta), x[..., 2]], axis=-1)
    phi = np.radians(x[..., 2])
    rho = r * np.sin(theta)
    return np.stack([rho * np.cos(phi), rho * np.sin(phi), r * np.cos(theta)], axis=-1)


def local_triads(kind: Kind, local: Float64) -> Float64:
    """(..., 3, 3) axes at local rectangular positions, in local rectangular axes."""
    triads = np.broadcast_to(np.eye(3), (*local.shape[:-1], 3, 3)).copy()
    if kind == "R":
        return triads
    x, y, z = local[..., 0], local[..., 1], local[..., 2]
    rho, r = np.hypot(x, y), np.sqrt(x * x + y * y + z * z)
    off_axis = _off_axis(local)
    safe = np.where(off_axis, rho, 1.0)
    cos_phi, sin_phi = x / safe, y / safe
    zero, one = np.zeros_like(x), np.ones_like(x)
    if kind == "C":
        rows = [[cos_phi, -sin_phi, zero], [sin_phi, cos_phi, zero], [zero, zero, one]]
    else:
        safe_r = np.where(off_axis, r, 1.0)
        c, s = z / safe_r, rho / safe_r
        rows = [
            [s * cos_phi, c * cos_phi, -sin_phi],
            [s * sin_phi, c * sin_phi, cos_phi],
            [c, -s, zero],
        ]
    turned = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    return np.where(off_axis[..., None, None], turned, triads)


def _off_axis(local: Float64) -> npt.NDArray[np.bool_]:
    """(...,) local rectangular positions (..., 3) whose angle about z is defined."""
    rho, r = np.hypot(local[..., 0], local[..., 1]), np.linalg.norm(local, axis=-1)
    off: npt.NDArray[np.bool_] = rho > _ON_AXIS * np.maximum(r, np.finfo(float).tiny)
    return off


def frame_from_points(kind: Kind, a: Float64, b: Float64, c: Float64) -> Frame | None:
    """Frame with origin a, z axis towards b and c in the half plane of x; all basic.

    Returns None where the three points lie on a line.
    """
    z, x = b - a, c - a
    scale = np.linalg.norm(z) * np.linalg.norm(x)
    y = np.cross(z, x)
    if not np.linalg.norm(y) > 1e-10 * scale:
        return None
    z, y = z / np.linalg.norm(z), y / np.linalg.norm(y)
    return Frame(kind, a, np.stack([np.cross(y, z), y, z], axis=-1))


class Frames(Mapping[int, Frame]):
    """All coordinate systems of a deck by id; 0 is the basic frame."""

    def __init__(self, frames: Mapping[int, Frame]) -> None:
        self._frames = {0: BASIC, **frames}

    def __getitem__(self, cid: int) -> Frame:
        try:
            return self._frames[int(cid)]
        except KeyError:
            raise InputError(f"coordinate system {cid} is not defined") from None

    def __iter__(self):
        return iter(self._frames)

    def __len__(self) -> int:
        return len(self._frames)

    def to_basic(self, cid: Int64, x: Float64) -> Float64:
        """Basic positions (n, 3) of coordinates (n, 3) in systems cid (n,)."""
        xyz = np.array(x, dtype=np.float64)
        for c in np.unique(cid):
            at = cid == c
            xyz[at] = self[c].to_basic(xyz[at])
        return xyz

    def triads(self, cid: Int64, xyz: Float64) -> Float64:
        """(n, 3, 3) axes of systems cid (n,) at basic positions (n, 3), as columns."""
        turns = np.empty((len(cid), 3, 3))
        for c in np.unique(cid):
            at = cid == c
            turns[at] = self[c].triads(xyz[at])
        return turns

    def vectors_to_basic(self, cid: Int64, v: Float64, xyz: Float64) -> Float64:
        """Vectors (n, 3) given along the axes of systems cid at xyz (n, 3), basic."""
        return np.einsum("nij,nj->ni", self.triads(cid, xyz), v)


def resolve(cord: pd.DataFrame, grid: pd.DataFrame) -> tuple[Frames, Float64]:
    """All frames and the basic positions of all grids.

    Frames may be defined in other frames (CORD2x) or by grids (CORD1x), and grids in
    frames, in any order.

    Args:
        cord: table CORD of the schema.
        grid: table GRID of the schema.

    Returns:
        The frames, and basic positions (g, 3) in the order of `grid`.

    Raises:
        InputError: a system refers to itself through others, to something that is not
            there, or its three points lie on a line; all such systems are named.
    """
    known: dict[int, Frame] = {0: BASIC}
    pending = list(cord.to_dict("records")) if len(cord) else []
    cp = grid["cp"].to_numpy(np.int64)
    x = grid[["x1", "x2", "x3"]].to_numpy(np.float64)
    row = dict(zip(grid["id"].tolist(), range(len(grid)), strict=True))
    problems = Problems()
    while pending:
        waiting = []
        for card in pending:
            points = _defining_points(card, known, row, cp, x)
            if points is None:
                waiting.append(card)
                continue
            frame = frame_from_points(card["type"], *points)
            if frame is None:
                problems.append(f"{_where(card)}: its three points lie on a line")
            known[int(card["cid"])] = frame or BASIC
        if len(waiting) == len(pending):
            problems += [_unresolved(card, pending, known, row, cp) for card in waiting]
            break
        pending = waiting
    frames = Frames(known)
    missing = sorted(set(np.unique(cp).tolist()) - set(known)) if not pending else []
    for cid in missing:
        ids = grid["id"].to_numpy()[cp == cid][:5].tolist()
        problems.append(f"GRID {ids}: coordinate system CP {cid} is not defined")
    problems.report()
    return frames, frames.to_basic(cp, x)


def _defining_points(
    card: dict,
    known: Mapping[int, Frame],
    row: Mapping[int, int],
    cp: Int64,
    x: Float64,
) -> tuple[Float64, Float64, Float64] | None:
    """Basic positions of the three defining points; None while something is unknown."""
    if card["form"] == 2:
        frame = known.get(int(card["rid"]))
        if frame is None:
            return None
        a, b, c = (
            frame.to_basic([card[f"{p}1"], card[f"{p}2"], card[f"{p}3"]]) for p in "abc"
        )
        return a, b, c
    rows = [row.get(int(card[g])) for g in ("g1", "g2", "g3")]
    if any(r is None or int(cp[r]) not in known for r in rows):
        return None
    a, b, c = (known[int(cp[r])].to_basic(x[r]) for r in rows if r is not None)
    return a, b, c


def _where(card: dict) -> str:
    name = f"CORD{card['form']}{card['type']} {card['cid']}"
    file, line = card.get("file"), card.get("line")
    return f"{file}:{line}: {name}" if file else name


def _unresolved(
    card: dict,
    waiting: list[dict],
    known: Mapping[int, Frame],
    row: Mapping[int, int],
    cp: Int64,
) -> str:
    """Why a system could not be placed."""
    cids = {int(c["cid"]) for c in waiting}
    if card["form"] == 2:
        need, absent = {int(card["rid"])}, []
    else:
        grids = [int(card[g]) for g in ("g1", "g2", "g3")]
        absent = [g for g in grids if g not in row]
        need = {int(cp[row[g]]) for g in grids if g in row}
    if absent:
        return f"{_where(card)}: grid {absent[0]} is not defined"
    undefined = sorted(need - set(known) - cids)
    if undefined:
        return f"{_where(card)}: coordinate system {undefined[0]} is not defined"
    return (
        f"{_where(card)}: refers to coordinate system "
        f"{sorted(need & cids)[0]}, which depends on it or on another cycle"
    )

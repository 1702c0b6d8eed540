"""A stiffened cylinder with wings and tail: a shell model of about 205,000 freedoms.

Made for timing. Fuselage of quadrilaterals with stringers and frame webs, floor, wing
and tail boxes with ribs and stringers, roots tied to the fuselage by bars. Free in the
air; SI units; x aft, y to starboard, z up.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from benchmarks.verification.mesh import Bulk

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

RADIUS, LENGTH = 2.0, 34.0


@dataclass(frozen=True)
class Size:
    """Numbers of elements: around, along, between frames; per box chord and span."""

    around: int = 72
    along: int = 272
    pitch: int = 6
    wing: tuple[int, int] = (18, 84)
    tail: tuple[int, int] = (12, 40)


class Mesh:
    """Grids and elements that are collected; ids count from 0 here."""

    def __init__(self) -> None:
        self._xyz: list[Float64] = []
        self.quads: list[Int64] = []
        self.bars: list[tuple[Int64, tuple[float, float, float]]] = []
        self.count = 0

    def add(self, xyz: Float64) -> Int64:
        """New grids (..., 3); their numbers (...)."""
        shape = xyz.shape[:-1]
        first = self.count
        self.count += int(np.prod(shape))
        self._xyz.append(xyz.reshape(-1, 3))
        return np.arange(first, self.count).reshape(shape)

    @property
    def xyz(self) -> Float64:
        """(g, 3) all grids, m."""
        return np.concatenate(self._xyz)

    def sheet(self, grids: Int64, *, closed: bool = False) -> None:
        """Quadrilaterals between rows of grids (m, n); closed: last column to first."""
        ring = np.c_[grids, grids[:, :1]] if closed else grids
        corners = (ring[:-1, :-1], ring[1:, :-1], ring[1:, 1:], ring[:-1, 1:])
        self.quads.append(np.stack([c.ravel() for c in corners], axis=1))

    def beams(self, chain: Int64, direction: tuple[float, float, float]) -> None:
        """Bars along chains of grids (n, ...)."""
        pairs = np.stack([chain[:-1].ravel(), chain[1:].ravel()], axis=1)
        self.bars.append((pairs, direction))


def _fuselage(mesh: Mesh, size: Size) -> Int64:
    """Skin, frame webs, stringers, floor; the grids of the skin (along, around)."""
    x = np.linspace(0.0, LENGTH, size.along + 1)
    angle = 2.0 * np.pi * np.arange(size.around) / size.around
    # Slightly tapered toward both ends, so that modes are well apart.
    taper = 1.0 - 0.5 * np.abs(2.0 * x / LENGTH - 1.0) ** 6
    ring = np.stack([0.0 * angle, np.sin(angle), np.cos(angle)], axis=1)
    skin = RADIUS * taper[:, None, None] * ring
    skin[..., 0] = x[:, None]
    grids = mesh.add(skin)
    mesh.sheet(grids, closed=True)
    mesh.beams(grids, (0.0, 0.3, 0.7))
    webs = np.arange(0, size.along + 1, size.pitch)
    inner = skin[webs] * [1.0, 0.93, 0.93]
    inner_grids = mesh.add(inner)
    for outer, inside in zip(grids[webs], inner_grids):
        mesh.sheet(np.stack([outer, inside]), closed=True)
        mesh.beams(np.append(inside, inside[0]), (1.0, 0.0, 0.0))
    _floor(mesh, grids, skin, size.around)
    return grids


def _floor(mesh: Mesh, grids: Int64, skin: Float64, around: int) -> None:
    """Sheet between the two skin lines at about a third of the height."""
    right = round(around * 0.29)
    left = around - right
    cuts = np.linspace(0.0, 1.0, 15)[1:-1]
    ends = skin[:, right], skin[:, left]
    between = ends[0][:, None] + (ends[1] - ends[0])[:, None] * cuts[:, None]
    inner = mesh.add(between)
    mesh.sheet(np.c_[grids[:, right], inner, grids[:, left]])
    mesh.beams(inner[:, ::4], (0.0, 0.0, 1.0))


def _box(
    mesh: Mesh,
    size: tuple[int, int],
    root: Float64,
    span: Float64,
    chord: tuple[float, float],
    depth: tuple[float, float],
    normal: Float64,
    skin: Int64,
) -> None:
    """A box with ribs from a root point along a span vector, tied to the fuselage."""
    chordwise, spanwise = size
    s = np.linspace(0.0, 1.0, spanwise + 1)[:, None]
    c = np.linspace(0.0, 1.0, chordwise + 1)[None]
    width = chord[0] + (chord[1] - chord[0]) * s
    half = 0.5 * (depth[0] + (depth[1] - depth[0]) * s) * (1.0 - 0.5 * (2 * c - 1) ** 2)
    along = np.array([1.0, 0.0, 0.0])
    middle = root + s[..., None] * span + (width * (c - 0.5))[..., None] * along
    upper = mesh.add(middle + half[..., None] * normal)
    lower = mesh.add(middle - half[..., None] * normal)
    for side in (upper, lower):
        mesh.sheet(side)
        mesh.beams(side[:, 1:-1:2], (1.0, 0.0, 0.0))
    for edge in (0, -1):
        mesh.sheet(np.stack([upper[:, edge], lower[:, edge]], axis=1))
    for rib in range(0, spanwise + 1, 4):
        mesh.sheet(np.stack([upper[rib], lower[rib]]))
    # Root tied to the nearest grids of the fuselage.
    xyz = mesh.xyz
    rim = np.concatenate([upper[0], lower[0]])
    distance = np.linalg.norm(xyz[rim][:, None] - xyz[skin.ravel()][None], axis=2)
    nearest = skin.ravel()[distance.argmin(axis=1)]
    mesh.beams(np.stack([rim, nearest]), (1.0, 0.2, 0.3))


def mesh_of(size: Size) -> Mesh:
    """The whole mesh."""
    mesh = Mesh()
    skin = _fuselage(mesh, size)
    up, right = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])
    for sign in (1.0, -1.0):
        root = np.array([15.0, sign * 2.05, -0.7])
        span = np.array([4.0, sign * 14.0, 1.2])
        _box(mesh, size.wing, root, span, (5.0, 1.6), (0.7, 0.2), up, skin)
        root, span = np.array([31.5, sign * 1.6, 0.6]), np.array([2.0, sign * 5.0, 0.4])
        _box(mesh, size.tail, root, span, (2.6, 1.2), (0.3, 0.12), up, skin)
    root, span = np.array([31.0, 0.0, 1.8]), np.array([2.5, 0.0, 5.0])
    _box(mesh, size.tail, root, span, (3.6, 1.6), (0.4, 0.15), right, skin)
    return mesh


def deck(size: Size | None = None) -> tuple[str, Mesh]:
    """A SOL 103 deck in text, and its mesh; grid k of the mesh has the id k + 1."""
    mesh = mesh_of(size or Size())
    bulk = Bulk("PARAM,G,.03\nPARAM,W3,60.\nEIGRL,9,,,20")
    bulk.add("MAT1", 1, 7e10, "", 0.33, 2700.0)
    bulk.add("PSHELL", 1, 1, 0.003, 1, "", 1, "", 12.0)
    bulk.add("PBAR", 2, 1, 3e-4, 4e-8, 9e-8, 1e-8)
    bulk.lines[-1] += "\n+,.02,.02,-.02,.02,-.02,-.02,.02,-.02"
    bulk.grids(mesh.xyz)
    for quads in mesh.quads:
        bulk.elements("CQUAD4", 1, quads)
    for pairs, direction in mesh.bars:
        bulk.elements("CBAR", 2, pairs, *direction)
    return bulk.deck(103, "METHOD = 9"), mesh

"""Skins, spar webs, ribs and stringers on the grids of a box."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from drake_landing.reference.d150.geometry import Int64
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.shell_mesh import BoxMesh

Law = Callable[[float], float]


@dataclass(frozen=True, kw_only=True)
class BoxSizing:
    """Sizes along the span (argument: span coordinate, m).

    Attributes:
        skin: thickness of the covers, m.
        web: thickness of the spar webs, m.
        rib: thickness of a rib by its number, m.
        stringer: area of all stringers of one cover, m²; None for none.
        cap: area of one spar cap, m²; None for none.
        stringer_height: of the stringers, which lie inside of the skin, m.
        bending: ratio of the skin's bending stiffness to that of a plain sheet, for
            sandwich skins.
        web_bending: the same for stiffened ribs and spar webs.
        stringer_bars: stringers as bars; else they are smeared over the skin.
        smeared_bending: ratio of the bending stiffness of a skin with its stringers.
        material: id.
    """

    skin: Law
    web: Law
    rib: Callable[[int], float]
    stringer: Law | None = None
    cap: Law | None = None
    stringer_height: float = 0.05
    bending: float = 1.0
    web_bending: float = 1.0
    stringer_bars: bool = True
    smeared_bending: float = 20.0
    material: int = 1


def add_box_elements(model: ModelBuilder, mesh: BoxMesh, sizing: BoxSizing) -> None:
    """Writes all elements of a box; one property per bay between ribs and item."""
    for first, last in _bays(mesh):
        span = float(mesh.stations.span[[first, last]].mean())
        name = f"{_plain(mesh.part)} bay at {span:.2f} m"
        _skins(model, mesh, first, last, name, span, sizing)
        _webs(model, mesh, first, last, name, sizing.web(span), sizing)
        _stringers(model, mesh, first, last, name, span, sizing)
    for number, station in enumerate(mesh.ribs):
        thickness = sizing.rib(number)
        name = f"{_plain(mesh.part)} rib {thickness * 1e3:.1f} mm"
        pid = model.shell_property(name, sizing.material, thickness, sizing.web_bending)
        _rib(model, mesh, int(station), pid)


def _plain(part: str) -> str:
    """Both halves share their properties."""
    return part.removesuffix("_right").removesuffix("_left")


def _bays(mesh: BoxMesh) -> list[tuple[int, int]]:
    ends = sorted({0, *map(int, mesh.ribs), len(mesh.ids) - 1})
    return list(pairwise(ends))


def _skins(
    model: ModelBuilder,
    mesh: BoxMesh,
    first: int,
    last: int,
    name: str,
    span: float,
    sizing: BoxSizing,
) -> None:
    title, thickness, mcid = f"{name}: skin", sizing.skin(span), None
    if sizing.stringer is None or sizing.stringer_bars:
        pid = model.shell_property(title, sizing.material, thickness, sizing.bending)
    else:
        width = float(np.linalg.norm(mesh.p[first, -1, 0] - mesh.p[first, 0, 0]))
        pid = model.stiffened_property(
            title,
            sizing.material,
            thickness,
            sizing.stringer(span) / width,
            sizing.smeared_bending,
        )
        mcid = _stringer_frame(model, mesh, first, last)
    for j, sign in ((-1, mesh.outward), (0, -mesh.outward)):
        grid = mesh.ids[first : last + 1, :, j]
        for quad in _quads(grid, sign):
            model.shell(mesh.part, pid, quad, mcid)


def _stringer_frame(model: ModelBuilder, mesh: BoxMesh, first: int, last: int) -> int:
    """Axes of the stringers in a bay: along the middle of the box."""
    middle = mesh.p[[first, last]].mean(axis=(1, 2))
    up = mesh.p[first, 0, -1] - mesh.p[first, 0, 0]
    span = mesh.stations.span[first]
    name = f"{mesh.part} from {span:.2f} m"
    return model.frame(name, middle[0], middle[1] - middle[0], up)


def _webs(
    model: ModelBuilder,
    mesh: BoxMesh,
    first: int,
    last: int,
    name: str,
    thickness: float,
    sizing: BoxSizing,
) -> None:
    pid = model.shell_property(
        f"{name}: spar web", sizing.material, thickness, sizing.web_bending
    )
    for i, sign in ((0, mesh.outward), (-1, -mesh.outward))[: 1 if mesh.wedge else 2]:
        for quad in _quads(mesh.ids[first : last + 1, i], sign):
            model.shell(mesh.part, pid, quad)


def _rib(model: ModelBuilder, mesh: BoxMesh, station: int, pid: int) -> None:
    for quad in _quads(mesh.ids[station], mesh.outward):
        model.shell(mesh.part, pid, quad)


def _stringers(
    model: ModelBuilder,
    mesh: BoxMesh,
    first: int,
    last: int,
    name: str,
    span: float,
    sizing: BoxSizing,
) -> None:
    rows = mesh.ids.shape[1]
    kinds = []
    if sizing.stringer is not None and sizing.stringer_bars:
        area, h = sizing.stringer(span) / (rows - 2), sizing.stringer_height
        kinds.append(("stringer", range(1, rows - 1), area, h))
    if sizing.cap is not None:
        kinds.append(("spar cap", (0, rows - 1), sizing.cap(span), 0.0))
    for kind, chordwise, area, height in kinds:
        # A blade of that height, or a square cap; torsion as of a thin strip.
        h = height or float(np.sqrt(area))
        i1, i2 = area * h**2 / 12, area * (area / h) ** 2 / 12
        pid = model.bar_property(
            f"{name}: {kind}", sizing.material, area, i1, i2, min(i1, i2) * 4
        )
        for i in chordwise:
            for j in (0, -1):
                _bar_line(model, mesh, first, last, i, j, pid, height / 2)


def _bar_line(
    model: ModelBuilder,
    mesh: BoxMesh,
    first: int,
    last: int,
    i: int,
    j: int,
    pid: int,
    inward: float,
) -> None:
    for k in range(first, last):
        up = mesh.p[k, i, -1] - mesh.p[k, i, 0]
        up = up / np.linalg.norm(up)
        shift = (-up if j == -1 else up) * inward
        model.bar(
            mesh.part,
            pid,
            int(mesh.ids[k, i, j]),
            int(mesh.ids[k + 1, i, j]),
            up,
            shift,
        )


def _quads(grid: Int64, sign: int) -> list[list[int]]:
    """Quadrilaterals of a grid of ids (n, m); merged corners make triangles.

    Rows along the first index; sign +1 walks second index first.
    """
    a, b = grid[:-1, :-1].ravel(), grid[:-1, 1:].ravel()
    c, d = grid[1:, 1:].ravel(), grid[1:, :-1].ravel()
    corners = np.stack([a, b, c, d] if sign > 0 else [a, d, c, b], axis=1)
    return [list(dict.fromkeys(map(int, quad))) for quad in corners]

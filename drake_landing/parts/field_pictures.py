"""Pictures of the stress field at the worst instant: the whole airframe, one component.

Drawn off-screen by VTK; where that is not possible, there is a sentence instead.
"""

import os
import subprocess
import sys
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.parts.stress import Stresses
from drake_landing.parts.stress_observer import Snapshot
from fem.deck.grids import corners_of
from fem.files.atomic import written_aside
from fem.model.structure import Structure

if TYPE_CHECKING:
    import pyvista

Float64 = npt.NDArray[np.float64]
Int64 = npt.NDArray[np.int64]

SIZE = (1500, 900)  # pixels
_CORNER = 0.2  # of the picture, for its axes
_DEFORMATION = 0.05  # of the airframe's size: largest displacement in a picture
_MODE = 0.006  # the same in that of a buckling mode, whose place is small
_NEAR = 0.02  # likewise its close-up
_CLOSE = 0.09  # of the airframe's size: half height of a close-up
_THROUGH = 0.35  # opacity of an airframe within which a place is marked
_TOP = 0.995  # share of elements below the end of the colour scale
_TRY = (
    "import pyvista as v; p = v.Plotter(off_screen=True); p.screenshot(None); p.close()"
)


@dataclass(frozen=True, kw_only=True)
class Field:
    """A field of stress or displacement, ready to be drawn.

    Attributes:
        p: (g, 3) grids, deformed, B, m.
        faces, lines: elements -> rows of grids; padded as VTK wants them.
        face_stress, line_stress: Pa per element.
        factor: of the displacements.
        worst: (k, 3) corners of the worst element, deformed.
        title: of the colours.
        unit: Pa, or what one is in the picture.
        top: end of the colour scale; None: by the values.
        near: half height of a close-up, of the airframe's size.
        marked: where `worst` is, is shown in the whole as well, through all that lies
            before it.
    """

    p: Float64
    faces: Int64
    lines: Int64
    face_stress: Float64
    line_stress: Float64
    factor: float
    worst: Float64
    title: str = "equivalent stress, MPa"
    unit: float = 1e6
    top: float | None = None
    near: float = _CLOSE
    marked: bool = False


def can_draw() -> bool:
    """Whether pictures are wanted, and VTK can draw here."""
    wanted = os.environ.get("DRAKE_LANDING_PICTURES", "").lower() != "off"
    return wanted and _vtk_draws()


@cache
def _vtk_draws() -> bool:
    """Tried once; a crash of a driver stays in a process of its own."""
    # Not from modules of the working directory, which may be somebody else's.
    command = [sys.executable, "-P", "-c", _TRY]
    try:
        done = subprocess.run(command, capture_output=True, timeout=120, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


def stress_field(
    structure: Structure,
    stresses: Stresses,
    snapshot: Snapshot,
    chosen: frozenset[int] | None = None,
) -> Field:
    """The deformed elements with their equivalent stress at an instant.

    Args:
        structure: the full model.
        stresses: of all elements.
        snapshot: displacements and the worst element.
        chosen: element ids; None: all.
    """
    equivalent = stresses.of(snapshot.displacement[:, None])[0, :, 0]
    stress = pd.Series(equivalent, index=stresses.id)
    return _field(structure, snapshot.displacement, stress, snapshot.element, chosen)


def mode_field(
    structure: Structure,
    shape: Float64,
    work: pd.Series,
    element: int,
    chosen: frozenset[int] | None = None,
) -> Field:
    """The elements moved by a buckling mode, with the work that is done on them.

    Args:
        structure: the full model.
        shape: (f,) the mode.
        work: element id -> share of the largest.
        element: with the most of it.
        chosen: element ids; None: all.
    """
    field = _field(structure, shape, work, element, chosen, _MODE)
    title = "work of the internal forces, share of the largest"
    return replace(field, title=title, unit=1.0, top=1.0, near=_NEAR, marked=True)


def _field(
    structure: Structure,
    displacement: Float64,
    values: pd.Series,
    element: int,
    chosen: frozenset[int] | None,
    share: float = _DEFORMATION,
) -> Field:
    """Elements moved by (f,) displacements, with values by element id.

    The largest displacement is a share of the airframe's size.
    """
    points = structure.points
    moved = structure.operator(points.grid_id, (1, 2, 3), frame="basic")
    u = (moved @ displacement).reshape(-1, 3)
    u = u - _rigid_part(structure, displacement, points.xyz)
    size = float(np.ptp(points.xyz, axis=0).max())
    largest = float(np.linalg.norm(u, axis=1).max())
    factor = _round(share * size / largest) if largest > 0.0 else 1.0
    p = points.xyz + factor * u
    faces, face_id = _cells(structure, "surface", chosen, values.index)
    lines, line_id = _cells(structure, "line", chosen, values.index)
    own = [row for row, e in zip((*faces, *lines), (*face_id, *line_id))
           if e == element]  # fmt: skip
    worst = p[own[0]] if own else p.mean(axis=0)[None]
    return Field(
        p=p,
        faces=_padded(faces),
        lines=_padded(lines),
        face_stress=values.loc[face_id].to_numpy(float),
        line_stress=values.loc[line_id].to_numpy(float),
        factor=factor,
        worst=worst,
    )


def draw_field(
    path: Path, field: Field, *, close: bool, up: Float64, aft: Float64
) -> Float64:
    """Draws a field; a close-up looks at its worst element.

    Args:
        path: PNG file.
        field: what to draw.
        close: close-up, instead of all.
        up, aft: (3,) directions in B.

    Returns:
        (2,) ends of the colour scale, Pa.
    """
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    plotter = pyvista.Plotter(off_screen=True, window_size=list(SIZE))
    plotter.set_background("white")
    sticks = close or not len(field.faces)
    every = np.concatenate([field.face_stress, field.line_stress])
    top = float(np.quantile(every, _TOP)) if not close else float(every.max())
    top = top if field.top is None else field.top
    scale = (0.0, max(top, 1e-6 * field.unit))
    bar = {
        "title": f"{field.title}\n",  # else it stands in the numbers
        "vertical": False,
        "position_x": 0.30,
        "position_y": 0.02,
        "width": 0.40,
        "height": 0.10,
        "title_font_size": 22,
        "label_font_size": 20,
        "unconstrained_font_size": True,
        "color": "black",
        "fmt": "%.0f" if scale[1] > 20.0 * field.unit else "%.1f",
    }
    for data, stress, width in (
        (_poly(field.p, faces=field.faces), field.face_stress, 1.0),
        (_poly(field.p, lines=field.lines), field.line_stress, 3.0 if sticks else 1.2),
    ):
        if not len(stress):
            continue
        data.cell_data["stress"] = stress / field.unit
        plotter.add_mesh(
            data,
            scalars="stress",
            cmap="turbo",
            clim=(0.0, scale[1] / field.unit),
            scalar_bar_args=bar,
            show_edges=close and width == 1.0,
            edge_opacity=0.3,
            line_width=width,
            ambient=0.65,
            diffuse=0.4,
            opacity=_THROUGH if field.marked and not close else 1.0,
        )
    if close:
        plotter.add_mesh(_outline(field.worst), color="magenta", line_width=5)
    elif field.marked:
        place = field.worst.mean(axis=0)[None]
        plotter.add_points(
            place, color="magenta", point_size=22, render_points_as_spheres=True
        )
    seen = _look(plotter, field, close=close, up=up, aft=aft)
    # Of the deck's basic frame.
    plotter.add_axes(color="black", line_width=3, viewport=emptiest_corner(seen))
    try:
        with written_aside(path) as part:
            plotter.screenshot(str(part))
    finally:
        plotter.close()
    return np.array(scale)


def _outline(corners: Float64) -> "pyvista.PolyData":
    """Closed line round an element."""
    import pyvista

    count = len(corners)
    ring = [count + 1, *range(count), 0]
    return pyvista.PolyData(corners, lines=np.array(ring))


def emptiest_corner(seen: Float64) -> tuple[float, float, float, float]:
    """Left, lower, right, upper end of the corner with the fewest points, from 0 to 1.

    Args:
        seen: (n, 2) places in the picture, to the right and up, from 0 to 1.
    """
    far = 1.0 - _CORNER
    corners = [
        (x, y, x + _CORNER, y + _CORNER)
        for x, y in ((0.0, 0.0), (0.0, far), (far, far), (far, 0.0))
    ]

    def inside(box: tuple[float, float, float, float]) -> int:
        return int(((seen >= box[:2]) & (seen <= box[2:])).all(axis=1).sum())

    return min(corners, key=inside)


def _look(
    plotter: "pyvista.Plotter", field: Field, *, close: bool, up: Float64, aft: Float64
) -> Float64:
    """From ahead, aside and above; a close-up from outside onto its element.

    Returns:
        (n, 2) where the points are in the picture, to the right and up, from 0 to 1.
    """
    size = float(np.ptp(field.p, axis=0).max())
    worst = field.worst.mean(axis=0)
    toward = _outside(field, up=up, aft=aft, near=field.near * size) if close else None
    if toward is None:
        side = 1.0 if worst @ np.cross(up, aft) >= 0.0 else -1.0
        toward = -0.8 * aft + side * np.cross(up, aft) + 0.55 * up
    toward = toward / np.linalg.norm(toward)
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    seen = field.p @ np.column_stack([right, np.cross(toward, right)])
    wide = np.ptp(seen, axis=0)
    middle = seen.min(axis=0) + 0.5 * wide
    focus = middle[0] * right + middle[1] * np.cross(toward, right)
    focus += toward * (field.p @ toward).mean()
    half = 0.56 * max(wide[1], wide[0] * SIZE[1] / SIZE[0])
    if close:
        focus, half = worst, field.near * size
    plotter.enable_parallel_projection()
    plotter.camera.up = tuple(up)
    plotter.camera.focal_point = tuple(focus)
    plotter.camera.position = tuple(focus + 3.0 * size * toward)
    plotter.camera.parallel_scale = half
    plotter.reset_camera_clipping_range()
    center = np.array([focus @ right, focus @ np.cross(toward, right)])
    return 0.5 + 0.5 * (seen - center) / (half * np.array([SIZE[0] / SIZE[1], 1.0]))


def _outside(field: Field, *, up: Float64, aft: Float64, near: float) -> Float64 | None:
    """Direction from the worst element away from its neighbourhood, slanted."""
    used = np.unique(_grids(field.faces))
    if not len(used):
        return None
    corners = field.worst
    middle, p = corners.mean(axis=0), field.p[used]
    away = middle - p[np.linalg.norm(p - middle, axis=1) < near].mean(axis=0)
    if len(corners) == 2:
        outward = away
    elif len(corners) == 3:
        outward = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    else:
        outward = np.cross(corners[2] - corners[0], corners[3] - corners[1])
    outward = outward / max(float(np.linalg.norm(outward)), 1e-12)
    outward = outward if away @ outward >= 0.0 else -outward
    starboard = np.cross(up, aft)
    # Slanted to the side where the element lies, never along the vertical.
    behind = 1.0 if away @ aft > 0.0 else -1.0
    side = 1.0 if middle @ starboard >= 0.0 else -1.0
    return outward + 0.5 * behind * aft + 0.4 * side * starboard


def _grids(faces: Int64) -> Int64:
    """Rows of the grids of padded cells."""
    rows, at = [], 0
    while at < len(faces):
        count = int(faces[at])
        rows.append(faces[at + 1 : at + 1 + count])
        at += count + 1
    return np.concatenate(rows) if rows else np.zeros(0, np.int64)


def _rigid_part(structure: Structure, u_f: Float64, p: Float64) -> Float64:
    """(g, 3) motion as a rigid body, in the mean of the masses."""
    rigid = structure.rigid_body
    heavy = structure.mass @ rigid
    share = np.linalg.solve(rigid.T @ heavy, heavy.T @ u_f)
    arm = p - structure.rigid_mass.center
    return share[:3] + np.cross(share[3:], arm)


def _cells(
    structure: Structure,
    kind: str,
    chosen: frozenset[int] | None,
    known: pd.Index,
) -> tuple[list[Int64], Int64]:
    """Rows of the grids of elements, and element ids."""
    grid_id, rows, ids = structure.points.grid_id, [], []
    for table, corners in corners_of(structure.deck.cards, kind).values():
        keep = table.eid.isin(known)
        if chosen is not None:
            keep &= table.eid.isin(chosen)
        rows += list(np.searchsorted(grid_id, corners[keep]))
        ids.append(table.eid[keep].to_numpy(np.int64))
    return rows, np.concatenate(ids) if ids else np.zeros(0, np.int64)


def _padded(cells: list[Int64]) -> Int64:
    if not cells:
        return np.zeros(0, np.int64)
    return np.concatenate([np.concatenate([[len(c)], c]) for c in cells])


def _poly(p: Float64, **cells: Int64) -> "pyvista.PolyData":
    import pyvista

    if not any(len(c) for c in cells.values()):
        return pyvista.PolyData()
    return pyvista.PolyData(p, **cells)


def _round(factor: float) -> float:
    """To one digit, so that it can be said."""
    power = 10.0 ** np.floor(np.log10(factor))
    return float(np.floor(factor / power) * power)

"""PNG pictures of a mesh and its modes, drawn without a screen."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from drake_landing.show.mesh import RIGID, Component, DrawnMesh
from drake_landing.show.modes import ShownModes
from fem.files.atomic import written_aside

if TYPE_CHECKING:
    import pyvista

Float64 = npt.NDArray[np.float64]

VIEWS = {  # from where one looks, and what is up
    "perspective": ((-0.75, 1.0, 0.6), (0, 0, 1)),
    "top": ((0, 0, 1), (0, 1, 0)),
    "side": ((0, 1, 0), (0, 0, 1)),
    "front": ((-1, 0, 0), (0, 0, 1)),
}
_COLOURS = (
    *("#4c78a8", "#f2a541", "#59a14f", "#b07aa1", "#e15759", "#76b7b2", "#9c755f"),
    *("#d4a6c8", "#8cd17d", "#499894", "#f1ce63", "#79706e", "#a0cbe8", "#ff9d9a"),
    *("#86bcb6", "#d37295", "#b6992d", "#fabfd2", "#bab0ac", "#5778a4"),
)
_LEGEND = 0.4  # width of the legend over that of a view
_MOST_NAMES = 32
DEFORMATION = 0.08  # of the size of the model: largest displacement in a picture


def colour(index: int) -> str:
    """Color of the component at a place in the order."""
    return _COLOURS[index % len(_COLOURS)]


def draw_mesh(path: Path, mesh: DrawnMesh) -> None:
    """Four views by component beside a legend; rigid elements are left out."""
    vista = _vista()
    shown = [(k, c) for k, c in enumerate(mesh.components) if c.name != RIGID]
    surfaces = [(k, c, _poly_data(mesh.p, c)) for k, c in shown]
    plotter = vista.Plotter(
        off_screen=True, shape=(2, 3), groups=[(slice(None), 2)],
        col_weights=[1.0, 1.0, _LEGEND], window_size=(2400, 1300),
    )  # fmt: skip
    wide = 2400 / (2.0 + _LEGEND)
    for place, (name, (position, up)) in enumerate(VIEWS.items()):
        plotter.subplot(place // 2, place % 2)
        for k, _, data in surfaces:
            if data.n_points:
                plotter.add_mesh(
                    data, color=colour(k), show_edges=True, line_width=1.0,
                    edge_opacity=0.25, lighting=True,
                )  # fmt: skip
        plotter.add_text(name, font_size=9, color="black")
        _look(plotter, mesh.p, position, up, wide / 650)
    plotter.subplot(0, 2)
    plotter.set_background("white")
    names = shown[:_MOST_NAMES]
    plotter.add_legend(
        [[c.name, colour(k)] for k, c in names],
        bcolor=None,
        face="rectangle",
        size=(0.98, min(0.96, 0.03 * len(names))),
        loc="center left",
    )
    _save(plotter, path)


_MOST_MODES = 10  # in one picture


def draw_modes(path: Path, mesh: DrawnMesh, modes: ShownModes) -> None:
    """Deformed shapes of the lowest modes, coloured by displacement."""
    vista = _vista()
    count = min(_MOST_MODES, len(modes.names))
    if count == 0:
        return
    columns = min(5, count)
    shape = (-(-count // columns), columns)
    size = (columns * 560, shape[0] * 420)
    plotter = vista.Plotter(off_screen=True, shape=shape, window_size=size)
    drawn = [c for c in mesh.components if c.name != RIGID]
    for k in range(count):
        plotter.subplot(k // columns, k % columns)
        u = modes.shape[:, :, k] * deformation_factor(mesh.p, modes.shape[:, :, k])
        amount = np.linalg.norm(u, axis=1)
        amount /= max(float(amount.max()), np.finfo(float).tiny)
        for component in drawn:
            data = _poly_data(mesh.p + u, component)
            if data.n_points:
                data["displacement"] = amount
                plotter.add_mesh(
                    data, scalars="displacement", cmap="viridis", clim=(0, 1),
                    show_scalar_bar=False, line_width=1.5,
                )  # fmt: skip
        words = modes.names[k].replace(": ", "\n", 1)
        title = f"mode {k + 1}: {modes.frequency_hz[k]:.3f} Hz\n{words}"
        plotter.add_text(title, font_size=8, color="black")
        _look(plotter, mesh.p + u, *VIEWS["perspective"], 560 / 420)
    _save(plotter, path)


def deformation_factor(p: Float64, shape: Float64) -> float:
    """Factor that makes the largest displacement (g, 3) visible."""
    size = float(np.ptp(p, axis=0).max()) if len(p) else 1.0
    largest = float(np.linalg.norm(shape, axis=1).max(initial=0.0))
    return DEFORMATION * size / largest if largest > 0 else 0.0


def _vista():
    """pyvista; VTK finds a way to draw without a screen, and need not say so."""
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)

    return pyvista


def _poly_data(p: Float64, component: Component) -> "pyvista.PolyData":
    return _vista().PolyData(
        p,
        faces=_padded(component.quads, component.triangles),
        lines=_padded(component.lines),
    )


def _padded(*tables: npt.NDArray[np.int64]) -> npt.NDArray[np.int64] | None:
    """Cells as VTK wants them: the number of points before the points."""
    parts = [
        np.column_stack([np.full(len(t), t.shape[1]), t]).ravel()
        for t in tables
        if len(t)
    ]
    return np.concatenate(parts) if parts else None


def _look(
    plotter: "pyvista.Plotter",
    p: Float64,
    position: Sequence[float],
    up: Sequence[float],
    aspect: float,
) -> None:
    """Points the camera so that the grids (g, 3) fill a picture, width over height."""
    plotter.set_background("white")
    plotter.enable_parallel_projection()
    plotter.view_vector(position, viewup=up)
    toward = np.array(position) / np.linalg.norm(position)
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    seen = p @ np.column_stack([right, np.cross(toward, right)])
    wide, high = np.ptp(seen, axis=0)
    middle = seen.min(axis=0) + 0.5 * np.array([wide, high])
    focus = np.column_stack([right, np.cross(toward, right)]) @ middle
    focus += toward * float((p @ toward).mean())
    distance = 2.0 * float(np.ptp(p, axis=0).max()) + 1e-9
    plotter.camera.focal_point = focus
    plotter.camera.position = focus + distance * toward
    plotter.camera.parallel_scale = 0.55 * max(high, wide / aspect) + 1e-9
    plotter.reset_camera_clipping_range()


def _save(plotter: "pyvista.Plotter", path: Path) -> None:
    with written_aside(path) as part:
        plotter.screenshot(str(part))
        plotter.close()

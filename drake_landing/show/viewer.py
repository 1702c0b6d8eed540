"""A page that shows a mesh and animates its modes: one file, no server, no network.

Positions, faces and mode shapes lie in the page as base64; shapes as 16-bit fractions
of their largest entry. The page's own WebGL program bends the mesh on the graphics
processor, so that large models move smoothly.
"""

import base64
import json
from importlib.resources import files
from pathlib import Path

import numpy as np
import numpy.typing as npt
from jinja2 import Environment, StrictUndefined

from drake_landing.show.mesh import RIGID, Component, DrawnMesh
from drake_landing.show.mesh_pictures import colour, deformation_factor
from drake_landing.show.modes import ShownModes
from fem.files.atomic import write_aside

Int64 = npt.NDArray[np.int64]
_FULL = 32767


def write_viewer(
    path: Path, title: str, mesh: DrawnMesh, modes: ShownModes | None
) -> None:
    """Writes the page.

    Args:
        path: of the HTML file.
        title: heading.
        mesh: what is shown.
        modes: what moves; None for a still picture.
    """
    data = viewer_data(title, mesh, modes)
    text = files("drake_landing.show").joinpath("viewer.html.j2").read_text("utf-8")
    template = Environment(undefined=StrictUndefined, autoescape=True).from_string(text)
    # "<" never appears, so that no name can end the script it stands in.
    plain = json.dumps(data).replace("<", "\\u003c")
    write_aside(
        path,
        lambda part: part.write_text(
            template.render(title=title, data=plain), encoding="utf-8"
        ),
    )


def viewer_data(title: str, mesh: DrawnMesh, modes: ShownModes | None) -> dict:
    """Data for the page's program, ready for JSON."""
    center = 0.5 * (mesh.p.min(axis=0) + mesh.p.max(axis=0))
    return {
        "title": title,
        "size": float(np.ptp(mesh.p, axis=0).max()),
        "p": _text((mesh.p - center).astype("<f4")),
        "components": [
            {
                "name": component.name,
                "colour": colour(k),
                "visible": component.name != RIGID,
                "faces": _text(_triangles(component).astype("<u4")),
                "edges": _text(_edges(component).astype("<u4")),
                "lines": _text(component.lines.astype("<u4")),
                "count": len(component.quads) + len(component.triangles),
                "bars": len(component.lines),
            }
            for k, component in enumerate(mesh.components)
        ],
        "modes": [] if modes is None else _modes(mesh, modes),
    }


def _modes(mesh: DrawnMesh, modes: ShownModes) -> list[dict]:
    listed = []
    for k, (hertz, name) in enumerate(zip(modes.frequency_hz, modes.names)):
        shape = modes.shape[:, :, k]
        largest = float(np.abs(shape).max(initial=0.0)) or 1.0
        listed.append(
            {
                "name": f"{k + 1}: {hertz:.3f} Hz",
                "words": name,
                "shape": _text(np.round(shape / largest * _FULL).astype("<i2")),
                "scale": largest * deformation_factor(mesh.p, shape),
            }
        )
    return listed


def _triangles(component: Component) -> Int64:
    """(t, 3): quadrilaterals cut along a diagonal."""
    q = component.quads
    return np.concatenate([q[:, [0, 1, 2]], q[:, [0, 2, 3]], component.triangles])


def _edges(component: Component) -> Int64:
    """(e, 2) edges of the faces, each once."""
    pairs = [np.zeros((0, 2), np.int64)]
    for faces in (component.quads, component.triangles):
        pairs += [faces[:, [i, i - 1]] for i in range(faces.shape[1])]
    return np.unique(np.sort(np.concatenate(pairs), axis=1), axis=0)


def _text(array: npt.NDArray) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")

"""The things that are seen in a replay: light, runway, airframe, gears, arrows."""

import numpy as np
import numpy.typing as npt
from pydrake.geometry import (
    Box,
    Cylinder,
    Meshcat,
    MeshcatAnimation,
    MeshcatCone,
    Rgba,
)
from pydrake.math import RigidTransform, RotationMatrix

from drake_landing.airframe.skeleton import Skeleton
from drake_landing.gears.rods import Rod

Float64 = npt.NDArray[np.float64]

_LINE, _SKIN = Rgba(0.17, 0.32, 0.55, 1.0), Rgba(0.86, 0.89, 0.93, 1.0)
_STRUT, _PISTON = Rgba(0.78, 0.8, 0.83, 1.0), Rgba(0.95, 0.96, 0.97, 1.0)
_TIRE, _HUB = Rgba(0.13, 0.13, 0.14, 1.0), Rgba(0.62, 0.64, 0.67, 1.0)
_SPOKE = Rgba(0.95, 0.6, 0.1, 1.0)
_GRASS, _GROUND = Rgba(0.47, 0.53, 0.42, 1.0), Rgba(0.52, 0.55, 0.58, 1.0)
_MARK = Rgba(0.93, 0.93, 0.9, 1.0)
_LOAD = Rgba(0.81, 0.2, 0.15, 1.0)

_RUNWAY_WIDTH = 1.3  # over the size of the aircraft
_ACROSS = RigidTransform(RotationMatrix.MakeXRotation(np.pi / 2), np.zeros(3))


def add_look(meshcat: Meshcat, size: float) -> None:
    """Light, sky and camera for an aircraft of this size, m."""
    meshcat.SetProperty("/Background", "top_color", [0.93, 0.95, 0.97])
    meshcat.SetProperty("/Background", "bottom_color", [0.80, 0.84, 0.88])
    for path in ("/Grid", "/Axes"):
        meshcat.SetProperty(path, "visible", False)
    # Meshcat's lamps hang a few metres above the origin: made for robots' tables.
    for lamp in ("PointLightNegativeX", "PointLightPositiveX", "SpotLight"):
        meshcat.SetProperty(f"/Lights/{lamp}", "visible", False)
    meshcat.SetProperty("/Lights/AmbientLight/<object>", "intensity", 1.6)
    meshcat.SetProperty("/Lights/DirectionalLight", "visible", True)
    meshcat.SetProperty("/Lights/DirectionalLight/<object>", "intensity", 1.0)
    eye = size * np.array([-0.41, -0.45, 0.12])
    meshcat.SetCameraPose(eye, size * np.array([-0.02, 0.0, 0.10]))


def add_runway(meshcat: Meshcat, size: float, distance: float) -> None:
    """Ground, and `/runway/marks`, which are to move aft as the aircraft rolls.

    Args:
        size: of the aircraft, m.
        distance: that the marks will have moved at the end, m.
    """
    length, width = distance + 12 * size, _RUNWAY_WIDTH * size
    middle = -length / 2 + 6 * size
    for name, box, color, z in (
        ("grass", Box(4 * length, 4 * length, 0.1), _GRASS, -0.2),
        ("ground", Box(length, width, 0.1), _GROUND, -0.09),
    ):
        meshcat.SetObject(f"/runway/{name}", box, color)
        meshcat.SetTransform(f"/runway/{name}", RigidTransform([middle, 0, z]))
    for side in (-0.46, 0.46):
        path = f"/runway/edge_{'left' if side < 0 else 'right'}"
        meshcat.SetObject(path, Box(length, 0.015 * size, 0.01), _MARK)
        meshcat.SetTransform(path, RigidTransform([middle, side * width, 0.0]))
    dash, gap = 0.25 * size, 0.75 * size
    for i, x in enumerate(np.arange(middle - length / 2, middle + length / 2, gap)):
        path = f"/runway/marks/{i}"
        meshcat.SetObject(path, Box(dash, 0.02 * size, 0.01), _MARK)
        meshcat.SetTransform(path, RigidTransform([x, 0, 0.0]))


def airframe_picture(
    meshcat: Meshcat, path: str, skeleton: Skeleton, p_W: Float64
) -> None:
    """Lines, and the skin where there is one, of an airframe whose grids are at p_W."""
    first, second = skeleton.edges.T
    p = np.asfortranarray(p_W.T)
    start, end = np.asfortranarray(p[:, first]), np.asfortranarray(p[:, second])
    meshcat.SetLineSegments(f"{path}/lines", start, end, 2.0, _LINE)
    if len(skeleton.faces):
        faces = np.asfortranarray(skeleton.faces.T.astype(np.int32))
        both = Meshcat.SideOfFaceToRender.kDoubleSide
        meshcat.SetTriangleMesh(f"{path}/skin", p, faces, _SKIN, side=both)


def add_rod(meshcat: Meshcat, path: str, rod: Rod, radius: float) -> None:
    """A rod of a gear; `radius` is that of its thickest one, m."""
    span = rod.end - rod.start
    length = float(np.linalg.norm(span))
    if length < 1e-6:
        return
    R = RotationMatrix.MakeFromOneVector(span / length, 2)
    color = _PISTON if rod.bright else _STRUT
    meshcat.SetObject(path, Cylinder(rod.thickness * radius, length), color)
    meshcat.SetTransform(path, RigidTransform(R, 0.5 * (rod.start + rod.end)))


def add_wheel(meshcat: Meshcat, path: str, radius: float) -> None:
    """A tire, and a cross on the hub that shows that it turns."""
    width = 0.55 * radius
    for name, shape, color in (
        ("tire", Cylinder(radius, width), _TIRE),
        ("hub", Cylinder(0.55 * radius, 1.02 * width), _HUB),
    ):
        meshcat.SetObject(f"{path}/{name}", shape, color)
        meshcat.SetTransform(f"{path}/{name}", _ACROSS)
    for i, (x, z) in enumerate(((1.6, 0.14), (0.14, 1.6))):
        spoke = Box(x * radius, 1.05 * width, z * radius)
        meshcat.SetObject(f"{path}/spoke_{i}", spoke, _SPOKE)


class Arrow:
    """A force, as long as it is large.

    Args:
        meshcat: to draw in.
        path: of the arrow.
        scale: length per force, m/N.
    """

    def __init__(self, meshcat: Meshcat, path: str, scale: float) -> None:
        self._path, self._scale = path, scale
        self._head = 0.45  # m
        meshcat.SetObject(f"{path}/shaft", Box(0.16, 0.16, 1.0), _LOAD)
        cone = MeshcatCone(self._head, 0.24, 0.24)
        meshcat.SetObject(f"{path}/head/cone", cone, _LOAD)
        # Its tip is at its origin, and it opens upward.
        over = RotationMatrix.MakeXRotation(np.pi)
        meshcat.SetTransform(f"{path}/head/cone", RigidTransform(over, np.zeros(3)))

    def show(
        self, animation: MeshcatAnimation, frame: int, p_W: Float64, force: Float64
    ) -> None:
        """Sets the arrow of a force (3,) at p_W (3,) in a frame; small ones hide."""
        size = float(np.linalg.norm(force))
        length = self._scale * size
        shown = length > self._head
        animation.SetProperty(frame, self._path, "visible", shown)
        if not shown:
            return
        R = RotationMatrix.MakeFromOneVector(force / size, 2)
        animation.SetTransform(frame, self._path, RigidTransform(R, p_W))
        shaft = length - self._head
        along = RigidTransform([0.0, 0.0, 0.5 * shaft])
        animation.SetTransform(frame, f"{self._path}/shaft", along)
        scale = [1.0, 1.0, shaft]
        animation.SetProperty(frame, f"{self._path}/shaft/<object>", "scale", scale)
        tip = RigidTransform([0.0, 0.0, length])
        animation.SetTransform(frame, f"{self._path}/head", tip)

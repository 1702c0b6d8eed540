"""`landing.html`: the landing to look at, recorded in Meshcat, without a server.

The aircraft stays in view and the runway's marks move past. The airframe's lines are a
sequence of pictures, of which one is visible at a time, because a recording can move
and show things but not bend them. Gears follow the attachment nodes.
"""

import logging
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from pydrake.common.eigen_geometry import Quaternion
from pydrake.geometry import (
    Box,
    Cylinder,
    Meshcat,
    MeshcatAnimation,
    MeshcatParams,
    Rgba,
)
from pydrake.math import RigidTransform, RotationMatrix

from drake_landing.axes import gear_in_A, rotation_AB
from drake_landing.gear import LandingGear
from drake_landing.gear_pictures import rods
from drake_landing.results import write_aside
from drake_landing.skeleton import Skeleton
from systems.rotations import exp

if TYPE_CHECKING:
    from drake_landing.process import ProcessResult

Float64 = npt.NDArray[np.float64]

_FRAMES_PER_SECOND = 16.0
_SECONDS = 8.0  # of the replay
_FACTORS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
_VISIBLE_SHARE = 0.02  # of the aircraft's size: a deformation that one sees

_LINE = Rgba(0.17, 0.32, 0.55, 1.0)
_STRUT, _PISTON = Rgba(0.45, 0.48, 0.52, 1.0), Rgba(0.75, 0.77, 0.8, 1.0)
_TYRE, _SPOKE = Rgba(0.13, 0.13, 0.14, 1.0), Rgba(0.9, 0.65, 0.15, 1.0)
_GROUND, _MARK = Rgba(0.52, 0.55, 0.58, 1.0), Rgba(0.93, 0.93, 0.9, 1.0)
_LOAD = Rgba(0.81, 0.23, 0.17, 1.0)


@dataclass(frozen=True, kw_only=True)
class Motion:
    """The landing at the frames of the replay, seen from an observer who moves along.

    Attributes:
        time: (f,) s.
        distance: (f,) how far the runway has gone by, m.
        p: (f, 3) centre of gravity; R: (f, 3, 3) R_WA.
        amplitudes: (f, n).
    """

    time: Float64
    distance: Float64
    p: Float64
    R: Float64
    amplitudes: Float64


def write_replay(path: Path, result: "ProcessResult") -> None:
    """Writes the replay of a run."""
    meshcat = _quiet_meshcat()
    skeleton = result.airframe.skeleton
    motion = frames(result)
    factor = deformation_factor(skeleton, motion.amplitudes)
    animation = MeshcatAnimation(_FRAMES_PER_SECOND)
    size = float(np.ptp(skeleton.p, axis=0).max())
    _look(meshcat, size)
    _runway(meshcat, animation, motion, size)
    _airframe(meshcat, animation, result, skeleton, motion, factor)
    R_AB = rotation_AB(result.case.airframe.axes)
    for gear in result.aircraft.gears:
        _gear(meshcat, animation, result, gear_in_A(gear, R_AB), motion, factor)
    meshcat.SetAnimation(animation)
    slowness = _SECONDS / motion.time[-1]
    caption = (
        f"{result.case.title or result.case.name}: {motion.time[-1]:.2f} s, "
        f"{slowness:.0f} times slower than real, deformation times {factor:g}, "
        "red: vertical tyre loads"
    )
    html = _captioned(meshcat.StaticHtml(), caption)
    write_aside(path, lambda to: to.write_text(html, encoding="utf-8") and None)


def _quiet_meshcat() -> Meshcat:
    """Without the line about the port where it listens: nobody connects to it."""
    log = logging.getLogger("drake")
    level = log.level
    log.setLevel(logging.WARNING)
    try:
        return Meshcat(MeshcatParams(host="localhost", show_stats_plot=False))
    finally:
        log.setLevel(level)


def frames(result: "ProcessResult") -> Motion:
    """The motion at evenly spaced instants."""
    history = result.history
    table = history.motion
    time = np.linspace(0, history.time[-1], int(_SECONDS * _FRAMES_PER_SECOND) + 1)

    def at(values: npt.ArrayLike) -> Float64:
        columns = np.asarray(values).T
        return np.array([np.interp(time, history.time, c) for c in columns]).T

    quaternions = at(table[["qw", "qx", "qy", "qz"]])
    p = at(table[["px", "py", "pz"]])
    distance = p[0, 0] - p[:, 0]
    p[:, 0] = 0.0
    return Motion(
        time=time,
        distance=distance,
        p=p,
        R=np.array([_rotation(q) for q in quaternions]),
        amplitudes=at(history.amplitudes).reshape(len(time), -1),
    )


def deformation_factor(skeleton: Skeleton, amplitudes: Float64) -> float:
    """The round factor that makes the largest displacement visible, 1 if it is."""
    if skeleton.shape.shape[2] == 0 or not np.any(amplitudes):
        return 1.0
    some = amplitudes[:: max(1, len(amplitudes) // 50)]
    largest = max(float(np.abs(skeleton.shape @ a).max()) for a in some)
    wanted = _VISIBLE_SHARE * float(np.ptp(skeleton.p, axis=0).max()) / largest
    return max((f for f in _FACTORS if f <= max(wanted, 1.0)), default=1.0)


def _rotation(q: Float64) -> Float64:
    return RotationMatrix(Quaternion(q / np.linalg.norm(q))).matrix()


def _look(meshcat: Meshcat, size: float) -> None:
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
    eye = size * np.array([-0.60, -0.66, 0.30])
    meshcat.SetCameraPose(eye, np.array([0.0, 0.0, 0.05 * size]))


def _runway(
    meshcat: Meshcat, animation: MeshcatAnimation, motion: Motion, size: float
) -> None:
    length = motion.distance[-1] + 6 * size
    middle = -length / 2 + 3 * size
    ground = Box(length, 1.3 * size, 0.1)
    meshcat.SetObject("/runway/ground", ground, _GROUND)
    meshcat.SetTransform("/runway/ground", RigidTransform([middle, 0, -0.09]))
    dash, gap = 0.25 * size, 0.75 * size
    for i, x in enumerate(np.arange(middle - length / 2, middle + length / 2, gap)):
        path = f"/runway/marks/{i}"
        meshcat.SetObject(path, Box(dash, 0.02 * size, 0.01), _MARK)
        meshcat.SetTransform(path, RigidTransform([x, 0, 0.0]))
    for i, distance in enumerate(motion.distance):
        animation.SetTransform(i, "/runway/marks", RigidTransform([distance, 0, 0]))


def _airframe(
    meshcat: Meshcat,
    animation: MeshcatAnimation,
    result: "ProcessResult",
    skeleton: Skeleton,
    motion: Motion,
    factor: float,
) -> None:
    p_AG = result.airframe.body.p_BG
    first, second = skeleton.edges.T
    for i, amplitudes in enumerate(motion.amplitudes):
        path = f"/airframe/at_{i}"
        p = (skeleton.deformed(amplitudes, factor) - p_AG) @ motion.R[i].T
        p = np.asfortranarray((p + motion.p[i]).T)
        start, end = np.asfortranarray(p[:, first]), np.asfortranarray(p[:, second])
        meshcat.SetLineSegments(path, start, end, 2.0, _LINE)
        meshcat.SetProperty(path, "visible", i == 0)
        for frame in (i - 1, i, i + 1):
            if 0 <= frame < len(motion.time):
                animation.SetProperty(frame, path, "visible", frame == i)


def _gear(
    meshcat: Meshcat,
    animation: MeshcatAnimation,
    result: "ProcessResult",
    gear: LandingGear,
    motion: Motion,
    factor: float,
) -> None:
    """Bodies of a gear, moved with the enlarged deformation of its attachment node."""
    body, history = result.airframe.body, result.history
    row = body.rows(gear.attachment_node)[0]
    radius = 0.16 * gear.tyre.radius
    for i, rod in enumerate(rods(gear, body.p_BN[row])):
        color = _PISTON if rod.bright else _STRUT
        path = f"/gears/{rod.body}/rod_{i}"
        _rod(meshcat, path, rod.start, rod.end, rod.thickness * radius, color)
    for wheel in gear.wheel_names:
        _wheel(meshcat, f"/gears/{wheel}_wheel", gear.tyre.radius)
        _load(meshcat, animation, result, gear, wheel, motion)
    seen = {
        name: _poses_at(history.time, poses, motion)
        for name, poses in history.bodies.items()
        if name.startswith(f"{gear.name}_")
    }
    for i, amplitudes in enumerate(motion.amplitudes):
        bend = factor * (body.translation[row] @ amplitudes)
        turn = exp(factor * (body.rotation[row] @ amplitudes)[None])[0]
        p = motion.p[i] + motion.R[i] @ (body.p_BN[row] - body.p_BG + bend)
        R = RotationMatrix.ProjectToRotationMatrix(motion.R[i] @ turn)
        shift = RigidTransform(R, p) @ seen[f"{gear.name}_fitting"][i].inverse()
        for name, poses in seen.items():
            animation.SetTransform(i, f"/gears/{name}", shift @ poses[i])
        for wheel in gear.wheel_names:
            at = (shift @ seen[f"{wheel}_wheel"][i]).translation()
            animation.SetTransform(i, f"/loads/{wheel}", RigidTransform(at))


def _poses_at(time: Float64, poses: Float64, motion: Motion) -> list[RigidTransform]:
    """Poses of a body at the frames; (t, 7) quaternion and position over time."""
    nearest = np.clip(np.searchsorted(time, motion.time), 0, len(time) - 1)
    found = []
    for i, row in enumerate(poses[nearest]):
        p = [row[4] + motion.distance[i], *row[5:]]
        found.append(RigidTransform(RotationMatrix(_rotation(row[:4])), p))
    return found


def _wheel(meshcat: Meshcat, path: str, radius: float) -> None:
    """A tyre, and a cross that shows that it turns."""
    width = 0.55 * radius
    across = RigidTransform(RotationMatrix.MakeXRotation(np.pi / 2), np.zeros(3))
    meshcat.SetObject(f"{path}/tyre", Cylinder(radius, width), _TYRE)
    meshcat.SetTransform(f"{path}/tyre", across)
    for i, (x, z) in enumerate(((1.5, 0.16), (0.16, 1.5))):
        spoke = Box(x * radius, 1.04 * width, z * radius)
        meshcat.SetObject(f"{path}/spoke_{i}", spoke, _SPOKE)


def _load(
    meshcat: Meshcat,
    animation: MeshcatAnimation,
    result: "ProcessResult",
    gear: LandingGear,
    wheel: str,
    motion: Motion,
) -> None:
    """A bar behind the wheel, as long as the vertical load."""
    history = result.history
    largest = max(float(t["vertical"].max()) for t in history.tyre.values())
    table = history.tyre[wheel]
    share = np.interp(motion.time, table.index, table["vertical"]) / max(largest, 1.0)
    size = float(np.ptp(result.airframe.skeleton.p, axis=0).max())
    length, width = 0.09 * size, 0.005 * size
    path = f"/loads/{wheel}/bar"
    meshcat.SetObject(path, Box(width, width, length), _LOAD)
    for i, s in enumerate(np.maximum(share, 1e-3)):
        p = [1.3 * gear.tyre.radius, 0.0, gear.tyre.radius + 0.5 * s * length]
        animation.SetTransform(i, path, RigidTransform(p))
        animation.SetProperty(i, f"{path}/<object>", "scale", [1.0, 1.0, float(s)])


def _rod(
    meshcat: Meshcat, path: str, a: Float64, b: Float64, radius: float, color: Rgba
) -> None:
    """A cylinder from a to b."""
    length = float(np.linalg.norm(b - a))
    if length < 1e-6:
        return
    R = RotationMatrix.MakeFromOneVector((b - a) / length, 2)
    meshcat.SetObject(path, Cylinder(radius, length), color)
    meshcat.SetTransform(path, RigidTransform(R, 0.5 * (a + b)))


def _captioned(html: str, caption: str) -> str:
    """The page with a line of text at its foot."""
    style = (
        "position:fixed;left:16px;bottom:12px;padding:6px 12px;border-radius:6px;"
        "background:rgba(255,255,255,.85);color:#2b3440;font:14px sans-serif"
    )
    note = f'<div style="{style}">{escape(caption)}</div></body>'
    head, _, tail = html.rpartition("</body>")
    title = f"<title>{escape(caption.split(':')[0])}</title>"
    return (head + note + tail).replace("<title>Drake MeshCat</title>", title)

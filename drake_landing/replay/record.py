"""`landing.html`: the landing to look at, recorded in Meshcat, without a server.

The aircraft stays in view and the runway's marks move past. The airframe is a sequence
of pictures, of which one is visible at a time, because a recording can move and show
things but not bend them. Gears follow the attachment nodes. What is drawn is in
`scene`; here is how it moves.
"""

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pandas as pd
from pydrake.common.eigen_geometry import Quaternion
from pydrake.geometry import Meshcat, MeshcatAnimation, MeshcatParams
from pydrake.math import RigidTransform, RotationMatrix

from drake_landing.airframe.skeleton import Skeleton
from drake_landing.case.axes import gear_in_A, rotation_AB
from drake_landing.gears.bodies import leg_lines
from drake_landing.gears.landing_gear import LandingGear
from drake_landing.gears.rods import rods
from drake_landing.replay.scene import (
    Arrow,
    add_look,
    add_rod,
    add_runway,
    add_wheel,
    airframe_picture,
)
from fem.files.atomic import write_aside
from systems.tools.rotations import exp

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

Float64 = npt.NDArray[np.float64]

# Nothing is fetched, of the page itself or of what a name might bring in.
# Meshcat makes its controls when the scene is read; they have no names of their own.
_NAMES = """
function nameControls() {
  const region = (element, label) => {
    if (!element) return;
    element.setAttribute("role", "region");
    element.setAttribute("aria-label", label);
  };
  region(document.querySelector("#meshcat-pane"), "The landing in three dimensions");
  document.querySelectorAll(".dg.ac, .lil-gui.root, .dg.main").forEach(
    (panel, i) => region(panel, "Controls" + (i ? " " + (i + 1) : "")));
  for (const control of document.querySelectorAll("input, select")) {
    if (control.getAttribute("aria-label")) continue;
    let place = control.parentElement;
    while (place && !place.innerText?.trim()) place = place.parentElement;
    const text = place ? place.innerText.trim().split("\\n")[0] : "";
    const kind = control.type === "checkbox" ? "show " : "";
    control.setAttribute("aria-label", kind + (text || "setting"));
  }
}
for (const wait of [0, 500, 2000, 6000]) setTimeout(nameControls, wait);
"""
_POLICY = (
    '<meta http-equiv="Content-Security-Policy" content="default-src \'none\'; '
    "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:; "
    'connect-src data: blob:; font-src data:; worker-src blob:">'
)
_FRAMES_PER_SECOND = 16.0
_SECONDS = 8.0  # of the replay
_FACTORS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
_VISIBLE_SHARE = 0.02  # of the aircraft's size: a deformation that one sees
_ARROW_SHARE = 0.13  # of the aircraft's size: the longest arrow


@dataclass(frozen=True, kw_only=True)
class Motion:
    """The landing at the frames of the replay, seen from an observer who moves along.

    Attributes:
        time: (f,) s.
        distance: (f,) how far the runway has gone by, m.
        p: (f, 3) center of gravity; R: (f, 3, 3) R_WA.
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
    add_look(meshcat, size)
    _runway(meshcat, animation, motion, size)
    _airframe(meshcat, animation, result, skeleton, motion, factor)
    R_AB = rotation_AB(result.case.airframe.axes)
    largest = max(1.0, *(_size(t).max() for t in result.history.tire.values()))
    for gear in result.aircraft.gears:
        drawn = gear_in_A(gear, R_AB)
        seen = _gear(meshcat, animation, result, drawn, motion, factor)
        for wheel in gear.wheel_names:
            arrow = Arrow(meshcat, f"/loads/{wheel}", _ARROW_SHARE * size / largest)
            _load(
                arrow, animation, result, drawn, wheel, seen[f"{wheel}_wheel"], motion
            )
    meshcat.SetAnimation(animation)
    caption = _caption(result, motion, factor, largest)
    html = _captioned(meshcat.StaticHtml(), caption)
    write_aside(path, lambda to: to.write_text(html, encoding="utf-8") and None)


def _caption(
    result: "ProcessResult", motion: Motion, factor: float, largest: float
) -> str:
    slowness = _SECONDS / motion.time[-1]
    enlarged = f"deformation times {factor:g}, " if factor != 1.0 else ""
    return (
        f"{result.case.title or result.case.name}: {motion.time[-1]:.2f} s, "
        f"{slowness:.0f} times slower than real, {enlarged}red: forces of the runway "
        f"on the tires, the longest {largest / 1e3:.0f} kN"
    )


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


def _runway(
    meshcat: Meshcat, animation: MeshcatAnimation, motion: Motion, size: float
) -> None:
    add_runway(meshcat, size, float(motion.distance[-1]))
    for i, distance in enumerate(motion.distance):
        shift = RigidTransform([distance, 0, 0])
        animation.SetTransform(i, "/runway/marks", shift)


def _airframe(
    meshcat: Meshcat,
    animation: MeshcatAnimation,
    result: "ProcessResult",
    skeleton: Skeleton,
    motion: Motion,
    factor: float,
) -> None:
    p_AG = result.airframe.body.p_BG
    for i, amplitudes in enumerate(motion.amplitudes):
        path = f"/airframe/at_{i}"
        p = (skeleton.deformed(amplitudes, factor) - p_AG) @ motion.R[i].T
        airframe_picture(meshcat, path, skeleton, p + motion.p[i])
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
) -> dict[str, list[RigidTransform]]:
    """Bodies of a gear, moved with the enlarged deformation of its attachment node.

    Returns:
        Name of each body -> where it is seen at the frames.
    """
    body, history = result.airframe.body, result.history
    row = body.rows(gear.attachment_node)[0]
    radius = 0.16 * gear.tyre.radius
    for i, rod in enumerate(rods(gear, body.p_BN[row])):
        path = f"/gears/{rod.body}/rod_{i}"
        add_rod(meshcat, path, rod, radius)
    for wheel in gear.wheel_names:
        add_wheel(meshcat, f"/gears/{wheel}_wheel", gear.tire_of(wheel).radius)
    poses = {
        name: _poses_at(history.time, poses, motion)
        for name, poses in history.bodies.items()
        if name.startswith(f"{gear.name}_")
    }
    seen: dict[str, list[RigidTransform]] = {name: [] for name in poses}
    p_AF = body.p_BN[row]
    more = enlarged_bending(
        history.bending.get(gear.name), leg_lines(gear, p_AF), p_AF, motion.time, factor
    )
    for i, amplitudes in enumerate(motion.amplitudes):
        bend = factor * (body.translation[row] @ amplitudes)
        turn = exp(factor * (body.rotation[row] @ amplitudes)[None])[0]
        p = motion.p[i] + motion.R[i] @ (body.p_BN[row] - body.p_BG + bend)
        R = RotationMatrix.ProjectToRotationMatrix(motion.R[i] @ turn)
        from_fitting = poses[f"{gear.name}_fitting"][i].inverse()
        for name in poses:
            bent = RigidTransform() if name == f"{gear.name}_fitting" else more[i]
            seen[name].append(
                RigidTransform(R, p) @ bent @ from_fitting @ poses[name][i]
            )
            animation.SetTransform(i, f"/gears/{name}", seen[name][i])
    return seen


def enlarged_bending(
    bending: pd.DataFrame | None,
    lines: Mapping[str, tuple[Float64, Float64]],
    p_AF: Float64,
    time: Float64,
    factor: float,
) -> list[RigidTransform]:
    """Further deflection of an elastic leg that enlarges it, in the fitting's frame.

    Args:
        bending: angles over time, rad; None of a rigid leg.
        lines: place and axis of each hinge in A, see `bodies.leg_lines`.
        p_AF: (3,) origin of the fitting in A, m.
        time: (f,) of the frames, s.
        factor: of the enlargement.
    """
    turns = [RigidTransform()] * len(time)
    if bending is None:
        return turns
    for kind, (place, axis) in lines.items():
        about = RigidTransform(place - p_AF)
        for i, angle in enumerate(np.interp(time, bending.index, bending[kind])):
            more = exp((factor - 1.0) * angle * axis[None])[0]
            R = RotationMatrix.ProjectToRotationMatrix(more)
            turn = RigidTransform(R, np.zeros(3))
            turns[i] = turns[i] @ about @ turn @ about.inverse()
    return turns


def _load(
    arrow: Arrow,
    animation: MeshcatAnimation,
    result: "ProcessResult",
    gear: LandingGear,
    wheel: str,
    poses: list[RigidTransform],
    motion: Motion,
) -> None:
    """The force of the runway on a tire, from the ground beside it."""
    table = result.history.tire[wheel]
    columns = ("deflection", "drag", "side", "vertical")
    values = [np.interp(motion.time, table.index, table[name]) for name in columns]
    offset = gear.wheel_offsets[gear.wheel_names.index(wheel) % len(gear.wheel_offsets)]
    radius = gear.tire_of(wheel).radius
    aside = (1.0 if offset >= 0.0 else -1.0) * 0.6 * radius
    for i, (X, deflection, drag, side, vertical) in enumerate(zip(poses, *values)):
        axle = X.rotation().matrix()[:, 1]
        aft = np.array([axle[1], -axle[0], 0.0])
        aft /= np.linalg.norm(aft)
        across = np.array([-aft[1], aft[0], 0.0])
        foot = X.translation() + aside * axle
        foot[2] -= radius - max(deflection, 0.0)
        force = drag * aft + side * across + np.array([0.0, 0.0, vertical])
        arrow.show(animation, i, foot, force)


def _size(tire) -> Float64:
    """(t,) magnitude of the force on a tire, N."""
    return np.sqrt((tire[["vertical", "drag", "side"]] ** 2).sum(axis=1).to_numpy())


def _poses_at(time: Float64, poses: Float64, motion: Motion) -> list[RigidTransform]:
    """Poses of a body at the frames; (t, 7) quaternion and position over time."""
    nearest = np.clip(np.searchsorted(time, motion.time), 0, len(time) - 1)
    found = []
    for i, row in enumerate(poses[nearest]):
        p = [row[4] + motion.distance[i], *row[5:]]
        found.append(RigidTransform(RotationMatrix(_rotation(row[:4])), p))
    return found


def _captioned(html: str, caption: str) -> str:
    """The page with a line of text at its foot, and names for screen readers."""
    style = (
        "position:fixed;left:16px;bottom:12px;padding:6px 12px;border-radius:6px;"
        "background:rgba(255,255,255,.85);color:#2b3440;font:14px sans-serif;margin:0"
    )
    heading = f'<main><h1 style="{style}">{escape(caption)}</h1></main>'
    html = html.replace("<head>", f"<head>\n{_POLICY}", 1)
    html = html.replace("<html>", '<html lang="en">', 1)
    head, _, tail = html.rpartition("</body>")
    title = f"<title>{escape(caption.split(':')[0])}</title>"
    page = f"{head}{heading}<script>{_NAMES}</script></body>{tail}"
    return page.replace("<title>Drake MeshCat</title>", title)

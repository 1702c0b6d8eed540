"""Where one looks at the reference aircraft: wing and fuselage, floor, a skin panel."""

import numpy as np
import numpy.typing as npt

from drake_landing.places import ANY, Beam, Panel, Places
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.limit_load import LOAD_FACTOR, applied_loads
from drake_landing.reference.d150.reference_axis import reference_nodes
from fem.model.structure import Structure

Float64 = npt.NDArray[np.float64]

# Just outboard of the fuselage's side, ahead of the wing's root, behind its flaps.
WING_ROOT, WING_TIP = 2.0, 16.5
FUSELAGE_FRONT, NOSE = 12.7, 1.5
FUSELAGE_REAR, TAIL = 19.0, 36.5
_SIDE = (-1.99, 1.99)
_WING = (10.0, 27.0)  # x of everything that hangs on the wings
_CUTS = 16

# Frames at which the floor is looked at.
_FLOOR = {"cockpit": "C08", "forward cabin": "C20", "over the wing": "C40",
          "aft cabin": "C60"}  # fmt: skip
_PANEL_FRAMES = ("C27", "C28")  # forward of the wing, without windows or doors
_PANEL_Z = -0.25  # m, between floor and windows


def reference_places(structure: Structure, level: str) -> Places:
    """Places of con, pre or full.

    Args:
        structure: of that level.
        level: con, pre or full.
    """
    if level == "full":
        return Places(
            beams=_beams(), panels=_panels(structure), equipment=_floor(structure)
        )
    return Places(beams=_beams(), equipment=_axis())


def steady_load(structure: Structure) -> Float64:
    """(f, 1) loads of steady flight at 1 g, which the inertia of the airframe balances.

    The lift is that of the source's limit load case, scaled to the weight; the gears
    hang on their attachments.
    """
    load = applied_loads(structure)[:, None] / LOAD_FACTOR
    return np.asarray(structure.load(load))


def _beams() -> tuple[Beam, ...]:
    """Wings outboard of the fuselage; fuselage ahead of the wing and behind it."""
    wing = np.linspace(WING_ROOT, WING_TIP, _CUTS)
    starboard = ((_WING, (0.0, 1e9), ANY),)
    port = ((_WING, (-1e9, 0.0), ANY),)
    front = (((-1e9, FUSELAGE_FRONT), _SIDE, ANY),)
    rear = (((FUSELAGE_REAR, 27.0), _SIDE, ANY), ((27.0, 1e9), ANY, ANY))
    ahead = np.linspace(FUSELAGE_FRONT, NOSE, _CUTS)
    behind = np.linspace(FUSELAGE_REAR, TAIL, _CUTS)
    rows = (
        ("right wing", "starboard", wing, starboard, "wing_right"),
        ("left wing", "port", -wing, port, "wing_left"),
        ("forward fuselage", "fore", ahead, front, "fuselage"),
        ("rear fuselage", "aft", behind, rear, "fuselage"),
    )
    reference = reference_nodes()
    return tuple(
        Beam(
            name=name,
            outward=outward,
            stations=stations,
            boxes=boxes,
            line=reference[axis].p,
        )
        for name, outward, stations, boxes, axis in rows
    )


def _floor(structure: Structure) -> dict[str, int]:
    """Middle of the floor, and the outer seat rail between two frames."""
    data = facts("fuselage_shell")["passenger_floor"]
    z = data["panel_z"]
    rails = [row[0] for row in data["columns"] if row[3]]
    found = {}
    for name, frame in _FLOOR.items():
        x = _frame(frame)
        nearest = _nearest(structure, [x, 0.0, z])
        found[f"floor, {name} ({frame})"] = nearest
        # The outermost rail that is there.
        rail = min((_nearest(structure, [x, y, z]) for y in rails[::-1]),
                   key=lambda g: _distance_to_rail(structure, g, rails))  # fmt: skip
        found[f"seat rail, {name} ({frame})"] = rail
    return found


def _distance_to_rail(structure: Structure, grid: int, rails: list[float]) -> float:
    """Larger for rails farther inboard, huge for grids that are on none."""
    y = structure.points.xyz[structure.points.rows(grid)][1]
    off = min(abs(y - rail) for rail in rails)
    return -y if off < 0.05 else 1e3 + off


def _axis() -> dict[str, int]:
    """Nodes of the fuselage's axis where there is no floor."""
    group = reference_nodes()["fuselage"]
    found = {}
    for name, frame in _FLOOR.items():
        at = int(np.argmin(np.abs(group.p[:, 0] - _frame(frame))))
        found[f"fuselage axis, {name} ({frame})"] = int(group.ids[at])
    return found


def _panels(structure: Structure) -> tuple[Panel, ...]:
    """The skin in the middle of a frame bay, and of the floor."""
    a, b = (_frame(name) for name in _PANEL_FRAMES)
    where = f"between frames {_PANEL_FRAMES[0]} and {_PANEL_FRAMES[1]}"
    z = facts("fuselage_shell")["passenger_floor"]["panel_z"]
    panels = []
    for name, y, height in (("side skin", 1.97, _PANEL_Z), ("floor panel", 0.51, z)):
        middle = _nearest(structure, [0.5 * (a + b), y, height])
        p = structure.points.xyz[structure.points.rows(middle)]
        beside = tuple(_nearest(structure, [x, p[1], p[2]]) for x in (a, b))
        panels.append(Panel(name=f"{name} {where}", grid=middle, beside=beside))
    return tuple(panels)


def _frame(name: str) -> float:
    frames = table("fuselage_frames").set_index("frame")
    return float(frames.x[name])


def _nearest(structure: Structure, p: list[float]) -> int:
    points = structure.points
    return int(points.grid_id[np.argmin(np.linalg.norm(points.xyz - p, axis=1))])

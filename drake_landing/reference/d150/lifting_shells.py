"""Wings, tails and movables as shells, with their reference nodes tied to the ribs."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from drake_landing.reference.d150.beams import STARBOARD, UP, massless_aluminium
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.geometry import Float64, surface
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.reference_axis import (
    SIDES,
    NodeGroup,
    Reference,
    movable_shares,
)
from drake_landing.reference.d150.shell_elements import add_box_elements
from drake_landing.reference.d150.shell_mesh import BoxMesh, add_box
from drake_landing.reference.d150.sizing import (
    box_sizing,
    movable_sizing,
    smeared,
    with_root_fittings,
)
from drake_landing.reference.d150.stations import (
    movable_stations,
    tail_stations,
    wing_stations,
)
from drake_landing.reference.d150.ties import tie

Meshes = dict[str, BoxMesh]
_FIRST_ID = {
    **{"wing_right": 100001, "wing_left": 120001},
    **{"tailplane_right": 140001, "tailplane_left": 150001, "fin": 160001},
    **{"inner_flap_right": 200001, "inner_flap_left": 205001},
    **{"outer_flap_right": 210001, "outer_flap_left": 215001},
    **{"aileron_right": 220001, "aileron_left": 225001},
    **{"elevator_right": 230001, "elevator_left": 235001, "rudder": 240001},
}
_BRACKET_ID = 250000
FITTING = 0.05  # m behind the spar


def add_lifting_shells(
    model: ModelBuilder, reference: Reference, density: Mapping[str, Any]
) -> Meshes:
    """Writes all lifting surfaces and movables.

    Args:
        model: the bench, reference nodes written.
        reference: the reference nodes.
        density: mesh density by component, see `mesh.yaml`.

    Returns:
        The meshes by part.
    """
    meshes: Meshes = {}
    for name in ("wing", "tailplane", "fin"):
        size = density[name]["size"]
        stations = wing_stations(size) if name == "wing" else tail_stations(name, size)
        parts = ("fin",) if name == "fin" else (f"{name}_right", f"{name}_left")
        for part in parts:
            mesh = add_box(
                model,
                part,
                surface(name),
                stations,
                chordwise=density[name]["chordwise"],
                high=density[name]["high"],
                first_id=_FIRST_ID[part],
                mirror_of=meshes.get(f"{name}_right"),
            )
            meshes[part] = mesh
            sizing = box_sizing(name)
            if density["stringers"] == "smeared":
                sizing = smeared(sizing, caps=name != "wing")
            if name == "wing" and density["root_fittings"]:
                sizing = with_root_fittings(sizing)
            add_box_elements(model, mesh, sizing)
            _tie_ribs(model, reference[part], mesh)
    for side, _ in SIDES:
        _tie_end(model, reference[f"monitor_wing_tip_{side}"], meshes[f"wing_{side}"])
    _tie_end(model, reference["monitor_fin_tip"], meshes["fin"])
    for part in list(_FIRST_ID)[5:]:
        meshes[part] = _movable(model, reference, part, density, meshes)
    return meshes


def _tie_ribs(model: ModelBuilder, group: NodeGroup, mesh: BoxMesh) -> None:
    """The reference node of each rib moves with the mean of the rib's edge."""
    for node, station in zip(group.ids, mesh.ribs):
        tie(model, f"ties {group.name}", node, mesh.ring(int(station)))


def _tie_end(model: ModelBuilder, group: NodeGroup, mesh: BoxMesh) -> None:
    tie(model, f"ties {group.name}", group.ids[0], mesh.ring(len(mesh.ids) - 1))


def _movable(
    model: ModelBuilder,
    reference: Reference,
    part: str,
    density: Mapping[str, Any],
    meshes: Meshes,
) -> BoxMesh:
    name = part.removesuffix("_right").removesuffix("_left")
    data = facts("movables")[name]
    mesh = add_box(
        model,
        part,
        surface(data["parent"]),
        movable_stations(name, density[name]["size"]),
        chordwise=density[name]["chordwise"],
        high=density[name]["high"],
        first_id=_FIRST_ID[part],
        wedge=True,
        mirror_of=meshes.get(f"{name}_right"),
    )
    add_box_elements(model, mesh, movable_sizing(name))
    group = reference[part]
    for node, station in zip(group.ids, _distinct_stations(group, mesh)):
        tie(model, f"ties {part}", node, mesh.ring(station))
    parent = data["parent"] + part.removeprefix(name)
    for k in movable_shares(name)[1]:
        _bracket(model, part, group.ids[k], group.p[k], meshes[parent])
    return mesh


def _distinct_stations(group: NodeGroup, mesh: BoxMesh) -> list[int]:
    """The station nearest to each reference node; no two nodes share one."""
    axis = 2 if group.name == "rudder" else 1
    taken: list[int] = []
    for span in np.abs(group.p[:, axis]):
        order = np.argsort(np.abs(mesh.stations.span - span))
        taken.append(next(int(k) for k in order if int(k) not in taken))
    return taken


def _bracket(
    model: ModelBuilder, part: str, node: int, p: Float64, parent: BoxMesh
) -> None:
    """A track or hinge bracket: a bar from the parent's rear spar to a reference node.

    Its foot is a fitting behind the spar, tied to three stations of it; its mass is the
    parent's.
    """
    axis = 2 if part == "rudder" else 1
    along = np.abs(parent.stations.rear[:, 0] - abs(p[axis]))
    k = int(np.clip(np.argmin(along), 1, len(along) - 2))
    foot = _BRACKET_ID + node % 10000
    where = f"brackets {part}"
    middle = parent.p[k, -1, [0, -1]].mean(axis=0)
    model.grids(where, [foot], middle[None] + [FITTING, 0.0, 0.0])
    model.average(where, foot, parent.spar(-1, k - 1, k + 1))
    data = facts("movables")["bracket"]
    pid = model.bar_property(
        "bracket of a movable",
        *(
            massless_aluminium(model),
            data["area"],
            data["i_flap"],
            data["i_chord"],
            data["j"],
        ),
    )
    normal = STARBOARD if part == "rudder" else UP
    model.bar(where, pid, foot, node, np.array(normal))

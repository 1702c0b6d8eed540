"""DLR-D150-PRE: wings, tails and movables as shells, the fuselage as a beam.

The center wing box hangs on the fuselage beam by a rigid element. The reference nodes
are tied to the shells so that a reduction can keep them.
"""

from drake_landing.reference.d150 import joints
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.gear_attachment import attach_gears
from drake_landing.reference.d150.lifting_shells import Meshes, add_lifting_shells
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.reference_axis import SIDES, Reference, frame_id

TOPOLOGIES = ("1", "2")


def build_pre(model: ModelBuilder, reference: Reference, topology: str) -> None:
    """Writes the structure of the preliminary-design aircraft.

    Args:
        model: an empty bench.
        reference: the reference nodes.
        topology: main gears on the rear spar of the center wing box (`1`), or on the
            rear spars of the center wing box and the inner wing (`2`).
    """
    for group in reference.values():
        model.grids(group.name, group.ids, group.p)
    joints.add_fuselage(model, reference["fuselage"])
    meshes = add_lifting_shells(model, reference, facts("mesh")["pre"])
    joints.join_wing(model, reference)
    joints.join_tailplane(model, reference)
    joints.join_fin(model, reference)
    joints.add_engines(model, reference)
    joints.add_rigid_monitors(model, reference, ("nose_tip", "cg", "tail_tip"))
    holds = {"nose": [frame_id(facts("fuselage")["nose_gear_frame"])]}
    attach_gears(model, holds | rear_spar_holds(meshes, topology))


def rear_spar_holds(meshes: Meshes, topology: str) -> dict[str, list[int]]:
    """Grids of the rear spar that hold the main gears, by gear.

    The ribs' own grids carry the reference nodes and stay out: two means over the same
    grids would be solved for one another.
    """
    ribs = list(table("wing_ribs").rib)
    first, last = (
        ribs.index(rib) for rib in facts("shells")["main_gear"][f"topology_{topology}"]
    )
    holds = {}
    for side, _ in SIDES:
        mesh = meshes[f"wing_{side}"]
        between = range(int(mesh.ribs[first]), int(mesh.ribs[last]))
        holds[f"main_{side}"] = [
            grid
            for k in between
            if mesh.stations.rib[k] < 0
            for grid in mesh.spar(-1, k, k)
        ]
    return holds

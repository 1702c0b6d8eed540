"""DLR-D150-FULL: lifting surfaces and fuselage as shells.

The center wing box, fin and tailplane are joined to the fuselage's shells. Reference
nodes are tied to frames and ribs, so that a reduction can keep them.
"""

from drake_landing.reference.d150 import joints
from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.fuselage import add_fuselage_shell
from drake_landing.reference.d150.gear_attachment import attach_gears
from drake_landing.reference.d150.lifting_shells import add_lifting_shells
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.pre import rear_spar_holds
from drake_landing.reference.d150.reference_axis import Reference

TOPOLOGIES = ("distributed", "1", "2")


def build_full(model: ModelBuilder, reference: Reference, topology: str) -> None:
    """Writes the structure of the full aircraft.

    Args:
        model: an empty bench.
        reference: the reference nodes.
        topology: main gears `distributed` along the wing's rear spar, or on it as in
            PRE (`1`, `2`).
    """
    for group in reference.values():
        model.grids(group.name, group.ids, group.p)
    density = facts("mesh")["full"]
    wings = add_lifting_shells(model, reference, density)
    fuselage = add_fuselage_shell(model, reference, density["fuselage"], wings)
    joints.add_engines(model, reference)
    joints.add_rigid_monitors(model, reference, ("nose_tip", "cg", "tail_tip"))
    holds = {"nose": fuselage.nose_gear}
    attach_gears(model, holds | rear_spar_holds(wings, topology))

"""What all levels or the beam-fuselage levels share: fuselage beam, joints, engines.

All joints act on reference nodes, which exist at every level.
"""

from collections.abc import Sequence

import numpy as np

from drake_landing.reference.d150 import beams
from drake_landing.reference.d150.beams import BarSection, add_chain, add_section
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.geometry import Float64, fuselage_section
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.reference_axis import (
    MONITORS,
    SIDES,
    NodeGroup,
    Reference,
    frame_id,
)


def add_fuselage(model: ModelBuilder, group: NodeGroup) -> None:
    """The fuselage as a beam through the reference nodes of the frames."""
    x = beams.middles(group.p)[:, 0]
    add_chain(model, "fuselage", group.ids, fuselage_sections(x), beams.UP)


def fuselage_sections(x: Float64) -> list[BarSection]:
    """Sections of the fuselage beam at stations x."""
    data = facts("fuselage")
    rows = np.array(data["stiffness"])
    ei = beams.logarithmic(x, rows[:, 0], rows[:, 1]) / beams.youngs_modulus()
    gj = beams.logarithmic(x, rows[:, 0], rows[:, 2]) / beams.shear_modulus()
    half, bottom, top = fuselage_section(x).T
    radius = (half + (top - bottom) / 2) / 2
    return [
        BarSection(
            area=2 * i / r**2,  # thin tube: I = pi r³ t, A = 2 pi r t
            i1=i,
            i2=i,
            j=j,
            shear=data["shear_factor"],
            half=(r, r),
        )
        for i, j, r in zip(ei, gj, radius)
    ]


def join_wing(model: ModelBuilder, reference: Reference) -> None:
    """A rigid element from the fuselage to the side-of-body ribs.

    Pinned along the fuselage: the center box may bend between the two ribs, while the
    fuselage holds it in pitch.
    """
    joint = [rib_node(reference, f"wing_{side}", "R04") for side, _ in SIDES]
    node = frame_id(facts("fuselage")["wing_node_frame"])
    model.rigid("wing joint", node, "1235", joint)


def join_tailplane(model: ModelBuilder, reference: Reference) -> None:
    """Two pivots hold translations; the screw jack's yoke holds the pitch."""
    data = facts("tails")["tailplane"]
    right, left = reference["tailplane_right"], reference["tailplane_left"]
    hinge = int(np.argmin(np.abs(np.array(data["ribs"])[:, 0] - data["hinge"][0])))
    frames = facts("fuselage")
    part = "tailplane joint"
    pivot = frame_id(frames["tailplane_hinge_frame"])
    model.rigid(part, pivot, "123", [right.id_of(hinge), left.id_of(hinge)])
    yoke = data["trim_yoke_stiffness"]
    section = BarSection(
        area=yoke["area"],
        i1=yoke["ei"] / beams.youngs_modulus(),
        i2=yoke["ei"] / beams.youngs_modulus(),
        j=yoke["gj"] / beams.shear_modulus(),
    )
    pid = add_section(
        model, part, "trim yoke", section, beams.massless_aluminium(model)
    )
    jack = frame_id(frames["tailplane_jack_frame"])
    for group in (right, left):
        model.element(part, "CBAR", pid, jack, group.id_of(0), *beams.UP)


def join_fin(model: ModelBuilder, reference: Reference) -> None:
    """The fin's root rib on the fuselage frame below it, rigidly."""
    frame = frame_id(facts("fuselage")["fin_frame"])
    model.rigid("fin joint", frame, "123456", [reference["fin"].id_of(0)])


def add_engines(model: ModelBuilder, reference: Reference) -> None:
    """The pylon: rigid down to the engine's center, all its flexibility there."""
    data = facts("engines")
    for side, _ in SIDES:
        part, engine = f"pylon_{side}", reference[f"engine_{side}"].id_of(0)
        pid = model.next_id(part, "property")
        model.section(part).comment(f"property {pid}: {part}")
        model.section(part).add("PBUSH", pid, "K", *data["pylon_stiffness"])
        rib = rib_node(reference, f"wing_{side}", data["rib"])
        # blank orientation, CID 0, S = 1: the spring sits at the engine's center
        model.element(part, "CBUSH", pid, rib, engine, None, None, None, 0, 1.0)


def add_rigid_monitors(
    model: ModelBuilder, reference: Reference, names: Sequence[str]
) -> None:
    """Monitoring points that follow the end of their structure rigidly."""
    frames = reference["fuselage"]
    owner = {
        "nose_tip": frames.ids[0],
        "cg": frames.nearest(reference["monitor_cg"].p[0] * (1, 0, 0)),
        "tail_tip": frames.ids[-1],
        "fin_tip": reference["fin"].ids[-1],
    }
    for name in names:
        model.rigid("monitoring points", owner[name], "123456", [MONITORS[name]])


def rib_node(reference: Reference, wing: str, rib: str) -> int:
    """Reference node of a rib (R01-R30) of `wing_right` or `wing_left`."""
    return reference[wing].id_of(list(table("wing_ribs").rib).index(rib))

"""DLR-D150-CON, the conceptual aircraft: 614 grids, beams, mass items.

261 reference nodes carry bars and masses; 198 grids outline the leading and trailing
edges and 155 the fuselage: they follow rigidly, for pictures.
"""

from itertools import pairwise

import numpy as np

from drake_landing.aircraft import beams
from drake_landing.aircraft.beams import BarSection, add_chain, add_section
from drake_landing.aircraft.facts import facts, table
from drake_landing.aircraft.gear_attachment import attach_gears
from drake_landing.aircraft.geometry import (
    Float64,
    fuselage_section,
    surface,
)
from drake_landing.aircraft.mass_items import movable_of
from drake_landing.aircraft.model import ModelBuilder
from drake_landing.aircraft.outline import add_edges, add_fuselage_outline
from drake_landing.aircraft.reference_axis import (
    MONITORS,
    SIDES,
    NodeGroup,
    Reference,
    frame_id,
    movable_shares,
)

TOPOLOGIES = ("1", "2")


def build_con(model: ModelBuilder, reference: Reference, topology: str) -> None:
    """Writes the conceptual aircraft.

    Args:
        model: an empty bench.
        reference: the reference nodes.
        topology: `1` gears on the side-of-body ribs of the centre wing box, `2` on the
            inner wing's gear ribs.
    """
    for group in reference.values():
        model.grids(group.name, group.ids, group.p)
    _fuselage(model, reference["fuselage"])
    _wing(model, reference)
    _tailplane(model, reference)
    _fin(model, reference)
    _movables(model, reference)
    _engines(model, reference)
    _rigid_monitors(model, reference)
    rib = {"1": "R04", "2": facts("gears")["main_rib"]}[topology]
    attach_gears(
        model,
        {
            "nose": [frame_id(facts("fuselage")["nose_gear_frame"])],
            "main_left": [_rib_node(reference, "wing_left", rib)],
            "main_right": [_rib_node(reference, "wing_right", rib)],
        },
    )
    add_edges(model, reference)
    add_fuselage_outline(model, reference["fuselage"])


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


def wing_sections(y: Float64) -> list[BarSection]:
    """Sections of the wing box at span coordinates |y|."""
    rows = table("wing_stiffness")

    def value(column: str) -> Float64:
        return beams.logarithmic(y, rows.y.to_numpy(), rows[column].to_numpy())

    factor = facts("wing")["stiffness_factor"]
    vertical = factor * value("ei_vertical") / beams.youngs_modulus()
    in_plane = factor * value("ei_in_plane") / beams.youngs_modulus()
    torsion = factor * value("gj") / beams.shear_modulus()
    height, width = value("box_height"), value("box_width")
    return [
        BarSection(
            area=4 * i1 / h**2 + 2 * h * t,  # two covers and two webs
            i1=i1,
            i2=i2,
            j=j,
            shear=facts("wing")["shear_factor"],
            half=(h / 2, w / 2),
        )
        for i1, i2, j, h, w, t in zip(
            vertical, in_plane, torsion, height, width, value("spar_thickness")
        )
    ]


def tail_sections(name: str, eta: Float64) -> list[BarSection]:
    """Sections of the tailplane's or the fin's box at shares of the span."""
    rows = np.array(facts("tails")[name]["stiffness"])
    vertical, in_plane, gj, area = (
        beams.logarithmic(eta, rows[:, 0], rows[:, k]) for k in (1, 2, 3, 4)
    )
    half = surface(name)
    station = half.station(eta)
    height = 0.09 * half.chord_at(station)
    width = 0.34 * half.chord_at(station)
    e, g = beams.youngs_modulus(), beams.shear_modulus()
    return [
        BarSection(area=a, i1=v / e, i2=i / e, j=t / g, half=(h / 2, w / 2))
        for a, v, i, t, h, w in zip(area, vertical, in_plane, gj, height, width)
    ]


def _fuselage(model: ModelBuilder, group: NodeGroup) -> None:
    x = beams.middles(group.p)[:, 0]
    add_chain(model, "fuselage", group.ids, fuselage_sections(x), beams.UP)


def _wing(model: ModelBuilder, reference: Reference) -> None:
    """Tip to centre to tip in one chain; the fuselage holds its side-of-body ribs."""
    right, left = reference["wing_right"], reference["wing_left"]
    centre = wing_sections(np.zeros(1))
    add_chain(model, "wing centre", [left.id_of(0), right.id_of(0)], centre, beams.UP)
    for side, _ in SIDES:
        group, tip = reference[f"wing_{side}"], reference[f"monitor_wing_tip_{side}"]
        p = np.concatenate([group.p, tip.p])
        sections = wing_sections(np.abs(beams.middles(p)[:, 1]))
        add_chain(model, group.name, [*group.ids, *tip.ids], sections, beams.UP)
    # Pinned along the fuselage: the centre box may bend between the two ribs, while
    # the frames between the main frames hold it in pitch.
    joint = [_rib_node(reference, f"wing_{side}", "R04") for side, _ in SIDES]
    node = frame_id(facts("fuselage")["wing_node_frame"])
    model.rigid("wing joint", node, "1235", joint)


def _tailplane(model: ModelBuilder, reference: Reference) -> None:
    data = facts("tails")["tailplane"]
    half = surface("tailplane")
    right, left = reference["tailplane_right"], reference["tailplane_left"]
    centre = tail_sections("tailplane", np.zeros(1))
    add_chain(
        model, "tailplane centre", [left.id_of(0), right.id_of(0)], centre, beams.UP
    )
    for group in (right, left):
        y = np.abs(beams.middles(group.p)[:, 1])
        add_chain(
            model,
            group.name,
            group.ids,
            tail_sections("tailplane", y / half.span),
            beams.UP,
        )
    hinge = int(np.argmin(np.abs(np.array(data["ribs"])[:, 0] - data["hinge"][0])))
    frames = facts("fuselage")
    model.rigid(
        "tailplane joint",
        frame_id(frames["tailplane_hinge_frame"]),
        "123",
        [right.id_of(hinge), left.id_of(hinge)],
    )
    yoke = data["trim_yoke_stiffness"]
    section = BarSection(
        area=yoke["area"],
        i1=yoke["ei"] / beams.youngs_modulus(),
        i2=yoke["ei"] / beams.youngs_modulus(),
        j=yoke["gj"] / beams.shear_modulus(),
    )
    jack = frame_id(frames["tailplane_jack_frame"])
    part = "tailplane joint"
    pid = add_section(
        model, part, "trim yoke", section, beams.massless_aluminium(model)
    )
    for group in (right, left):
        model.element(part, "CBAR", pid, jack, group.id_of(0), *beams.UP)


def _fin(model: ModelBuilder, reference: Reference) -> None:
    group, fin = reference["fin"], surface("fin")
    eta = (beams.middles(group.p)[:, 2] - fin.root) / fin.span
    add_chain(model, "fin", group.ids, tail_sections("fin", eta), beams.STARBOARD)
    root = frame_id(facts("fuselage")["fin_frame"])
    model.rigid("fin joint", root, "123456", [group.id_of(0)])


def _movables(model: ModelBuilder, reference: Reference) -> None:
    """A bar along each movable, on brackets from the parent's nearest nodes."""
    data = facts("movables")
    material = beams.massless_aluminium(model)
    for group in list(reference.values()):
        name = movable_of(group.name)
        if name not in data:
            continue
        parent = reference[data[name]["parent"] + group.name.removeprefix(name)]
        normal = beams.STARBOARD if name == "rudder" else beams.UP
        pids = [
            add_section(model, group.name, f"{group.name} {what}", section, material)
            for what, section in (
                ("box", _movable_bar(data["section"])),
                ("bracket", _movable_bar(data["bracket"])),
            )
        ]
        for a, b in pairwise(group.ids):
            model.element(group.name, "CBAR", pids[0], a, b, *normal)
        for k in movable_shares(name)[1]:
            root = parent.nearest(group.p[k])
            model.element(group.name, "CBAR", pids[1], root, group.id_of(k), *normal)


def _movable_bar(data: dict[str, float]) -> BarSection:
    return BarSection(
        area=data["area"], i1=data["i_flap"], i2=data["i_chord"], j=data["j"]
    )


def _engines(model: ModelBuilder, reference: Reference) -> None:
    """The pylon: rigid down to the engine's centre, all its flexibility there."""
    data = facts("engines")
    for side, _ in SIDES:
        part, engine = f"pylon_{side}", reference[f"engine_{side}"].id_of(0)
        pid = model.next_id(part, "property")
        model.section(part).comment(f"property {pid}: {part}")
        model.section(part).add("PBUSH", pid, "K", *data["pylon_stiffness"])
        rib = _rib_node(reference, f"wing_{side}", data["rib"])
        # blank orientation, CID 0, S = 1: the spring sits at the engine's centre
        model.element(part, "CBUSH", pid, rib, engine, None, None, None, 0, 1.0)


def _rigid_monitors(model: ModelBuilder, reference: Reference) -> None:
    """Points that follow the end of their structure; the wing tips are bar nodes."""
    frames = reference["fuselage"]
    owner = {
        "nose_tip": frames.ids[0],
        "cg": frames.nearest(reference["monitor_cg"].p[0] * (1, 0, 0)),
        "tail_tip": frames.ids[-1],
        "fin_tip": reference["fin"].ids[-1],
    }
    for name, node in owner.items():
        model.rigid("monitoring points", node, "123456", [MONITORS[name]])


def _rib_node(reference: Reference, wing: str, rib: str) -> int:
    return reference[wing].id_of(list(table("wing_ribs").rib).index(rib))

"""DLR-D150-CON, the conceptual aircraft: 614 grids, beams, mass items.

261 reference nodes carry bars and masses; 198 grids outline the leading and trailing
edges and 155 the fuselage: they follow rigidly, for pictures.
"""

from itertools import pairwise

import numpy as np

from drake_landing.reference.d150 import beams, joints
from drake_landing.reference.d150.beams import BarSection, add_chain, add_section
from drake_landing.reference.d150.facts import facts, table
from drake_landing.reference.d150.gear_attachment import attach_gears
from drake_landing.reference.d150.geometry import (
    Float64,
    surface,
)
from drake_landing.reference.d150.mass_items import movable_of
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.outline import add_edges, add_fuselage_outline
from drake_landing.reference.d150.reference_axis import (
    SIDES,
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
        topology: `1` gears on the side-of-body ribs of the center wing box, `2` on the
            inner wing's gear ribs.
    """
    for group in reference.values():
        model.grids(group.name, group.ids, group.p)
    joints.add_fuselage(model, reference["fuselage"])
    _wing(model, reference)
    joints.join_wing(model, reference)
    _tailplane(model, reference)
    joints.join_tailplane(model, reference)
    _fin_beam(model, reference)
    joints.join_fin(model, reference)
    _movables(model, reference)
    joints.add_engines(model, reference)
    # The wing tips are nodes of the wing's bars.
    rigid = ("nose_tip", "cg", "tail_tip", "fin_tip")
    joints.add_rigid_monitors(model, reference, rigid)
    rib = {"1": "R04", "2": facts("gears")["main_rib"]}[topology]
    attach_gears(
        model,
        {
            "nose": [frame_id(facts("fuselage")["nose_gear_frame"])],
            "main_left": [joints.rib_node(reference, "wing_left", rib)],
            "main_right": [joints.rib_node(reference, "wing_right", rib)],
        },
    )
    add_edges(model, reference)
    add_fuselage_outline(model, reference["fuselage"])


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


def _wing(model: ModelBuilder, reference: Reference) -> None:
    """Tip to center to tip in one chain; the fuselage holds two ribs."""
    right, left = reference["wing_right"], reference["wing_left"]
    center = wing_sections(np.zeros(1))
    add_chain(model, "wing center", [left.id_of(0), right.id_of(0)], center, beams.UP)
    for side, _ in SIDES:
        group, tip = reference[f"wing_{side}"], reference[f"monitor_wing_tip_{side}"]
        p = np.concatenate([group.p, tip.p])
        sections = wing_sections(np.abs(beams.middles(p)[:, 1]))
        add_chain(model, group.name, [*group.ids, *tip.ids], sections, beams.UP)


def _tailplane(model: ModelBuilder, reference: Reference) -> None:
    half = surface("tailplane")
    right, left = reference["tailplane_right"], reference["tailplane_left"]
    center = tail_sections("tailplane", np.zeros(1))
    add_chain(
        model, "tailplane center", [left.id_of(0), right.id_of(0)], center, beams.UP
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


def _fin_beam(model: ModelBuilder, reference: Reference) -> None:
    group, fin = reference["fin"], surface("fin")
    eta = (beams.middles(group.p)[:, 2] - fin.root) / fin.span
    add_chain(model, "fin", group.ids, tail_sections("fin", eta), beams.STARBOARD)


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

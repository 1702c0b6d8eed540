"""Outline grids for pictures: leading and trailing edges, fuselage. Rigid, massless."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from drake_landing.reference.d150.geometry import MIRROR, fuselage_point, surface
from drake_landing.reference.d150.model import ModelBuilder
from drake_landing.reference.d150.reference_axis import NodeGroup, Reference

EDGE_BASE = {
    "wing_right": 21000,
    "wing_left": 22000,
    "tailplane_right": 23000,
    "tailplane_left": 24000,
    "fin": 25000,
}
RING_BASE = 26000
RINGS = 38  # of four points each, and three more crown points at the windscreen


def add_edges(model: ModelBuilder, reference: Reference) -> None:
    """A grid on the leading and one on the trailing edge of every rib."""
    for name, base in EDGE_BASE.items():
        group = reference[name]
        shape = surface(name.removesuffix("_right").removesuffix("_left"))
        station = np.abs(group.p[:, shape.span_axis])
        side = MIRROR if name.endswith("left") else np.ones(3)
        part = f"outline {name}"
        count = len(group.ids)
        edges = []
        for k, fraction in enumerate((0.0, 1.0)):
            ids = [base + 100 * (k + 1) + i for i in range(1, count + 1)]
            model.grids(part, ids, shape.point(station, fraction) * side)
            edges.append(ids)
        for node, *points in zip(group.ids, *edges):
            model.rigid(part, node, "123456", points)
        for ids in edges:
            _line(model, part, ids)
        for end in (0, -1):
            _line(model, part, [edges[0][end], edges[1][end]])


def add_fuselage_outline(model: ModelBuilder, frames: NodeGroup) -> None:
    """Rings of crown, starboard, keel and port points round 38 of the frames."""
    part = "outline fuselage"
    chosen = np.unique(np.linspace(0, len(frames.ids) - 1, RINGS).round().astype(int))
    angles = np.deg2rad([0.0, 90.0, 180.0, 270.0])
    lines: list[list[int]] = []
    for ring, k in enumerate(chosen):
        ids = [RING_BASE + 10 * (ring + 1) + j for j in range(4)]
        model.grids(part, ids, fuselage_point(frames.p[k, 0], angles))
        model.rigid(part, frames.ids[k], "123456", ids)
        lines.append(ids)
    for line in zip(*lines):
        _line(model, part, line)
    for ring in lines:
        _line(model, part, [*ring, ring[0]])
    rest = [k for k in range(len(frames.ids)) if k not in chosen][:3]
    crown = [RING_BASE + 501 + j for j in range(3)]
    model.grids(part, crown, fuselage_point(frames.p[rest, 0], 0.0))
    for k, i in zip(rest, crown):
        model.rigid(part, frames.ids[k], "123456", [i])


def _line(model: ModelBuilder, part: str, ids: Sequence[int]) -> None:
    section = model.section(part)
    for a, b in pairwise(ids):
        section.add("PLOTEL", model.next_id(part), a, b)

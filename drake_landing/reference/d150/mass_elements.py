"""Lumped masses as CONM2: mass, offset and inertia about the mass center."""

from drake_landing.reference.d150.masses import Lumps
from drake_landing.reference.d150.model import ModelBuilder


def add_masses(model: ModelBuilder, lumps: Lumps) -> None:
    """One CONM2 per component and node."""
    for component, nodes in lumps.items():
        part = f"masses {component}"
        for node, lump in sorted(nodes.items()):
            offset, j = lump.about_center()
            # Nastran's products of inertia are the negative off-diagonal terms.
            inertia = (j[0, 0], -j[1, 0], j[1, 1], -j[2, 0], -j[2, 1], j[2, 2])
            model.element(
                part,
                *("CONM2", node, 0, float(lump.mass)),
                *(_tidy(x, 1e-9) for x in offset),
                None,
                *(_tidy(x, 1e-9 * float(lump.mass)) for x in inertia),
            )


def _tidy(x: float, negligible: float) -> float:
    """Round-off of a symmetric sum is no offset."""
    return 0.0 if abs(x) < negligible else float(x)

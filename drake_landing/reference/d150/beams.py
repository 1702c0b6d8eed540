"""Chains of bars: fuselage, wings, tails, movables of the conceptual aircraft."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from drake_landing.reference.d150.facts import facts
from drake_landing.reference.d150.geometry import Float64
from drake_landing.reference.d150.model import ModelBuilder

UP = (0.0, 0.0, 1.0)
STARBOARD = (0.0, 1.0, 0.0)


@dataclass(frozen=True, kw_only=True)
class BarSection:
    """Cross section of a bar.

    Attributes:
        area: m².
        i1: second moment for bending in plane 1 (that of the orientation vector), m⁴.
        i2: for bending in plane 2, m⁴.
        j: torsion constant, m⁴.
        shear: effective over full area in both planes; 0 is rigid in shear.
        half: half sizes along the orientation vector and across, m, where stresses
            are recovered.
    """

    area: float
    i1: float
    i2: float
    j: float
    shear: float = 0.0
    half: tuple[float, float] = (0.0, 0.0)


def add_materials(model: ModelBuilder) -> None:
    """MAT1 of every material of the data."""
    section = model.section("Materials")
    for name, m in facts("materials").items():
        section.comment(name)
        section.add(
            *("MAT1", m["id"], m["e"], None, m["nu"], m["rho"], None, None, None),
            *(m["tension"], m["tension"], m["shear"]),
        )


def massless_aluminium(model: ModelBuilder) -> int:
    """Material of bars whose mass is given by mass items."""
    section = model.section("Materials")
    if "massless" not in model.parts:
        model.parts["massless"] = []
        m = facts("materials")["al2024"]
        section.comment("al2024 of the beam models: mass is in the mass items")
        section.add("MAT1", 11, m["e"], None, m["nu"], 0.0)
    return 11


def shear_modulus() -> float:
    """Shear modulus of the beam models' aluminium, Pa."""
    m = facts("materials")["al2024"]
    return m["e"] / (2 * (1 + m["nu"]))


def youngs_modulus() -> float:
    """Young's modulus of the beam models' aluminium, Pa."""
    return facts("materials")["al2024"]["e"]


def add_section(
    model: ModelBuilder, part: str, name: str, section: BarSection, material: int
) -> int:
    """PBAR with a comment naming it; returns its id."""
    pid = model.next_id(part, "property")
    text = model.section(part)
    text.comment(f"property {pid}: {name}")
    c, d = (_five_digits(x) for x in section.half)
    shear = section.shear or None
    stress = (c, d, c, -d, -c, d, -c, -d) if c else (None,) * 8
    text.add(
        *("PBAR", pid, material),
        *map(_five_digits, (section.area, section.i1, section.i2, section.j)),
        *(None, None, *stress, shear, shear),
    )
    return pid


def _five_digits(x: float) -> float:
    """Section values as an engineer writes them; they fit small fields."""
    return float(f"{x:.5g}")


def add_chain(
    model: ModelBuilder,
    part: str,
    nodes: Sequence[int],
    sections: Sequence[BarSection],
    orientation: tuple[float, float, float],
) -> None:
    """Bars between successive nodes, each with its own section."""
    material = massless_aluminium(model)
    for a, b, section in zip(nodes, nodes[1:], sections):
        pid = add_section(model, part, f"{part} {a}-{b}", section, material)
        model.element(part, "CBAR", pid, a, b, *orientation)


def middles(p: Float64) -> Float64:
    """Midpoints of a chain of points, (n - 1, 3)."""
    return (p[1:] + p[:-1]) / 2


def logarithmic(x: Float64, knots: Float64, values: Float64) -> Float64:
    """(n,) at x (n,): linear in the logarithm, as stiffness falls outward."""
    return np.exp(np.interp(x, knots, np.log(values)))

"""Axes, signs and masses of a report."""

from typing import TYPE_CHECKING

import numpy as np

from drake_landing.case.axes import deck_axes, moment_words
from drake_landing.report.axes_figure import axes_sketch
from drake_landing.report.page import Block, Section, pairs_block
from drake_landing.results.whole_mass import whole_mass

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult


def axes_section(result: "ProcessResult") -> Section:
    """The deck's axes drawn, what all numbers refer to, masses and inertia."""
    R_AB, structure = result.airframe.R_AB, result.airframe.structure
    gears = [n for gear in result.aircraft.gears for n in gear.attachments.values()]
    sketch = axes_sketch(structure, R_AB, gears, list(result.parts.cuts.values()))
    return Section(
        id="axes",
        title="Axes, units, signs, mass",
        text="All in this report and in the files is along the axes x, y, z of the "
        f"deck's basic frame ({deck_axes(R_AB)}), which is fixed to the airframe and "
        "pitches, rolls and yaws with it, and in SI units (m, kg, s, N, Pa; kN and MPa "
        "where a heading says so), whatever the units of the deck. Aft, starboard and "
        "up are directions of the airframe, too; those of the runway are named. "
        "Moments are right-handed about their axes; positive ones that act on "
        f"the airframe turn: {moment_words(R_AB)}. Loads, "
        "accelerations and stresses are increments to the steady flight before "
        "touchdown where nothing else is said; all are limit loads, without a factor. "
        "Accelerations are those of the motion: an accelerometer shows 1 g upward "
        "more. Time counts from the start of the run.",
        blocks=[
            Block(svg=sketch, caption="The arrows start at the deck's origin."),
            pairs_block(_mass_pairs(result), "Mass, gears extended"),
        ],
    )


def _mass_pairs(result: "ProcessResult") -> list[tuple[str, str]]:
    """Mass properties of the airframe and of the aircraft with its gears, as texts."""
    body, R_AB = result.airframe.body, result.airframe.R_AB
    whole = whole_mass(result.airframe, result.aircraft.gears)
    own, chord = R_AB.T @ body.p_BG, result.case.airframe.mac

    def share(cg: np.ndarray) -> str:
        return "" if chord is None else f", {chord.percent(cg, R_AB):.2f} % MAC"

    pairs = [
        ("airframe without gears", _mass(body.mass, own) + share(own)),
        ("its inertia", _inertia(R_AB.T @ body.inertia_G @ R_AB)),
        ("aircraft with gears", _mass(whole.mass, whole.cg) + share(whole.cg)),
        ("its inertia with gears", _inertia(whole.inertia)),
    ]
    gears = [
        f"{g.name.replace('_', ' ')} {g.mass:,.1f} kg" for g in result.aircraft.gears
    ]
    return [*pairs, ("gears", ", ".join(gears))]


def _inertia(inertia: np.ndarray) -> str:
    return (
        "about that center of gravity, axes of the deck, kg m²: "
        + ", ".join(f"I{a}{a} {inertia[i, i]:,.0f}" for i, a in enumerate("xyz"))
        + "; products (minus the integrals) "
        + ", ".join(
            f"I{'xyz'[i]}{'xyz'[j]} {inertia[i, j]:z,.0f}"
            for i, j in ((0, 1), (0, 2), (1, 2))
        )
    )


def _mass(mass: float, cg: np.ndarray) -> str:
    x, y, z = cg
    return (
        f"{mass:,.1f} kg, center of gravity at x {x:z.3f}, y {y:z.3f}, z {z:z.3f} m "
        "from the origin of the deck"
    )

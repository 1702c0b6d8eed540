"""The part of the report on section loads and monitor points."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from drake_landing.parts import tables
from drake_landing.parts.observers import PartsFound
from drake_landing.report import parts_figures as figures
from drake_landing.report.page import Block, Section, table_block

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

# Beams whose loads differ less are mirror images and are shown once.
_ALIKE = 0.01
_MINUS = "\N{MINUS SIGN}"  # no line is broken after it
_NOUGHT = 1e-6  # of the largest of all parts: rounding


def section_loads(result: "ProcessResult") -> Section:
    """Shear, bending and torsion (N, N m) along each part and over time at one cut."""
    found = result.parts
    blocks, left_out = [], []
    shown: list[tuple[str, np.ndarray]] = []
    size = {n: _size(c.named(found.landing.sections[n])) for n, c in found.cuts.items()}
    nought = _NOUGHT * max(size.values(), default=0.0)
    for name, cuts in found.cuts.items():
        loads = found.landing.sections[name]
        named = np.abs(cuts.named(loads))
        if size[name] <= nought:
            left_out.append(
                f"{name} (its shear, bending and torsion are nought by symmetry)"
            )
            continue
        twin = next((n for n, other in shown if _alike(named, other)), None)
        if twin is not None:
            left_out.append(f"{name} (the mirror image of {twin})")
            continue
        shown.append((name, named))
        bending = cuts.named(loads)[:, found.looked_at[name], 1]
        worst = int(np.argmax(np.abs(bending)))
        blocks += [
            Block(svg=figures.section_envelopes(cuts, found.time, loads, worst)),
            Block(svg=figures.root_histories(cuts, found, result.practices)),
        ]
    if shown:
        blocks.append(_section_table(result, [name for name, _ in shown]))
    also = f" Left out: {'; '.join(left_out)}." if left_out else ""
    return Section(
        id="sections",
        title="Section loads",
        text="Load case: the landing, as increments to steady flight. Elements that "
        "cross a plane are cut; a section load is the resultant of the gears' loads "
        "and of the inertia of all that lies on the outer side. Shear is upward, "
        "bending lifts the outer end, torsion turns about the outward direction (of "
        "vertical parts shear and bending are to starboard); their axes in the deck "
        "stand in the table. Moments refer to a point of each cut, in the table: "
        f"{_points_said(found)}. Shaded: extremes over time; dashed: when bending at "
        "the cut below is largest. The equilibrium of the whole airframe is missed by "
        f"{found.imbalance[0]:.0e} of the largest applied force and "
        f"{found.imbalance[1]:.0e} of the moment.{also} All six components, "
        "fore-and-aft shear and bending among them: results.h5, group parts/sections; "
        "extremes: section_loads.csv.",
        blocks=blocks,
    )


def monitor_points(result: "ProcessResult") -> Section:
    """Extremes (N, N m) at the monitor points of the deck, in their own frames."""
    table = tables.monitor_extremes(result.parts)
    table[["min", "max"]] /= 1e3
    heads = {
        "name": "monitor point",
        "label": "label",
        "card": "card",
        "frame": "axes of frame",
        "point_x": "about x m",
        "point_y": "y m",
        "point_z": "z m",
        "quantity": "quantity",
        "min": "least kN, kN m",
        "time_of_min": "at s",
        "max": "largest kN, kN m",
        "time_of_max": "at s ",
    }
    formats = {"min": ".2f", "max": ".2f"}
    formats |= dict.fromkeys(("point_x", "point_y", "point_z"), ".2f")
    formats |= dict.fromkeys(("time_of_min", "time_of_max"), ".3f")
    return Section(
        id="monitors",
        title="Monitor points of the deck",
        text="As increments to steady flight. MONPNT1: the gears' loads and the "
        "inertia of the grids of its component. MONPNT3: the elastic forces of the "
        "elements at its grids. F1 to M3 along the axes of the frame CD, moments about "
        "the point, which stands in the deck's basic frame. Over time: "
        "monitor_histories.csv, results.h5, group parts/monitor_points.",
        blocks=[table_block(table, heads, formats, "Extremes")],
    )


def _size(named: np.ndarray) -> float:
    return float(np.abs(named).max(initial=0.0))


def _points_said(found: PartsFound) -> str:
    lines = [name for name, cuts in found.cuts.items() if cuts.beam.line is not None]
    if len(lines) == len(found.cuts):
        return "where the part's reference line meets the cut"
    centre = "the EA-weighted centre of the elements that are cut"
    if not lines:
        return centre
    return f"{centre}; of {', '.join(lines)} where its reference line meets the cut"


def _alike(a: np.ndarray, b: np.ndarray) -> bool:
    return a.shape == b.shape and bool(np.abs(a - b).max() <= _ALIKE * np.abs(b).max())


def _section_table(result: "ProcessResult", names: Sequence[str]) -> Block:
    """Extremes at the cuts that are looked at over time."""
    table = tables.section_envelopes(result.parts)
    at = result.parts.looked_at
    first = [float(result.parts.cuts[n].beam.stations[at[n]]) for n in names]
    keep = [
        (row.beam, row.station) in set(zip(names, first)) for row in table.itertuples()
    ]
    table = table[keep].copy()
    kilo = ["min", "max"]
    table[kilo] = table[kilo] / 1e3
    table["cut"] = [f"{row.axis} = {row.station:z.2f} m" for row in table.itertuples()]
    table["acts"] = [
        f"{row.quantity} {'along' if row.quantity == 'shear' else 'about'} "
        f"{row.direction.replace('-', _MINUS)}"
        for row in table.itertuples()
    ]
    heads = {
        "beam": "part",
        "cut": "cut at",
        "point_x": "point x m",
        "point_y": "y m",
        "point_z": "z m",
        "acts": "quantity",
        "min": "least kN or kN m",
        "time_of_min": "at s",
        "max": "largest kN or kN m",
        "time_of_max": "at s ",
    }
    formats = {"min": ".1f", "max": ".1f"}
    formats |= dict.fromkeys(("point_x", "point_y", "point_z"), ".2f")
    formats |= dict.fromkeys(("time_of_min", "time_of_max"), ".3f")
    return table_block(table, heads, formats, "Extremes at these cuts")

"""The part of the report on section loads and monitor points."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from drake_landing.parts import tables
from drake_landing.parts.cuts import NAMED
from drake_landing.parts.observers import PartsFound
from drake_landing.places import axis_name
from drake_landing.report import parts_figures as figures
from drake_landing.report.page import Block, Section, table_block
from drake_landing.results.verdict import mirrored

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

_MINUS = "\N{MINUS SIGN}"  # no line is broken after it
_SHARE = 0.1  # of shear or bending: smaller loads sideways are not drawn
_NOUGHT = 1e-6  # of the largest of all parts: rounding


def section_loads(result: "ProcessResult") -> Section:
    """Shear, bending and torsion (N, N m) along each part and over time at one cut.

    Those aft, of fuselages to starboard, where they are not small beside them.
    """
    found = result.parts
    blocks, left_out = [], []
    shown: list[tuple[str, np.ndarray]] = []
    drawn = {name: _drawn(found, name) for name in found.cuts}
    for name, cuts in found.cuts.items():
        loads = found.landing.sections[name]
        named = np.concatenate([d.of(loads) for d in drawn[name]], axis=-1)
        twin = next((n for n, other in shown if mirrored(named, other)), None)
        if twin is not None:
            left_out.append(f"{name} (the mirror image of {twin})")
            continue
        shown.append((name, named))
        for diagrams in drawn[name]:
            bending = diagrams.of(loads)[:, found.looked_at[name], 1]
            worst = int(np.argmax(np.abs(bending)))
            blocks += [
                Block(
                    svg=figures.section_envelopes(
                        cuts, found.time, loads, worst, diagrams
                    )
                ),
                Block(
                    svg=figures.root_histories(cuts, found, result.practices, diagrams)
                ),
            ]
    if shown:
        blocks.append(_section_table(found, [name for name, _ in shown], drawn))
    also = f" Left out: {'; '.join(left_out)}." if left_out else ""
    return Section(
        id="sections",
        title="Section loads",
        text="Load case: the landing, as increments to steady flight. Elements that "
        "cross a plane are cut; a section load is the resultant of the gears' loads "
        "and of the inertia of all that lies on the outer side. Shear is upward, "
        "bending lifts the outer end, torsion turns about the outward direction (of "
        "vertical parts shear and bending are to starboard). Fore-and-aft shear is "
        "aft and its bending turns the outer end aft, side shear and bending of "
        "fuselages are to starboard; they are drawn where they reach "
        f"{_SHARE:.0%} of the others. The axes in the deck stand in the table. "
        "Moments refer to a point of each cut, in the table: "
        f"{_points_text(found)}. Shaded: extremes over time; dashed: at the instant "
        "when bending is largest at the cut whose histories follow. The equilibrium of "
        "the whole airframe is missed by "
        f"{found.imbalance[0]:.0e} of the largest applied force and "
        f"{found.imbalance[1]:.0e} of the moment.{also} All six components at all "
        "cuts: results.h5, group parts/sections; extremes: section_loads.csv.",
        blocks=blocks,
    )


def _drawn(found: PartsFound, name: str) -> list[figures.Diagrams]:
    """The diagrams of a part that are worth a picture."""
    cuts, loads = found.cuts[name], found.landing.sections[name]
    main, side = figures.Diagrams.main(cuts), figures.Diagrams.sideways(cuts)
    nought = _NOUGHT * max(
        (float(np.abs(f).max(initial=0.0)) for f in found.landing.sections.values()),
        default=0.0,
    )
    size, beside = (np.abs(d.of(loads)).max(axis=(0, 1)) for d in (main, side))
    kept = [main] if size.max() > nought else []
    if beside.max() > nought and (beside > _SHARE * size[:2]).any():
        kept.append(side)
    return kept or [main]


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


def _points_text(found: PartsFound) -> str:
    lines = [name for name, cuts in found.cuts.items() if cuts.beam.line is not None]
    if len(lines) == len(found.cuts):
        return "where the part's reference line meets the cut"
    center = "the EA-weighted center of the elements that are cut"
    if not lines:
        return center
    return f"{center}; of {', '.join(lines)} where its reference line meets the cut"


def _section_table(
    found: PartsFound,
    names: Sequence[str],
    drawn: Mapping[str, Sequence[figures.Diagrams]],
) -> Block:
    """Extremes, with their instants, of what is drawn over time."""
    rows = []
    for name in names:
        cuts, at = found.cuts[name], found.looked_at[name]
        beam = cuts.beam
        turn = np.cross(beam.direction, beam.side)
        axes = dict(zip(NAMED, (beam.lift, beam.across, beam.direction)))
        axes |= dict(zip(beam.sideways, (beam.side, turn)))
        for diagrams in drawn[name]:
            values = diagrams.of(found.landing.sections[name][:, at]) / 1e3
            for q, (quantity, unit) in enumerate(zip(diagrams.names, diagrams.units)):
                low, high = int(values[:, q].argmin()), int(values[:, q].argmax())
                way = "along" if unit == "N" else "about"
                axis = axis_name(axes[quantity]).replace("-", _MINUS)
                rows.append(
                    {
                        "part": name,
                        "cut": f"{beam.axis} = {beam.stations[at]:z.2f} m",
                        **dict(zip(("x", "y", "z"), cuts.point[at])),
                        "acts": f"{quantity} {way} {axis}, k{unit}",
                        **{"min": values[low, q], "at_min": found.time[low]},
                        **{"max": values[high, q], "at_max": found.time[high]},
                    }
                )
    heads = {
        "part": "part",
        "cut": "cut at",
        "x": "point x m",
        "y": "y m",
        "z": "z m",
        "acts": "quantity",
        "min": "least",
        "at_min": "at s",
        "max": "largest",
        "at_max": "at s ",
    }
    formats = {"min": ".1f", "max": ".1f", "at_min": ".3f", "at_max": ".3f"}
    formats |= dict.fromkeys(("x", "y", "z"), ".2f")
    return table_block(pd.DataFrame(rows), heads, formats, "Extremes at these cuts")

"""The landing gears of a report: peaks, histories, attachment nodes."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pandas as pd

from drake_landing.case.axes import deck_axes
from drake_landing.report import figures
from drake_landing.report.page import Block, Section, table_block

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult


def gears_section(result: "ProcessResult") -> Section:
    """Peaks and histories of tires, shock absorbers and attachments."""
    return Section(
        id="gears",
        title="Landing gears",
        text="Tire loads are those of the runway on all tires of a gear: vertical is "
        "normal to the runway, drag along it, aft. Stroke and force of a shock "
        "absorber are along its own axis, positive in compression. The wheels stand "
        "still at touchdown and are spun up by the drag. A gear in the air loads its "
        "node by its own inertia.",
        blocks=[
            *_gear_peaks(result),
            Block(svg=figures.struts_and_tires(result.history)),
            Block(svg=figures.force_over_stroke(result.history)),
        ],
    )


def _gear_peaks(result: "ProcessResult") -> Iterator[Block]:
    """Peaks and their instants."""
    peaks = result.gears.pivot(index="gear", columns="quantity", values="peak")
    peaks = peaks.loc[list(dict.fromkeys(result.gears["gear"]))].reset_index()
    kilo = [c for c in peaks.columns if c not in ("gear", "stroke")]
    peaks[kilo] = peaks[kilo] / 1e3
    heads = {
        "gear": "gear",
        "stroke": "stroke m",
        "tyre_vertical": "tire vertical kN",
        "tyre_drag": "tire drag kN",
        **{f"attachment_f{a}": f"F{a} kN" for a in "xyz"},
        **{f"attachment_m{a}": f"M{a} kN m" for a in "xyz"},
    }
    formats = dict.fromkeys(heads, ".2f") | {"stroke": ".4f"}
    # Zero by symmetry reads better without a sign.
    peaks[kilo] = peaks[kilo].where(peaks[kilo].abs() > 5e-3, 0.0)
    instants = result.gears.pivot(index="gear", columns="quantity", values="time")
    instants = instants.loc[peaks["gear"]].reset_index()
    instants[kilo] = instants[kilo].where(peaks[kilo] != 0.0)
    yield table_block(
        peaks,
        heads,
        formats,
        f"Load case '{result.case.name}': peaks per gear (largest magnitude, with its "
        "sign): tires in the axes of the runway; F and M on the airframe at the "
        f"attachment node, axes of the deck ({deck_axes(result.airframe.R_AB)}), "
        "increments to steady flight; the peaks of a row are not of one instant",
    )
    yield table_block(
        instants,
        {name: head.split(" k")[0].removesuffix(" m") for name, head in heads.items()},
        dict.fromkeys(heads, ".3f"),
        "Instants of these peaks, s",
    )


def attachment_nodes(result: "ProcessResult") -> Block:
    """Section of the nodes that moments are about."""
    points, rows = result.airframe.structure.points, []
    for gear in result.aircraft.gears:
        for name, node in gear.attachments.items():
            x, y, z = points.xyz[points.rows(node)]
            rows.append(
                {"name": name.replace("_", " "), "node": str(node)}
                | {"x": float(x), "y": float(y), "z": float(z)}
            )
    heads = {"name": "attachment", "node": "grid", "x": "x m", "y": "y m", "z": "z m"}
    formats = dict.fromkeys("xyz", ".3f")
    return table_block(pd.DataFrame(rows), heads, formats, "Attachment nodes")

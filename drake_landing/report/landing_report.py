"""The report of one landing: which pictures and tables, in which order."""

import platform
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from drake_landing.case.axes import deck_axes
from drake_landing.report import figures
from drake_landing.report.acceleration_sections import (
    accelerations_section,
    spectra_section,
)
from drake_landing.report.axes_section import axes_section
from drake_landing.report.gear_sections import attachment_nodes, gears_section
from drake_landing.report.page import (
    Block,
    Page,
    Section,
    pairs_block,
    table_block,
    write_page,
)
from drake_landing.report.parts_sections import Picture, parts_sections
from drake_landing.report.run_sections import case_section, files_section, made_section
from drake_landing.results.reliability import reliability
from drake_landing.results.summary import key_figures, story
from drake_landing.results.verdict import verdict
from drake_landing.transient.extremes import worst_elements
from drake_landing.versions import versions

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult


_BESIDE = {
    "landing.html": "Replay in three dimensions",
    "histories.html": "Interactive histories",
}
_WORST = {
    "result": "result",
    "type": "type",
    "column": "quantity",
    "element": "element",
    "value": "extreme",
    "time": "time, s",
}


def write_report(
    path: Path,
    result: "ProcessResult",
    pictures: Sequence[Picture] = (),
    unable: str = "",
    buckling: Sequence[Picture] = (),
) -> None:
    """Writes `report.html`.

    Args:
        path: of the file.
        result: of the run.
        pictures: of the stress field, and what they show.
        unable: a sentence on why there are none.
        buckling: pictures of the mode that buckles first.
    """
    case = result.case
    write_page(
        path,
        Page(
            name=case.name,
            title=case.title or f"{result.aircraft.name}: landing",
            story=story(result),
            key_figures=key_figures(result),
            sections=list(_sections(result, pictures, unable, buckling, path.parent)),
            beside=[
                (name, what)
                for name, what in _BESIDE.items()
                if (path.parent / name).is_file()
            ],
            footer=", ".join(f"{k} {v}" for k, v in versions().items() if k != "python")
            + f", Python {platform.python_version()}. SI units.",
        ),
    )


def _sections(
    result: "ProcessResult",
    pictures: Sequence[Picture],
    unable: str,
    buckling: Sequence[Picture],
    folder: Path,
) -> Iterator[Section]:
    yield Section(
        id="verdict",
        title="In short",
        blocks=[
            pairs_block(verdict(result)),
            pairs_block(reliability(result), "How far the numbers carry"),
            *_late(result),
        ],
    )
    yield axes_section(result)
    yield gears_section(result)
    yield Section(
        id="loads",
        title="Attachment loads",
        text="Force and moment of the gear on the airframe at the attachment node, in "
        f"the axes of the deck ({deck_axes(result.airframe.R_AB)}), as increments to "
        "steady flight; moments are about the node, right-handed about the axes. These "
        "load the full model.",
        blocks=[
            Block(svg=figures.attachment_loads(result.history)),
            attachment_nodes(result),
        ],
    )
    yield from parts_sections(result, pictures, unable, buckling)
    yield accelerations_section(result)
    yield spectra_section(result)
    yield _extremes(result)
    yield Section(
        id="energy",
        title="Energy audit",
        text="Kinetic, stored and dissipated energy must add up to a constant. "
        + _reference_energy(result),
        blocks=[Block(svg=figures.energy(result.history))],
    )
    yield case_section(result)
    yield made_section(result)
    yield files_section(result, folder)
    if result.notices:
        yield Section(
            id="notices",
            title=f"Notices ({len(result.notices)})",
            text="What the program met in the deck and the case; of one kind, one line "
            "with the number.",
            blocks=[Block(items=result.notices)],
        )


def _reference_energy(result: "ProcessResult") -> str:
    """What the figure of the energies refers to."""
    energy = f"{result.history.figures['sink_energy'] / 1e3:.1f} kJ"
    if result.aircraft.scenario.start == "touchdown":
        return (
            f"The sink energy, half the mass times the sink rate squared, is {energy}."
        )
    return (
        f"The aircraft rolls and does not sink: shares are those of {energy}, the sink "
        "energy of a landing with the same mass."
    )


def _late(result: "ProcessResult") -> list[Block]:
    """Extremes that came in the last swing."""
    if result.late.empty:
        return []
    heads = {"kind": "kind", "quantity": "quantity", "value": "extreme", "unit": "unit"}
    heads |= {"time": "time s"}
    return [
        table_block(
            result.late,
            heads,
            {"value": ".4g", "time": ".3f"},
            "Extremes in the last swing of the run: a longer one may find more",
        )
    ]


def _extremes(result: "ProcessResult") -> Section:
    worst = worst_elements(result.envelopes, 1)
    return Section(
        id="extremes",
        title="Extremes of all results",
        text="Extremes of element forces and stresses in the direct transient, "
        "increments to steady flight: for each type and quantity the element with "
        "the largest. All elements: results.h5, group envelope; the worst ten: "
        "worst_elements.csv. Quantities and element axes are Nastran's; SI units (N, "
        "N m, N/m of shells, Pa). Stresses of bars without stress recovery points "
        "leave out bending; those of CBUSH are forces times the recovery coefficients "
        "of PBUSH (1 by default), and no stress then.",
        blocks=[table_block(worst, _WORST, {"value": ".4g", "time": ".3f"})],
    )

"""One line on each file of a result folder, and README.txt that says them."""

from pathlib import Path
from typing import TYPE_CHECKING

from drake_landing.case.axes import deck_axes
from fem.files.atomic import write_aside

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

README = "README.txt"
_LINES = {
    "report.html": "the report: verdict, loads, stresses, case, how it was made; "
    "prints",
    "histories.html": "the histories to hover and zoom, all panels together",
    "landing.html": "replay of the landing in three dimensions, for a browser",
    "landing_sol109.bdf": "deck of the direct transient, complete, in the deck's units",
    "airframe.bdf": "deck of the airframe that the program has written for this run",
    "results.h5": "all histories, section loads, extremes, case and provenance (HDF5)",
    "gears.csv": "peaks per gear, largest magnitude with its sign; their units in the "
    "column unit",
    "attachment_loads.csv": "gear on airframe at the attachment nodes over time, "
    "deck's axes, multibody run",
    "tyres.csv": "each wheel over time: deflection, runway on tire (vertical, drag "
    "aft, side to starboard), slip, spin",
    "struts.csv": "each shock absorber over time: stroke, rate, force, positive in "
    "compression",
    "accelerations_multibody.csv": "monitoring points over time, multibody model, "
    "deck's axes",
    "accelerations_transient.csv": "monitoring points over time, direct transient, "
    "deck's axes",
    "accelerations_equipment.csv": "places of equipment over time, direct transient, "
    "deck's axes",
    "comparison.csv": "multibody against direct transient: peaks in m/s², errors over "
    "the transient's values, last mode (highest_hz) in Hz",
    "section_loads.csv": "extremes of shear, bending, torsion at all cuts, the point "
    "that moments refer to, units in the column unit",
    "section_roots.csv": "section loads over time at the cut of each part that is "
    "looked at",
    "monitor_points.csv": "extremes of the deck's monitor points (MONPNT1, MONPNT3), "
    "along the axes of their frame, units in the column unit",
    "monitor_histories.csv": "the same over time",
    "worst_stresses.csv": "ten elements of each component with the least margin or the "
    "largest stress",
    "worst_elements.csv": "of each result quantity the ten elements that see most, "
    "units in the column unit",
    "late_extremes.csv": "extremes in the last swing of the run; empty: none",
    "buckling.csv": "panels that buckle first in the static cases of the landing's "
    "instants: load factor, margin, place",
    "practices.csv": "the same landing by three practices, units in the column unit",
    "stages.csv": "time and memory of each stage of the run",
    "pictures": "stress field at the instants of the largest stresses (PNG)",
    "report.pdf": "the report, printed",
    README: "these lines, and the units and axes of all files",
}
_SOMETIMES = ("airframe.bdf", "buckling.csv", "practices.csv", "report.pdf", "pictures",
              "monitor_points.csv", "monitor_histories.csv")  # fmt: skip


def file_lines(result: "ProcessResult", folder: Path) -> list[tuple[str, str]]:
    """Name of each file that a run writes, and what it holds."""
    there = {name for name in _SOMETIMES if (folder / name).exists()}
    there |= {"buckling.csv"} if result.buckled is not None else set()
    there |= {"practices.csv"} if result.practices is not None else set()
    return [(n, t) for n, t in _LINES.items() if n in there or n not in _SOMETIMES]


def write_readme(result: "ProcessResult", folder: Path) -> None:
    """README.txt: what each file is, in which axes and units."""
    lines = file_lines(result, folder)
    width = max(len(name) for name, _ in lines)
    text = (
        f"Results of the load case '{result.case.name}'\n\n"
        + "".join(f"{name:<{width}}  {line}\n" for name, line in lines)
        + "\nUnits: SI, whatever the deck has; in brackets in the heading of a column, "
        "in the\ncolumn `unit` where rows differ. In results.h5: attributes `unit`, or "
        "`columns` with\n`units`, of each dataset.\n"
        f"Axes: the deck's basic frame ({deck_axes(result.airframe.R_AB)}), but those "
        "of the runway for tires.\n"
        "Loads, accelerations and stresses are increments to the steady flight before "
        "touchdown\nwhere the report does not say otherwise. Times count from the "
        "start of the run.\n"
        "How it was made: drake-landing show-run <this folder>.\n"
    )
    write_aside(
        folder / README, lambda to: to.write_text(text, encoding="utf-8") and None
    )

"""What a run leaves in its folder, from the tables to the report."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from drake_landing.case.reading import case_text
from drake_landing.csv_tables import write_csv
from drake_landing.landing.history import LandingHistory
from drake_landing.parts import tables
from drake_landing.parts.buckling import with_margin
from drake_landing.parts.observers import PartsWatch
from drake_landing.results import units
from drake_landing.results.late_extremes import flagged
from drake_landing.results.readme import write_readme
from drake_landing.results.result import ProcessResult
from drake_landing.results.result_files import write_history_csv, write_results
from drake_landing.transient.extremes import worst_elements
from fem.exit_status import is_system_failure


def write_all(result: ProcessResult, out: Path, watch: PartsWatch) -> None:
    """results.h5, the CSV tables, pictures, report.html and landing.html."""
    from drake_landing.parts.gallery import buckling_pictures, stress_pictures
    from drake_landing.replay.record import write_replay
    from drake_landing.report import write_report
    from drake_landing.report.histories import write_histories

    stages = result.stages
    stages.begin("writing the result files")
    write_files(result, out)
    lost: list[str] = []
    with _at_most_lost("landing.html, the replay,", lost):
        write_replay(out / "landing.html", result)
    stages.begin("pictures of the stress field")
    structure, parts, R_AB = (
        result.airframe.structure,
        result.parts,
        result.airframe.R_AB,
    )
    pictured: list[tuple[Path, str]] = []
    pictures, unable = [], "Pictures of the stress field failed, see the notices."
    with _at_most_lost("pictures of the stress field", lost):
        pictures, unable = stress_pictures(
            out,
            structure,
            watch.stresses,
            parts,
            result.case.parts,
            R_AB,
            watch.steady,
        )
    with _at_most_lost("picture of the panel that buckles", lost):
        pictured = buckling_pictures(out, structure, result.buckled, parts, R_AB)
    stages.begin("writing the report")
    with _at_most_lost("histories.html, the interactive histories,", lost):
        write_histories(out / "histories.html", result)
    result = replace(result, notices=(*result.notices, *lost))
    write_report(out / "report.html", result, pictures, unable, pictured)
    stages.end()
    write_csv(out / "stages.csv", units.with_units(stages.table()))
    write_readme(result, out)


@contextmanager
def _at_most_lost(what: str, lost: list[str]) -> Iterator[None]:
    """What goes wrong with a picture costs the picture, not the report.

    A full disk is no matter of the picture.
    """
    try:
        yield
    except Exception as error:
        if is_system_failure(error):
            raise
        lost.append(f"{what} could not be made: {type(error).__name__}: {error}")


def write_landing(history: LandingHistory, out: Path) -> None:
    """CSV tables of the landing alone: what is interrupted later keeps them."""
    write_history_csv(out / "attachment_loads.csv", history.attachment)
    write_history_csv(out / "tyres.csv", history.tire)
    write_history_csv(out / "struts.csv", history.strut)


def write_files(result: ProcessResult, out: Path) -> None:
    """results.h5 and the CSV tables, but those of the landing."""
    history, parts = result.history, result.parts
    ultimate = result.case.parts.ultimate_factor
    write_results(
        out / "results.h5",
        case=case_text(result.case),
        body=result.airframe.body,
        R_AB=result.airframe.R_AB,
        history=history,
        loads=result.loads,
        response=result.response,
        envelopes=result.envelopes,
        comparison=result.comparison,
        gears=result.gears,
        parts=parts,
        provenance=result.provenance,
        seconds=sum(result.seconds.values()),
    )
    write_csv(out / "comparison.csv", result.comparison)  # the agreed columns
    worst = tables.worst_elements(parts.judged, ultimate)
    elements, sections = (
        worst_elements(result.envelopes, 10),
        tables.section_envelopes(parts),
    )
    extremes = {
        "worst_elements": elements.assign(unit=units.element_result_units(elements)),
        "worst_stresses": tables.stacked(worst, tables.axial_elements(parts.judged)),
        "section_loads": sections.assign(unit=units.quantity_units(sections)),
    }
    for name, table in extremes.items():
        late = flagged(table, result.loads.time[-1], result.swing)
        write_csv(out / f"{name}.csv", units.with_units(late))
    if parts.stations:
        monitors = tables.monitor_extremes(parts)
        monitors = monitors.assign(unit=units.quantity_units(monitors))
        late = flagged(monitors, result.loads.time[-1], result.swing)
        write_csv(out / "monitor_points.csv", units.with_units(late))
        over_time = units.with_units(tables.monitors_over_time(parts))
        write_csv(out / "monitor_histories.csv", over_time, index=True)
    gears = result.gears.assign(unit=units.quantity_units(result.gears))
    write_csv(out / "gears.csv", flagged(gears, history.time[-1], result.swing))
    write_csv(out / "late_extremes.csv", units.with_units(result.late))
    roots = units.with_units(tables.root_histories(parts))
    write_csv(out / "section_roots.csv", roots, index=True)
    write_history_csv(
        out / "accelerations_equipment.csv", tables.equipment_histories(parts)
    )
    if result.buckled is not None:
        panels = with_margin(result.buckled, ultimate)
        write_csv(out / "buckling.csv", units.with_units(panels))
    if result.practices is not None:
        write_csv(out / "practices.csv", units.with_units(result.practices.table))
    write_history_csv(out / "accelerations_multibody.csv", result.multibody_on_grid)
    write_history_csv(out / "accelerations_transient.csv", result.response)

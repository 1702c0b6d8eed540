"""The hybrid process, from a case to its report.

    deck -> modes -> landing in Drake -> attachment loads -> direct transient -> compare

`run_case` is the whole story; each chapter is a module of its own.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd

from drake_landing.airframe.aircraft import Aircraft
from drake_landing.airframe.body import AirframeModel, load_airframe
from drake_landing.airframe.load_shapes import load_model
from drake_landing.airframe.relevance import ModalModel
from drake_landing.airframe.selection import expected_pulses, modal_model
from drake_landing.airframe.truncation import frequency_for, load_errors
from drake_landing.cache import Cache
from drake_landing.case.axes import rotation_AB
from drake_landing.case.reading import case_text
from drake_landing.case.schema import Case, Simulation
from drake_landing.files import write_csv
from drake_landing.landing.compilation import compilation_remark
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.landing.history import LandingHistory, gear_peaks
from drake_landing.landing.lifetime import used_once
from drake_landing.landing.run import build_landing, fast_mode_notices, fly
from drake_landing.landing.settling import LIMIT, Settling, swing_of
from drake_landing.parts import tables
from drake_landing.parts.buckling import with_margin
from drake_landing.parts.observers import PartsWatch
from drake_landing.parts.stress import stress_point_notices
from drake_landing.process.aircraft import checked_aircraft
from drake_landing.process.full_response import FullResponse, full_response
from drake_landing.process.landing_deck import check_landing_deck, write_landing_deck
from drake_landing.progress import Reporter
from drake_landing.results import units
from drake_landing.results.comparison import RunLabel, comparison_table
from drake_landing.results.files import write_history_csv, write_results
from drake_landing.results.late_extremes import flagged, late_extremes
from drake_landing.results.provenance import Provenance
from drake_landing.results.readme import write_readme
from drake_landing.results.result import ProcessResult, on_grid
from drake_landing.results.stages import Stages
from drake_landing.results.truncation import Truncation
from drake_landing.transient.extremes import worst_elements
from drake_landing.transient.practices import rigid
from drake_landing.transient.step_error import expected_step_error
from fem.errors import by_kind
from fem.exit_status import of_the_system
from fem.model.structure import Structure
from systems.airframe.modal_body import ModalBody

_LONGER = 1.6  # times the length of a run that ended too soon


def run_case(
    case: Case,
    out: str | Path,
    progress: Reporter | None = None,
    *,
    practices: bool = False,
) -> ProcessResult:
    """Runs the process and writes all result files into the folder `out`.

    Args:
        case: validated.
        out: folder.
        progress: told the stages.
        practices: also what rigid gear loads and static slices would have made of it.

    Raises:
        InputError: case, deck or gears are at fault; every problem is named.
        LandingError: the landing could not be integrated.
    """
    with case.reading():
        return _run_case(case, Path(out), Stages(progress), practices)


def _run_case(case: Case, out: Path, stages: Stages, practices: bool) -> ProcessResult:
    out.mkdir(parents=True, exist_ok=True)

    cache = Cache.of_user()
    stages.begin("reading the deck")
    aircraft, structure, remarks = checked_aircraft(case, out)
    provenance = Provenance.begin(case, aircraft, out)
    stages.begin("assembling the matrices")
    _assemble(structure)
    stages.begin("expected error of the time step")
    shapes = load_model(structure, aircraft, cache)
    pulses = expected_pulses(structure, case.airframe, aircraft, aircraft.scenario)
    step = expected_step_error(case, aircraft, structure, shapes, pulses)
    remarks = (*remarks, *step.remarks, *aircraft.scenario.remarks)
    stages.begin("eigenmodes")
    airframe = load_airframe(
        case.airframe,
        aircraft,
        stages.progress,
        case.scenario,
        cache,
        structure,
    )

    swing = swing_of(float(shapes.frequency_hz[shapes.elastic].min(initial=np.inf)))
    flight = _fly_and_respond(
        case, aircraft, airframe, swing, out, cache, stages, practices
    )
    history, loads, full = flight.history, flight.loads, flight.full
    stages.begin("writing the deck of the transient")
    deck = out / "landing_sol109.bdf"
    worst = tables.worst_elements(full.parts.judged, 1.0, 1)["id"].tolist()
    write_landing_deck(deck, case, aircraft, airframe, loads, worst, provenance.lines())
    deck_checked = check_landing_deck(deck, case, airframe, loads)

    stages.begin("comparing")
    label = RunLabel(
        run=case.name,
        aircraft=aircraft.name,
        topology=aircraft.topology,
        basis=case.airframe.basis,
        modes=airframe.body.n,
        highest_hz=airframe.highest_hz,
    )
    comparison = comparison_table(
        label,
        loads.time,
        {name: table.to_numpy() for name, table in full.response.items()},
        {n: t.to_numpy() for n, t in on_grid(history, loads.time).items()},
    )
    result = ProcessResult(
        case=case,
        aircraft=aircraft,
        airframe=airframe,
        history=history,
        loads=loads,
        response=full.response,
        envelopes=full.envelopes,
        comparison=comparison,
        gears=gear_peaks(case.name, history),
        parts=full.parts,
        step=step,
        swing=swing,
        truncation=Truncation(
            gears=_load_errors(aircraft, airframe, shapes, history, loads),
            enough_hz=frequency_for(shapes, pulses),
        ),
        late=flight.late,
        deck_checked=deck_checked,
        provenance=provenance,
        practices=full.practices,
        buckled=full.buckled,
        notices=tuple(
            by_kind(
                [
                    *aircraft.notices,
                    *airframe.notices,
                    *map(case.places.named, remarks),
                    *fast_mode_notices(airframe.body, case.simulation),
                    *stress_point_notices(structure),
                    *full.watch.notices,
                ]
            )
        ),
        stages=stages,
    )
    write_all(result, out, full.watch)
    return result


def _load_errors(
    aircraft: Aircraft,
    airframe: AirframeModel,
    shapes: ModalModel,
    history: LandingHistory,
    loads: AttachmentLoads,
) -> dict[str, float]:
    """Gear that touches -> expected error of its load by modes that are left out."""
    closing, largest = {}, {}
    for gear in aircraft.gears:
        tire = max(history.tire[w]["deflection"].max() for w in gear.wheel_names)
        stroke = history.strut[gear.name]["stroke"].max()
        closing[gear.attachment_node] = float(stroke + max(tire, 0.0))
        vertical = history.leg(gear.name, "vertical").max()
        largest[gear.attachment_node] = float(vertical)
    errors = load_errors(
        shapes,
        modal_model(airframe.structure, airframe.basis, aircraft),
        {int(n): loads.load[:, i] for i, n in enumerate(loads.node_id)},
        closing,
        largest,
    )
    return {
        gear.name: errors[gear.attachment_node]
        for gear in aircraft.gears
        if gear.attachment_node in errors
    }


def _assemble(structure: Structure) -> tuple[int, int]:
    """Entries of K and M, which are kept."""
    return structure.stiffness.nnz, structure.mass.nnz


@dataclass(frozen=True, kw_only=True)
class _Flight:
    """A landing and what the full model answers to it."""

    history: LandingHistory
    loads: AttachmentLoads
    full: FullResponse
    late: pd.DataFrame  # see `late_extremes`


def _fly_and_respond(
    case: Case,
    aircraft: Aircraft,
    airframe: AirframeModel,
    swing: float,
    out: Path,
    cache: Cache,
    stages: Stages,
    practices: bool,
) -> _Flight:
    """Landing and transient; once more and longer where an extreme came late.

    Only runs that find their own end are repeated. The landing shows when loads,
    accelerations and modes have settled, so that this is rare.
    """
    at_least = 0.0
    while True:
        settling = Settling(swing=swing, at_least=at_least)
        flight = _once(
            case, aircraft, airframe, settling, out, cache, stages, practices
        )
        end = flight.history.time[-1]
        open_end = case.simulation.duration == "auto" and not case.transient.duration
        if flight.late.empty or not open_end or end >= LIMIT:
            return flight
        at_least = min(_LONGER * end, LIMIT)


def _once(
    case: Case,
    aircraft: Aircraft,
    airframe: AirframeModel,
    settling: Settling,
    out: Path,
    cache: Cache,
    stages: Stages,
    practices: bool,
) -> _Flight:
    body, simulation = airframe.body, case.simulation
    first = compilation_remark()
    stages.begin("landing", f"(elastic modes in the multibody model: {body.n}{first})")
    history = _fly(case, aircraft, body, simulation, stages.progress, settling)
    write_landing(history, out)
    histories = [history]
    if practices:
        stages.begin("landing with a rigid airframe")
        as_long = simulation.model_copy(update={"duration": float(history.time[-1])})
        histories.append(_fly(case, aircraft, rigid(body), as_long, stages.progress))

    stages.begin("handing over the attachment loads")
    duration = case.transient_duration(float(history.time[-1]))
    loads = [
        h.attachment_loads().resampled(case.transient.step, duration) for h in histories
    ]
    full = full_response(case, aircraft, airframe, loads, cache, stages)
    late = late_extremes(full.parts, full.response, settling.swing)
    return _Flight(history=history, loads=loads[0], full=full, late=late)


def _fly(
    case: Case,
    aircraft: Aircraft,
    body: ModalBody,
    simulation: Simulation,
    progress: Reporter,
    settling: Settling | None = None,
) -> LandingHistory:
    """The multibody run of a body."""
    R_AB, points = rotation_AB(case.airframe.axes), aircraft.monitoring
    landing = build_landing(
        body,
        aircraft.gears,
        points,
        R_AB,
        aircraft.scenario,
        simulation.slow_modes_above,
        case.bushing,
    )
    scenario = aircraft.scenario
    with used_once(landing):
        return fly(landing, scenario, simulation, points, R_AB, progress, settling)


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
        pictured = buckling_pictures(out, structure, result.buckled, R_AB)
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
        if of_the_system(error):
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
        "worst_elements": elements.assign(unit=units.of_element_results(elements)),
        "worst_stresses": tables.stacked(worst, tables.axial_elements(parts.judged)),
        "section_loads": sections.assign(unit=units.of_quantities(sections)),
    }
    for name, table in extremes.items():
        late = flagged(table, result.loads.time[-1], result.swing)
        write_csv(out / f"{name}.csv", units.with_units(late))
    if parts.stations:
        monitors = tables.monitor_extremes(parts)
        monitors = monitors.assign(unit=units.of_quantities(monitors))
        late = flagged(monitors, result.loads.time[-1], result.swing)
        write_csv(out / "monitor_points.csv", units.with_units(late))
        over_time = units.with_units(tables.monitors_over_time(parts))
        write_csv(out / "monitor_histories.csv", over_time, index=True)
    gears = result.gears.assign(unit=units.of_quantities(result.gears))
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

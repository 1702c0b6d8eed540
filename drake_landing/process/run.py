"""The hybrid process, from a case to its report.

    deck -> modes -> landing in Drake -> attachment loads -> direct transient -> compare

`run_case` is the whole story; each chapter is a module of its own.
"""

from dataclasses import dataclass
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
from drake_landing.case.schema import Case
from drake_landing.case.simulation import Simulation
from drake_landing.landing.compilation import compilation_remark
from drake_landing.landing.handover import AttachmentLoads
from drake_landing.landing.history import LandingHistory, gear_peaks
from drake_landing.landing.lifetime import used_once
from drake_landing.landing.run import build_landing, fast_mode_notices, fly
from drake_landing.landing.settling import LIMIT, Settling, swing_of
from drake_landing.parts import tables
from drake_landing.parts.stress import stress_point_notices
from drake_landing.process.aircraft import checked_aircraft
from drake_landing.process.full_response import FullResponse, full_response
from drake_landing.process.landing_deck import check_landing_deck, write_landing_deck
from drake_landing.process.run_folder import write_all, write_landing
from drake_landing.progress import Reporter
from drake_landing.results.comparison import RunLabel, comparison_table
from drake_landing.results.late_extremes import late_extremes
from drake_landing.results.provenance import Provenance
from drake_landing.results.result import ProcessResult, on_grid
from drake_landing.results.stages import Stages
from drake_landing.results.truncation import Truncation
from drake_landing.transient.practices import rigid
from drake_landing.transient.step_error import expected_step_error
from fem.errors import by_kind
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

"""The hybrid process, from a case to its report.

    deck -> modes -> landing in Drake -> attachment loads -> direct transient -> compare

`run_case` is the whole story; each chapter is a module of its own.
"""

import time as clock
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from drake_landing.airframe import AirframeModel, load_airframe
from drake_landing.axes import rotation_AB
from drake_landing.cache import Cache
from drake_landing.case import Case
from drake_landing.cases_io import case_text
from drake_landing.comparison import RunLabel, comparison_table
from drake_landing.extremes import element_envelopes, worst_elements
from drake_landing.handover import AttachmentLoads, smooth_curve
from drake_landing.history import POINT, LandingHistory, gear_peaks
from drake_landing.inputs import Aircraft, prepare_aircraft
from drake_landing.landing import build_landing, fast_mode_notices, fly
from drake_landing.progress import Reporter, Silent
from drake_landing.response import transient_response
from drake_landing.results import write_csv, write_history_csv, write_results
from drake_landing.transient_deck import transient_deck, write_transient_deck
from fem.envelope import Envelope


@dataclass(frozen=True, kw_only=True)
class ProcessResult:
    """What a run of the process found.

    Attributes:
        case: as validated.
        aircraft: deck, gears and monitoring points of the case.
        airframe: finite-element model, its modes, and the modal body.
        history: the multibody run.
        loads: attachment loads on the grid of the transient, as handed over.
        response: acceleration of the monitoring points, direct transient, B.
        envelopes: extremes of all element forces and stresses in the transient.
        comparison: table of `comparison.csv`.
        gears: table of `gears.csv`.
        notices: what the user should know.
        seconds: stage -> wall time.
    """

    case: Case
    aircraft: Aircraft
    airframe: AirframeModel
    history: LandingHistory
    loads: AttachmentLoads
    response: dict[str, pd.DataFrame]
    envelopes: tuple[Envelope, ...]
    comparison: pd.DataFrame
    gears: pd.DataFrame
    notices: tuple[str, ...] = ()
    seconds: Mapping[str, float] = field(default_factory=dict)

    @property
    def multibody_on_grid(self) -> dict[str, pd.DataFrame]:
        """Accelerations of the multibody run at the instants of the transient."""
        return on_grid(self.history, self.loads.time)


def run_case(case: Case, out: Path, progress: Reporter | None = None) -> ProcessResult:
    """Runs the process and writes all result files into the folder `out`.

    Raises:
        InputError: case, deck or gears are at fault; every problem is named.
        LandingError: the landing could not be integrated.
    """
    with case.places.located():
        return _run_case(case, out, _Stages(progress or Silent()))


def _run_case(case: Case, out: Path, stages: "_Stages") -> ProcessResult:
    out.mkdir(parents=True, exist_ok=True)

    stages.begin("reading the airframe")
    aircraft = prepare_aircraft(case, out)
    airframe = load_airframe(
        case.airframe, aircraft, stages.progress, case.scenario, Cache.of_user()
    )
    R_AB = rotation_AB(case.airframe.axes)

    stages.begin(f"landing (elastic modes in the multibody model: {airframe.body.n})")
    points = aircraft.monitoring
    landing = build_landing(
        airframe.body,
        aircraft.gears,
        points,
        R_AB,
        aircraft.scenario,
        case.simulation.slow_modes_above,
    )
    history = fly(
        landing, aircraft.scenario, case.simulation, points, R_AB, stages.progress
    )

    stages.begin("handing over the attachment loads")
    loads = history.attachment_loads().resampled(
        case.transient.step, case.transient_duration
    )
    write_landing_deck(out / "landing_sol109.bdf", case, aircraft, airframe, loads)

    stages.begin("direct transient response of the full model")
    envelopes = element_envelopes(airframe.structure)
    response = transient_response(
        airframe.structure,
        loads,
        points,
        case.transient.scheme,
        stages.progress,
        envelopes,
    )

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
        {name: table.to_numpy() for name, table in response.items()},
        {n: t.to_numpy() for n, t in on_grid(history, loads.time).items()},
    )
    result = ProcessResult(
        case=case,
        aircraft=aircraft,
        airframe=airframe,
        history=history,
        loads=loads,
        response=response,
        envelopes=tuple(envelopes),
        comparison=comparison,
        gears=gear_peaks(case.name, history),
        notices=(
            *aircraft.notices,
            *airframe.notices,
            *fast_mode_notices(airframe.body, case.simulation),
        ),
        seconds=stages.seconds,
    )
    stages.begin("writing results and report")
    write_all(result, out)
    stages.end()
    return result


def on_grid(history: LandingHistory, time: np.ndarray) -> dict[str, pd.DataFrame]:
    """Accelerations of the multibody run at given instants."""
    index = pd.Index(time, name="time")
    inside = np.minimum(time, history.time[-1])
    return {
        point: pd.DataFrame(
            smooth_curve(history.time, table.to_numpy())(inside),
            columns=list(POINT),
            index=index,
        )
        for point, table in history.monitoring.items()
    }


def write_landing_deck(
    path: Path,
    case: Case,
    aircraft: Aircraft,
    airframe: AirframeModel,
    loads: AttachmentLoads,
) -> None:
    """The complete SOL 109 deck of this landing."""
    lines = transient_deck(
        aircraft.deck,
        loads,
        airframe.displacement_axes(loads.node_id),
        output=list(aircraft.monitoring.values()),
        selections=airframe.selections,
        title=f"{case.name}: landing, attachment loads of the multibody run",
    )
    write_transient_deck(path, lines)


def write_all(result: ProcessResult, out: Path) -> None:
    """results.h5, the CSV tables, report.html and landing.html."""
    from drake_landing.replay import write_replay
    from drake_landing.report import write_report

    history = result.history
    write_results(
        out / "results.h5",
        case=case_text(result.case),
        body=result.airframe.body,
        history=history,
        loads=result.loads,
        response=result.response,
        envelopes=result.envelopes,
        comparison=result.comparison,
        gears=result.gears,
    )
    write_csv(out / "comparison.csv", result.comparison)
    write_csv(out / "gears.csv", result.gears)
    write_csv(out / "worst_elements.csv", worst_elements(result.envelopes, 10))
    write_history_csv(out / "attachment_loads.csv", history.attachment)
    write_history_csv(out / "tyres.csv", history.tyre)
    write_history_csv(out / "struts.csv", history.strut)
    write_history_csv(out / "accelerations_multibody.csv", result.multibody_on_grid)
    write_history_csv(out / "accelerations_transient.csv", result.response)
    write_replay(out / "landing.html", result)
    write_report(out / "report.html", result)


class _Stages:
    """Tells the stages and measures them."""

    def __init__(self, progress: Reporter) -> None:
        self.progress = progress
        self.seconds: dict[str, float] = {}
        self._name, self._start = "", 0.0

    def begin(self, name: str) -> None:
        self.end()
        self._name, self._start = name, clock.perf_counter()
        self.progress.stage(name)

    def end(self) -> None:
        if self._name:
            self.seconds[self._name] = clock.perf_counter() - self._start
        self._name = ""

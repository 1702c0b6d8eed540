"""A study: landings with several sets of modes, transients, comparison, budget."""

import time as clock
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.airframe.selection import Choice
from drake_landing.cache import Cache
from drake_landing.csv_tables import write_csv
from drake_landing.progress import Reporter, Silent
from drake_landing.reference.studies.airframes import StudyAirframe, study_airframe
from drake_landing.reference.studies.bases import bases_of, bases_table, spectrum_table
from drake_landing.reference.studies.budget import error_budget
from drake_landing.reference.studies.gaps import gap_table
from drake_landing.reference.studies.landings import LandingResult, LandingTask, fly_all
from drake_landing.reference.studies.plan import Plan, RunName
from drake_landing.reference.studies.runs import Study, StudyRun
from drake_landing.reference.studies.study_tables import (
    budget_table,
    convergence_table,
    study_table,
)
from drake_landing.reference.studies.transients import TransientTask, respond_all
from drake_landing.results.comparison import RunLabel, comparison_table
from fem.files.atomic import written_aside

Float64 = npt.NDArray[np.float64]


def run_study(
    plan: Plan,
    out: Path,
    progress: Reporter | None = None,
    cache: Cache | None = None,
) -> Study:
    """Runs a study and writes `comparison.csv`, further tables and `report.html`.

    What an earlier, perhaps interrupted, study has computed is taken from the cache.

    Args:
        plan: one of `PLANS`, or another.
        out: folder.
        progress: told what happens.
        cache: default: the user's.
    """
    tell, cache = progress or Silent(), cache or Cache.of_user()
    seconds: dict[str, float] = {}
    begun = clock.perf_counter()

    def lap(name: str) -> None:
        nonlocal begun
        now = clock.perf_counter()
        seconds[name] = seconds.get(name, 0.0) + now - begun
        begun = now

    airframes = {}
    for topology in plan.topologies:
        tell.stage(f"airframe, topology {topology}: candidate modes and their order")
        airframes[topology] = study_airframe(
            plan, topology, out / f"topology_{topology}", cache, tell
        )
    lap("decks, matrices, candidate modes")

    names = plan.runs
    chosen = [airframes[n.topology].choose(n) for n in names]
    tell.stage(f"{len(names)} landings in the multibody model")
    landings = fly_all(
        [
            LandingTask(
                body=airframes[n.topology].body(choice),
                case=airframes[n.topology].case,
                aircraft=airframes[n.topology].aircraft,
            )
            for n, choice in zip(names, chosen)
        ],
        cache,
        lambda done, wanted: tell.share(done / wanted, f"{done} of {wanted}"),
    )
    lap("landings")

    tell.stage(f"direct transients of the full model, {len(names)} load cases")
    responses = respond_all(
        [
            TransientTask(airframe=airframes[n.topology], loads=landing.loads)
            for n, landing in zip(names, landings)
        ],
        cache,
        tell.share,
        tell.stage,
    )
    lap("direct transients")

    tell.stage("error budgets")
    runs = tuple(
        _run(airframes[name.topology], name, choice, landing, response)
        for name, choice, landing, response in zip(names, chosen, landings, responses)
    )
    points = tuple(next(iter(airframes.values())).aircraft.monitoring)
    lap("budgets and tables")
    tell.stage("bases and convergence")
    bases = bases_of(plan, airframes, cache)
    study = Study(
        plan=plan,
        airframes=airframes,
        points=points,
        runs=runs,
        comparison=_comparison(airframes, points, runs),
        measures=study_table(points, runs),
        budgets=budget_table(points, runs),
        convergence=convergence_table(airframes, runs),
        spectra=spectrum_table(airframes, bases),
        bases=bases_table(plan, airframes, bases, runs),
        gaps=gap_table(plan, airframes, runs),
        gears=pd.concat(
            [r.landing.gears.assign(run=str(r.name)) for r in runs], ignore_index=True
        )[["run", "gear", "quantity", "peak", "time"]],
        seconds=seconds,
    )
    lap("bases and convergence")
    tell.stage("writing tables and report")
    _write(study, out)
    return study


def _run(
    airframe: StudyAirframe,
    name: RunName,
    choice: Choice,
    landing: LandingResult,
    response: Float64,
) -> StudyRun:
    return StudyRun(
        name=name,
        choice=choice,
        landing=landing,
        transient=response,
        budget=error_budget(
            airframe.candidates.model,
            airframe.of_basis(name.basis).model,
            choice.model,
            landing.loads,
            landing.acceleration,
            response,
            airframe.case.transient.scheme,
        ),
    )


def _comparison(
    airframes: Mapping[str, StudyAirframe],
    points: tuple[str, ...],
    runs: tuple[StudyRun, ...],
) -> pd.DataFrame:
    tables = []
    for run in runs:
        airframe = airframes[run.name.topology]
        label = RunLabel(
            run=str(run.name),
            aircraft=airframe.aircraft.name,
            topology=run.name.topology,
            basis=run.name.basis,
            modes=run.choice.count,
            highest_hz=run.choice.highest_hz,
        )
        fe, multibody = (
            {point: values[:, i] for i, point in enumerate(points)}
            for values in (run.transient, run.landing.acceleration)
        )
        tables.append(comparison_table(label, run.time, fe, multibody))
    return pd.concat(tables, ignore_index=True)


def _write(study: Study, out: Path) -> None:
    from drake_landing.reference.studies.picture_files import write_pictures
    from drake_landing.reference.studies.report import write_study_report

    write_csv(out / "comparison.csv", study.comparison)
    write_csv(out / "gears.csv", study.gears)
    write_csv(out / "measures.csv", study.measures)
    write_csv(out / "budget.csv", study.budgets)
    write_csv(out / "convergence.csv", study.convergence)
    write_csv(out / "spectra.csv", study.spectra)
    write_csv(out / "bases.csv", study.bases)
    write_csv(out / "gaps.csv", study.gaps)
    with written_aside(out / "histories.npz") as part:
        np.savez_compressed(
            part,
            time=study.runs[0].time,
            points=np.array(study.points),
            runs=np.array([str(run.name) for run in study.runs]),
            multibody=np.array([run.landing.acceleration for run in study.runs]),
            transient=np.array([run.transient for run in study.runs]),
        )
    write_study_report(out / "report.html", study)
    write_pictures(out / "figures", study)

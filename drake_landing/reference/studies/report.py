"""The page of a study: findings, figures, tables."""

import platform
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pandas as pd

from drake_landing.reference.studies import figures
from drake_landing.reference.studies.findings import (
    estimate_quality,
    findings,
    key_figures,
)
from drake_landing.reference.studies.plan import NAMES
from drake_landing.report.page import Block, Page, Section, table_block, write_page
from drake_landing.versions import versions

if TYPE_CHECKING:
    from drake_landing.reference.studies.runs import Study, StudyRun

_MEASURES = {
    "topology": "topology",
    "selection": "modes",
    "modes": "number",
    "point": "point",
    "peak_fe": "peak, transient m/s²",
    "time_fe": "at s",
    "peak_mbs": "peak, multibody m/s²",
    "time_mbs": "at s ",
    "peak_error": "peak error",
    "rms_error": "rms difference",
    "correlation": "correlation",
    "sg_magnitude": "S-G magnitude",
    "sg_phase": "S-G phase",
    "sprague_geers": "S-G combined",
}
_PERCENT = dict.fromkeys(
    ("peak_error", "rms_error", "sg_magnitude", "sg_phase", "sprague_geers"), ".2%"
)
_BUDGET = {
    "topology": "topology",
    "selection": "modes",
    "point": "point",
    "total": "multibody against FE",
    "truncation": "truncation",
    "reduction": "reduction",
    "formulation": "formulation",
    "integration": "time integration",
    "rest": "modes above candidates",
    "feedback": "feedback",
    "expected": "omitted, expected beforehand",
    "truncated": "omitted, found",
}


def write_study_report(path: Path, study: "Study") -> None:
    """Writes `report.html`."""
    plan = study.plan
    write_page(
        path,
        Page(
            name=f"study {plan.name}",
            title=plan.title,
            story=_story(study),
            key_figures=key_figures(study),
            sections=list(_sections(study)),
            footer=", ".join(f"{k} {v}" for k, v in versions().items() if k != "python")
            + f", Python {platform.python_version()}. SI units.",
        ),
    )


def _story(study: "Study") -> str:
    plan = study.plan
    counts = sorted({run.choice.count for run in study.runs})
    return (
        f"{len(study.runs)} landings at {plan.scenario.sink_rate:g} m/s sink rate, "
        f"with {', '.join(map(str, counts))} elastic modes and gear topologies "
        f"{', '.join(plan.topologies)}; each against the direct transient of the full "
        "model under its own attachment loads."
    )


def _sections(study: "Study") -> Iterator[Section]:
    yield Section(
        id="findings",
        title="Findings",
        text="Differences are rms of multibody less direct transient over rms of the "
        "transient, vertical acceleration.",
        blocks=[
            table_block(
                findings(study),
                {"finding": "statement", "figures": "figures", "holds": "holds"},
                {},
            )
        ],
    )
    yield Section(
        id="convergence",
        title="Convergence",
        text="Lines: linear modes against the direct transient under the same loads: "
        "lowest modes of the reduced model (the paper's practice) and of the full one, "
        "those of highest relevance, shapes combined for the gears' pulses. Marks: "
        "whole runs, multibody against direct transient. The grey line is 1 %.",
        blocks=[Block(svg=figures.convergence(study))],
    )
    for topology in study.plan.topologies:
        yield Section(
            id=f"topology-{topology}",
            title=f"Accelerations, topology {topology}",
            text="Vertical, increments to steady flight.",
            blocks=[
                Block(svg=figures.accelerations(study, run), caption=_caption(run))
                for run in study.runs
                if run.name.topology == topology
            ],
        )
    yield _measures(study)
    yield _budget(study)
    yield _bases(study)
    yield _gaps(study)
    yield _costs(study)


def _caption(run: "StudyRun") -> str:
    last = f", up to {run.choice.highest_hz:.1f} Hz" if run.choice.count else ""
    return run.name.words + last


def _measures(study: "Study") -> Section:
    table = study.measures
    shown = table[(table["axis"] == "z") & table["point"].isin(study.plan.points)]
    formats = {
        **dict.fromkeys(("peak_fe", "peak_mbs"), ".3f"),
        **dict.fromkeys(("time_fe", "time_mbs"), ".4f"),
        **_PERCENT,
        "correlation": ".5f",
    }
    return Section(
        id="measures",
        title="Measures",
        text="Vertical acceleration. All axes and points are in measures.csv and "
        "comparison.csv.",
        blocks=[table_block(shown, _MEASURES, formats)],
    )


def _budget(study: "Study") -> Section:
    shown = study.budgets[study.budgets["point"].isin(study.plan.points)]
    parts = [name for name in _BUDGET if name not in ("topology", "selection", "point")]
    return Section(
        id="budget",
        title="Error budget",
        text="Each part measured by itself, rms over rms of the transient, vertical. "
        "Truncation: modes of the basis left out. Reduction: all modes of the reduced "
        "model against the full one. Formulation: finite rotation and deformed arms of "
        "the multibody model against linear modes. Time integration: the scheme of the "
        "transient against the exact response. Feedback: how much the response of the "
        "full model changes because the gear loads depend on the modes, against the "
        "run with the best modes; it does not enter the difference. The last two "
        "columns are all that the linear modes lack, of the acceleration vector. "
        + estimate_quality(study),
        blocks=[
            *(
                Block(svg=figures.budget_bars(study, t), caption=f"topology {t}")
                for t in study.plan.topologies
            ),
            table_block(shown, _BUDGET, dict.fromkeys(parts, ".2%")),
        ],
    )


def _bases(study: "Study") -> Section:
    spectra = study.spectra.assign(basis=study.spectra["basis"].map(NAMES))
    table = study.bases.assign(basis=study.bases["basis"].map(NAMES)).pivot_table(
        index=["basis", "set", "modes", "highest_hz"],
        columns="point",
        values="rms_error",
        sort=False,
    )
    points = [p for p in study.plan.points if p in table.columns]
    return Section(
        id="bases",
        title="Bases",
        text="Modes of the model reduced to its interface beside those of the full "
        "model (same: modes of the full model that the reduced one has in nearly the "
        "same shape), and linear responses against the direct transient, vertical "
        "acceleration, loads of one run.",
        blocks=[
            table_block(
                spectra,
                {
                    "basis": "basis",
                    "freedoms": "freedoms",
                    "below_hz": "below Hz",
                    "modes": "modes",
                    "same": "same",
                    "too_high": "frequency too high by, at most",
                },
                {"below_hz": "g", "too_high": ".1%"},
            ),
            table_block(
                table.reset_index(),
                {
                    "basis": "basis",
                    "set": "set",
                    "modes": "modes",
                    "highest_hz": "up to Hz",
                    **{p: p.replace("_", " ") for p in points},
                },
                {"highest_hz": ".0f"} | dict.fromkeys(points, ".2%"),
            ),
        ],
    )


def _gaps(study: "Study") -> Section:
    table = study.gaps.pivot_table(
        index=["practice", "modes"], columns="point", values="rms_error", sort=False
    )
    points = [p for p in study.plan.points if p in table.columns]
    return Section(
        id="gaps",
        title="What more modes do not close",
        text="The lowest modes of the full model against the transient, vertical "
        "acceleration, linear, loads of one run: as in this study; with modal damping "
        "that is not the projection of the transient's; with a longer step of the "
        "transient.",
        blocks=[
            table_block(
                table.reset_index(),
                {
                    "practice": "practice",
                    "modes": "modes",
                    **{p: p.replace("_", " ") for p in points},
                },
                dict.fromkeys(points, ".1%"),
            )
        ],
    )


def _costs(study: "Study") -> Section:
    runs = pd.DataFrame(
        [
            {
                "run": str(run.name),
                "steps": run.landing.steps,
                "seconds": run.landing.seconds,
            }
            for run in study.runs
        ]
    )
    stages = pd.DataFrame(
        {"stage": study.seconds.keys(), "seconds": study.seconds.values()}
    )
    return Section(
        id="costs",
        title="Cost",
        text="What an earlier study had computed came from the cache.",
        blocks=[
            table_block(
                stages,
                {"stage": "stage", "seconds": "wall time s"},
                {"seconds": ".1f"},
            ),
            table_block(
                runs,
                {"run": "landing", "steps": "steps", "seconds": "processor time s"},
                {"seconds": ".1f"},
            ),
        ],
    )

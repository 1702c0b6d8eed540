"""What a study says: the paper's findings, each with its number, true or not."""

import itertools
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from drake_landing.reference.studies.plan import NAMES, RunName

if TYPE_CHECKING:
    from drake_landing.reference.studies.runs import Study, StudyRun

# Difference (rms) at and below which a result is called sufficient: at 20 % the curves
# part visibly, at 5 % they coincide but for details.
SUFFICIENT = 0.20
CLOSED = 0.01
SIGNIFICANT = 2.0 / 3.0  # what is left of the largest error where modes gain
LOWEST = ("count", "below")  # selections by frequency
_FACTOR = 2.0


def key_figures(study: "Study") -> list[tuple[str, str]]:
    """Worst point of each kind of run."""
    figures = []
    for selection in study.plan.selections:
        rows = _vertical(study, selection=selection)
        worst = rows.loc[rows["rms_error"].idxmax()]
        place = f"{worst['point'].replace('_', ' ')}, topology {worst['topology']}"
        figures.append(
            (f"{_words(selection)}: rms", f"{worst['rms_error']:.1%} ({place})")
        )
    return figures[:9]


def findings(study: "Study") -> pd.DataFrame:
    """Columns finding, figures, holds."""
    rows = []
    plan = study.plan
    for topology in plan.topologies:
        for selection in plan.selections:
            table = _vertical(study, topology=topology, selection=selection)
            worst = float(table["rms_error"].max())
            peak = float(table["peak_error"].abs().max())
            told = ", ".join(
                f"{p.replace('_', ' ')} {e:.1%}"
                for p, e in zip(table["point"], table["rms_error"])
            )
            verdict = "insufficient" if worst > SUFFICIENT else "good"
            if max(worst, peak) <= CLOSED:
                verdict = "gap closed: rms and peak within 1 %"
            rows.append(
                (
                    f"topology {topology}, {_words(selection)}",
                    f"{told}; peak {peak:.1%}",
                    verdict,
                )
            )
    rows += _gains(study)
    rows += _halved(study)
    rows += _topologies(study)
    return pd.DataFrame(rows, columns=["finding", "figures", "holds"])


def _gains(study: "Study") -> list[tuple[str, str, str]]:
    """What more of the lowest modes bring, in the full and in the reduced model."""
    rows = []
    for topology in study.plan.topologies:
        of_basis: dict[str, list[StudyRun]] = {}
        for run in study.runs:
            if run.name.topology == topology and run.name.parsed.kind in LOWEST:
                of_basis.setdefault(run.name.basis, []).append(run)
        for basis, runs in of_basis.items():
            ordered = sorted(runs, key=lambda run: run.choice.count)
            for few, many in itertools.pairwise(ordered):
                a, b = (
                    _vertical(study, topology=topology, selection=run.name.selection)
                    for run in (few, many)
                )
                worst = float(b["rms_error"].max() / a["rms_error"].max())
                told = ", ".join(
                    f"{p.replace('_', ' ')} {x:.1%} to {y:.1%}"
                    for p, x, y in zip(a["point"], a["rms_error"], b["rms_error"])
                )
                rows.append(
                    (
                        f"topology {topology}, {NAMES[basis]}: {many.choice.count} "
                        f"modes gain over {few.choice.count}",
                        told,
                        "yes" if worst < SIGNIFICANT else "no significant gain",
                    )
                )
    return rows


def _halved(study: "Study") -> list[tuple[str, str, str]]:
    """Half the modes, made for the gears' pulses, against the 50 Hz set."""
    pairs = (("count 73", "pulses 36"), ("below 50 Hz", "pulses 47"))
    rows = []
    for topology in study.plan.topologies:
        for low, half in pairs:
            if not {low, half} <= set(study.plan.selections):
                continue
            a = _vertical(study, topology=topology, selection=low)["rms_error"]
            b = _vertical(study, topology=topology, selection=half)["rms_error"]
            told = ", ".join(f"{y:.2%} against {x:.2%}" for x, y in zip(a, b))
            rows.append(
                (
                    f"topology {topology}: {_words(half)} as good as {_words(low)}, "
                    "at every point",
                    told,
                    "yes" if (b.to_numpy() <= a.to_numpy()).all() else "no",
                )
            )
    return rows


def _topologies(study: "Study") -> list[tuple[str, str, str]]:
    """The second topology closer than the first at c.g. and wing tip."""
    if len(study.plan.topologies) < 2:
        return []
    first, second = study.plan.topologies[:2]
    rows = []
    for selection in study.plan.selections:
        if RunName(topology=first, selection=selection).parsed.kind not in LOWEST:
            continue
        one, two = (
            _vertical(study, topology=t, selection=selection).set_index("point")
            for t in (first, second)
        )
        for point in [p for p in study.plan.points if p in ("cg", "wing_tip_right")]:
            a = float(one["rms_error"][point])
            b = float(two["rms_error"][point])
            rows.append(
                (
                    f"topology {second} closer than {first}, "
                    f"{point.replace('_', ' ')}, {_words(selection)}",
                    f"{b:.2%} against {a:.2%}",
                    "yes" if b < a else "no",
                )
            )
    return rows


def estimate_quality(study: "Study") -> str:
    """How often the truncation error was foreseen within a factor of two."""
    table = study.budgets[study.budgets["point"].isin(study.plan.points)]
    ratio = (table["expected"] / table["truncated"]).to_numpy()
    good = (ratio <= _FACTOR) & (ratio >= 1.0 / _FACTOR)
    return (
        f"The error expected before any landing is within a factor of 2 of "
        f"the one found for {good.mean():.0%} of {len(ratio)} points and runs (ratio "
        f"{np.min(ratio):.2f} to {np.max(ratio):.2f})."
    )


def _words(selection: str) -> str:
    return RunName(topology="", selection=selection).words


def _vertical(study: "Study", **wanted: str) -> pd.DataFrame:
    table = study.measures
    keep = (table["axis"] == "z") & table["point"].isin(study.plan.points)
    for column, value in wanted.items():
        keep &= table[column] == value
    return table.loc[keep]

"""What a study says: the paper's findings, each with its number, true or not."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

if TYPE_CHECKING:
    from drake_landing.studies.study import Study

# Difference (rms) at and below which a result is called sufficient: at 20 % the curves
# part visibly, at 5 % they coincide but for details.
SUFFICIENT = 0.20
CLOSED = 0.01
_FACTOR = 2.0


def key_figures(study: "Study") -> list[tuple[str, str]]:
    """Worst point of each kind of run."""
    figures = []
    for selection in study.plan.selections:
        rows = _vertical(study, selection=selection)
        worst = rows.loc[rows["rms_error"].idxmax()]
        place = f"{worst['point'].replace('_', ' ')}, topology {worst['topology']}"
        figures.append((f"{selection}: rms", f"{worst['rms_error']:.1%} ({place})"))
    return figures[:7]


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
                    f"topology {topology}, {selection}",
                    f"{told}; peak {peak:.1%}",
                    verdict,
                )
            )
    rows += _halved(study)
    rows += _topologies(study)
    return pd.DataFrame(rows, columns=["finding", "figures", "holds"])


def _halved(study: "Study") -> list[tuple[str, str, str]]:
    """Half the modes, by relevance, against the 50 Hz set."""
    pairs = {("count 73", "relevance 36"), ("below 50 Hz", "relevance 46")}
    rows = []
    for topology in study.plan.topologies:
        for low, half in pairs:
            if not {low, half} <= set(study.plan.selections):
                continue
            a = _vertical(study, topology=topology, selection=low)["rms_error"].max()
            b = _vertical(study, topology=topology, selection=half)["rms_error"].max()
            rows.append(
                (
                    f"topology {topology}: {half} as good as {low}, worst point",
                    f"{b:.2%} against {a:.2%}",
                    "yes" if b <= a else "no",
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
        if not selection.startswith(("count", "below")):
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
                    f"{point.replace('_', ' ')}, {selection}",
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
        f"The truncation error expected before any landing is within a factor of 2 of "
        f"the one found for {good.mean():.0%} of {len(ratio)} points and runs (ratio "
        f"{np.min(ratio):.2f} to {np.max(ratio):.2f})."
    )


def _vertical(study: "Study", **wanted: str) -> pd.DataFrame:
    table = study.measures
    keep = (table["axis"] == "z") & table["point"].isin(study.plan.points)
    for column, value in wanted.items():
        keep &= table[column] == value
    return table.loc[keep]

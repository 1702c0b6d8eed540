"""Figures of a study in the paper's layout: multibody blue, direct transient red."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from drake_landing.reference.studies.plan import FULL_MODES, RunName
from drake_landing.report.svg_plots import (
    MULTIBODY,
    SERIES,
    TRANSIENT,
    curve,
    finish,
    legend,
    panels,
    svg,
)

if TYPE_CHECKING:
    from drake_landing.reference.studies.runs import Study, StudyRun


def _percent(share: float, _place: int | None = None) -> str:
    return f"{100.0 * share:g} %"


_ORDERS = {  # order of a selection -> label, line, colour
    "guyan": ("lowest modes, Guyan", "--", SERIES[1]),
    "craig-bampton": ("lowest modes, Craig-Bampton", "--", SERIES[4]),
    "lowest": ("lowest modes, full model", ":", SERIES[3]),
    "relevance": ("most relevant modes", "-", SERIES[2]),
    "pulses": ("combined for pulses", "-", SERIES[0]),
}


def accelerations(study: "Study", run: "StudyRun") -> str:
    """Vertical acceleration of the four points of the paper."""
    points = study.plan.points
    with panels(-(-len(points) // 2), 2, height=2.2) as (figure, grid):
        places = [axes for row in grid for axes in row]
        for i, (axes, point) in enumerate(zip(places, points)):
            _both(axes, study, run, point)
            last = "time, s" if i >= len(points) - 2 else None
            finish(axes, point.replace("_", " "), "m/s²", x=last)
        legend(figure, places[0])
        return svg(figure, f"vertical accelerations, {run.name}")


def _both(axes: Axes, study: "Study", run: "StudyRun", point: str) -> None:
    """The transient as a broad line: it is seen where the multibody run covers it."""
    p = study.points.index(point)
    transient, multibody = run.transient[:, p, 2], run.landing.acceleration[:, p, 2]
    curve(axes, run.time, transient, TRANSIENT, "direct transient")
    axes.lines[-1].set_linewidth(2.6)
    curve(axes, run.time, multibody, MULTIBODY, "multibody")
    axes.lines[-1].set_linewidth(1.0)


def many_runs(study: "Study", runs: Sequence["StudyRun"]) -> str:
    """Vertical acceleration, a row for each run, a column for each point."""
    points = study.plan.points
    with panels(len(runs), len(points), height=1.45) as (figure, grid):
        for row, run in zip(grid, runs):
            for axes, point in zip(row, points):
                _both(axes, study, run, point)
                last = "time, s" if run is runs[-1] else None
                title = f"{point.replace('_', ' ')}, m/s²" if run is runs[0] else ""
                finish(axes, title, "", x=last)
            row[0].set_ylabel(_row_name(run))
        for column in zip(*grid):
            low, high = zip(*(axes.get_ylim() for axes in column))
            for axes in column:
                axes.set_ylim(min(low), max(high))
        legend(figure, grid[0][0])
        return svg(figure, f"vertical accelerations, {', '.join(map(_label, runs))}")


def _label(run: "StudyRun") -> str:
    return str(run.name)


def _row_name(run: "StudyRun") -> str:
    """Two short lines."""
    count = run.choice.count
    if count == 0:
        return "rigid"
    kind = run.name.parsed.kind
    if kind not in ("relevance", "pulses"):
        kind = f"to {run.choice.highest_hz:.0f} Hz"
    return f"{count} modes\n{kind}"


def convergence(study: "Study") -> str:
    """Error over the number of modes, a panel for each point and topology."""
    topologies, points = list(study.airframes), study.plan.points
    columns = -(-len(points) // 2)
    with panels(2 * len(topologies), columns, height=2.4) as (figure, grid):
        places = iter([axes for row in grid for axes in row])
        for topology in topologies:
            for point in points:
                axes = next(places)
                table = study.convergence
                of_point = table[
                    (table["topology"] == topology) & (table["point"] == point)
                ]
                for order, (label, style, color) in _ORDERS.items():
                    rows = of_point[of_point["order"] == order]
                    if len(rows):
                        axes.plot(
                            rows["modes"],
                            rows["rms_error"],
                            style,
                            color=color,
                            label=label,
                        )
                _mark_runs(axes, study, topology, point)
                axes.set_yscale("log")
                axes.set_xscale("log")
                axes.set_ylim(1e-3, 2.0)
                axes.axhline(0.01, color="#8a94a3", linewidth=0.8)
                axes.yaxis.set_major_formatter(_percent)
                axes.set_xticks([5, 10, 20, 50, 100, 200, 500])
                axes.xaxis.set_major_formatter("{x:g}")
                axes.xaxis.minorticks_off()
                where = f", topology {topology}" if len(topologies) > 1 else ""
                axes.set_title(point.replace("_", " ") + where)
                axes.set_ylabel("rms difference")
        for axes in grid[-1]:
            axes.set_xlabel("number of elastic modes")
        handles, labels = grid[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=3)
        return svg(figure, "convergence over the number of modes")


def _mark_runs(axes: Axes, study: "Study", topology: str, point: str) -> None:
    """Whole runs, multibody against direct transient."""
    table = study.measures
    rows = table[
        (table["topology"] == topology)
        & (table["point"] == point)
        & (table["axis"] == "z")
        & (table["modes"] > 0)
    ]
    for row in rows.to_dict("records"):
        name = RunName(topology=topology, selection=str(row["selection"]))
        kind = name.parsed.kind
        order = kind if kind in _ORDERS else "lowest"
        if name.basis != FULL_MODES:
            order = name.basis
        color = _ORDERS[order][2]
        axes.plot(row["modes"], row["rms_error"], "o", color=color, markersize=4.5)


def budget_bars(study: "Study", topology: str) -> str:
    """Parts of the difference, run by run, for each point."""
    from drake_landing.reference.studies.study_tables import BUDGET

    points = study.plan.points
    rows = -(-len(points) // 2)
    budgets = study.budgets[study.budgets["topology"] == topology]
    with panels(rows, 2, height=2.6) as (figure, grid):
        places = [axes for row in grid for axes in row]
        for axes, point in zip(places, points):
            table = budgets[budgets["point"] == point]
            at = np.arange(len(table))
            for k, (part, color) in enumerate(zip((*BUDGET, "feedback"), SERIES)):
                axes.bar(
                    at + 0.14 * (k - 2.5), table[part], 0.13, color=color, label=part
                )
            axes.set_yscale("log")
            axes.set_ylim(1e-4, 1.0)
            axes.yaxis.set_major_formatter(_percent)
            axes.set_title(point.replace("_", " "))
            axes.set_xticks(at, [_short(r) for r in table.to_dict("records")])
            axes.tick_params(axis="x", labelsize=7, labelrotation=30)
            axes.grid(axis="x", visible=False)
        handles, labels = places[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper right", ncols=6)
        return svg(figure, f"error budget, topology {topology}")


def _short(row: dict) -> str:
    words = {"relevance": "relevance ", "pulses": "pulses ", "guyan": "Guyan "}
    kind = words.get(str(row["selection"]).split()[0], "lowest ")
    return f"{kind}{row['modes']}"

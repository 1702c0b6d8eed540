"""Figures of a study in the paper's layout: multibody blue, direct transient red."""

from typing import TYPE_CHECKING

import numpy as np

from drake_landing.report.plots import (
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
    from drake_landing.studies.study import Study, StudyRun


def accelerations(study: "Study", run: "StudyRun") -> str:
    """Vertical acceleration of the four points of the paper."""
    points = study.plan.points
    with panels(-(-len(points) // 2), 2, height=2.2) as (figure, grid):
        places = [axes for row in grid for axes in row]
        for i, (axes, point) in enumerate(zip(places, points)):
            p = study.points.index(point)
            curve(axes, run.time, run.transient[:, p, 2], TRANSIENT, "direct transient")
            curve(
                axes,
                run.time,
                run.landing.acceleration[:, p, 2],
                MULTIBODY,
                "multibody",
            )
            last = "time, s" if i >= len(points) - 2 else None
            finish(axes, point.replace("_", " "), "m/s²", x=last)
        legend(figure, places[0])
        return svg(figure, f"vertical accelerations, {run.name}")


def convergence(study: "Study") -> str:
    """Error over the number of modes: lowest modes, and the most relevant ones."""
    topologies = list(study.airframes)
    with panels(1, len(topologies), height=3.4) as (figure, grid):
        for axes, topology in zip(grid[0], topologies):
            of_topology = study.convergence[study.convergence["topology"] == topology]
            for color, point in zip(SERIES, study.plan.points):
                one = of_topology[of_topology["point"] == point]
                for order, style in (("lowest", ":"), ("relevance", "-")):
                    rows = one[one["order"] == order]
                    axes.plot(
                        rows["modes"],
                        rows["rms_error"],
                        style,
                        color=color,
                        label=f"{point.replace('_', ' ')}, {order}",
                    )
                _mark_runs(axes, study, topology, point, color)
            axes.set_yscale("log")
            axes.set_xscale("log")
            axes.set_ylim(2e-3, 2.0)
            axes.axhline(0.01, color="#8a94a3", linewidth=0.8)
            axes.yaxis.set_major_formatter("{x:.1%}")
            axes.set_xticks([5, 10, 20, 50, 100, 200, 500])
            axes.xaxis.set_major_formatter("{x:g}")
            axes.xaxis.minorticks_off()
            axes.set_title(f"rms difference, topology {topology}")
            axes.set_xlabel("number of elastic modes")
        handles, labels = grid[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=4)
        return svg(figure, "convergence over the number of modes")


def _mark_runs(axes, study: "Study", topology: str, point: str, color: str) -> None:
    """Whole runs, multibody against direct transient, as dots."""
    table = study.measures
    rows = table[
        (table["topology"] == topology)
        & (table["point"] == point)
        & (table["axis"] == "z")
        & (table["modes"] > 0)
    ]
    marks = {"count": "o", "below": "o", "relevance": "o", "pulses": "D"}
    for kind, mark in marks.items():
        some = rows[rows["selection"].str.startswith(kind)]
        fill = "none" if kind in ("count", "below") else color
        axes.plot(
            some["modes"], some["rms_error"], mark, color=color, markerfacecolor=fill
        )


def budget_bars(study: "Study") -> str:
    """Parts of the difference, run by run, for each point."""
    from drake_landing.studies.tables import BUDGET

    points = study.plan.points
    rows = -(-len(points) // 2)
    with panels(rows, 2, height=2.6) as (figure, grid):
        places = [axes for row in grid for axes in row]
        for axes, point in zip(places, points):
            table = study.budgets[study.budgets["point"] == point]
            at = np.arange(len(table))
            for k, (part, color) in enumerate(zip((*BUDGET, "feedback"), SERIES)):
                axes.bar(
                    at + 0.16 * (k - 2), table[part], 0.15, color=color, label=part
                )
            axes.set_yscale("log")
            axes.set_ylim(1e-4, 1.0)
            axes.yaxis.set_major_formatter("{x:.2%}")
            axes.set_title(point.replace("_", " "))
            axes.set_xticks(at, [_short(r) for r in table.to_dict("records")])
            axes.tick_params(axis="x", labelsize=7, labelbottom=True)
            axes.grid(axis="x", visible=False)
        handles, labels = places[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper right", ncols=5)
        return svg(figure, "error budget")


def _short(row: dict) -> str:
    words = {"relevance": "rel.", "pulses": "pulse "}
    kind = words.get(str(row["selection"]).split()[0], "")
    return f"T{row['topology'][:1]}\n{kind}{row['modes']}"

"""The pictures of one run: gear loads, struts and tires, accelerations, energy."""

from collections.abc import Iterable, Mapping

import numpy as np
import numpy.typing as npt
import pandas as pd

from drake_landing.landing.history import ATTACHMENT, UNITS, LandingHistory
from drake_landing.report.svg_plots import (
    INK,
    MULTIBODY,
    SERIES,
    TRANSIENT,
    common_scale,
    curve,
    finish,
    legend,
    panels,
    svg,
)

Float64 = npt.NDArray[np.float64]

_ACROSS = 3  # panels side by side


def attachment_loads(history: LandingHistory) -> str:
    """Forces and moments of each gear on the airframe, components in B."""
    gears = list(history.attachment)
    kinds = (ATTACHMENT[:3], ATTACHMENT[3:])
    scales = [
        common_scale(
            [t[n] for t in history.attachment.values() for n in k], UNITS[k[0]]
        )
        for k in kinds
    ]
    pictures = []
    for group in _groups(gears):
        with panels(2, len(group), height=2.2) as (figure, grid):
            for column, gear in enumerate(group):
                table = history.attachment[gear]
                for row, (names, (factor, unit)) in enumerate(zip(kinds, scales)):
                    axes = grid[row][column]
                    for name, color in zip(names, SERIES):
                        values = factor * table[name]
                        curve(axes, table.index, values, color, name[1])
                    what = "force" if row == 0 else "moment"
                    last = "time, s" if row == 1 else None
                    finish(axes, f"{words(gear)}: {what}", unit, x=last)
            legend(figure, grid[0][0])
            pictures.append(svg(figure, f"attachment loads of {', '.join(group)}"))
    return "\n".join(pictures)


def struts_and_tires(history: LandingHistory) -> str:
    """Stroke, force over stroke, tire loads per gear, wheel speed."""
    gears = list(history.strut)
    with panels(2, 2, height=2.4) as (figure, grid):
        (stroke, vertical), (drag, spin) = grid
        for name, axes, series in (
            ("stroke", stroke, {g: history.strut[g]["stroke"] for g in gears}),
            ("vertical", vertical, {g: history.leg(g, "vertical") for g in gears}),
            ("drag", drag, {g: history.leg(g, "drag") for g in gears}),
            ("spin", spin, {g: _mean_spin(history, g) for g in gears}),
        ):
            factor, unit = common_scale(list(series.values()), UNITS[name])
            for i, (gear, values) in enumerate(series.items()):
                curve(
                    axes,
                    values.index,
                    factor * values,
                    SERIES[i % len(SERIES)],
                    words(gear),
                    dashed=repeats(series, gear),
                )
            titles = {
                "stroke": "Shock-absorber stroke",
                "vertical": "Vertical tire load per gear",
                "drag": "Tire drag per gear",
                "spin": "Wheel speed, mean of the gear's wheels",
            }
            last = "time, s" if name in ("drag", "spin") else None
            finish(axes, titles[name], unit, x=last)
        legend(figure, stroke)
        return svg(figure, "strokes, tire loads and wheel speeds")


def force_over_stroke(history: LandingHistory) -> str:
    """The loop of each shock absorber; its area is the energy it takes."""
    gears = list(history.strut)
    factor, unit = common_scale([t["force"] for t in history.strut.values()], "N")
    pictures = []
    for group in _groups(gears):
        with panels(1, len(group), height=2.3) as (figure, grid):
            for i, gear in enumerate(group):
                table, axes = history.strut[gear], grid[0][i]
                curve(axes, table["stroke"], factor * table["force"], SERIES[i])
                finish(axes, f"{words(gear)}: shock absorber", unit, x="stroke, m")
            pictures.append(svg(figure, f"force over stroke of {', '.join(group)}"))
    return "\n".join(pictures)


def accelerations(
    point: str, multibody: pd.DataFrame, transient: pd.DataFrame, floor: float
) -> str:
    """Both histories of one monitoring point, one panel per axis that moves.

    Args:
        point: name of the point.
        multibody, transient: columns x, y, z over time, m/s².
        floor: components whose reference never exceeds it are zero by symmetry.
    """
    moving = [a for a in "xyz" if transient[a].abs().max() > floor]
    if not moving:
        return ""
    with panels(1, len(moving), height=2.5) as (figure, grid):
        for i, axis in enumerate(moving):
            axes = grid[0][i]
            curve(axes, transient.index, transient[axis], TRANSIENT, "direct transient")
            curve(axes, multibody.index, multibody[axis], MULTIBODY, "multibody")
            finish(axes, f"{words(point)}, {axis}", "m/s²")
        legend(figure, grid[0][0])
        return svg(figure, f"acceleration of {point}")


def spectra(
    frequency: Float64,
    multibody: dict[str, Float64],
    transient: dict[str, Float64],
    axis: str,
) -> str:
    """Shock response spectra of the vertical acceleration, point by point.

    Args:
        frequency: (f,) of the oscillators, Hz.
        multibody, transient: point -> (f,) m/s².
        axis: of the deck, along which the points shake.
    """
    rows = -(-len(transient) // 2)
    with panels(rows, 2, height=2.3) as (figure, grid):
        places = [axes for row in grid for axes in row]
        for i, (axes, point) in enumerate(zip(places, transient)):
            curve(axes, frequency, transient[point], TRANSIENT, "direct transient")
            curve(axes, frequency, multibody[point], MULTIBODY, "multibody")
            axes.set_xscale("log")
            axes.set_xticks([2, 5, 10, 20, 50, 100, 200])
            axes.xaxis.set_major_formatter("{x:g}")
            axes.xaxis.minorticks_off()
            below = i + 2 >= len(transient)
            label = "frequency of the oscillator, Hz" if below else None
            finish(axes, f"{words(point)}, {axis}", "m/s²", x=label)
            axes.tick_params(labelbottom=below)
        for axes in places[len(transient) :]:
            axes.set_visible(False)
        legend(figure, places[0])
        return svg(figure, "shock response spectra")


def energy(history: LandingHistory) -> str:
    """Changes of the parts, and what their sum misses, over the sink energy."""
    table = history.energy
    parts = [c for c in table.columns if c != "balance"]
    change = table[parts] - table[parts].iloc[0]
    factor, unit = common_scale([change[c] for c in parts], "J")
    with panels(1, 2, height=2.6) as (figure, grid):
        shares, rest = grid[0]
        for color, part in zip(SERIES, parts):
            label = part.replace("tyre", "tire")  # the name in the result file
            curve(shares, change.index, factor * change[part], color, label)
        finish(shares, "Change of energy since the start", unit)
        sink = history.figures["sink_energy"]
        curve(rest, table.index, table["balance"] / sink, INK)
        finish(rest, "Sum of all changes over the sink energy", "")
        rest.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3))
        legend(figure, shares)
        return svg(figure, "energy audit")


def words(name: str) -> str:
    """`main_left` as it is said."""
    return name.replace("_", " ")


def _groups(names: list[str]) -> Iterable[list[str]]:
    return (names[i : i + _ACROSS] for i in range(0, len(names), _ACROSS))


def _mean_spin(history: LandingHistory, gear: str) -> pd.Series:
    return history.leg(gear, "spin") / len(history.wheels[gear])


def repeats(series: Mapping[str, pd.Series] | pd.DataFrame, name: str) -> bool:
    """Whether an earlier series is nearly the same: its curve would hide this one."""
    size = max(float(series[name].abs().max()), 1e-12)
    for other, values in series.items():
        if other == name:
            return False
        if float((values - series[name]).abs().max()) < 0.02 * size:
            return True
    return False

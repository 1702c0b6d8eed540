"""Pictures of what the parts see: stresses, section loads, floor, panels, practices."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pandas as pd
from matplotlib.axes import Axes

from drake_landing.parts.cuts import NAMED, BeamCuts
from drake_landing.parts.observers import PartsFound
from drake_landing.report.svg_plots import (
    INK,
    MULTIBODY,
    SERIES,
    TRANSIENT,
    common_scale,
    curve,
    finish,
    head,
    legend,
    panels,
    svg,
)
from drake_landing.transient.practices import HYBRID, RIGID, STATIC, Practices

Float64 = npt.NDArray[np.float64]

_UNITS = {"shear": "N", "bending": "N m", "torsion": "N m"}
_ROUNDING = 1e-5
_SAID = {"acceleration": "acceleration, ", "section load": "", "stress": "stress, "}
_PRACTICE = {HYBRID: TRANSIENT, RIGID: MULTIBODY, STATIC: INK}


def stress_bars(components: pd.DataFrame) -> str:
    """Largest equivalent stress of each component, and the share of the allowable.

    Args:
        components: of `tables.component_table`.
    """
    rows = components.sort_values("equivalent")
    place = np.arange(len(rows))
    with panels(1, 1, height=0.6 + 0.24 * len(rows)) as (figure, grid):
        axes = grid[0][0]
        stress = rows.equivalent.to_numpy() / 1e6
        axes.barh(place, stress, color=SERIES[5], height=0.62, zorder=2)
        top = stress.max(initial=1.0)
        for k, (value, margin) in enumerate(zip(stress, rows.margin)):
            note = f"{value:.0f}" if value >= 10 else f"{value:.1f}"
            known = "" if np.isnan(margin) else f"   margin {_signed(margin)}"
            axes.text(value + 0.008 * top, k, note + known, va="center", size=8)
        axes.set_yticks(place, rows.component)
        axes.grid(axis="y", visible=False)
        axes.set_xlim(0.0, 1.22 * top)
        axes.set_title("Largest equivalent stress of each component, MPa")
        return svg(figure, "stress by component")


@dataclass(frozen=True)
class Diagrams:
    """Section loads that are drawn beside each other.

    Attributes:
        names: shear, bending, ...
        units: N or N m of each.
        of: the loads (t, ..., k) from section loads (t, ..., 6) of cuts.
    """

    names: Sequence[str]
    units: Sequence[str]
    of: Callable[[Float64], Float64]

    @classmethod
    def main(cls, cuts: BeamCuts) -> "Diagrams":
        """Shear upward, bending of the outer end upward, torsion."""
        return cls(NAMED, [_UNITS[name] for name in NAMED], cuts.named)

    @classmethod
    def sideways(cls, cuts: BeamCuts) -> "Diagrams":
        """Shear and bending aft, of fuselages to starboard."""
        return cls(cuts.beam.sideways, ["N", "N m"], cuts.along_side)


def section_envelopes(
    cuts: BeamCuts, time: Float64, loads: Float64, instant: int, drawn: Diagrams
) -> str:
    """Extremes of section loads along a beam, and the loads at an instant.

    Args:
        cuts: of the beam.
        time: (t,) s.
        loads: (t, n, 6) section loads.
        instant: row of the time that is drawn as a line.
        drawn: which of them.
    """
    named = _without_rounding(drawn.of(loads))
    beam = cuts.beam
    shown = _shown(named)
    with panels(1, len(shown), height=2.6) as (figure, grid):
        for axes, q in zip(grid[0], shown):
            quantity, values = drawn.names[q], named[..., q]
            factor, unit = common_scale([values], drawn.units[q])
            low, high = factor * values.min(axis=0), factor * values.max(axis=0)
            axes.fill_between(
                beam.stations, low, high, color=TRANSIENT, alpha=0.16, linewidth=0
            )
            for edge in (low, high):
                axes.plot(beam.stations, edge, color=TRANSIENT, marker="o", ms=2.2)
            label, then = f"at {time[instant]:.3f} s", factor * values[instant]
            curve(axes, beam.stations, then, INK, label, dashed=True)
            finish(axes, quantity, unit, x=f"cut at {beam.axis} of the deck, m")
        head(figure, f"{beam.name}: along the part")
        legend(figure, grid[0][0])
        said = ", ".join(drawn.names[q] for q in shown)
        return svg(figure, f"section loads along the {beam.name}: {said}")


def root_histories(
    cuts: BeamCuts, found: PartsFound, practices: Practices | None, drawn: Diagrams
) -> str:
    """Section loads over time at one cut, with those of the other practices."""
    name = cuts.beam.name
    at = found.looked_at[name]
    where = f"{cuts.beam.axis} = {cuts.beam.stations[at]:z.2f} m"
    cases = list(zip((HYBRID, RIGID), found.cases))
    roots = [
        _without_rounding(drawn.of(case.sections[name][:, at])) for _, case in cases
    ]
    shown = _shown(np.stack(roots))
    with panels(1, len(shown), height=2.5) as (figure, grid):
        for axes, q in zip(grid[0], shown):
            quantity, histories = drawn.names[q], [root[:, q] for root in roots]
            factor, unit = common_scale(histories, drawn.units[q])
            for (practice, _), values in reversed(list(zip(cases, histories))):
                label = practice if practices else "direct transient"
                curve(axes, found.time, factor * values, _PRACTICE[practice], label)
            if practices:
                of = drawn.of(practices.slices.sections[name][:, at])[:, q]
                axes.plot(
                    practices.slices.time,
                    factor * of,
                    linestyle="",
                    marker="D",
                    ms=4,
                    color=INK,
                    label=STATIC,
                )
            finish(axes, quantity, unit)
            axes.set_xlim(found.time[0], found.time[-1])
        head(figure, f"{_part(name, where)}: over time")
        legend(figure, grid[0][0])
        said = ", ".join(drawn.names[q] for q in shown)
        return svg(figure, f"section loads over time, {name}: {said}")


def _part(name: str, where: str) -> str:
    """Name and cut, once where a part is named by its cut."""
    return name if where in name else f"{name}, cut at {where}"


def _without_rounding(named: Float64) -> Float64:
    """Loads (..., k) that are nought by symmetry without what rounding left there."""
    size = np.abs(named).reshape(-1, named.shape[-1]).max(axis=0)
    # Shear in N and moments in N m of one beam: of one order, some metres apart.
    return np.where(size > _ROUNDING * size.max(), named, 0.0)


def _shown(named: Float64) -> list[int]:
    """Loads (..., k) worth a diagram: those that are not nought by symmetry."""
    return [q for q in range(named.shape[-1]) if np.any(named[..., q])] or [0]


def panel(found: PartsFound, at: int, axis: int) -> str:
    """Acceleration of a panel's middle beside that of its frames.

    Args:
        found: what the parts see.
        at: which of the panels.
        axis: 0, 1, 2: across the panel, B.
    """
    place = found.places.panels[at]
    motion = found.landing.acceleration
    middle = motion[place.grid][:, axis]
    beside = np.mean([motion[g][:, axis] for g in place.beside], axis=0)
    with panels(1, 2, height=2.3) as (figure, grid):
        both, relative = grid[0]
        curve(both, found.time, middle, TRANSIENT, "between the frames")
        curve(both, found.time, beside, INK, "on the frames, mean")
        finish(both, f"{place.name.split(' between')[0]}, {'xyz'[axis]}", "m/s²")
        curve(relative, found.time, middle - beside, SERIES[0], "difference")
        finish(relative, "middle less frames", "m/s²")
        legend(figure, both)
        return svg(figure, f"panel {place.name}")


def equipment(
    histories: Mapping[str, pd.DataFrame],
    frequency: Float64,
    spectra: Mapping[str, Float64],
    title: str,
    axis: str,
) -> str:
    """Vertical accelerations of some places, and their shock response spectra.

    Args:
        histories: place -> columns x, y, z over time, m/s².
        frequency: (f,) Hz.
        spectra: place -> (f,) m/s².
        title: what the places have in common.
        axis: of the deck, the vertical one.
    """
    with panels(1, 2, height=2.2, shared=False) as (figure, grid):
        motion, response = grid[0]
        for color, name in zip((TRANSIENT, MULTIBODY, *SERIES), histories):
            values, label = histories[name][axis], name.split(",")[0]
            label = label.replace("_", " ")
            curve(motion, values.index, values, color, label)
            curve(response, frequency, spectra[name], color)
        finish(motion, f"{title}: acceleration, {axis}", "m/s²")
        finish(response, "shock response spectrum", "m/s²", x="frequency, Hz")
        response.set_xscale("log")
        response.set_xticks([2, 5, 10, 20, 50, 100, 200])
        response.xaxis.set_major_formatter("{x:g}")
        response.xaxis.minorticks_off()
        legend(figure, motion)
        return svg(figure, f"floor accelerations {title}")


def practice_errors(practices: Practices) -> str:
    """Errors of the other practices against the hybrid process, each quantity."""
    table = practices.table
    quantities = list(dict.fromkeys(zip(table.kind, table.quantity)))
    # A gap between the kinds.
    gaps = np.cumsum([0, *(a[0] != b[0] for a, b in pairwise(quantities))])
    place = -(np.arange(len(quantities)) + gaps).astype(float)
    with panels(1, 1, height=0.6 + 0.26 * len(quantities)) as (figure, grid):
        axes = grid[0][0]
        for practice, shift in ((RIGID, 0.17), (STATIC, -0.17)):
            rows = table[table.practice == practice].set_index(["kind", "quantity"])
            error = np.array([rows.error[q] for q in quantities])
            _bars(axes, place + shift, 100 * error, _PRACTICE[practice], practice)
        labels = [f"{_SAID[kind]}{quantity}" for kind, quantity in quantities]
        axes.set_yticks(place, labels)
        axes.grid(axis="y", visible=False)
        axes.axvline(0.0, color=INK, linewidth=0.8)
        axes.set_ylim(place[-1] - 0.7, 0.7)
        axes.set_title("Peak against that of the hybrid process, %")
        legend(figure, axes)
        return svg(figure, "errors of the practices")


def _bars(axes: Axes, place: Float64, values: Float64, color: str, label: str) -> None:
    axes.barh(place, values, height=0.32, color=color, label=label, zorder=2)


def _signed(margin: float) -> str:
    return f"{margin:+.1f}" if margin < 10 else "> 10"

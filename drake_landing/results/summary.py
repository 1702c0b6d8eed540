"""A run in one sentence and five figures."""

from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from drake_landing.case.axes import axis_words
from drake_landing.results.truncation import peaks_below

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult


def story(result: "ProcessResult") -> str:
    """One sentence on what was done."""
    body, scenario = result.airframe.body, result.aircraft.scenario
    mass = body.mass + sum(gear.mass for gear in result.aircraft.gears)
    return (
        f"{result.aircraft.name}, {mass / 1e3:.1f} t, "
        f"{scenario.story}: "
        f"{len(result.aircraft.gears)} gears on a multibody airframe with "
        f"{mode_count(result)}, then the attachment loads on the "
        f"full model of {result.airframe.grids} grids over "
        f"{result.loads.time[-1]:.2f} s."
    )


def mode_count(result: "ProcessResult") -> str:
    """E.g. `73 elastic modes`."""
    n = result.airframe.body.n
    return f"{n} elastic mode{'' if n == 1 else 's'}"


def key_figures(result: "ProcessResult") -> list[tuple[str, str]]:
    """The five most useful numbers of a run, as text."""
    gears = result.gears.set_index("quantity")
    tire, drag, stroke = (
        _largest(gears.loc[[quantity]])
        for quantity in ("tyre_vertical", "tyre_drag", "stroke")
    )
    return [
        ("largest vertical tire load of a gear", _at(tire, 1e-3, "kN", ".1f")),
        ("largest spin-up drag of a gear", _at(drag, 1e-3, "kN", ".1f")),
        ("largest stroke", _at(stroke, 1.0, "m", ".3f")),
        ("highest acceleration", _acceleration(result)),
        ("multibody against direct transient", _difference(result)),
    ]


def _largest(table: pd.DataFrame) -> pd.Series:
    return table.iloc[int(np.argmax(table["peak"].abs().to_numpy()))]


def _at(row: pd.Series, factor: float, unit: str, spec: str) -> str:
    gear = str(row["gear"]).replace("_", " ")
    return f"{factor * row['peak']:z{spec}} {unit} ({gear}, {row['time']:.3f} s)"


def _acceleration(result: "ProcessResult") -> str:
    """Raw, without what lies above the last mode, and of the multibody model."""
    comparison = result.comparison
    row = comparison.iloc[int(np.argmax(comparison["peak_fe"].to_numpy()))]
    way = axis_words(result.airframe.R_AB)[str(row["axis"])]
    where = f"{str(row['point']).replace('_', ' ')}, along {row['axis']}: {way}"
    low = peaks_below(result).set_index(["point", "axis"]).peak_low
    below = f"low-passed at {result.airframe.highest_hz:.0f} Hz:"
    return (
        f"{row['peak_fe']:z.2f} m/s² ({where}; {below} "
        f"{low.loc[(row['point'], row['axis'])]:.2f}; multibody: "
        f"{row['peak_mbs']:z.2f} m/s²)"
    )


def _difference(result: "ProcessResult") -> str:
    """Difference of the vertical accelerations, or of all where none is vertical."""
    comparison = result.comparison
    vertical = comparison[comparison["axis"] == result.vertical].dropna(
        subset="rms_error"
    )
    errors = (vertical if len(vertical) else comparison.dropna())["rms_error"]
    if errors.empty:
        return "nothing moves"
    low, high = errors.min(), errors.max()
    return f"rms {low:.1%} to {high:.1%} (vertical accelerations, all points)"


def time_taken(result: "ProcessResult") -> list[str]:
    """Lines of a table: time, share and memory of each stage."""
    table = result.stages.table()
    width = max(map(len, table.stage))
    head = f"{'':<{width}}      wall  share  processor  peak memory"
    return [head] + [
        f"{row.stage:<{width}}  {row.wall:6.1f} s  {row.share:5.0%}  "
        f"{row.processor:7.1f} s  {row.memory_gb:8.2f} GB"
        for row in table.itertuples()
    ]

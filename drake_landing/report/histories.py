"""histories.html: the histories to be hovered, zoomed and compared, in one file.

All panels have one time axis: zooming one zooms all, and a cursor goes through all.
The report has the same as pictures, for print.
"""

import json
from collections.abc import Iterator
from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd
from jinja2 import Environment, StrictUndefined

from drake_landing.case.axes import deck_axes
from drake_landing.landing.history import UNITS
from drake_landing.parts.tables import root_histories
from drake_landing.report.figures import repeats, words
from drake_landing.results.units import unit_of
from fem.arrays import Float64
from fem.files.atomic import write_aside

if TYPE_CHECKING:
    from drake_landing.results.result import ProcessResult

_BYTES = 900_000  # of all numbers; the library takes 4.8 MB of the 6 that are allowed
_PER_POINT = 15  # bytes
_MOST = 2000  # points of a curve


def write_histories(path: Path, result: "ProcessResult") -> None:
    """Writes the page.

    Args:
        path: of the file.
        result: of the run.
    """
    from plotly.offline import get_plotlyjs

    panels = list(_panels(result))
    count = sum(len(table.columns) for _, _, table in panels)
    points = int(np.clip(_BYTES / (_PER_POINT * max(count, 1)), 100, _MOST))
    data = [
        {
            "title": title,
            "unit": unit,
            "curves": [
                {
                    "name": str(c),
                    "dash": "dash" if repeats(table, c) else "solid",
                    **_curve(table.index.to_numpy(), table[c], points),
                }
                for c in table.columns
            ],
        }
        for title, unit, table in panels
    ]
    folder = files("drake_landing.report")
    environment = Environment(autoescape=True, undefined=StrictUndefined)
    template = environment.from_string(
        folder.joinpath("histories.html.j2").read_text(encoding="utf-8")
    )
    text = template.render(
        title=result.case.title or result.case.name,
        axes=deck_axes(result.airframe.R_AB),
        library=get_plotlyjs(),
        # Nothing in the names may end the script.
        data=json.dumps(data, separators=(",", ":")).replace("<", "\\u003c"),
    )
    write_aside(path, lambda to: to.write_text(text, encoding="utf-8") and None)


def thinned(values: Float64, points: int) -> np.ndarray:
    """Rows of a history to draw: the least and the largest of each stretch.

    Args:
        values: (t,).
        points: to keep at most; extremes stay.
    """
    if len(values) <= points:
        return np.arange(len(values))
    bounds = np.linspace(0, len(values), points // 2 + 1).astype(int)
    rows = {0, len(values) - 1}
    for a, b in pairwise(bounds.tolist()):
        part = values[a:b]
        rows |= {a + int(part.argmin()), a + int(part.argmax())}
    return np.array(sorted(rows))


def _curve(time: Float64, values: pd.Series, points: int) -> dict[str, list[float]]:
    y = values.to_numpy(float)
    rows = thinned(y, points - 2)
    return {
        "x": [round(float(t), 4) for t in time[rows]],
        "y": [float(f"{v:.5g}") for v in y[rows]],
    }


def _panels(result: "ProcessResult") -> Iterator[tuple[str, str, pd.DataFrame]]:
    """Title, unit, curves over time."""
    history = result.history
    gears = list(history.strut)
    for column, title in (
        ("vertical", "Vertical tire load per gear, of the runway"),
        ("drag", "Tire drag per gear, of the runway, aft"),
    ):
        legs = {words(g): history.leg(g, column) for g in gears}
        yield title, UNITS[column], pd.DataFrame(legs)
    strokes = {words(g): history.strut[g]["stroke"] for g in gears}
    yield "Shock-absorber stroke", "m", pd.DataFrame(strokes)
    for names, what in ((["fx", "fy", "fz"], "force"), (["mx", "my", "mz"], "moment")):
        for gear, table in history.attachment.items():
            own = pd.DataFrame(table[names]).add_prefix(f"{words(gear)} ")
            title = f"{words(gear)}: {what} on the airframe at the attachment node"
            yield title, UNITS[names[0]], own
    roots = root_histories(result.parts)
    for quantity in ("shear", "bending", "torsion"):
        own = pd.DataFrame(roots[[c for c in roots if str(c).endswith(quantity)]])
        if len(own.columns):
            title = f"Section loads: {quantity} at the cuts of the report"
            yield title, unit_of(quantity), own
    for point, table in result.response.items():
        both = [
            table.add_suffix(" direct transient"),
            result.multibody_on_grid[point].add_suffix(" multibody"),
        ]
        title = f"{words(point)}: acceleration"
        yield title, "m/s²", pd.concat(both, axis="columns")
